//! Generated models and moving scenes for tests and benchmarks of distance and collision queries.
//!
//! The robotics models and the three scenes are *reconstructions* from the report SAND97-0366, "The C-Space Toolkit"
//! (§2.3.5 and §3.3.2): the report prints polygon counts, clearances and pictures, not the models themselves. The
//! counts here are the printed ones, to the polygon but for the stalagmites; the shapes are ours. The remaining models
//! are hard cases for hierarchies. Bumpy pairs, scattered obstacles and the robot arm are scenes of our own, for
//! comparisons and for studies of growth.
//!
//! Every face is a convex planar polygon, counter-clockwise from outside. Robot base, lamp, teapot, gear, plate,
//! motor, stalagmite, bumpy sphere, spaghetti, screws and all bodies of the scenes are unions of closed surfaces;
//! floor, nested shells and coincident squares are open. Closed surfaces of one model may overlap, as parts stuck into
//! one another do.
//!
//! Everything is deterministic: the same arguments give the same bits on the same machine.

mod mesh;

mod motion;

mod random;

mod curve;

mod loft;

mod lathe;
mod prism;
mod tube;

mod lamp;
mod robot_base;
mod teapot;

mod gear;

mod motor;
mod plate;
mod point;

mod bumpy_sphere;
mod stalagmite;

mod grid;

mod coincident;
mod floor_and_screws;
mod nested_shells;
mod spaghetti;

mod scene;

mod free_lamp;
mod gear_plate_motor;
mod teapot_contacts;

mod ball_tree;

mod bumpy_pair;
mod puma_arm;
mod scattered;

pub use bumpy_pair::{PlacedScene, Placement, bumpy_pair, bumpy_pair_coherent};
pub use bumpy_sphere::bumpy_sphere;
pub use coincident::coincident;
pub use floor_and_screws::floor_and_screws;
pub use free_lamp::{free_lamp, free_lamp_seeded};
pub use gear::gear;
pub use gear_plate_motor::{gear_plate_motor, gear_plate_motor_seeded};
pub use lamp::{lamp, lamps};
pub use mesh::Mesh;
pub use motion::Pose;
pub use motor::motor;
pub use nested_shells::nested_shells;
pub use plate::plate;
pub use point::Point;
pub use puma_arm::{ArmScene, puma_coherent, puma_random};
pub use random::Random;
pub use robot_base::{robot_base, robot_bases};
pub use scattered::scattered;
pub use scene::Scene;
pub use spaghetti::spaghetti;
pub use stalagmite::stalagmite;
pub use teapot::teapot;
pub use teapot_contacts::{teapot_contacts, teapot_contacts_seeded};

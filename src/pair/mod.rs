//! Pairs: two bodies at two poses, no robot (§2.3.3).

mod ball_and_solid;
mod box_bounds;
mod closed_cores;
mod containment;
mod hit;
mod near_primitives;
mod nearest_first;
mod pair_contacts;
mod pair_distance;
mod pair_visits;
mod pairing;
mod rounds;
mod shortlist;
mod singles;
mod swept_bounds;
mod swept_leaves;
mod traversal;
mod visitor;
mod visitors;
mod winding;

pub use ball_and_solid::{BallAndSolid, OnlyBall};
pub use box_bounds::{
    BoundRefinement, Motion32, ROUNDING, bounds, gaps_of_balls, gaps_to_point, sharper_bounds,
};
pub use hit::{Hit, HitKey, Inner};
pub use pair_contacts::WorldContact;
pub use pair_distance::PrimitiveScratch;
pub use pairing::Pairing;
pub use rounds::{Rounds, are_spheres, only_rounds};
pub use shortlist::{Ranked, Shortlist};
pub use singles::{Singles, SinglesNearest};
pub use swept_bounds::{
    BoxSweep, GapsWanted, SingleUnits, SweptGaps, Twist32, sum_factor, swept_gaps,
};
pub use swept_leaves::{SweptLeaves, SweptLimits};
pub use traversal::{Scratch, traverse, visit_pair};
pub use visitor::{PrimitivePair, Visitor, Wanted};
pub use visitors::{Collect, NearestPrimitives, Within, meets};
pub use winding::{RayScratch, Winding, winding};

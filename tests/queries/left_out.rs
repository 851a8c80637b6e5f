//! Pairs of bodies that no coordinate moves, left out on request: all that a coordinate moves still counts.

use std::sync::Arc;

use cstk::body::Body;
use cstk::cobject::{CObject, Class, InducedOptions, LeftOut, SObjects};
use cstk::environment::{Attachment, Change, Environment};
use cstk::motion::{MotionOptions, MotionOutcome};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, Distance, QueryContext, SSide};
use cstk::robot::JointKind;
use cstk::space::Space;

use helpers::robots::{environment, link, robot, space};
use helpers::shapes::cuboid;

/// A pose at which a box from `cuboid` has its middle at a point.
fn middle_at(body: &Body, at: [f64; 3]) -> Pose {
    Pose::from_translation(Vec3::from(at) - body.center())
}

/// A base that stands in a table, a carriage that runs along x at height 2, and on it a fixed tool frame; a fixed post of the base.
struct Cell {
    cube: Arc<Body>,
    space: Arc<Space>,
    world: Arc<Environment>,
}

const BASE: usize = 0;
const CARRIAGE: usize = 1;
const TOOL: usize = 2;
const POST: usize = 3;

impl Cell {
    fn new() -> Self {
        let cube = cuboid([1.0; 3]).body;
        let mut links = vec![
            link(None, JointKind::Fixed, Vec3::x()),
            link(Some(BASE), JointKind::Prismatic, Vec3::x()),
            link(Some(CARRIAGE), JointKind::Fixed, Vec3::x()),
            link(Some(BASE), JointKind::Fixed, Vec3::x()),
        ];
        links[BASE].body = Some(cube.clone());
        links[BASE].at = middle_at(&cube, [0.0; 3]);
        links[CARRIAGE].body = Some(cube.clone());
        links[CARRIAGE].at = Pose::from_translation(Vec3::new(0.0, 0.0, 2.0));
        links[POST].at = Pose::from_translation(Vec3::new(-3.0, 0.0, 0.0));
        let table = cuboid([20.0, 20.0, 1.0]).body;
        let (world, _) = environment(&[
            (&table, middle_at(&table, [0.0, 0.0, -0.75])),
            (&cube, middle_at(&cube, [5.0, 0.0, 2.0])),
        ]);
        Self {
            cube,
            space: space(vec![robot(3, links)]),
            world,
        }
    }

    fn set(&self, unmoved: bool) -> CObject {
        let left_out = LeftOut {
            allowed: &[],
            unmoved,
        };
        let objects = SObjects::All(self.world.clone());
        let options = InducedOptions::default();
        CObject::induced(self.space.clone(), &[], objects, left_out, options).unwrap()
    }

    /// Adds a cube that a link holds, its middle at a point of the link's frame.
    fn hold(&self, link: usize, at: [f64; 3]) -> u64 {
        let add = Change::add(self.cube.clone(), Pose::identity());
        let id = self.world.apply(&[add]).unwrap().0[0];
        let attachment = Attachment::new(&self.space, link, &[]).unwrap();
        let pose = middle_at(&self.cube, at);
        let hold = Change::Attach {
            id,
            pose,
            attachment,
        };
        self.world.apply(&[hold]).unwrap();
        id
    }
}

fn distance(set: &CObject, x: f64) -> Distance {
    let at = Configuration::Coordinates(&[x]);
    QueryContext::new()
        .distance(set, at, f64::INFINITY)
        .unwrap()
}

fn class(set: &CObject, x: f64) -> Class {
    let at = Configuration::Coordinates(&[x]);
    QueryContext::new().classify(set, at).unwrap()
}

#[test]
fn a_base_may_stand_in_its_table() {
    let cell = Cell::new();
    let (all, moved) = (cell.set(false), cell.set(true));
    // The base reaches a quarter into the table, wherever the carriage is.
    assert_eq!(class(&all, 0.0), Class::Inside);
    // The carriage's front is at x + .5, the wall at 4.5; the carriage is 1.75 above the table.
    for x in [-3.0, 0.0, 2.0, 3.5] {
        let found = distance(&moved, x);
        assert!((found.distance - (4.0 - x).min(1.75)).abs() < 1e-13, "{x}");
        let witness = found.witness.unwrap();
        assert_eq!(witness.r_link, CARRIAGE);
    }
    assert_eq!(class(&moved, 4.25), Class::Inside);
    let proved = |set: &CObject, to: f64| {
        let options = MotionOptions::default();
        let mut query = QueryContext::new();
        query.motion(set, &[-3.0], &[to], &options).unwrap().outcome
    };
    assert_eq!(proved(&moved, 3.9), MotionOutcome::Free);
    assert_eq!(proved(&moved, 4.1), MotionOutcome::Hit);
    assert_eq!(proved(&all, 3.9), MotionOutcome::Hit);
}

/// What a link that moves holds is tested against the base; what hangs on the base, against what moves.
#[test]
fn what_is_held_counts_where_its_holder_moves() {
    let cell = Cell::new();
    // Below the tool, a quarter above the table, at the height of the base.
    let held = cell.hold(TOOL, [0.0, 0.0, -1.5]);
    let moved = cell.set(true);
    let found = distance(&moved, 1.1);
    assert!((found.distance - 0.1).abs() < 1e-13);
    assert_eq!(found.witness.unwrap().s_side, SSide::Object(held));
    assert!((distance(&moved, 2.0).distance - 0.25).abs() < 1e-13);
    assert_eq!(class(&moved, 0.9), Class::Inside);

    // On the post, in the table: the table does not count for it, the carriage does.
    let cell = Cell::new();
    let on_post = cell.hold(POST, [0.0, 0.0, 0.0]);
    let (all, moved) = (cell.set(false), cell.set(true));
    assert_eq!(class(&all, 2.0), Class::Inside);
    assert_eq!(class(&moved, 2.0), Class::Outside);
    let found = distance(&moved, -3.0);
    // The carriage, from 1.5 up, is a length of 1 above the cube that ends at .5.
    assert!((found.distance - 1.0).abs() < 1e-13);
    assert_eq!(found.witness.unwrap().s_side, SSide::Object(on_post));
}

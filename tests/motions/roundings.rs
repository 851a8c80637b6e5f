//! Motions of numbers so small, so large, or cancelled so far that roundings decide: none is called free whose end is inside.

use std::f64::consts::TAU;
use std::sync::Arc;

use cstk::cobject::{CObject, Class, PureShape};
use cstk::error::Result;
use cstk::motion::{MotionOptions, MotionOutcome, RegionOptions, RegionOutcome};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::{Coordinate, CustomJoint, JointKind, LinkDefinition, Speeds, Twist};
use cstk::space::{Space, WorldBox};

use helpers::pure::pure;
use helpers::random::Random;
use helpers::robots::{against, environment, link, robot, space};
use helpers::shapes::cuboid;

use super::random_scenes::{built, class};

fn outcome(set: &CObject, q0: &[f64], q1: &[f64]) -> MotionOutcome {
    let answer = QueryContext::new().motion(set, q0, q1, &MotionOptions::default());
    answer.unwrap().outcome
}

/// A slider without a body, within a range.
fn slider([lower, upper]: [f64; 2]) -> Arc<Space> {
    let links = vec![link(None, JointKind::Prismatic, Vec3::x())];
    let range = Coordinate::Interval { lower, upper };
    let world = WorldBox {
        low: [f64::NEG_INFINITY; 3],
        high: [f64::INFINITY; 3],
    };
    Arc::new(Space::new(vec![robot(3, links)], &[Some(range)], world).unwrap())
}

const ANYWHERE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

#[test]
fn what_moves_by_less_than_squares_can_hold_does_not_rest() {
    let (low, high) = (1e-200, 2e-200);
    let shape = PureShape::Box {
        low: vec![low],
        high: vec![high],
    };
    for scale in [None, Some(1.0), Some(1e-40)] {
        let set = pure(&slider(ANYWHERE), shape.clone(), scale);
        // Into the box, and right through it.
        for end in [1.2e-200, 8e-200] {
            assert_ne!(
                outcome(&set, &[0.0], &[end]),
                MotionOutcome::Free,
                "{end:e}"
            );
            let options = RegionOptions::default();
            let region = QueryContext::new().classify_region(&set, &[0.0], &[end], &options);
            assert_ne!(region.unwrap().outcome, RegionOutcome::Free, "{end:e}");
        }
    }
    // A point before a floor, and before the side of the world.
    let point = built(|b| b.add_points(&[Vec3::zeros()], 0.0).map(|_| ()).unwrap());
    for kind in [
        JointKind::Planar,
        JointKind::FreeEuler,
        JointKind::Prismatic,
    ] {
        let nq = kind.nq();
        let links = vec![LinkDefinition {
            body: Some(point.clone()),
            ..link(None, kind, Vec3::x())
        }];
        let world = WorldBox {
            low: [-1.0; 3],
            high: [3e-200, 1.0, 1.0],
        };
        let space = Arc::new(Space::new(vec![robot(3, links)], &[], world).unwrap());
        let sides = pure(&space, PureShape::BeyondWorld { links: vec![0] }, None);
        let floor = PureShape::Floor {
            links: vec![0],
            normal: -Vec3::x(),
            offset: -3e-200,
        };
        let floor = pure(&space, floor, None);
        let mut end = vec![0.0; nq];
        end[0] = 4e-200;
        for set in [&sides, &floor] {
            let name = format!("{:?} of {nq}", set.set());
            assert_ne!(
                outcome(set, &vec![0.0; nq], &end),
                MotionOutcome::Free,
                "{name}"
            );
        }
    }
}

#[test]
fn the_rounding_of_the_way_counts_for_pure_sets() {
    // The range ends between the sum of start and difference and the end itself.
    for (range, ends) in [
        ([-3.0, 5e-17], [-3.0, 1e-16]),
        ([-1e10, 1.0], [-1e10, 1.0 + 1e-7]),
    ] {
        let space = slider(range);
        let limits = pure(&space, PureShape::BeyondLimits, Some(1.0));
        let [from, to] = ends;
        assert_ne!(outcome(&limits, &[from], &[to]), MotionOutcome::Free);
        assert_eq!(outcome(&limits, &[from], &[range[1]]), MotionOutcome::Free);
    }
    let cube = cuboid([1.0; 3]).body;
    let links = vec![LinkDefinition {
        body: Some(cube),
        ..link(None, JointKind::Prismatic, Vec3::x())
    }];
    let over_floor = space(vec![robot(3, links)]);
    let floor = PureShape::Floor {
        links: vec![0],
        normal: -Vec3::x(),
        offset: -1.5,
    };
    let half_space = |end: f64| PureShape::HalfSpace {
        normal: vec![-1.0],
        offset: -end,
        is_open: false,
    };
    let near = PureShape::Box {
        low: vec![5e-17],
        high: vec![1.0],
    };
    let cases = [
        (slider(ANYWHERE), half_space(5e-17), [-3.0, 1e-16]),
        (slider(ANYWHERE), near, [-3.0, 1e-16]),
        (slider(ANYWHERE), half_space(1.0), [-1e10, 1.0 + 1e-7]),
        (over_floor, floor, [-1e10, 1.0 + 1e-7]),
    ];
    for (space, shape, [from, to]) in cases {
        let set = pure(&space, shape, None);
        let name = format!("{:?}", set.set());
        let at_end = QueryContext::new().classify(&set, Configuration::Coordinates(&[to]));
        assert_eq!(at_end.unwrap(), Class::Inside, "{name}");
        assert_ne!(outcome(&set, &[from], &[to]), MotionOutcome::Free, "{name}");
    }
}

/// A cube on a slider before a wall that it reaches into by a little, where what the coordinate is multiplied and shifted by cancels.
#[test]
fn what_multiples_and_offsets_cancel_is_rounded() {
    let cube = cuboid([1.0; 3]).body;
    let mut random = Random::new(251);
    let context = &mut QueryContext::new();
    for exponent in [4, 6, 8, 10] {
        let multiplier = 10f64.powi(exponent);
        let links = vec![LinkDefinition {
            body: Some(cube.clone()),
            multiplier,
            offset: -multiplier,
            ..link(None, JointKind::Prismatic, Vec3::x())
        }];
        let space = space(vec![robot(3, links)]);
        let mut inside = 0;
        for _ in 0..300 {
            let [q0, q1] = [
                1.0 - random.within(0.5, 1.0) / multiplier,
                1.0 + random.within(0.2, 0.8) / multiplier,
            ];
            let place = multiplier * q1 - multiplier;
            let depth = 1e-16 * multiplier * random.within(0.0, 4.0);
            let wall = Pose::from_translation(Vec3::new(place + 1.0 - depth, 0.0, 0.0));
            let set = against(&space, &environment(&[(&cube, wall)]).0);
            if class(context, &set, &[q1]) == Class::Inside {
                inside += 1;
                let found = outcome(&set, &[q0], &[q1]);
                assert_ne!(found, MotionOutcome::Free, "{multiplier:e} {q0} {q1}");
            }
        }
        assert!(inside > 50, "{inside}");
    }
}

/// A shift by the coordinate less a large number.
struct Far;

const FAR: f64 = 1e10;

impl CustomJoint for Far {
    fn coordinates(&self) -> usize {
        1
    }

    fn pose(&self, q: &[f64]) -> Result<Pose> {
        Ok(Pose::from_translation(Vec3::new(q[0] - FAR, 0.0, 0.0)))
    }

    fn jacobian(&self, _: &[f64], columns: &mut Vec<Twist>) -> Result<()> {
        columns.push(Twist {
            linear: Vec3::x(),
            angular: Vec3::zeros(),
        });
        Ok(())
    }

    fn speeds(&self) -> Option<Speeds> {
        Some(Speeds {
            linear: 1.0,
            angular: 0.0,
        })
    }
}

#[test]
fn the_rounding_of_a_custom_joints_coordinate_counts() {
    let cube = cuboid([1.0; 3]).body;
    let links = vec![LinkDefinition {
        body: Some(cube.clone()),
        ..link(None, JointKind::Custom(Arc::new(Far)), Vec3::x())
    }];
    let space = space(vec![robot(3, links)]);
    let mut random = Random::new(257);
    let context = &mut QueryContext::new();
    for _ in 0..200 {
        let (q0, q1) = (random.within(0.0, 1e4) - FAR, FAR + random.within(0.3, 0.4));
        let wall = Pose::from_translation(Vec3::new(q1 - FAR + 1.0 - 2e-7, 0.0, 0.0));
        let set = against(&space, &environment(&[(&cube, wall)]).0);
        assert_eq!(class(context, &set, &[q1]), Class::Inside);
        assert_ne!(
            outcome(&set, &[q0], &[q1]),
            MotionOutcome::Free,
            "{q0} {q1}"
        );
    }
}

/// However often an angle goes round, the motion ends where the angle points.
#[test]
fn motions_end_where_large_angles_point() {
    let ball = built(|b| b.add_sphere(&Vec3::x(), 0.01, 0).unwrap());
    let links = vec![LinkDefinition {
        body: Some(ball.clone()),
        ..link(None, JointKind::Revolute, Vec3::z())
    }];
    let space = space(vec![robot(3, links)]);
    assert_eq!(space.coordinates()[0], Coordinate::Circle);
    let context = &mut QueryContext::new();
    for exponent in 4..=17 {
        for lead in [1.0, 2.0, 3.0, 5.0, 7.0] {
            let end = lead * 10f64.powi(exponent);
            let v = space.difference(&[0.0], &[end]);
            let distance = space.distance(&[0.0], &[end], None);
            assert_eq!(distance, v[0].abs(), "{end:e}");
            let off = (v[0].sin() - end.sin()).abs() + (v[0].cos() - end.cos()).abs();
            assert!(
                off < 1e-15 && v[0].abs() <= TAU / 2.0,
                "{end:e}: off by {off:e}"
            );
            let (sine, cosine) = end.sin_cos();
            let place = Pose::from_translation(Vec3::new(cosine - 1.0, sine, 0.0));
            let set = against(&space, &environment(&[(&ball, place)]).0);
            assert_eq!(class(context, &set, &[end]), Class::Inside);
            let found = outcome(&set, &[0.0], &[end]);
            assert_ne!(found, MotionOutcome::Free, "{end:e}");
        }
    }
}

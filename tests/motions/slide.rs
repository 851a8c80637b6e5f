//! The sliding step (Appendix A): free, along one wall, along two, blocked, touching, inside, and never through.

use std::sync::Arc;

use cstk::body::{Body, BodyBuilder};
use cstk::cobject::{CObject, InducedOptions, LeftOut, SObjects};
use cstk::environment::{Change, Environment};
use cstk::hierarchy::HierarchyOptions;
use cstk::motion::{SlideOptions, SlideOutcome};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::{JointKind, LinkDefinition, RobotBuilder};
use cstk::space::{Coordinate, Space, WorldBox};

fn cuboid(low: [f64; 3], high: [f64; 3]) -> Arc<Body> {
    let points: Vec<Vec3> = (0..8)
        .map(|i| {
            let pick = |axis: usize| {
                if i >> axis & 1 == 0 {
                    low[axis]
                } else {
                    high[axis]
                }
            };
            Vec3::new(pick(0), pick(1), pick(2))
        })
        .collect();
    let mut builder = BodyBuilder::new(3).unwrap();
    builder.add_polyhedron(&points, 0).unwrap();
    Arc::new(
        builder
            .build(&HierarchyOptions::default(), &mut |_| Ok(()))
            .unwrap(),
    )
}

/// A unit cube around the origin that moves along x and y, among walls.
fn cube_among(walls: &[([f64; 3], [f64; 3])], ranges: &[Option<Coordinate>]) -> CObject {
    let mut builder = RobotBuilder::new(3).unwrap();
    for (axis, body) in [
        (Vec3::x(), None),
        (Vec3::y(), Some(cuboid([-0.5; 3], [0.5; 3]))),
    ] {
        let link = LinkDefinition {
            parent: body.as_ref().map(|_| 0),
            body,
            kind: JointKind::Prismatic,
            axis,
            ..Default::default()
        };
        builder.add_link(link).unwrap();
    }
    let robot = Arc::new(builder.build().unwrap());
    let world = WorldBox {
        low: [-50.0; 3],
        high: [50.0; 3],
    };
    let space = Arc::new(Space::new(vec![robot], ranges, world).unwrap());
    let environment = Arc::new(Environment::default());
    let changes: Vec<Change> = walls
        .iter()
        .map(|&(low, high)| Change::add(cuboid(low, high), Pose::identity()))
        .collect();
    environment.apply(&changes).unwrap();
    CObject::induced(
        space,
        &[],
        SObjects::All(environment),
        LeftOut::default(),
        InducedOptions::default(),
    )
    .unwrap()
}

const FLOOR: ([f64; 3], [f64; 3]) = ([-20.0, -2.0, -5.0], [20.0, -1.0, 5.0]);

fn options() -> SlideOptions {
    SlideOptions::with_shell(0.5)
}

#[test]
fn a_free_step_is_taken_whole() {
    let cobject = cube_among(&[FLOOR], &[]);
    let step = QueryContext::new()
        .slide(&cobject, &[0.0, 5.0], &[0.3, -0.2], &options())
        .unwrap();
    assert_eq!(step.outcome, SlideOutcome::Moved);
    assert_eq!(step.configuration, vec![0.3, 4.8]);
    assert_eq!(step.contacts, 0);
}

#[test]
fn along_a_floor_the_tangential_part_remains() {
    let cobject = cube_among(&[FLOOR], &[]);
    // The cube's underside is 0.05 over the floor: just the desired distance.
    let step = QueryContext::new()
        .slide(&cobject, &[0.0, -0.45], &[0.2, -0.2], &options())
        .unwrap();
    assert_eq!(step.outcome, SlideOutcome::Moved);
    assert!((step.configuration[0] - 0.2).abs() < 1e-9);
    assert!((step.configuration[1] + 0.45).abs() < 1e-9);
    assert!((step.distance_after - 0.05).abs() < 1e-9);

    // Nearer than that, it is pushed out to the desired distance.
    let step = QueryContext::new()
        .slide(&cobject, &[0.0, -0.49], &[0.2, -0.2], &options())
        .unwrap();
    assert!((step.distance_after - 0.05).abs() < 1e-9);

    // With the length kept, the tangential part is as long as the step asked for.
    let mut kept = options();
    kept.normalize = true;
    let step = QueryContext::new()
        .slide(&cobject, &[0.0, -0.45], &[0.2, -0.2], &kept)
        .unwrap();
    assert!((step.configuration[0] - 0.2 * 2f64.sqrt()).abs() < 1e-6);
}

#[test]
fn between_floor_and_wall_it_is_blocked_one_way_and_free_another() {
    let wall = ([1.0, -2.0, -5.0], [2.0, 20.0, 5.0]);
    let cobject = cube_among(&[FLOOR, wall], &[]);
    let mut query = QueryContext::new();
    let corner = [0.45, -0.45];
    let into = query
        .slide(&cobject, &corner, &[0.2, -0.2], &options())
        .unwrap();
    assert_eq!(into.outcome, SlideOutcome::Blocked);
    assert_eq!(into.configuration, corner);
    let up = query
        .slide(&cobject, &corner, &[0.2, 0.2], &options())
        .unwrap();
    assert_eq!(up.outcome, SlideOutcome::Moved);
    assert!((up.configuration[0] - 0.45).abs() < 1e-9);
    assert!((up.configuration[1] + 0.25).abs() < 1e-9);
}

#[test]
fn a_long_step_does_not_pass_through_a_thin_wall() {
    let sheet = ([3.0, -20.0, -5.0], [3.001, 20.0, 5.0]);
    let cobject = cube_among(&[sheet], &[]);
    let mut query = QueryContext::new();
    let mut q = vec![0.0, 0.0];
    for _ in 0..40 {
        let step = query.slide(&cobject, &q, &[6.0, 0.0], &options()).unwrap();
        q = step.configuration;
        assert!(q[0] < 2.5, "{q:?}");
    }
    assert!(q[0] > 2.0, "{q:?}");
}

#[test]
fn a_touching_start_slides_and_an_overlapping_one_does_not() {
    let cobject = cube_among(&[FLOOR], &[]);
    let mut query = QueryContext::new();
    let touching = [0.0, -0.5];
    let at = Configuration::Coordinates(&touching);
    assert_eq!(
        query
            .distance(&cobject, at, f64::INFINITY)
            .unwrap()
            .distance,
        0.0
    );
    let step = query
        .slide(&cobject, &touching, &[0.2, 0.0], &options())
        .unwrap();
    assert_eq!(step.outcome, SlideOutcome::Moved);
    assert!((step.distance_after - 0.05).abs() < 1e-9);
    let inside = query
        .slide(&cobject, &[0.0, -0.6], &[0.2, 0.0], &options())
        .unwrap();
    assert_eq!(inside.outcome, SlideOutcome::Inside);
}

#[test]
fn no_start_however_near_lets_it_pass_through_a_wall_or_stop_in_the_open() {
    let sheet = ([0.6, -1.0, -5.0], [0.601, 20.0, 5.0]);
    let (closed, open) = (cube_among(&[FLOOR, sheet], &[]), cube_among(&[FLOOR], &[]));
    let mut query = QueryContext::new();
    for gap in [0.0, 1e-15, 1e-12, 1e-9, 1e-7, 1e-4, 1e-2] {
        let q = [0.0, -0.5 + gap];
        let step = query.slide(&closed, &q, &[8.0, 0.0], &options()).unwrap();
        assert!(step.configuration[0] < 0.1, "{gap:e}: {step:?}");
        let step = query.slide(&open, &q, &[0.1, 0.0], &options()).unwrap();
        assert_eq!(step.outcome, SlideOutcome::Moved, "{gap:e}");
        assert!(step.configuration[0] > 0.09, "{gap:e}: {step:?}");
    }
}

#[test]
fn ranges_and_the_world_box_hold() {
    let range = Coordinate::Interval {
        lower: -1.0,
        upper: 1.0,
    };
    let cobject = cube_among(&[FLOOR], &[Some(range), None]);
    let mut query = QueryContext::new();
    let step = query
        .slide(&cobject, &[0.9, 5.0], &[0.3, 0.0], &options())
        .unwrap();
    assert!((step.configuration[0] - 1.0).abs() < 1e-12 && step.configuration[1] == 5.0);
    for outside in [[1.0, 5.0], [2.0, 5.0]] {
        let step = query
            .slide(&cobject, &outside, &[0.3, 0.0], &options())
            .unwrap();
        assert_eq!(step.outcome, SlideOutcome::Blocked);
    }
    let step = query
        .slide(&cobject, &[0.0, 49.9], &[0.0, 10.0], &options())
        .unwrap();
    assert!(step.configuration[1] <= 50.0);
}

#[test]
fn bad_options_are_named() {
    let cobject = cube_among(&[FLOOR], &[]);
    let mut query = QueryContext::new();
    for (shell, desired, culprit) in [
        (0.0, 0.0, "max_shell"),
        (f64::NAN, 0.0, "max_shell"),
        (0.5, 0.6, "desired_distance"),
        (0.5, f64::NAN, "desired_distance"),
    ] {
        let mut bad = SlideOptions::with_shell(shell);
        bad.desired_distance = desired;
        let error = query
            .slide(&cobject, &[0.0, 5.0], &[0.1, 0.0], &bad)
            .unwrap_err();
        assert!(error.message.contains(culprit), "{}", error.message);
    }
}

//! The least distance along motions: against dense samples of the distance, and in closed forms.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use cstk::body::{Body, BodyBuilder};
use cstk::cobject::{CObject, Class, InducedOptions, Predicate, PureShape};
use cstk::error::{ErrorKind, Result};
use cstk::hierarchy::HierarchyOptions;
use cstk::motion::{ClearanceOptions, ClearanceOutcome, MotionClearance};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, Distance, QueryContext};
use cstk::robot::{JointKind, LinkDefinition};
use cstk::space::Space;

use helpers::pure::pure;
use helpers::random::Random;
use helpers::robots::{against, against_with, environment, link, robot, space};
use helpers::shapes::cuboid;

use super::motions::gantry;
use super::random_scenes::{at, built, class, scene};

fn distance(context: &mut QueryContext, cobject: &CObject, q: &[f64]) -> Distance {
    let at = Configuration::Coordinates(q);
    context.distance(cobject, at, f64::INFINITY).unwrap()
}

/// `CSTK_CLEARANCES=10000 cargo test --release --test motions clearances_bound -- --nocapture` runs a campaign.
#[test]
fn clearances_bound_every_sample() {
    let campaign: Option<usize> = std::env::var("CSTK_CLEARANCES")
        .ok()
        .map(|n| n.parse().unwrap());
    let count = campaign.unwrap_or(400);
    let mut random = Random::new(211);
    let context = &mut QueryContext::new();
    let mut outcomes = [0usize; 6];
    let mut dense = 0;
    let mut cobject = scene(&mut random);
    for round in 0..count {
        if round % 5 == 0 {
            cobject = scene(&mut random);
        }
        let space = cobject.space().clone();
        let drawn = |random: &mut Random, size: f64| -> Vec<f64> {
            (0..space.nv())
                .map(|_| random.within(-size, size))
                .collect()
        };
        let q0 = space.step(&space.neutral(), &drawn(&mut random, 2.0));
        let size = [0.05, 0.3, 1.0, 3.0][random.below(4)];
        let q1 = space.step(&q0, &drawn(&mut random, size));
        let v = space.difference(&q0, &q1);
        let options = ClearanceOptions {
            relative_tolerance: [0.0, 0.1][random.below(2)],
            ..ClearanceOptions::with_tolerance([1e-2, 1e-3, 1e-5][random.below(3)])
        };
        let found = context
            .motion_clearance(&cobject, &q0, &q1, &options)
            .unwrap();
        outcomes[found.outcome as usize] += 1;
        assert_eq!(at(&space, &q0, &v, found.time), found.configuration);
        let there = distance(context, &cobject, &found.configuration);
        assert_eq!(there.upper, found.upper, "round {round}: {found:?}");
        match found.outcome {
            ClearanceOutcome::Hit => {
                let there = class(context, &cobject, &found.configuration);
                assert_eq!(there, Class::Inside, "round {round}: {found:?}");
                assert_eq!(found.lower, 0.0);
                continue;
            }
            ClearanceOutcome::Known => {
                let allowed = options
                    .tolerance
                    .max(options.relative_tolerance * found.upper);
                assert!(found.upper - found.lower <= allowed, "{found:?}");
            }
            _ => assert!(found.lower <= found.upper),
        }
        let samples = if dense < 30 { 20_000 } else { 200 };
        dense += 1;
        for i in 0..=samples {
            let t = f64::from(i) / f64::from(samples);
            let sampled = distance(context, &cobject, &at(&space, &q0, &v, t));
            // A proof, and so its threshold, holds for distances of the same rounding.
            assert!(
                sampled.upper >= found.lower * (1.0 - 1e-12),
                "round {round}: {} at {t} of {found:?}",
                sampled.upper
            );
        }
    }
    println!("known, hit, beyond, empty, near, undecided: {outcomes:?}");
    assert!(outcomes[0] > count / 4 && outcomes[1] > count / 10);
    assert!(outcomes[2..].iter().all(|&n| n == 0), "{outcomes:?}");
}

fn ball(radius: f64) -> Arc<Body> {
    built(|b| b.add_sphere(&Vec3::zeros(), radius, 0).unwrap())
}

fn shifted(x: f64, y: f64, z: f64) -> Pose {
    Pose::from_translation(Vec3::new(x, y, z))
}

fn clearance(cobject: &CObject, from: f64, to: f64, tolerance: f64) -> MotionClearance {
    let options = ClearanceOptions::with_tolerance(tolerance);
    QueryContext::new()
        .motion_clearance(cobject, &[from], &[to], &options)
        .unwrap()
}

/// Within the tolerance of a closed form.
fn expect(found: &MotionClearance, distance: f64, tolerance: f64) {
    assert_eq!(found.outcome, ClearanceOutcome::Known, "{found:?}");
    let rounding = 1e-12;
    assert!(found.lower <= distance + rounding, "{distance}: {found:?}");
    assert!(found.upper >= distance - rounding, "{distance}: {found:?}");
    assert!(found.upper - found.lower <= tolerance, "{found:?}");
}

#[test]
fn closed_forms_are_met() {
    // Two balls that pass each other: nearest at 1.3 / 3 of the way.
    let balls = gantry(&ball(0.1), &ball(0.15), shifted(0.0, 0.5, 0.0));
    for tolerance in [1e-1, 1e-3, 1e-6, 1e-9] {
        let found = clearance(&balls, -1.3, 1.7, tolerance);
        expect(&found, 0.25, tolerance);
        // Over the time the distance rises by 9 t^2 / 2 / 0.5 or so.
        let error = (found.time - 1.3 / 3.0).abs();
        assert!(error < 0.5 * tolerance.sqrt(), "{error} at {tolerance}");
    }
    // A ball of 5 mm that passes the end of a plate of 1 mm: of eight or a thousand samples none is there.
    let plate = cuboid([0.001, 1.0, 1.0]).body;
    let cell = gantry(&ball(0.005), &plate, shifted(0.025_51, 0.55, 0.0));
    for tolerance in [1e-2, 1e-4, 1e-8] {
        expect(&clearance(&cell, -0.5, 0.5, tolerance), 0.045, tolerance);
    }
    // A box along a wall: all times between are nearest. Then at its margin.
    let (cube, wall) = (cuboid([0.4; 3]).body, cuboid([1.0; 3]).body);
    let cell = gantry(&cube, &wall, shifted(0.0, 1.0, 0.0));
    expect(&clearance(&cell, -2.0, 1.0, 1e-6), 0.3, 1e-6);
    let links = vec![LinkDefinition {
        body: Some(cube),
        ..link(None, JointKind::Prismatic, Vec3::x())
    }];
    let options = InducedOptions {
        margin: 0.125,
        ..InducedOptions::default()
    };
    let (walls, _) = environment(&[(&wall, shifted(0.0, 1.0, 0.0))]);
    let cell = against_with(&space(vec![robot(3, links)]), &walls, options);
    expect(&clearance(&cell, -2.0, 1.0, 1e-6), 0.175, 1e-6);
    // A ball on an arm of a metre that turns past another, farther out: nearest at 0.
    let hand = built(|b| b.add_sphere(&Vec3::x(), 0.05, 0).unwrap());
    let links = vec![LinkDefinition {
        body: Some(hand),
        ..link(None, JointKind::Revolute, Vec3::z())
    }];
    let (objects, _) = environment(&[(&ball(0.1), shifted(1.5, 0.0, 0.0))]);
    let cell = against(&space(vec![robot(3, links)]), &objects);
    expect(&clearance(&cell, -0.7, 1.9, 1e-6), 0.35, 1e-6);
    // At an end of the motion, and at rest.
    let found = clearance(&cell, 0.0, 1.9, 1e-6);
    expect(&found, 0.35, 1e-6);
    assert_eq!(found.time, 0.0);
    expect(&clearance(&cell, 0.0, 0.0, 1e-6), 0.35, 1e-6);
}

#[test]
fn what_meets_has_none() {
    let plate = cuboid([0.001, 1.0, 1.0]).body;
    let cell = gantry(&ball(0.005), &plate, shifted(0.0255, 0.0, 0.0));
    for tolerance in [1e-9, 1e-3, 10.0] {
        let found = clearance(&cell, -0.5, 0.5, tolerance);
        assert_eq!(found.outcome, ClearanceOutcome::Hit, "{found:?}");
        assert!(found.lower == 0.0 && found.upper < 1e-12, "{found:?}");
        assert!((found.configuration[0] - 0.0255).abs() < 0.006, "{found:?}");
    }
    // What stays out of a plate by less than the tolerance is told from what meets it.
    let cell = gantry(&ball(0.005), &plate, shifted(0.0255, 0.506, 0.0));
    expect(&clearance(&cell, -0.5, 0.5, 10.0), 0.001, 10.0);
}

/// A slider from 0 on, and sets around 5 in its own units.
#[test]
fn pure_sets_measure_in_their_units() {
    let space: Arc<Space> = {
        let links = vec![LinkDefinition {
            body: Some(cuboid([1.0; 3]).body),
            ..link(None, JointKind::Prismatic, Vec3::x())
        }];
        space(vec![robot(3, links)])
    };
    let beyond = || PureShape::HalfSpace {
        normal: vec![-1.0],
        offset: -5.0,
        is_open: false,
    };
    for (scale, distance) in [(None, 1.0), (Some(2.0), 2.0)] {
        let set = pure(&space, beyond(), scale);
        let found = clearance(&set, 0.0, 4.0, 1e-6);
        expect(&found, distance, 1e-6);
        assert_eq!(found.time, 1.0);
    }
    let floor = PureShape::Floor {
        links: vec![0],
        normal: -Vec3::x(),
        offset: -5.0,
    };
    expect(
        &clearance(&pure(&space, floor, None), 0.0, 4.0, 1e-6),
        0.5,
        1e-6,
    );
    // Units that cannot be compared.
    let wall = cuboid([1.0; 3]).body;
    let (objects, _) = environment(&[(&wall, shifted(9.0, 0.0, 0.0))]);
    let bodies = Arc::new(against(&space, &objects));
    let kind = |set: &CObject| {
        let options = ClearanceOptions::with_tolerance(1e-3);
        let refused = QueryContext::new().motion_clearance(set, &[0.0], &[4.0], &options);
        refused.unwrap_err().kind
    };
    let mixed = CObject::union(&[bodies.clone(), pure(&space, beyond(), None)]).unwrap();
    assert_eq!(kind(&mixed), ErrorKind::Unsupported);
    let both = CObject::union(&[bodies.clone(), pure(&space, beyond(), Some(10.0))]).unwrap();
    expect(&clearance(&both, 0.0, 4.0, 1e-6), 4.0, 1e-6);
    assert_eq!(
        kind(&CObject::complement(&bodies).unwrap()),
        ErrorKind::Unsupported
    );
    let (nothing, _) = environment(&[]);
    let found = clearance(&against(&space, &nothing), 0.0, 4.0, 1e-6);
    assert_eq!(found.outcome, ClearanceOutcome::Empty);
    assert_eq!((found.lower, found.upper), (f64::INFINITY, f64::INFINITY));
}

#[test]
fn a_largest_distance_is_all_that_is_proved() {
    let cell = gantry(&ball(0.1), &ball(0.15), shifted(0.0, 0.5, 0.0));
    let context = &mut QueryContext::new();
    let mut found = |max_distance: f64| {
        let options = ClearanceOptions {
            max_distance,
            ..ClearanceOptions::with_tolerance(1e-3)
        };
        let found = context.motion_clearance(&cell, &[-1.3], &[1.7], &options);
        found.unwrap()
    };
    for max_distance in [0.0, 0.1, 0.24] {
        let beyond = found(max_distance);
        assert_eq!(beyond.outcome, ClearanceOutcome::BeyondMax, "{beyond:?}");
        assert_eq!(beyond.lower, max_distance);
    }
    for max_distance in [0.26, 1.0] {
        expect(&found(max_distance), 0.25, 1e-3);
    }
}

/// However little work is allowed, the bounds hold.
#[test]
fn limited_work_gives_bounds_that_hold() {
    let cell = gantry(&cuboid([0.2; 3]).body, &ball(0.15), shifted(0.0, 0.5, 0.0));
    let options = ClearanceOptions::with_tolerance(1e-6);
    let work_of_first = {
        let context = &mut QueryContext::new();
        distance(context, &cell, &[-1.3]);
        let work = context.statistics();
        work.node_pairs + work.primitive_pairs
    };
    let mut outcomes = [0usize; 3];
    for limit in (0..400).chain([4000, 100_000]) {
        let context = &mut QueryContext::new();
        context.set_limit(Some(limit));
        match context.motion_clearance(&cell, &[-1.3], &[1.7], &options) {
            Err(error) => {
                assert_eq!(error.kind, ErrorKind::Limit);
                // Only where not even the distance at the start is known.
                assert!(limit < work_of_first, "{limit}");
                outcomes[0] += 1;
            }
            Ok(found) => {
                let is_known = found.outcome == ClearanceOutcome::Known;
                assert!(is_known || found.outcome == ClearanceOutcome::Undecided);
                assert!(found.lower <= 0.25 + 1e-12 && found.upper >= 0.25 - 1e-12);
                outcomes[1 + usize::from(is_known)] += 1;
            }
        }
    }
    assert!(outcomes.iter().all(|&n| n > 0), "{outcomes:?}");
}

/// Rounding ends what no tolerance ends, with bounds that hold.
#[test]
fn a_tolerance_below_rounding_ends_near() {
    let cell = gantry(
        &cuboid([0.2; 3]).body,
        &cuboid([0.3; 3]).body,
        shifted(0.0, 0.5, 0.0),
    );
    let found = clearance(&cell, -1.3, 1.7, 1e-300);
    assert_eq!(found.outcome, ClearanceOutcome::Near, "{found:?}");
    assert!(found.lower <= 0.25 && found.upper >= 0.25, "{found:?}");
    assert!(found.upper - found.lower < 1e-9, "{found:?}");
}

#[test]
fn bad_input_is_refused() {
    let cell = gantry(&ball(0.1), &ball(0.1), shifted(0.0, 1.0, 0.0));
    let good = ClearanceOptions::with_tolerance(1e-3);
    let kind = |q0: &[f64], q1: &[f64], options: ClearanceOptions| {
        let refused = QueryContext::new().motion_clearance(&cell, q0, q1, &options);
        refused.unwrap_err().kind
    };
    assert_eq!(kind(&[f64::NAN], &[1.0], good), ErrorKind::NotFinite);
    assert_eq!(kind(&[1.0], &[f64::INFINITY], good), ErrorKind::NotFinite);
    assert_eq!(kind(&[0.0, 1.0], &[1.0], good), ErrorKind::WrongSize);
    for (tolerance, expected) in [
        (0.0, ErrorKind::InvalidArgument),
        (-1.0, ErrorKind::InvalidArgument),
        (f64::NAN, ErrorKind::NotFinite),
        (f64::INFINITY, ErrorKind::NotFinite),
    ] {
        let options = ClearanceOptions::with_tolerance(tolerance);
        assert_eq!(kind(&[0.0], &[1.0], options), expected, "{tolerance}");
    }
    for relative_tolerance in [-0.1, 1.0] {
        let options = ClearanceOptions {
            relative_tolerance,
            ..good
        };
        assert_eq!(kind(&[0.0], &[1.0], options), ErrorKind::InvalidArgument);
    }
    let options = ClearanceOptions {
        max_distance: -1.0,
        ..good
    };
    assert_eq!(kind(&[0.0], &[1.0], options), ErrorKind::InvalidArgument);
}

/// A bar of two balls that turns among eight others, as large as a house or smaller than anything: the same work and the same answer.
#[test]
fn clearances_know_no_scale() {
    let mut known = None;
    for scale in [1.0, 1e30, 1e-20, 1e-30, 1e-38, 1e-44] {
        let balls = |centers: &[f64]| {
            let mut builder = BodyBuilder::new(3).unwrap();
            for x in centers {
                let center = Vec3::x() * (x * scale);
                builder.add_sphere(&center, 0.1 * scale, 0).unwrap();
            }
            let options = HierarchyOptions::default();
            Arc::new(builder.build(&options, &mut |_| Ok(())).unwrap())
        };
        let mut turned = link(None, JointKind::Revolute, Vec3::z());
        turned.body = Some(balls(&[1.0, 0.5]));
        let one = balls(&[0.0]);
        let around = (0..7).map(|k| {
            let angle = f64::from(k) + 1.0;
            Vec3::new(1.9 * angle.cos(), 1.9 * angle.sin(), 0.3) * scale
        });
        let places = std::iter::once(Vec3::y() * (1.3 * scale)).chain(around);
        let placed: Vec<(&Arc<Body>, Pose)> = places
            .map(|at| (&one, Pose::from_translation(at)))
            .collect();
        let (world, _) = environment(&placed);
        let space = space(vec![robot(3, vec![turned])]);
        let mut context = QueryContext::new();
        let options = ClearanceOptions::with_tolerance(1e-6 * scale);
        let found = context
            .motion_clearance(&against(&space, &world), &[0.0], &[3.0], &options)
            .unwrap();
        assert_eq!(found.outcome, ClearanceOutcome::Known, "{scale}");
        // The nearest is the one ahead, .3 from the outer ball's centre, less two radii.
        let bounds = [found.lower / scale, found.upper / scale];
        assert!(
            bounds[0] <= 0.1 + 1e-12 && bounds[1] >= 0.1 - 1e-12,
            "{scale} {bounds:?}"
        );
        assert!(bounds[1] - bounds[0] <= 1.01e-6, "{scale} {bounds:?}");
        let work = context.statistics().node_pairs;
        let usual = *known.get_or_insert(work);
        assert!(
            work <= 2 * usual,
            "{scale}: {work} node pairs, {usual} at 1"
        );
    }
}

/// Where q is at least 2, with a lower bound of the distance; counts how often it is asked.
#[derive(Default)]
struct Beyond {
    asked: AtomicUsize,
}

impl Predicate for Beyond {
    fn classify(&self, q: &[f64]) -> Result<Class> {
        Ok(match q[0] >= 2.0 {
            true => Class::Inside,
            false => Class::Outside,
        })
    }

    fn distance(&self, q: &[f64]) -> Result<Option<f64>> {
        self.asked.fetch_add(1, Ordering::Relaxed);
        Ok(Some(0.5 * (2.0 - q[0])))
    }
}

/// Of a bound no distance is known that the lower bound could come near: what is proved is told after a few proofs.
#[test]
fn a_predicate_that_bounds_is_not_asked_without_end() {
    let slider = link(None, JointKind::Prismatic, Vec3::x());
    let space = &space(vec![robot(3, vec![slider])]);
    for (max_distance, least) in [(f64::INFINITY, 0.0), (0.8, 0.45), (0.3, 0.3)] {
        let predicate = Arc::new(Beyond::default());
        let set = pure(space, PureShape::Predicate(predicate.clone()), None);
        let options = ClearanceOptions {
            max_distance,
            ..ClearanceOptions::with_tolerance(1e-3)
        };
        let found = QueryContext::new()
            .motion_clearance(&set, &[0.0], &[1.0], &options)
            .unwrap();
        let expected = match max_distance == 0.3 {
            true => ClearanceOutcome::BeyondMax,
            false => ClearanceOutcome::Near,
        };
        assert_eq!(found.outcome, expected, "{found:?}");
        assert!((least..=0.5).contains(&found.lower), "{found:?}");
        let asked = predicate.asked.load(Ordering::Relaxed);
        assert!(asked < 1000, "{asked} times");
    }
}

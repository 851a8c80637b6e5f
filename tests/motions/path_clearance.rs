//! The least distance along paths: in closed form, and against dense samples.

use cstk::cobject::{CObject, Class};
use cstk::error::{Error, ErrorKind, Result};
use cstk::motion::{ClearanceOptions, ClearanceOutcome, PathClearance};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::{JointKind, LinkDefinition};

use helpers::random::Random;
use helpers::robots::{against, environment, link, robot, space};
use helpers::shapes::cuboid;

use super::discs::Discs;
use super::random_scenes::{class, scene};

fn silent(_: f64) -> Result<()> {
    Ok(())
}

fn clearance(cell: &CObject, points: &[f64], options: &ClearanceOptions) -> PathClearance {
    let mut context = QueryContext::new();
    let found = context.path_clearance(cell, points, options, &mut silent);
    found.unwrap()
}

fn random_points(random: &mut Random, count: usize) -> Vec<f64> {
    (0..2 * count).map(|_| random.within(-3.0, 3.0)).collect()
}

fn least(of_segments: &[f64]) -> f64 {
    of_segments.iter().copied().fold(f64::INFINITY, f64::min)
}

#[test]
fn the_clearance_among_discs_is_the_closed_form() {
    let mut random = Random::new(31);
    let mut outcomes = [0usize; 6];
    for round in 0..400 {
        let discs = Discs::random(&mut random);
        let count = 2 + random.below(12);
        // Half of them far enough out to be free.
        let mut points = random_points(&mut random, count);
        if round % 2 == 0 {
            points.iter_mut().skip(1).step_by(2).for_each(|y| *y += 4.5);
        }
        let tolerance = [1e-1, 1e-3, 1e-6][random.below(3)];
        let options = ClearanceOptions::with_tolerance(tolerance);
        let found = clearance(&discs.cell, &points, &options);
        let segments = discs.on_path(&points);
        let expected = least(&segments);
        let clearance = &found.clearance;
        outcomes[clearance.outcome as usize] += 1;
        if expected <= 0.0 {
            assert_eq!(clearance.outcome, ClearanceOutcome::Hit, "{round}");
            assert!(segments[found.segment] <= 1e-12, "{round}: {found:?}");
            assert_eq!(clearance.lower, 0.0);
            continue;
        }
        assert_eq!(clearance.outcome, ClearanceOutcome::Known, "{round}");
        assert!(
            clearance.lower <= expected + 1e-9,
            "{round}: {expected} {found:?}"
        );
        assert!(
            clearance.upper >= expected - 1e-9,
            "{round}: {expected} {found:?}"
        );
        assert!(clearance.upper - clearance.lower <= tolerance, "{found:?}");
        // The place is where it is said to be.
        assert!(
            segments[found.segment] <= clearance.upper + 1e-9,
            "{found:?}"
        );
        let [from, to] = [0, 1].map(|i| &points[2 * (found.segment + i)..][..2]);
        let place = discs.cell.space().interpolate(from, to, clearance.time);
        for (x, y) in place.iter().zip(&clearance.configuration) {
            assert!((x - y).abs() < 1e-12, "{found:?}");
        }
        assert!((discs.on_segment(&place, &place) - clearance.upper).abs() < 1e-9);
    }
    assert!(outcomes[0] > 100 && outcomes[1] > 100, "{outcomes:?}");
}

#[test]
fn clearances_of_paths_bound_every_sample() {
    let mut random = Random::new(37);
    let context = &mut QueryContext::new();
    let mut outcomes = [0usize; 6];
    for round in 0..120 {
        let cobject = scene(&mut random);
        let space = cobject.space().clone();
        let mut points = Vec::new();
        let mut q = space.neutral();
        for size in [2.0, 0.3, 0.1, 0.4] {
            let step: Vec<f64> = (0..space.nv())
                .map(|_| random.within(-size, size))
                .collect();
            q = space.step(&q, &step);
            points.extend(&q);
        }
        let tolerance = [1e-2, 1e-4][random.below(2)];
        let options = ClearanceOptions::with_tolerance(tolerance);
        let found = clearance(&cobject, &points, &options).clearance;
        outcomes[found.outcome as usize] += 1;
        if found.outcome == ClearanceOutcome::Hit {
            assert_eq!(
                class(context, &cobject, &found.configuration),
                Class::Inside
            );
            continue;
        }
        assert!(found.upper - found.lower <= tolerance, "{found:?}");
        let points: Vec<&[f64]> = points.chunks(space.nq()).collect();
        for two in points.windows(2) {
            for i in 0..=300 {
                let q = space.interpolate(two[0], two[1], f64::from(i) / 300.0);
                let at = Configuration::Coordinates(&q);
                let sampled = context.distance(&cobject, at, f64::INFINITY).unwrap();
                let least = found.lower * (1.0 - 1e-12);
                assert!(
                    sampled.upper >= least,
                    "{round}: {} {found:?}",
                    sampled.upper
                );
            }
        }
    }
    assert!(outcomes[0] > 20 && outcomes[1] > 10, "{outcomes:?}");
    assert!(outcomes[2..].iter().all(|&n| n == 0), "{outcomes:?}");
}

#[test]
fn beyond_the_largest_distance_and_of_nothing() {
    let discs = Discs::new(&[[0.0, 0.0, 0.4]]);
    let points = [-2.0, 1.0, 2.0, 1.0, 2.0, 3.0];
    let asked = |max_distance: f64| {
        let options = ClearanceOptions {
            max_distance,
            ..ClearanceOptions::with_tolerance(1e-4)
        };
        clearance(&discs.cell, &points, &options)
    };
    // The ball's surface passes at a half.
    let beyond = asked(0.45).clearance;
    assert_eq!(beyond.outcome, ClearanceOutcome::BeyondMax);
    assert_eq!((beyond.lower, beyond.upper), (0.45, f64::INFINITY));
    let known = asked(0.55);
    assert_eq!(known.clearance.outcome, ClearanceOutcome::Known);
    assert_eq!(known.segment, 0);
    let empty = clearance(
        &Discs::new(&[]).cell,
        &points,
        &ClearanceOptions::with_tolerance(1.0),
    );
    assert_eq!(empty.clearance.outcome, ClearanceOutcome::Empty);
    assert_eq!(empty.clearance.lower, f64::INFINITY);
    // A single point rests.
    let at = clearance(
        &discs.cell,
        &points[..2],
        &ClearanceOptions::with_tolerance(1e-9),
    );
    assert!(
        (at.clearance.upper - (5f64.sqrt() - 0.5)).abs() < 1e-9,
        "{at:?}"
    );
}

#[test]
fn limited_work_gives_bounds_that_hold() {
    let discs = Discs::new(&[[0.0, 0.0, 0.4], [1.5, 0.0, 0.2], [-1.5, 0.2, 0.3]]);
    let points = [-2.0, 1.0, 0.0, 0.8, 2.0, 1.0, 2.0, 3.0, -2.0, 1.1];
    let expected = least(&discs.on_path(&points));
    let options = ClearanceOptions::with_tolerance(1e-6);
    let mut outcomes = [0usize; 3];
    for limit in (0..300).chain([100_000]) {
        let mut context = QueryContext::new();
        context.set_limit(Some(limit));
        match context.path_clearance(&discs.cell, &points, &options, &mut silent) {
            Err(error) => {
                assert_eq!(error.kind, ErrorKind::Limit);
                outcomes[0] += 1;
            }
            Ok(found) => {
                let found = found.clearance;
                let is_known = found.outcome == ClearanceOutcome::Known;
                assert!(is_known || found.outcome == ClearanceOutcome::Undecided);
                assert!(found.lower <= expected + 1e-9 && found.upper >= expected - 1e-9);
                outcomes[1 + usize::from(is_known)] += 1;
            }
        }
    }
    assert!(outcomes.iter().all(|&n| n > 0), "{outcomes:?}");
}

#[test]
fn progress_rises_and_may_end_the_work() {
    let discs = Discs::new(&[[0.0, 0.0, 0.4]]);
    let points = [-2.0, 1.0, 0.0, 0.8, 2.0, 1.0, 2.0, 3.0];
    let options = ClearanceOptions::with_tolerance(1e-3);
    let mut seen = Vec::new();
    let mut context = QueryContext::new();
    let found = context.path_clearance(&discs.cell, &points, &options, &mut |part| {
        seen.push(part);
        Ok(())
    });
    assert!(found.is_ok());
    assert_eq!(seen.len(), 4);
    assert!(seen.windows(2).all(|two| two[0] < two[1]) && seen[3] == 1.0);
    let stopped = context.path_clearance(&discs.cell, &points, &options, &mut |_| {
        Err(Error::new(ErrorKind::Cancelled, "enough"))
    });
    assert_eq!(stopped.unwrap_err().kind, ErrorKind::Cancelled);
}

/// A corner of a turning bar passes a wall at gaps of rounding: what a motion's clearance leaves open, that of a path must not decide.
#[test]
fn a_path_is_known_only_where_its_segments_are() {
    let bar = LinkDefinition {
        body: Some(cuboid([2.0, 0.2, 0.2]).body),
        ..link(None, JointKind::Revolute, Vec3::z())
    };
    let space = space(vec![robot(3, vec![bar])]);
    let wall = cuboid([1.0, 10.0, 2.0]).body;
    // The farthest that the corner comes.
    let reached = 1.01f64.sqrt();
    let options = ClearanceOptions::with_tolerance(1e-3);
    let [mut open, mut known] = [0; 2];
    for i in 0..400 {
        let gap = 1e-15 * 1.03f64.powi(i);
        let at = Pose::from_translation(Vec3::new(0.5 + reached + gap, 0.0, 0.0));
        let cell = against(&space, &environment(&[(&wall, at)]).0);
        let context = &mut QueryContext::new();
        let motion = context.motion_clearance(&cell, &[-0.3], &[0.2], &options);
        let path = context.path_clearance(&cell, &[-0.3, 0.2], &options, &mut silent);
        let outcomes = [motion.unwrap().outcome, path.unwrap().clearance.outcome];
        assert_eq!(outcomes[0], outcomes[1], "at a gap of {gap}");
        open += usize::from(outcomes[0] == ClearanceOutcome::Near);
        known += usize::from(outcomes[0] == ClearanceOutcome::Known);
    }
    assert!(open > 10 && known > 10, "{open} and {known}");
}

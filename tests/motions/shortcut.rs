//! Paths made shorter by proofs: what is left is free by closed forms and by samples, and never longer.

use cstk::cobject::{CObject, Class};
use cstk::error::{Error, ErrorKind, Result};
use cstk::motion::{MotionOptions, MotionOutcome, Shortcut, ShortcutOptions, ShortcutOutcome};
use cstk::query::QueryContext;

use helpers::random::Random;

use super::discs::{Discs, length, shortest_around};
use super::random_scenes::{class, scene};

fn silent(_: f64) -> Result<()> {
    Ok(())
}

fn shortcut(cell: &CObject, points: &[f64], options: &ShortcutOptions) -> Shortcut {
    let mut context = QueryContext::new();
    let found = context.path_shortcut(cell, points, options, &mut silent);
    found.unwrap()
}

/// Ends stay, lengths are what they are said to be, and no path grows.
fn check(given: &[f64], found: &Shortcut) {
    let n = given.len();
    assert_eq!(found.points[..2], given[..2]);
    assert_eq!(found.points[found.points.len() - 2..], given[n - 2..]);
    let lengths = [length(given), length(&found.points)];
    for (told, counted) in found.lengths.iter().zip(lengths) {
        assert!(
            (told - counted).abs() < 1e-12 * (1.0 + counted),
            "{found:?}"
        );
    }
    assert!(found.lengths[1] <= found.lengths[0], "{found:?}");
}

#[test]
fn what_is_left_among_discs_is_free_by_the_closed_form() {
    let mut random = Random::new(41);
    let [mut free, mut blocked, mut cuts] = [0; 3];
    for round in 0..300 {
        let discs = Discs::random(&mut random);
        let threshold = [0.0, 0.05][random.below(2)];
        let mut points: Vec<f64> = Vec::new();
        for _ in 0..200 {
            let next = [0, 1].map(|_| random.within(-3.0, 3.0));
            let last: Vec<f64> = points.iter().rev().take(2).rev().copied().collect();
            let from = if last.is_empty() { &next[..] } else { &last };
            // Every tenth path is taken as it comes.
            if round % 10 == 0 || discs.on_segment(from, &next) > threshold + 1e-6 {
                points.extend(next);
            }
            if points.len() == 40 {
                break;
            }
        }
        if points.is_empty() {
            continue;
        }
        let options = ShortcutOptions {
            attempts: 60,
            seed: round,
            threshold,
        };
        let found = shortcut(&discs.cell, &points, &options);
        check(&points, &found);
        let before = discs.on_path(&points);
        if found.outcome == ShortcutOutcome::NotFree {
            blocked += 1;
            assert!(before[found.given.segment] <= threshold + 1e-9, "{round}");
            assert_eq!(found.points, points);
            continue;
        }
        free += 1;
        cuts += found.cuts;
        assert_eq!(found.outcome, ShortcutOutcome::Done);
        for clearance in discs.on_path(&found.points) {
            assert!(clearance > threshold - 1e-12, "{round}: {clearance}");
        }
        let again = shortcut(&discs.cell, &points, &options);
        assert_eq!(again.points, found.points, "the same call, the same answer");
    }
    assert!(
        free > 100 && blocked > 10 && cuts > 500,
        "{free} {blocked} {cuts}"
    );
}

#[test]
fn where_nothing_is_in_the_way_the_path_is_straight() {
    let points = [0.0, 0.0, 1.0, 2.0, -1.0, 2.0, 3.0, 1.0];
    let found = shortcut(&Discs::new(&[]).cell, &points, &ShortcutOptions::default());
    assert_eq!(found.points, [0.0, 0.0, 3.0, 1.0]);
    assert_eq!((found.cuts, found.outcome), (1, ShortcutOutcome::Done));
    // A straight path stays; without attempts every path does.
    let straight = shortcut(
        &Discs::new(&[]).cell,
        &points[..4],
        &ShortcutOptions::default(),
    );
    assert_eq!((straight.cuts, &straight.points[..]), (0, &points[..4]));
    let none = ShortcutOptions {
        attempts: 0,
        ..ShortcutOptions::default()
    };
    assert_eq!(
        shortcut(&Discs::new(&[]).cell, &points, &none).points,
        points
    );
}

#[test]
fn around_a_disc_it_comes_near_the_shortest_way() {
    let discs = Discs::new(&[[0.0, 0.0, 0.9]]);
    let points = [-2.0, 0.0, -2.0, 3.0, 2.0, 3.0, 2.0, 0.0];
    let shortest = shortest_around(2.0, 1.0);
    for seed in 0..20 {
        let options = ShortcutOptions {
            attempts: 400,
            seed,
            threshold: 0.0,
        };
        let found = shortcut(&discs.cell, &points, &options);
        check(&points, &found);
        assert!(found.lengths[1] >= shortest - 1e-9);
        assert!(
            found.lengths[1] <= 1.05 * shortest,
            "{seed}: {:?}",
            found.lengths
        );
    }
}

#[test]
fn every_segment_is_proved_and_free_at_samples() {
    let mut random = Random::new(43);
    let context = &mut QueryContext::new();
    let [mut free, mut cuts] = [0; 2];
    for round in 0..150 {
        let cobject = scene(&mut random);
        let space = cobject.space().clone();
        let mut points = Vec::new();
        let mut q = space.neutral();
        for size in [2.0, 0.6, 0.3, 0.6, 0.4] {
            let step: Vec<f64> = (0..space.nv())
                .map(|_| random.within(-size, size))
                .collect();
            q = space.step(&q, &step);
            points.extend(&q);
        }
        let options = ShortcutOptions {
            seed: round,
            ..ShortcutOptions::default()
        };
        let found = shortcut(&cobject, &points, &options);
        assert!(found.lengths[1] <= found.lengths[0]);
        if found.outcome == ShortcutOutcome::NotFree {
            continue;
        }
        free += 1;
        cuts += found.cuts;
        let points: Vec<&[f64]> = found.points.chunks(space.nq()).collect();
        for two in points.windows(2) {
            let proved = context.motion(&cobject, two[0], two[1], &MotionOptions::default());
            assert_eq!(proved.unwrap().outcome, MotionOutcome::Free, "{round}");
            for i in 0..=300 {
                let q = space.interpolate(two[0], two[1], f64::from(i) / 300.0);
                assert_ne!(class(context, &cobject, &q), Class::Inside, "{round}");
            }
        }
    }
    assert!(free > 30 && cuts > 30, "{free} {cuts}");
}

#[test]
fn limited_work_leaves_a_path_that_is_free() {
    let discs = Discs::new(&[[0.0, 0.0, 0.9], [0.0, 2.0, 0.3]]);
    let points = [-2.0, 0.0, -2.0, 3.0, 2.0, 3.0, 2.0, 0.0];
    let mut outcomes = [0usize; 3];
    let mut last = f64::INFINITY;
    for limit in (0..200).chain((200..20_000).step_by(97)) {
        let mut context = QueryContext::new();
        context.set_limit(Some(limit));
        let options = ShortcutOptions::default();
        let found = context.path_shortcut(&discs.cell, &points, &options, &mut silent);
        let found = found.unwrap();
        outcomes[found.outcome as usize] += 1;
        check(&points, &found);
        assert!(discs.on_path(&found.points).iter().all(|&d| d > 0.0));
        if found.outcome == ShortcutOutcome::NotFree {
            assert_eq!(found.given.motion.outcome, MotionOutcome::Undecided);
        }
        // More work never makes it longer.
        assert!(found.lengths[1] <= last);
        last = found.lengths[1];
    }
    assert!(outcomes.iter().all(|&n| n > 0), "{outcomes:?}");
}

#[test]
fn progress_rises_and_may_end_the_work() {
    let discs = Discs::new(&[[0.0, 0.0, 0.9]]);
    let points = [-2.0, 0.0, -2.0, 3.0, 2.0, 3.0, 2.0, 0.0];
    let options = ShortcutOptions::default();
    let mut context = QueryContext::new();
    let mut seen = Vec::new();
    let found = context.path_shortcut(&discs.cell, &points, &options, &mut |part| {
        seen.push(part);
        Ok(())
    });
    assert!(found.is_ok());
    assert_eq!(seen.len(), 3 + options.attempts + 1);
    assert!(seen.windows(2).all(|two| two[0] < two[1]) && *seen.last().unwrap() == 1.0);
    for end in [1, 3, 7] {
        let mut calls = 0;
        let stopped = context.path_shortcut(&discs.cell, &points, &options, &mut |_| {
            calls += 1;
            if calls == end {
                return Err(Error::new(ErrorKind::Cancelled, "enough"));
            }
            Ok(())
        });
        assert_eq!(stopped.unwrap_err().kind, ErrorKind::Cancelled);
        assert_eq!(calls, end);
    }
}

/// As many attempts as there are numbers, stopped by the caller.
#[test]
fn any_number_of_attempts_is_made_until_the_caller_stops() {
    let discs = Discs::new(&[[0.0, 0.0, 0.9]]);
    let points = [-2.0, 0.0, -2.0, 3.0, 2.0, 3.0, 2.0, 0.0];
    let options = ShortcutOptions {
        attempts: usize::MAX,
        ..ShortcutOptions::default()
    };
    let mut calls = 0;
    let stopped = QueryContext::new().path_shortcut(&discs.cell, &points, &options, &mut |part| {
        assert!((0.0..=1.0).contains(&part), "{part}");
        calls += 1;
        match calls < 1000 {
            true => Ok(()),
            false => Err(Error::new(ErrorKind::Cancelled, "enough")),
        }
    });
    assert_eq!(stopped.unwrap_err().kind, ErrorKind::Cancelled);
}

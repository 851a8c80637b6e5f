//! Slides that go on: where they arrive and what stops them, in closed form; and what every one of their motions keeps.

use std::sync::Arc;

use cstk::cobject::{CObject, Class};
use cstk::error::{Error, ErrorKind, Result};
use cstk::motion::{SlidPath, SlideToOptions, SlideToOutcome};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::{Coordinate, JointKind, LinkDefinition};
use cstk::space::{Space, WorldBox};

use helpers::random::Random;
use helpers::robots::{against, environment, link, robot};
use helpers::shapes::cuboid;

use super::discs::{Discs, length, shortest_around};
use super::random_scenes::{class, scene};

fn silent(_: f64) -> Result<()> {
    Ok(())
}

fn slide_to(cell: &CObject, q: &[f64], goal: &[f64], options: &SlideToOptions) -> SlidPath {
    let mut context = QueryContext::new();
    let led = context.slide_to(cell, q, [goal, goal], None, options, &mut silent);
    led.unwrap()
}

fn options() -> SlideToOptions {
    SlideToOptions::with_step(0.05, 0.12)
}

#[test]
fn a_free_way_is_one_motion() {
    let discs = Discs::new(&[[0.0, 0.0, 0.4]]);
    let led = slide_to(&discs.cell, &[-2.0, 1.0], &[2.0, 1.0], &options());
    assert_eq!(led.outcome, SlideToOutcome::Arrived);
    assert_eq!(led.points, [-2.0, 1.0, 2.0, 1.0]);
    assert_eq!((led.remaining, led.steps, led.motions), (0.0, 0, 1));
    // Where it is there already nothing is done.
    let led = slide_to(&discs.cell, &[-2.0, 1.0], &[-2.0, 1.0], &options());
    assert_eq!(led.points, [-2.0, 1.0]);
    assert_eq!((led.outcome, led.motions), (SlideToOutcome::Arrived, 0));
}

#[test]
fn around_a_disc_it_arrives() {
    let discs = Discs::new(&[[0.0, 0.0, 0.5]]);
    for y in [-0.4, -0.3, 0.25, 0.35] {
        let (start, goal) = ([-2.0, y], [2.0, 0.0]);
        let led = slide_to(&discs.cell, &start, &goal, &options());
        assert_eq!(led.outcome, SlideToOutcome::Arrived, "{y}: {led:?}");
        assert_eq!(led.points[..2], start);
        assert_eq!(led.points[led.points.len() - 2..], goal);
        assert!(discs.on_path(&led.points).iter().all(|&d| d > 0.0));
        // It hugs the disc at a tenth of the shell.
        let shortest = shortest_around(2.0, 0.6);
        assert!(
            length(&led.points) < 1.1 * shortest,
            "{}",
            length(&led.points)
        );
    }
}

#[test]
fn head_on_it_stops_before_the_disc() {
    let discs = Discs::new(&[[0.0, 0.0, 0.5]]);
    let led = slide_to(&discs.cell, &[-2.0, 0.0], &[2.0, 0.0], &options());
    assert!(
        matches!(led.outcome, SlideToOutcome::Blocked | SlideToOutcome::Idle),
        "{led:?}"
    );
    let last = &led.points[led.points.len() - 2..];
    assert!((last[0] - (-0.6 - 0.012)).abs() < 1e-3, "{last:?}");
    assert!((led.remaining - (2.0 - last[0])).abs() < 1e-2);
    // Near enough is there.
    let near = SlideToOptions {
        tolerance: 0.02,
        ..options()
    };
    let led = slide_to(&discs.cell, &[-2.0, 0.0], &[-0.6, 0.0], &near);
    assert_eq!(led.outcome, SlideToOutcome::Arrived);
    assert!(led.remaining > 0.0 && led.remaining <= 0.02);
    // Inside it does not move.
    let led = slide_to(&discs.cell, &[0.0, 0.1], &[2.0, 0.0], &options());
    assert_eq!((led.outcome, led.points.len()), (SlideToOutcome::Inside, 2));
}

#[test]
fn a_number_of_steps_ends_it() {
    let discs = Discs::new(&[[0.0, 0.0, 0.5]]);
    let (start, goal) = ([-2.0, 0.3], [2.0, 0.0]);
    let whole = slide_to(&discs.cell, &start, &goal, &options());
    for max_steps in [1, 2, 5, 11] {
        let few = SlideToOptions {
            max_steps,
            ..options()
        };
        let led = slide_to(&discs.cell, &start, &goal, &few);
        assert_eq!((led.outcome, led.steps), (SlideToOutcome::Steps, max_steps));
        assert_eq!(led.points[..], whole.points[..led.points.len()]);
    }
}

/// A step that gains too little, but ends within the tolerance.
#[test]
fn whoever_is_near_enough_has_arrived() {
    let discs = Discs::new(&[[0.0, 0.0, 0.5]]);
    let (start, goal) = ([-2.0, 0.3], [2.0, 0.0]);
    for steps in 1..12 {
        let few = SlideToOptions {
            steps_between_motions: 1000,
            max_steps: steps,
            ..options()
        };
        let short = slide_to(&discs.cell, &start, &goal, &few);
        let impatient = SlideToOptions {
            tolerance: short.remaining * (1.0 + 1e-9),
            max_steps: 1000,
            min_gain: 0.999_999,
            max_idle_steps: 0,
            ..few
        };
        let led = slide_to(&discs.cell, &start, &goal, &impatient);
        let is_near = led.remaining <= impatient.tolerance;
        assert_eq!(led.outcome == SlideToOutcome::Arrived, is_near, "{led:?}");
    }
}

#[test]
fn goals_may_be_boxes() {
    let discs = Discs::new(&[[0.0, 0.0, 0.5]]);
    let any = f64::INFINITY;
    let mut query = QueryContext::new();
    let mut led = |low: [f64; 2], high: [f64; 2], weights: Option<&[f64]>| {
        let way = query.slide_to(
            &discs.cell,
            &[-2.0, 0.3],
            [&low, &high],
            weights,
            &options(),
            &mut silent,
        );
        way.unwrap()
    };
    let past = led([1.0, -any], [9.0, any], None);
    assert_eq!(past.outcome, SlideToOutcome::Arrived);
    let last = &past.points[past.points.len() - 2..];
    assert_eq!(last[0], 1.0);
    assert!(discs.on_path(&past.points).iter().all(|&d| d > 0.0));
    // Straight up, to the nearest place of the box.
    let up = led([-3.0, 1.5], [-1.0, 2.0], None);
    assert_eq!(up.points, [-2.0, 0.3, -2.0, 1.5]);
    // A heavy coordinate takes more steps.
    let heavy = led([1.0, -any], [9.0, any], Some(&[2.0, 1.0]));
    assert_eq!(heavy.outcome, SlideToOutcome::Arrived);
    assert!(heavy.steps > past.steps, "{} {}", heavy.steps, past.steps);
}

/// A bar that turns without limits, and a post in its way on the shorter side.
#[test]
fn circles_go_the_shorter_way() {
    let bar = cuboid([1.0, 0.1, 0.1]).body;
    let links = vec![LinkDefinition {
        body: Some(bar),
        ..link(None, JointKind::Revolute, Vec3::z())
    }];
    let space = Arc::new(
        Space::new(
            vec![robot(3, links)],
            &[Some(Coordinate::Circle)],
            WorldBox::unbounded(),
        )
        .unwrap(),
    );
    let post = cuboid([0.1; 3]).body;
    let at = |x: f64| Pose::from_translation(Vec3::new(x, 0.9, 0.0));
    let free = against(&space, &environment(&[(&post, at(0.0))]).0);
    let led = slide_to(&free, &[3.0], &[-3.0], &options());
    assert_eq!(led.outcome, SlideToOutcome::Arrived);
    assert_eq!(led.points, [3.0, -3.0]);
    // Steps of several turns are proved as the shorter ways that the path names.
    let context = &mut QueryContext::new();
    let held = against(
        &space,
        &environment(&[(&post, Pose::from_translation(Vec3::new(0.0, 0.4, 0.0)))]).0,
    );
    for step in [0.05, 1.0, 4.0, 50.0] {
        let wide = SlideToOptions::with_step(step, 0.2);
        let led = slide_to(&held, &[0.1], &[2.9], &wide);
        assert_ne!(led.outcome, SlideToOutcome::Arrived, "{step}");
        for two in led.points.windows(2) {
            for i in 0..=200 {
                let q = space.interpolate(&two[..1], &two[1..], f64::from(i) / 200.0);
                assert_ne!(class(context, &held, &q), Class::Inside, "{step}");
            }
        }
    }
}

/// A scene, a configuration of it and a goal.
fn scene_with_ends(random: &mut Random) -> (CObject, [Vec<f64>; 2]) {
    let cobject = scene(random);
    let space = cobject.space();
    let mut drawn = |size: f64| -> Vec<f64> {
        (0..space.nv())
            .map(|_| random.within(-size, size))
            .collect()
    };
    let start = space.step(&space.neutral(), &drawn(2.0));
    let goal = space.step(&start, &drawn(1.5));
    (cobject, [start, goal])
}

/// Wherever it leads, nothing is met at any sample, and nothing leaves its range.
#[test]
fn every_motion_of_random_slides_is_free_at_samples() {
    let mut random = Random::new(47);
    let context = &mut QueryContext::new();
    let mut outcomes = [0usize; 6];
    let mut slid = 0;
    for round in 0..150 {
        let (cobject, [start, goal]) = scene_with_ends(&mut random);
        let space = cobject.space().clone();
        let options = SlideToOptions {
            max_steps: 60,
            ..SlideToOptions::with_step(0.1, 0.2)
        };
        let led = slide_to(&cobject, &start, &goal, &options);
        outcomes[led.outcome as usize] += 1;
        slid += led.steps;
        let points: Vec<&[f64]> = led.points.chunks(space.nq()).collect();
        assert_eq!(points[0], start);
        let last = points[points.len() - 1];
        assert_eq!(led.remaining, space.distance(last, &goal, None), "{round}");
        assert_eq!(led.outcome == SlideToOutcome::Arrived, led.remaining == 0.0);
        if points.len() == 1 {
            continue;
        }
        for two in points.windows(2) {
            for i in 0..=100 {
                let q = space.interpolate(two[0], two[1], f64::from(i) / 100.0);
                assert_ne!(class(context, &cobject, &q), Class::Inside, "{round}");
            }
        }
        assert!(space.contains(last).unwrap());
        let again = slide_to(&cobject, &start, &goal, &options);
        assert_eq!(again.points, led.points, "the same call, the same answer");
    }
    println!("arrived, inside, blocked, idle, steps, limited: {outcomes:?}, {slid} steps");
    assert!(
        outcomes[0] > 10 && outcomes[1] > 10 && outcomes[3] > 3,
        "{outcomes:?}"
    );
    assert!(slid > 300, "{slid}");
}

/// Where no distance is to be kept, slides come as near as rounding, and no nearer.
#[test]
fn slides_that_touch_stay_outside() {
    let mut random = Random::new(4711);
    let context = &mut QueryContext::new();
    let (mut points, mut touching) = (0, 0);
    for round in 0..700 {
        let (cobject, [start, goal]) = scene_with_ends(&mut random);
        let space = cobject.space().clone();
        let mut options = SlideToOptions {
            max_steps: 40,
            ..SlideToOptions::with_step(0.1, 0.2)
        };
        options.slide.desired_distance = 0.0;
        let led = slide_to(&cobject, &start, &goal, &options);
        for q in led.points.chunks(space.nq()).skip(1) {
            let q = Configuration::Coordinates(q);
            let distance = context.distance(&cobject, q, f64::INFINITY).unwrap();
            assert!(distance.lower > 0.0, "round {round}: {}", distance.distance);
            points += 1;
            touching += usize::from(distance.lower < 1e-9);
        }
    }
    assert!(points > 1000 && touching > 10, "{points} {touching}");
}

#[test]
fn limited_work_leaves_the_way_so_far() {
    let discs = Discs::new(&[[0.0, 0.0, 0.5]]);
    let (start, goal) = ([-2.0, 0.3], [2.0, 0.0]);
    let whole = slide_to(&discs.cell, &start, &goal, &options());
    let mut outcomes = [0usize; 2];
    for limit in (0..3000).step_by(7).chain([1_000_000]) {
        let mut context = QueryContext::new();
        context.set_limit(Some(limit));
        let ends = [&goal[..], &goal[..]];
        let led = context.slide_to(&discs.cell, &start, ends, None, &options(), &mut silent);
        let led = led.unwrap();
        let is_limited = led.outcome == SlideToOutcome::Limited;
        assert!(is_limited || led.outcome == whole.outcome);
        assert!(discs.on_path(&led.points).iter().all(|&d| d > 0.0));
        outcomes[usize::from(is_limited)] += 1;
    }
    assert!(outcomes.iter().all(|&n| n > 0), "{outcomes:?}");
}

#[test]
fn progress_rises_and_may_end_the_work() {
    let discs = Discs::new(&[[0.0, 0.0, 0.5]]);
    let (start, goal) = ([-2.0, 0.3], [2.0, 0.0]);
    let mut query = QueryContext::new();
    let mut seen = Vec::new();
    let ends = [&goal[..], &goal[..]];
    let led = query.slide_to(&discs.cell, &start, ends, None, &options(), &mut |part| {
        seen.push(part);
        Ok(())
    });
    assert!(led.is_ok() && seen.len() > 10);
    assert!(seen.windows(2).all(|two| two[0] < two[1]) && *seen.last().unwrap() == 1.0);
    let stopped = query.slide_to(&discs.cell, &start, ends, None, &options(), &mut |part| {
        if part > 0.01 {
            return Err(Error::new(ErrorKind::Cancelled, "enough"));
        }
        Ok(())
    });
    assert_eq!(stopped.unwrap_err().kind, ErrorKind::Cancelled);
}

#[test]
fn bad_input_is_refused() {
    let discs = Discs::new(&[[0.0, 0.0, 0.5]]);
    let mut query = QueryContext::new();
    let mut kind = |low: &[f64], high: &[f64], weights: Option<&[f64]>, options: SlideToOptions| {
        let refused = query.slide_to(
            &discs.cell,
            &[-2.0, 0.1],
            [low, high],
            weights,
            &options,
            &mut silent,
        );
        refused.unwrap_err().kind
    };
    let (goal, good) = ([2.0, 0.0], options());
    let inf = f64::INFINITY;
    use ErrorKind::{InvalidArgument, NotFinite, WrongSize};
    assert_eq!(kind(&goal[..1], &goal, None, good), WrongSize);
    assert_eq!(kind(&goal, &goal[..1], None, good), WrongSize);
    assert_eq!(kind(&[f64::NAN, 0.0], &goal, None, good), NotFinite);
    assert_eq!(kind(&[-inf, 0.0], &goal, None, good), NotFinite);
    assert_eq!(kind(&[inf, 0.0], &[-inf, 0.0], None, good), NotFinite);
    assert_eq!(kind(&[2.1, 0.0], &goal, None, good), InvalidArgument);
    assert_eq!(kind(&goal, &goal, Some(&[1.0]), good), WrongSize);
    assert_eq!(kind(&goal, &goal, Some(&[1.0, 0.0]), good), InvalidArgument);
    assert_eq!(kind(&goal, &goal, Some(&[1.0, inf]), good), NotFinite);
    for step in [0.0, -1.0] {
        assert_eq!(
            kind(&goal, &goal, None, SlideToOptions { step, ..good }),
            InvalidArgument
        );
    }
    for min_gain in [-0.1, 1.0] {
        let options = SlideToOptions { min_gain, ..good };
        assert_eq!(kind(&goal, &goal, None, options), InvalidArgument);
    }
    let options = SlideToOptions {
        max_steps: 0,
        ..good
    };
    assert_eq!(kind(&goal, &goal, None, options), InvalidArgument);
    let options = SlideToOptions {
        tolerance: f64::NAN,
        ..good
    };
    assert_eq!(kind(&goal, &goal, None, options), NotFinite);
}

//! Motions that a function gives.

use std::f64::consts::PI;
use std::sync::Arc;

use cstk::cobject::{CObject, Class, PureOptions, PureShape};
use cstk::error::{Error, ErrorKind, Result};
use cstk::motion::{MotionBounds, MotionFunction, MotionMoment, MotionOptions, MotionOutcome};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::{JointKind, LinkDefinition};

use super::curves::arm_among_hulls;
use helpers::random::Random;
use helpers::robots::{against, environment, link, robot, space};
use helpers::shapes::cuboid;

/// Each coordinate is `start + size sin(speed t + phase)`.
struct Waves(Vec<[f64; 4]>);

impl Waves {
    fn random(random: &mut Random, nq: usize) -> Self {
        let size = [0.05, 0.3, 1.0][random.below(3)];
        Self(
            (0..nq)
                .map(|_| {
                    let start = random.within(-2.0, 2.0);
                    let (size, speed) = (random.within(0.0, size), random.within(0.0, 6.0));
                    [start, size, speed, random.within(-PI, PI)]
                })
                .collect(),
        )
    }

    fn q(&self, t: f64) -> Vec<f64> {
        let at = |[start, size, speed, phase]: &[f64; 4]| start + size * (speed * t + phase).sin();
        self.0.iter().map(at).collect()
    }

    fn bounds(&self) -> [Vec<f64>; 2] {
        [1, 2].map(|order| {
            let largest = |wave: &[f64; 4]| wave[1] * wave[2].powi(order);
            self.0.iter().map(largest).collect()
        })
    }
}

impl MotionFunction for Waves {
    fn at(&self, t: f64, moment: &mut MotionMoment) -> Result<()> {
        moment.q = self.q(t);
        for (c, [_, size, speed, phase]) in self.0.iter().enumerate() {
            moment.rates[c] = size * speed * (speed * t + phase).cos();
            moment.accelerations[c] = -size * speed * speed * (speed * t + phase).sin();
        }
        Ok(())
    }
}

/// A function of one coordinate, from its value and derivatives.
struct Coordinate<F>(F);

impl<F: Fn(f64) -> [f64; 3]> MotionFunction for Coordinate<F> {
    fn at(&self, t: f64, moment: &mut MotionMoment) -> Result<()> {
        [moment.q[0], moment.rates[0], moment.accelerations[0]] = (self.0)(t);
        Ok(())
    }
}

fn class(context: &mut QueryContext, set: &CObject, q: &[f64]) -> Class {
    let at = Configuration::Coordinates(q);
    context.classify(set, at).unwrap()
}

#[test]
fn free_functions_are_free_at_every_sample_and_hits_are_hits() {
    let mut random = Random::new(213);
    let context = &mut QueryContext::new();
    let mut outcomes = [0usize; 4];
    for _ in 0..150 {
        let set = arm_among_hulls(&mut random);
        let space = set.space();
        for _ in 0..6 {
            let waves = Waves::random(&mut random, space.nq());
            let [max_rates, max_accelerations] = &waves.bounds();
            let bounds = &MotionBounds {
                max_rates,
                max_accelerations,
            };
            let options = &MotionOptions::default();
            let answer = context.motion_on_function(&set, &waves, bounds, options);
            let answer = answer.unwrap();
            outcomes[answer.outcome as usize] += 1;
            for i in 0..150 {
                let t = f64::from(i) / 149.0;
                if answer.outcome == MotionOutcome::Free || t < answer.times[0] {
                    let found = class(context, &set, &waves.q(t));
                    assert_ne!(found, Class::Inside, "at {t} of {answer:?}");
                }
            }
            if answer.outcome == MotionOutcome::Hit {
                let q = waves.q(answer.times[1]);
                assert_eq!(class(context, &set, &q), Class::Inside);
                assert_eq!(q, answer.configuration);
                assert!(answer.times[1] - answer.times[0] <= options.tolerance);
            }
        }
    }
    println!("free, hit, near, undecided: {outcomes:?}");
    assert!(outcomes[0] > 100 && outcomes[1] > 100, "{outcomes:?}");
    assert!(outcomes[2] < 20 && outcomes[3] == 0, "{outcomes:?}");
}

/// A cube of side .2 on a rail, and a wall that it meets at .75.
fn slider() -> (Arc<cstk::space::Space>, CObject) {
    let links = vec![LinkDefinition {
        body: Some(cuboid([0.2; 3]).body),
        ..link(None, JointKind::Prismatic, Vec3::x())
    }];
    let wall = cuboid([0.2, 1.0, 1.0]).body;
    let space = space(vec![robot(3, links)]);
    let at = Pose::from_translation(Vec3::new(0.95, 0.0, 0.0));
    let cell = against(&space, &environment(&[(&wall, at)]).0);
    (space, cell)
}

const SLIDE: MotionBounds = MotionBounds {
    max_rates: &[4.0],
    max_accelerations: &[8.0],
};

/// 4 t (1 - t), which is .75 at t = .25.
fn parabola(t: f64) -> [f64; 3] {
    [4.0 * t * (1.0 - t), 4.0 - 8.0 * t, -8.0]
}

#[test]
fn contacts_come_when_closed_forms_say() {
    let (_, cell) = slider();
    let context = &mut QueryContext::new();
    let mut contact = |function: &dyn MotionFunction, bounds: &MotionBounds| {
        let options = &MotionOptions::default();
        let answer = context.motion_on_function(&cell, function, bounds, options);
        let answer = answer.unwrap();
        (answer.outcome == MotionOutcome::Hit).then_some(answer.times[1])
    };
    let on_parabola = contact(&Coordinate(parabola), &SLIDE).unwrap();
    assert!((on_parabola - 0.25).abs() < 2e-6, "{on_parabola}");
    // Half speed up to the middle, then a second derivative that jumps: 1.4 t, then .7 + 1.4 s + 4 s^2.
    let jumps = Coordinate(|t: f64| {
        let s = (t - 0.5).max(0.0);
        let acceleration = if t > 0.5 { 8.0 } else { 0.0 };
        [1.4 * t + 4.0 * s * s, 1.4 + 8.0 * s, acceleration]
    });
    let bounds = MotionBounds {
        max_rates: &[5.4],
        ..SLIDE
    };
    let s = (-1.4 + (1.4f64 * 1.4 + 4.0 * 4.0 * 0.05).sqrt()) / 8.0;
    let found = contact(&jumps, &bounds).unwrap();
    assert!((found - 0.5 - s).abs() < 2e-6, "{found}");
    // One that turns just before the wall.
    let below = |t: f64| parabola(t).map(|x| 0.7499 * x);
    assert_eq!(contact(&Coordinate(below), &SLIDE), None);
    // What rests stays free.
    let rests = MotionBounds {
        max_rates: &[0.0],
        max_accelerations: &[0.0],
    };
    assert_eq!(contact(&Coordinate(|_| [0.5, 0.0, 0.0]), &rests), None);
}

/// A slider that rests at .5 where the whole motion is looked at first, and at the end has come just to the wall, or not quite.
#[test]
fn what_speeds_up_after_a_look_is_seen() {
    let (_, cell) = slider();
    let context = &mut QueryContext::new();
    for (way, meets) in [(0.2501, true), (0.2499, false)] {
        let speeds_up = Coordinate(|t: f64| {
            let s = (t - 0.5).max(0.0);
            let acceleration = if t > 0.5 { 8.0 * way } else { 0.0 };
            [0.5 + 4.0 * way * s * s, 8.0 * way * s, acceleration]
        });
        let bounds = &MotionBounds {
            max_rates: &[4.0 * way],
            max_accelerations: &[8.0 * way],
        };
        let options = &MotionOptions::default();
        let answer = context.motion_on_function(&cell, &speeds_up, bounds, options);
        let answer = answer.unwrap();
        assert_eq!(answer.outcome == MotionOutcome::Hit, meets, "{answer:?}");
        if meets {
            let time = 0.5 + 0.5 * (0.25f64 / way).sqrt();
            assert!((answer.times[1] - time).abs() < 2e-6, "{time}, {answer:?}");
        }
    }
}

#[test]
fn sets_of_c_space_are_followed_along_functions() {
    let (space, _) = slider();
    let options = PureOptions {
        scale: Some(1.0),
        ..PureOptions::default()
    };
    let shape = PureShape::Box {
        low: vec![0.75],
        high: vec![2.0],
    };
    let set = CObject::pure(space, shape, options).unwrap();
    let context = &mut QueryContext::new();
    let mut ask = |function: &dyn MotionFunction| {
        let options = &MotionOptions::default();
        context
            .motion_on_function(&set, function, &SLIDE, options)
            .unwrap()
    };
    let hit = ask(&Coordinate(parabola));
    assert_eq!(hit.outcome, MotionOutcome::Hit);
    assert!((hit.times[1] - 0.25).abs() < 2e-6, "{:?}", hit.times);
    let below = ask(&Coordinate(|t| parabola(t).map(|x| 0.7499 * x)));
    assert_eq!(below.outcome, MotionOutcome::Free);
}

#[test]
fn what_exceeds_its_bounds_is_refused_by_name() {
    let (_, cell) = slider();
    let context = &mut QueryContext::new();
    let mut refused = |function: &dyn MotionFunction, bounds: &MotionBounds| {
        let options = &MotionOptions::default();
        let answer = context.motion_on_function(&cell, function, bounds, options);
        let error = answer.unwrap_err();
        (error.kind, error.message)
    };
    let with = |rate: f64, acceleration: f64| ([rate], [acceleration]);
    let invalid = ErrorKind::InvalidArgument;
    for (([rate], [acceleration]), kind, culprit) in [
        (with(3.0, 8.0), invalid, "max_rates"),
        (with(4.0, 7.0), invalid, "max_accelerations"),
        (with(-1.0, 8.0), invalid, "max_rates[0]"),
        (
            with(4.0, f64::NAN),
            ErrorKind::NotFinite,
            "max_accelerations",
        ),
    ] {
        let bounds = MotionBounds {
            max_rates: &[rate],
            max_accelerations: &[acceleration],
        };
        let (found, message) = refused(&Coordinate(parabola), &bounds);
        assert!(found == kind && message.contains(culprit), "{message}");
    }
    // Derivatives of another motion: the place tells.
    let lies = |t: f64| [parabola(t)[0], 0.0, 0.0];
    let rests = MotionBounds {
        max_rates: &[0.0],
        max_accelerations: &[0.0],
    };
    let (kind, message) = refused(&Coordinate(lies), &rests);
    assert!(
        kind == invalid && message.contains("coordinate 0"),
        "{message}"
    );
    // Rates that are none, or half of what they should be, within bounds that hold of the motion.
    let straight = MotionBounds {
        max_rates: &[4.0],
        max_accelerations: &[0.0],
    };
    for part in [0.0, 0.5, 0.999] {
        let slow = |t: f64| [4.0 * t, 4.0 * part, 0.0];
        let (kind, message) = refused(&Coordinate(slow), &straight);
        assert!(
            kind == invalid && message.contains("derivative"),
            "{message}"
        );
        let slow = |t: f64| [parabola(t)[0], part * parabola(t)[1], part * -8.0];
        let (kind, message) = refused(&Coordinate(slow), &SLIDE);
        assert!(
            kind == invalid && message.contains("derivative"),
            "{message}"
        );
    }
    let unknown = |t: f64| [parabola(t)[0], f64::NAN, -8.0];
    assert_eq!(
        refused(&Coordinate(unknown), &SLIDE).0,
        ErrorKind::NotFinite
    );
    let (kind, _) = refused(&Coordinate(|_| [f64::INFINITY, 0.0, 0.0]), &SLIDE);
    assert_eq!(kind, ErrorKind::NotFinite);
    let two = MotionBounds {
        max_rates: &[4.0, 4.0],
        ..SLIDE
    };
    assert_eq!(refused(&Coordinate(parabola), &two).0, ErrorKind::WrongSize);
    struct Broken;
    impl MotionFunction for Broken {
        fn at(&self, t: f64, moment: &mut MotionMoment) -> Result<()> {
            if t > 0.0 {
                return Err(Error::new(ErrorKind::Callback, "no more"));
            }
            moment.q[0] = 0.0;
            moment.rates[0] = 0.0;
            moment.accelerations[0] = 0.0;
            Ok(())
        }
    }
    assert_eq!(refused(&Broken, &SLIDE).0, ErrorKind::Callback);
}

#[test]
fn quaternions_rest_while_others_move() {
    let body = cuboid([1.0; 3]).body;
    let links = vec![LinkDefinition {
        body: Some(body.clone()),
        ..link(None, JointKind::Free, Vec3::z())
    }];
    let space = space(vec![robot(3, links)]);
    let far = Pose::from_translation(Vec3::new(9.0, 0.0, 0.0));
    let cell = against(&space, &environment(&[(&body, far)]).0);
    let neutral = space.neutral();
    let nq = space.nq();
    struct Rests(Vec<f64>);
    impl MotionFunction for Rests {
        fn at(&self, _: f64, moment: &mut MotionMoment) -> Result<()> {
            moment.q.clone_from(&self.0);
            moment.rates.fill(0.0);
            moment.accelerations.fill(0.0);
            Ok(())
        }
    }
    let context = &mut QueryContext::new();
    let mut ask = |rate: f64| {
        let (max_rates, max_accelerations) = (&vec![rate; nq][..], &vec![0.0; nq][..]);
        let bounds = &MotionBounds {
            max_rates,
            max_accelerations,
        };
        let options = &MotionOptions::default();
        context.motion_on_function(&cell, &Rests(neutral.clone()), bounds, options)
    };
    assert_eq!(ask(0.0).unwrap().outcome, MotionOutcome::Free);
    assert_eq!(ask(1.0).unwrap_err().kind, ErrorKind::Unsupported);
}

/// A coordinate that is multiplied by 1e50 swings back and forth with accelerations of 1e50, and through an obstacle between times at
/// which it is far from there: of its third derivative nothing is known, however large the second is.
#[test]
fn the_largest_accelerations_hide_nothing() {
    let period = 1.0 / 8.0;
    let step = period / 4.0;
    let acceleration = 0.999e50;
    let start = 0.5 * acceleration * step * step;
    // From rest at the start, back at full acceleration and away again.
    let swing = |t: f64| {
        let s = t.rem_euclid(period);
        let far = acceleration * step * step;
        let [x, v, a] = if s < step {
            [
                -0.5 * acceleration * s * s,
                -acceleration * s,
                -acceleration,
            ]
        } else if s < 3.0 * step {
            let e = s - 2.0 * step;
            [
                0.5 * acceleration * e * e - far,
                acceleration * e,
                acceleration,
            ]
        } else {
            let e = period - s;
            [-0.5 * acceleration * e * e, acceleration * e, -acceleration]
        };
        [start + x, v, a]
    };
    let slab = cuboid([2e49; 3]).body;
    let links = vec![LinkDefinition {
        body: Some(slab.clone()),
        multiplier: 1e50,
        ..link(None, JointKind::Prismatic, Vec3::x())
    }];
    let space = space(vec![robot(3, links)]);
    let set = against(&space, &environment(&[(&slab, Pose::identity())]).0);
    let context = &mut QueryContext::new();
    assert_eq!(class(context, &set, &[0.0]), Class::Inside);
    let bounds = &MotionBounds {
        max_rates: &[1.0001 * acceleration * step],
        max_accelerations: &[1e50],
    };
    let options = &MotionOptions::default();
    let answer = context.motion_on_function(&set, &Coordinate(swing), bounds, options);
    let outcome = answer.map(|answer| answer.outcome);
    assert!(!matches!(outcome, Ok(MotionOutcome::Free)), "{outcome:?}");
}

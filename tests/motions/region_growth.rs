//! Boxes that grow around a configuration: free at every sample, and stopped by what is told.

use std::sync::Arc;

use cstk::cobject::{CObject, Class, PureShape};
use cstk::motion::{GrowthOptions, SideStop};
use cstk::pose::{Pose, Vec3};
use cstk::query::QueryContext;

use helpers::pure::pure;
use helpers::random::Random;
use helpers::robots::{against, environment};
use helpers::shapes::cuboid;

use crate::random_scenes::scene;
use crate::regions::{amount, class, sample};
use crate::regions_in_closed_form::slider;

/// Whatever the limit of work, what was proved until then is answered.
#[test]
fn limited_work_leaves_the_box_so_far() {
    let (space, cube) = (slider(), cuboid([1.0; 3]).body);
    let walls = [-3.0, 4.0].map(|x| (&cube, Pose::from_translation(Vec3::new(x, 0.0, 0.0))));
    let cobject = against(&space, &environment(&walls).0);
    let whole = QueryContext::new()
        .grow_region(&cobject, &[0.0], None, &GrowthOptions::default())
        .unwrap();
    let mut outcomes = [0; 2];
    for limit in (4..400).chain([1_000_000]) {
        let mut context = QueryContext::new();
        context.set_limit(Some(limit));
        let grown = context.grow_region(&cobject, &[0.0], None, &GrowthOptions::default());
        let grown = grown.unwrap();
        let is_limited = grown
            .sides
            .iter()
            .any(|side| side.stop == SideStop::Limited);
        assert!(whole.low[0] <= grown.low[0] && grown.low[0] <= 0.0);
        assert!(0.0 <= grown.high[0] && grown.high[0] <= whole.high[0]);
        assert!(is_limited || grown.low == whole.low && grown.high == whole.high);
        outcomes[usize::from(is_limited)] += 1;
    }
    assert!(outcomes.iter().all(|&n| n > 0), "{outcomes:?}");
}

/// Sides so short that their halves are no numbers any more end as others do, also where nothing can be proved: at touching cubes it is
/// not known that their complement is left.
#[test]
fn the_shortest_sides_end() {
    let (space, cube) = (slider(), cuboid([1.0; 3]).body);
    let wall = [(&cube, Pose::from_translation(Vec3::new(2.0, 0.0, 0.0)))];
    let complement =
        CObject::complement(&Arc::new(against(&space, &environment(&wall).0))).unwrap();
    let touching = 1.0;
    let context = &mut QueryContext::new();
    for max_side in [1e-300, 1e-310, 1e-317, 5e-324] {
        let options = &GrowthOptions {
            max_side,
            ..GrowthOptions::default()
        };
        let grown = context.grow_region(&complement, &[touching], None, options);
        let grown = grown.unwrap();
        assert_eq!((grown.low[0], grown.high[0]), (touching, touching));
    }
}

/// Grown boxes hold their configuration, are free at every sample, and what stops a side is a contact just beyond it.
#[test]
fn grown_boxes_are_free_and_stopped_by_contacts() {
    let (count, samples) = amount(60);
    let count = count.min(1000);
    let mut random = Random::new(317);
    let context = &mut QueryContext::new();
    let mut grown_boxes = 0;
    let mut contacts = 0;
    for round in 0..count {
        let cobject = scene(&mut random);
        let space = cobject.space().clone();
        let v: Vec<f64> = (0..space.nv()).map(|_| random.within(-2.0, 2.0)).collect();
        let q = space.step(&space.neutral(), &v);
        let options = GrowthOptions {
            max_boxes: 50,
            ..GrowthOptions::default()
        };
        if class(context, &cobject, &q) == Class::Inside {
            let error = context.grow_region(&cobject, &q, None, &options);
            assert!(error.unwrap_err().message.contains("inside"));
            continue;
        }
        let weights: Vec<f64> = (0..space.nv())
            .map(|_| [0.0, 0.5, 1.0, 2.0][random.below(4)])
            .collect();
        let grown = context
            .grow_region(&cobject, &q, Some(&weights), &options)
            .unwrap();
        grown_boxes += 1;
        let ends = [&grown.low[..], &grown.high[..]];
        for (c, x) in q.iter().enumerate() {
            assert!(ends[0][c] <= *x && *x <= ends[1][c], "round {round}");
        }
        for _ in 0..samples {
            let q = sample(&mut random, ends);
            let found = class(context, &cobject, &q);
            assert_ne!(found, Class::Inside, "round {round}: {q:?} of {grown:?}");
        }
        assert_eq!(grown.sides.len(), 2 * space.nv());
        for (number, side) in grown.sides.iter().enumerate() {
            let weight = weights[number / 2];
            if weight == 0.0 {
                assert_eq!(side.stop, SideStop::Fixed);
            }
            if side.stop == SideStop::Contact {
                contacts += 1;
                let at = side.configuration.as_ref().unwrap();
                assert_eq!(class(context, &cobject, at), Class::Inside);
                assert_eq!(side.distance.as_ref().unwrap().lower, 0.0);
                // No farther beyond the box than the tolerance allows.
                let beyond = (0..q.len()).map(|c| (ends[0][c] - at[c]).max(at[c] - ends[1][c]));
                let farthest = beyond.fold(0.0, f64::max);
                assert!(
                    farthest <= 2.0 * options.tolerance * weight + 1e-12,
                    "round {round}: {farthest} beyond"
                );
            }
        }
        let again = QueryContext::new().grow_region(&cobject, &q, Some(&weights), &options);
        let again = again.unwrap();
        assert_eq!([&again.low, &again.high], [&grown.low, &grown.high]);
    }
    println!("{grown_boxes} boxes, {contacts} sides in contact");
    assert!(grown_boxes > count / 3 && contacts > grown_boxes / 5);
}

/// A cube between two walls: its way is as long as the gap, up to the tolerance.
#[test]
fn a_box_grows_to_the_walls_and_to_the_range() {
    let space = slider();
    let wall = cuboid([1.0; 3]).body;
    let at = |x: f64| Pose::from_translation(Vec3::new(x, 0.0, 0.0));
    let (walls, ids) = environment(&[(&wall, at(-2.0)), (&wall, at(3.0))]);
    let set = against(&space, &walls);
    let context = &mut QueryContext::new();
    for tolerance in [0.1, 1e-3, 1e-6] {
        let options = GrowthOptions {
            tolerance,
            ..GrowthOptions::default()
        };
        let grown = context.grow_region(&set, &[0.3], None, &options).unwrap();
        // Inside from -3 to -1 and from 2 to 4.
        assert!(grown.low[0] > -1.0 && grown.low[0] < -1.0 + 2.0 * tolerance);
        assert!(grown.high[0] < 2.0 && grown.high[0] > 2.0 - 2.0 * tolerance);
        for (side, id) in grown.sides.iter().zip(&ids) {
            assert_eq!(side.stop, SideStop::Contact);
            let witness = side.distance.as_ref().unwrap().witness.unwrap();
            assert_eq!(witness.s_side, cstk::query::SSide::Object(*id));
        }
    }
    let options = GrowthOptions {
        max_side: 0.5,
        ..GrowthOptions::default()
    };
    let grown = context.grow_region(&set, &[0.0], None, &options).unwrap();
    assert_eq!([grown.low[0], grown.high[0]], [-0.5, 0.5]);
    assert!(
        grown
            .sides
            .iter()
            .all(|side| side.stop == SideStop::MaxSide)
    );
}

/// Wherever a wall is, a side that it stops has no more room than the tolerance.
#[test]
fn sides_stop_within_the_tolerance_of_contact() {
    let space = slider();
    let context = &mut QueryContext::new();
    let options = GrowthOptions::default();
    for i in 0..1000 {
        let wall = 0.5 + 0.003 * f64::from(i);
        let beyond = PureShape::HalfSpace {
            normal: vec![-1.0],
            offset: -wall,
            is_open: false,
        };
        let set = pure(&space, beyond, None);
        let grown = context.grow_region(&set, &[0.0], None, &options).unwrap();
        if grown.sides[1].stop == SideStop::Contact {
            let room = wall - grown.high[0];
            assert!(room <= options.tolerance * (1.0 + 1e-9), "{wall}: {room}");
        }
    }
}

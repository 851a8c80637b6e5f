//! Round bodies of very different sizes that turn: a small one that comes to rest a little inside a large one, in closed form.

use cstk::cobject::{CObject, Class};
use cstk::motion::{MotionOptions, MotionOutcome, PairMotion, RegionOptions, RegionOutcome};
use cstk::pose::{Pose, Vec3, rotation_about};
use cstk::query::QueryContext;
use cstk::robot::{JointKind, LinkDefinition};

use helpers::random::Random;
use helpers::robots::{against, environment, link, robot, space};

use super::random_scenes::{built, class};

/// A ball at the end of an arm that turns about x, and a large ball or capsule that it reaches into at the end of its way.
struct Reaching {
    cell: CObject,
    /// The deepest overlap.
    depth: f64,
    angles: [f64; 2],
    pair: [std::sync::Arc<cstk::body::Body>; 2],
    pose: Pose,
}

impl Reaching {
    fn random(random: &mut Random) -> Self {
        let exponential =
            |random: &mut Random, low: f64, high: f64| 10f64.powf(random.within(low, high));
        let arm = exponential(random, -2.0, 0.0);
        let small = arm * exponential(random, -3.0, -1.0);
        let large = exponential(random, -1.0, 1.0);
        let depth = small * exponential(random, -3.0, 0.0);
        let start = random.within(-3.0, 3.0);
        let sign = [1.0, -1.0][random.below(2)];
        let end = start + sign * random.within(0.3, 2.0);
        let tip = built(|b| b.add_sphere(&Vec3::new(0.0, 0.0, arm), small, 0).unwrap());
        let place = Vec3::new(0.0, -arm * end.sin(), arm * end.cos());
        let ahead = Vec3::new(0.0, -end.cos(), -end.sin()) * sign;
        let towards = ahead * random.within(0.2, 1.0) + random.point(0.8);
        let towards = towards.normalize();
        let center = towards * (small + large - depth);
        let is_capsule = random.below(2) == 0;
        let object = built(|b| match is_capsule {
            true => b
                .add_capsule(&center, &(center + towards * large), large, 0)
                .unwrap(),
            false => b.add_sphere(&center, large, 0).unwrap(),
        });
        let links = vec![LinkDefinition {
            body: Some(tip.clone()),
            ..link(None, JointKind::Revolute, Vec3::x())
        }];
        let pose = Pose::from_translation(place);
        let (environment, _) = environment(&[(&object, pose)]);
        Self {
            cell: against(&space(vec![robot(3, links)]), &environment),
            depth: depth / large,
            angles: [start, end],
            pair: [tip, object],
            pose,
        }
    }
}

/// `CSTK_MOTIONS=200000 cargo test --release --test motions round_bodies -- --nocapture` runs a campaign.
#[test]
fn a_small_ball_that_turns_does_not_end_inside_a_large_one_unseen() {
    let count = std::env::var("CSTK_MOTIONS").map_or(4000, |n| n.parse().unwrap());
    let mut random = Random::new(241);
    let context = &mut QueryContext::new();
    for _ in 0..count {
        let scene = Reaching::random(&mut random);
        let [start, end] = scene.angles;
        assert_eq!(class(context, &scene.cell, &[end]), Class::Inside);
        let options = MotionOptions::default();
        let straight = context.motion(&scene.cell, &[start], &[end], &options);
        let back = context.motion(&scene.cell, &[end], &[start], &options);
        for answer in [straight, back] {
            let answer = answer.unwrap();
            assert_ne!(answer.outcome, MotionOutcome::Free, "{:e}", scene.depth);
        }
        let turned = |angle: f64| Pose {
            rotation: rotation_about(&Vec3::x(), angle),
            ..Pose::identity()
        };
        let poses = [turned(start), turned(end)];
        let [tip, object] = &scene.pair;
        let moving = PairMotion {
            body: tip,
            poses: [&poses[0], &poses[1]],
        };
        let resting = PairMotion {
            body: object,
            poses: [&scene.pose, &scene.pose],
        };
        let answer = context.pair_motion(&moving, &resting, &options).unwrap();
        assert_ne!(answer.outcome, MotionOutcome::Free, "{:e}", scene.depth);
        // A box that goes on a little behind the end, so that its own end is no sample of the contact.
        let behind = end + 1e-4 * (end - start);
        let (low, high) = (start.min(behind), start.max(behind));
        let options = RegionOptions::default();
        let answer = context.classify_region(&scene.cell, &[low], &[high], &options);
        let outcome = answer.unwrap().outcome;
        assert_ne!(outcome, RegionOutcome::Free, "{:e}", scene.depth);
    }
}

/// The boxes of a ball's hierarchy hold its centre alone: what its size is must not be told by them.
#[test]
fn a_ball_that_turns_costs_no_more_the_smaller_it_is() {
    let context = &mut QueryContext::new();
    for exponent in 1..=9 {
        let radius = 10f64.powi(-exponent);
        let ball = built(|b| b.add_sphere(&Vec3::zeros(), radius, 0).unwrap());
        let large = built(|b| b.add_sphere(&Vec3::zeros(), 1.58, 0).unwrap());
        let links = vec![LinkDefinition {
            body: Some(ball),
            ..link(None, JointKind::FreeEuler, Vec3::z())
        }];
        let towards = Vec3::new(1.0, 1.0, 1.0).normalize();
        let pose = Pose::from_translation(towards * (1.58 + 0.0097 + 2.0 * radius));
        let (environment, _) = environment(&[(&large, pose)]);
        let cell = against(&space(vec![robot(3, links)]), &environment);
        let (from, to) = (
            [0.0, 0.0, 0.0, 1.0, -2.0, -1.0],
            [radius, 0.0, 0.0, -1.4, -0.9, 0.36],
        );
        context.reset_statistics();
        let answer = context.motion(&cell, &from, &to, &MotionOptions::default());
        assert_eq!(answer.unwrap().outcome, MotionOutcome::Free);
        let looked_at = context.statistics().node_pairs;
        assert!(
            looked_at < 100,
            "radius {radius:e}: {looked_at} pairs of boxes"
        );
    }
}

//! Chains of turns and shifts say where links are on a segment of C-space, how they move, and bound how they may.

use cstk::pose::{Pose, Vec3};
use cstk::robot::{JointKind, LinkDefinition, MotionChain};

use helpers::random::Random;
use helpers::robots::{link, robot, space};

const KINDS: [JointKind; 7] = [
    JointKind::Fixed,
    JointKind::Revolute,
    JointKind::Prismatic,
    JointKind::Planar,
    JointKind::Spherical,
    JointKind::Free,
    JointKind::FreeEuler,
];

/// A chain of a link of a random robot, and the pose that the robot itself has for it at a time.
struct Case {
    chain: MotionChain,
    truth: Box<dyn Fn(f64) -> Pose>,
}

fn case(random: &mut Random) -> Case {
    let length = 1 + random.below(5);
    let links = (0..length).map(|i| {
        let mut definition = LinkDefinition {
            at: random.pose(1.0),
            ..link(
                i.checked_sub(1 + random.below(2)),
                KINDS[random.below(KINDS.len())].clone(),
                [random.point(1.0), Vec3::z()][random.below(2)],
            )
        };
        if definition.kind.has_axis() {
            definition.multiplier = random.within(-2.0, 2.0);
            definition.offset = random.within(-1.0, 1.0);
        }
        definition
    });
    let robot = robot(3, links.collect());
    let space = space(vec![robot.clone()]);
    let drawn = |random: &mut Random, size: f64| -> Vec<f64> {
        (0..space.nv())
            .map(|_| random.within(-size, size))
            .collect()
    };
    let q = space.step(&space.neutral(), &drawn(random, 1.5));
    let size = [0.1, 1.0, 3.0][random.below(3)];
    let mut v = drawn(random, size);
    // Some coordinates rest, as most do in a planner's last joints.
    v.iter_mut()
        .for_each(|rate| *rate *= f64::from(u8::from(random.below(4) > 0)));
    let moving = random.below(length);
    let mut carriers = vec![None];
    let mut next = robot.links()[moving].parent;
    while let Some(carrier) = next {
        carriers.push(Some(carrier));
        next = robot.links()[carrier].parent;
    }
    let frame = carriers[random.below(carriers.len())];
    let chain = robot.motion_chain(frame, moving, &q, &v).unwrap();
    let truth = move |t: f64| {
        let part: Vec<f64> = v.iter().map(|rate| rate * t).collect();
        let poses = space.link_poses(&space.step(&q, &part)).unwrap();
        match frame {
            Some(frame) => poses[frame].inverse().compose(&poses[moving]),
            None => poses[moving],
        }
    };
    Case {
        chain,
        truth: Box::new(truth),
    }
}

#[test]
fn poses_are_those_of_the_robot() {
    let mut random = Random::new(81);
    for _ in 0..2000 {
        let case = case(&mut random);
        for t in [0.0, random.within(0.0, 1.0), 1.0] {
            let (found, truth) = (case.chain.at(t).pose, (case.truth)(t));
            assert!((found.rotation - truth.rotation).amax() < 1e-12);
            assert!((found.translation - truth.translation).amax() < 1e-12);
        }
    }
}

#[test]
fn an_inverse_leads_back_and_a_chain_goes_on() {
    let mut random = Random::new(82);
    for _ in 0..500 {
        let [one, other] = [case(&mut random), case(&mut random)];
        let between = one.chain.inverse().followed_by(&other.chain);
        let t = random.within(0.0, 1.0);
        let truth = (one.truth)(t).inverse().compose(&(other.truth)(t));
        let found = between.at(t).pose;
        assert!((found.rotation - truth.rotation).amax() < 1e-12);
        assert!((found.translation - truth.translation).amax() < 1e-11);
    }
}

/// Central differences of the poses are the oracle of velocities, those of velocities the oracle of accelerations.
#[test]
fn velocities_and_accelerations_are_derivatives() {
    let mut random = Random::new(83);
    let step = 1e-5;
    for _ in 0..1000 {
        let [one, other] = [case(&mut random), case(&mut random)];
        let chain = one.chain.inverse().followed_by(&other.chain);
        let t = random.within(0.1, 0.9);
        let point = random.point(1.0);
        let at = |t: f64| chain.at(t).pose.transform_point(&point);
        let velocity = |t: f64| {
            let state = chain.at(t);
            state.velocity(&(state.pose.rotation * point))
        };
        let state = chain.at(t);
        let scale = 1.0 + chain.rates().origin[2] + chain.rates().turn.powi(3);
        let by_poses = (at(t + step) - at(t - step)) / (2.0 * step);
        assert!((velocity(t) - by_poses).amax() < 1e-8 * scale);
        let by_velocities = (velocity(t + step) - velocity(t - step)) / (2.0 * step);
        let acceleration = state.acceleration(&(state.pose.rotation * point));
        assert!((acceleration - by_velocities).amax() < 1e-7 * scale);
    }
}

#[test]
fn no_derivative_is_above_its_bound() {
    let mut random = Random::new(84);
    // The largest part of a bound that a derivative has come to: 1 would be tight.
    let mut used = [0.0f64; 3];
    for round in 0..2000 {
        let case_a = case(&mut random);
        let chain = if round % 2 == 0 {
            case_a.chain
        } else {
            let other = case(&mut random);
            case_a.chain.inverse().followed_by(&other.chain)
        };
        let rates = chain.rates();
        let point = random.point(0.5);
        let radius = point.norm();
        let bound = |k: usize| rates.origin[k] + rates.turn.powi(k as i32 + 1) * radius;
        let acceleration = |t: f64| {
            let state = chain.at(t);
            state.acceleration(&(state.pose.rotation * point))
        };
        for i in 0..=10 {
            let t = f64::from(i) / 10.0;
            let state = chain.at(t);
            let step = 1e-5;
            let third = (acceleration(t + step) - acceleration(t - step)) / (2.0 * step);
            let derivatives = [
                state.velocity(&(state.pose.rotation * point)).norm(),
                acceleration(t).norm(),
                third.norm(),
            ];
            for (k, derivative) in derivatives.into_iter().enumerate() {
                let slack = if k == 2 {
                    1e-6 * (1.0 + bound(2))
                } else {
                    1e-12 * (1.0 + bound(k))
                };
                assert!(derivative <= bound(k) + slack, "derivative {}", k + 1);
                if bound(k) > 0.0 {
                    used[k] = used[k].max(derivative / bound(k));
                }
            }
        }
    }
    println!("used of the bounds at most: {used:.3?}");
    assert!(
        used[0] > 0.9,
        "bounds of {used:?} of themselves are of no use"
    );
}

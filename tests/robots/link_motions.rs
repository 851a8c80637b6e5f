//! Where links are on a motion through C-space, how they move, and bounds of how they may: against the poses of the robot.

use std::sync::Arc;

use cstk::pose::{Pose, Vec3, rotation_about};
use cstk::robot::{
    JointKind, LinkDefinition, LinkMotions, LinkSpeeds, LinkStates, MotionState, RatesFrom, bezier,
};
use cstk::space::Space;

use helpers::random::Random;
use helpers::robots::{Screw, link, robot, space};

/// The last two move on straight segments only.
const KINDS: [JointKind; 7] = [
    JointKind::Fixed,
    JointKind::Revolute,
    JointKind::Prismatic,
    JointKind::Planar,
    JointKind::FreeEuler,
    JointKind::Spherical,
    JointKind::Free,
];

/// The links of a random robot on a random motion, and the poses that the robot itself has at a time.
struct Case {
    motions: LinkMotions,
    poses: Box<dyn Fn(f64) -> Vec<Pose>>,
}

fn random_space(random: &mut Random, kinds: &[JointKind]) -> Arc<Space> {
    let length = 1 + random.below(5);
    let links = (0..length).map(|i| {
        let mut definition = LinkDefinition {
            at: random.pose(1.0),
            ..link(
                i.checked_sub(1 + random.below(2)),
                kinds[random.below(kinds.len())].clone(),
                [random.point(1.0), Vec3::z()][random.below(2)],
            )
        };
        if definition.kind.has_axis() {
            definition.multiplier = random.within(-2.0, 2.0);
            definition.offset = random.within(-1.0, 1.0);
        }
        definition
    });
    let links = links.collect();
    space(vec![
        robot(3, links),
        robot(3, vec![link(None, JointKind::Revolute, Vec3::z())]),
    ])
}

fn case(random: &mut Random) -> Case {
    let is_curved = random.below(2) == 0;
    let space = random_space(random, if is_curved { &KINDS[..5] } else { &KINDS });
    let drawn = |random: &mut Random, size: f64| -> Vec<f64> {
        (0..space.nv())
            .map(|_| random.within(-size, size))
            .collect()
    };
    if is_curved {
        let count = 1 + random.below(5);
        let controls: Vec<f64> = (0..count).flat_map(|_| drawn(random, 1.5)).collect();
        let motions = space.link_motions_on_curve(&controls);
        let nq = space.nq();
        let poses = move |t: f64| {
            let of = |c: usize| bezier(controls.iter().skip(c).step_by(nq).copied(), t);
            let q: Vec<f64> = (0..nq).map(of).collect();
            space.link_poses(&q).unwrap()
        };
        return Case {
            motions,
            poses: Box::new(poses),
        };
    }
    let q = space.step(&space.neutral(), &drawn(random, 1.5));
    let size = [0.1, 1.0, 3.0][random.below(3)];
    let mut v = drawn(random, size);
    // Some coordinates rest, as most do in a planner's last joints, and some move by what may be noise.
    v.iter_mut()
        .for_each(|rate| *rate *= [0.0, 1.0, 1.0, 1.0, 1e-6][random.below(5)]);
    Case {
        motions: space.link_motions(&q, &v),
        poses: Box::new(move |t| {
            let part: Vec<f64> = v.iter().map(|rate| rate * t).collect();
            space.link_poses(&space.step(&q, &part)).unwrap()
        }),
    }
}

fn state(motions: &LinkMotions, link: usize, t: f64) -> MotionState {
    let mut states = LinkStates::default();
    states.start(motions, t);
    *states.of(motions, link)
}

#[test]
fn poses_are_those_of_the_robot() {
    let mut random = Random::new(81);
    let mut states = LinkStates::default();
    for _ in 0..2000 {
        let case = case(&mut random);
        for t in [0.0, random.within(0.0, 1.0), 1.0] {
            states.start(&case.motions, t);
            let truth = (case.poses)(t);
            assert_eq!(truth.len(), case.motions.len());
            // Asked for in any order.
            let first = random.below(truth.len());
            for link in (first..truth.len()).chain(0..first) {
                let found = states.of(&case.motions, link).pose;
                assert!((found.rotation - truth[link].rotation).amax() < 1e-12);
                assert!((found.translation - truth[link].translation).amax() < 1e-11);
            }
        }
    }
}

/// An arm folded to and fro, of many links that turn about random axes, and the same with every link before the last at rest in its frame:
/// what is the same place but for rounding is as far apart as the bound says at most, which grows with the chain.
#[test]
fn places_are_rounded_within_the_bound_of_their_chain() {
    let mut random = Random::new(83);
    let mut least = f64::INFINITY;
    for count in [3, 30, 300, 1000] {
        let (mut turning, mut fixed) = (Vec::new(), Vec::new());
        let mut q = Vec::new();
        for i in 0..count {
            let axis = random.unit();
            let angle = random.within(-3.0, 3.0);
            let at = Pose::from_translation(random.unit() * [1.0, 1e3][i % 2]);
            let parent = usize::checked_sub(i, 1);
            turning.push(LinkDefinition {
                at,
                ..link(parent, JointKind::Revolute, axis)
            });
            // The same turn by its rotation matrix, split in two.
            let half = Pose {
                rotation: rotation_about(&axis, 0.5 * angle),
                translation: Vec3::zeros(),
            };
            fixed.push(LinkDefinition {
                at: at.compose(&half).compose(&half),
                ..link(parent, JointKind::Fixed, Vec3::x())
            });
            q.push(angle);
        }
        let [turning, fixed] = [turning, fixed].map(|links| space(vec![robot(3, links)]));
        let places = [
            turning.link_poses(&q).unwrap()[count - 1],
            fixed.link_poses(&[]).unwrap()[count - 1],
        ];
        let point = Vec3::new(1.0, 2.0, 2.0);
        let [a, b] = places.map(|pose| pose.transform_point(&point));
        let motions = turning.link_motions(&q, &vec![0.1; count]);
        let rates = RatesFrom::new(&motions, None).of(count - 1).unwrap().rates;
        let bound = rates.rounding.of_places(point.norm(), 1.0);
        assert!(
            (a - b).norm() <= bound,
            "{count}: {} > {bound}",
            (a - b).norm()
        );
        let per_link = bound / (count as f64 * rates.rounding.size * f64::EPSILON);
        least = least.min(per_link);
        assert_eq!(rates.rounding.elements, 2 * count as u32);
    }
    assert!(least > 20.0, "{least} epsilon a link");
}

/// Central differences of the poses are the oracle of velocities, those of velocities the oracle of accelerations.
#[test]
fn velocities_and_accelerations_are_derivatives() {
    let mut random = Random::new(83);
    let step = 1e-5;
    for _ in 0..1000 {
        let case = case(&mut random);
        let link = random.below(case.motions.len());
        let t = random.within(0.1, 0.9);
        let point = random.point(1.0);
        let at = |t: f64| (case.poses)(t)[link].transform_point(&point);
        let velocity = |t: f64| {
            let state = state(&case.motions, link, t);
            state.velocity(&(state.pose.rotation * point))
        };
        let now = state(&case.motions, link, t);
        let rates = RatesFrom::new(&case.motions, None).of(link).unwrap().rates;
        let scale = 1.0 + rates.origin[2] + rates.turn[2];
        let by_poses = (at(t + step) - at(t - step)) / (2.0 * step);
        assert!((velocity(t) - by_poses).amax() < 1e-8 * scale);
        let by_velocities = (velocity(t + step) - velocity(t - step)) / (2.0 * step);
        let acceleration = now.acceleration(&(now.pose.rotation * point));
        assert!((acceleration - by_velocities).amax() < 1e-7 * scale);
    }
}

/// The first three derivatives of a point as another link sees it, or the world, by differences of the robot's poses.
#[test]
fn no_derivative_is_above_its_bound() {
    let mut random = Random::new(84);
    // The largest part of a bound that a derivative has come to: 1 would be tight.
    let mut used = [0.0f64; 3];
    for round in 0..3000 {
        let case = case(&mut random);
        let [link, other] = [(); 2].map(|()| random.below(case.motions.len()));
        let seen_from = (round % 2 == 0).then_some(other);
        let mut seen = RatesFrom::new(&case.motions, seen_from);
        let rates = seen.of(link).unwrap().rates;
        let point = random.point(0.5);
        let bound = |k: usize| rates.origin[k] + rates.turn[k] * point.norm();
        let place = |t: f64| {
            let poses = (case.poses)(t);
            let there = poses[link].transform_point(&point);
            seen_from.map_or(there, |from| poses[from].inverse().transform_point(&there))
        };
        for i in 1..10 {
            let t = f64::from(i) / 10.0;
            let h = 1e-3;
            let [a, b, c, d, e] = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| place(t + k * h));
            let derivatives = [
                (a - 8.0 * b + 8.0 * d - e) / (12.0 * h),
                (-a + 16.0 * b - 30.0 * c + 16.0 * d - e) / (12.0 * h * h),
                (-a + 2.0 * b - 2.0 * d + e) / (2.0 * h * h * h),
            ];
            for (k, derivative) in derivatives.into_iter().enumerate() {
                let derivative = derivative.norm();
                // The differences' own errors: of rounding, and of the next derivatives.
                let size = 1.0 + bound(2) * (1.0 + rates.turn[0].powi(2));
                let slack = [1e-9, 1e-7, 1e-4][k] * size;
                assert!(
                    derivative <= bound(k) + slack,
                    "derivative {}: {derivative} of {}",
                    k + 1,
                    bound(k)
                );
                if bound(k) > 0.1 {
                    used[k] = used[k].max(derivative / bound(k));
                }
            }
        }
    }
    println!("used of the bounds at most: {used:.3?}");
    assert!(
        used[0] > 0.9 && used[1] > 0.8,
        "bounds of {used:?} of themselves are of no use"
    );
}

/// The speeds that are told for all links at once, by differences of the robot's poses; what their places are rounded by is counted along
/// the same chain as for one link alone.
#[test]
fn no_link_is_faster_than_its_speed() {
    let mut random = Random::new(86);
    let mut used = 0.0f64;
    for _ in 0..3000 {
        let case = case(&mut random);
        let link = random.below(case.motions.len());
        let speed = *LinkSpeeds::new(&case.motions).of(link);
        let point = random.point(0.5);
        let bound = speed.at_radius(point.norm());
        let rates = RatesFrom::new(&case.motions, None).of(link).unwrap().rates;
        let closer = rates.origin[0] + rates.turn[0] * point.norm();
        assert!(bound >= closer * (1.0 - 1e-12), "{bound} below {closer}");
        for reach in [0.0, 0.5, 1.0] {
            let [quick, exact] =
                [&speed.rounding, &rates.rounding].map(|of| of.of_places(1.0, reach));
            assert_eq!(quick, exact);
        }
        let place = |t: f64| (case.poses)(t)[link].transform_point(&point);
        for i in 1..10 {
            let (t, h) = (f64::from(i) / 10.0, 1e-5);
            let speed = (place(t + h) - place(t - h)).norm() / (2.0 * h);
            assert!(
                speed <= bound + 1e-8 * (1.0 + rates.origin[2] + rates.turn[2]),
                "{speed} of {bound}"
            );
            if bound > 0.1 {
                used = used.max(speed / bound);
            }
        }
    }
    assert!(used > 0.9, "speeds of {used} of the bounds are of no use");
}

/// The links between two, the first of them carried by no other: those that carry one and not both.
fn between(parents: &[Option<usize>], a: usize, b: Option<usize>) -> Vec<usize> {
    let carriers = |link: Option<usize>| -> Vec<usize> {
        std::iter::successors(link, |&link| parents[link]).collect()
    };
    let [a, b] = [carriers(Some(a)), carriers(b)];
    let own = |list: &[usize], other: &[usize]| -> Vec<usize> {
        list.iter()
            .copied()
            .filter(|link| !other.contains(link))
            .collect()
    };
    [own(&a, &b), own(&b, &a)].concat()
}

/// Trees of several robots, some of whose joints are the caller's: bounds are known where no such joint moves between two links, whatever
/// was asked before, and hold there.
#[test]
fn rates_of_branches_and_custom_joints_are_bounds() {
    let mut random = Random::new(85);
    let mut counts = [0; 2];
    for _ in 0..700 {
        let mut parents: Vec<Option<usize>> = Vec::new();
        let mut is_custom = Vec::new();
        let robots = (0..1 + random.below(3)).map(|_| {
            let first = parents.len();
            let links = (0..1 + random.below(7)).map(|i: usize| {
                let parent = (i > 0 && random.below(6) > 0).then(|| random.below(i));
                parents.push(parent.map(|parent| parent + first));
                let kind = match random.below(9) {
                    8 => JointKind::Custom(Arc::new(Screw)),
                    i if i < 7 => KINDS[i].clone(),
                    _ => JointKind::Revolute,
                };
                is_custom.push(matches!(kind, JointKind::Custom(_)));
                let mut definition = LinkDefinition {
                    at: random.pose(1.0),
                    ..link(
                        parent,
                        kind,
                        [random.point(1.0), Vec3::z()][random.below(2)],
                    )
                };
                if definition.kind.has_axis() {
                    definition.multiplier = random.within(-2.0, 2.0);
                    definition.offset = random.within(-1.0, 1.0);
                }
                definition
            });
            let links: Vec<_> = links.collect();
            robot(3, links)
        });
        let space = space(robots.collect());
        let drawn = |random: &mut Random, size: f64| -> Vec<f64> {
            (0..space.nv())
                .map(|_| random.within(-size, size) * f64::from(u8::from(random.below(4) > 0)))
                .collect()
        };
        let q = space.step(&space.neutral(), &drawn(&mut random, 1.5));
        let v = drawn(&mut random, 1.0);
        let poses = |t: f64| {
            let part: Vec<f64> = v.iter().map(|rate| rate * t).collect();
            space.link_poses(&space.step(&q, &part)).unwrap()
        };
        let motions = space.link_motions(&q, &v);
        let moves: Vec<bool> = (0..parents.len())
            .map(|link| {
                let (start, later) = (poses(0.0), poses(0.37));
                let in_parent = |poses: &[Pose]| match parents[link] {
                    None => poses[link],
                    Some(parent) => poses[parent].inverse().compose(&poses[link]),
                };
                let [start, later] = [in_parent(&start), in_parent(&later)];
                (start.rotation - later.rotation).amax() > 1e-9
                    || (start.translation - later.translation).amax() > 1e-9
            })
            .collect();
        let mut seen = RatesFrom::new(&motions, None);
        for _ in 0..12 {
            let link = random.below(parents.len());
            match random.below(3) {
                0 => seen.look_from(Some(random.below(parents.len()))),
                1 if random.below(5) == 0 => seen.look_from(None),
                _ => {}
            }
            let from = seen.from();
            let is_known = !between(&parents, link, from)
                .iter()
                .any(|&link| is_custom[link] && moves[link]);
            let found = seen.of(link).copied();
            assert_eq!(found.is_some(), is_known, "{link} from {from:?}");
            counts[usize::from(is_known)] += 1;
            let Some(found) = found else {
                continue;
            };
            let rates = found.rates;
            let point = random.point(0.5);
            let place = |t: f64| {
                let poses = poses(t);
                let there = poses[link].transform_point(&point);
                from.map_or(there, |from| poses[from].inverse().transform_point(&there))
            };
            let bound = |k: usize| rates.origin[k] + rates.turn[k] * point.norm();
            for i in 1..6 {
                let (t, h) = (f64::from(i) / 6.0, 1e-3);
                let [a, b, c, d, e] = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| place(t + k * h));
                let derivatives = [
                    (a - 8.0 * b + 8.0 * d - e) / (12.0 * h),
                    (-a + 16.0 * b - 30.0 * c + 16.0 * d - e) / (12.0 * h * h),
                    (-a + 2.0 * b - 2.0 * d + e) / (2.0 * h * h * h),
                ];
                for (k, derivative) in derivatives.into_iter().enumerate() {
                    let size = 1.0 + bound(2) * (1.0 + rates.turn[0].powi(2));
                    let slack = [1e-9, 1e-7, 1e-4][k] * size;
                    let derivative = derivative.norm();
                    assert!(
                        derivative <= bound(k) + slack,
                        "{k}: {derivative} of {}",
                        bound(k)
                    );
                }
            }
        }
    }
    println!("unknown, known: {counts:?}");
    assert!(counts.iter().all(|count| *count > 300));
}

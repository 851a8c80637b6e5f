//! Joint groups as robots of their own: equal to the whole robot with the other joints at rest, in poses, distances, gradients,
//! Jacobians, motions and boxes.

use std::sync::Arc;

use cstk::cobject::CObject;
use cstk::error::ErrorKind;
use cstk::motion::{MotionOptions, MotionOutcome};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::{Coordinate, JointKind, LinkDefinition, Robot};
use cstk::space::Sampler;

use helpers::robots::{against, environment, link, robot, space};
use helpers::shapes::box_corners;

fn cuboid(sides: [f64; 3]) -> Arc<cstk::body::Body> {
    let mut builder = cstk::body::BodyBuilder::new(3).unwrap();
    builder.add_polyhedron(&box_corners(sides), 0).unwrap();
    Arc::new(helpers::models::built(&builder, &Default::default()))
}

/// Two arms on a body that moves freely, joints of every kind, and one that follows another.
fn whole() -> Arc<Robot> {
    let part = |parent: Option<usize>, kind: JointKind, at: [f64; 3], axis: Vec3| LinkDefinition {
        body: Some(cuboid([0.2, 0.15, 0.1])),
        at: Pose::from_translation(Vec3::from(at)),
        ..link(parent, kind, axis)
    };
    let turn = || JointKind::Revolute;
    let limited = |definition| LinkDefinition {
        limits: [-1.0, 1.5],
        ..definition
    };
    let mut links = vec![
        part(None, JointKind::Free, [0.0; 3], Vec3::z()),
        limited(part(Some(0), turn(), [0.5, 0.0, 0.0], Vec3::z())),
        part(
            Some(1),
            JointKind::Prismatic,
            [0.4, 0.1, 0.0],
            Vec3::new(1.0, 2.0, 0.5),
        ),
        part(Some(2), JointKind::Spherical, [0.3, 0.0, 0.1], Vec3::z()),
        limited(part(Some(0), turn(), [-0.5, 0.0, 0.0], Vec3::y())),
        part(Some(4), JointKind::Planar, [-0.4, 0.0, 0.0], Vec3::z()),
        part(Some(5), turn(), [-0.3, 0.0, 0.2], Vec3::x()),
        part(Some(6), JointKind::FreeEuler, [0.0, 0.3, 0.0], Vec3::z()),
    ];
    // Follows the turn of link 1; its coordinate is 7.
    links.push(LinkDefinition {
        coordinate: Some(7),
        multiplier: -0.5,
        offset: 0.25,
        ..part(Some(4), turn(), [0.0, 0.3, 0.3], Vec3::z())
    });
    for definition in &mut links[2..3] {
        definition.limits = [-0.2, 0.4];
    }
    robot(3, links)
}

/// Configurations of the whole robot, its unbounded coordinates near 0.
fn draw(robot: &Arc<Robot>, sampler: &mut Sampler) -> Vec<f64> {
    let ranges: Vec<_> = robot
        .ranges()
        .iter()
        .map(|range| match *range {
            Coordinate::Interval { lower, .. } if !lower.is_finite() => {
                Some(Coordinate::Interval {
                    lower: -0.3,
                    upper: 0.3,
                })
            }
            _ => None,
        })
        .collect();
    let bounded = cstk::space::Space::new(
        vec![robot.clone()],
        &ranges,
        cstk::space::WorldBox::unbounded(),
    );
    bounded.unwrap().sample(sampler).unwrap().to_vec()
}

const GROUPS: [&[usize]; 6] = [&[1, 2], &[0], &[3, 6], &[8], &[4, 5, 7], &[2, 1, 0, 2]];

/// For each velocity of the frozen robot, that of the whole one.
fn velocities(whole: &Robot, frozen: &Robot) -> Vec<usize> {
    let mut places = vec![usize::MAX; frozen.nv()];
    for (of_whole, own) in whole.links().iter().zip(frozen.links()) {
        for i in 0..own.joint.kind.nv() {
            places[own.joint.velocity + i] = of_whole.joint.velocity + i;
        }
    }
    places
}

#[test]
fn a_group_answers_as_the_whole_robot_with_the_rest_at_rest() {
    let whole = whole();
    let all = space(vec![whole.clone()]);
    let obstacles = [
        ([0.9, 0.7, 0.2], 0.3),
        ([-0.9, 0.8, -0.3], 0.4),
        ([0.2, -1.0, 0.5], 0.5),
    ];
    let bodies =
        obstacles.map(|(at, side)| (cuboid([side; 3]), Pose::from_translation(Vec3::from(at))));
    let objects: Vec<_> = bodies.iter().map(|(body, pose)| (body, *pose)).collect();
    let (world, _) = environment(&objects);
    let links = [[1, 6], [2, 5], [3, 0]];
    let sets = |space: &Arc<cstk::space::Space>| {
        let own = CObject::induced_links(space.clone(), &links, Default::default()).unwrap();
        let world = against(space, &world);
        CObject::union(&[Arc::new(own), Arc::new(world)]).unwrap()
    };
    let set = sets(&all);
    let mut sampler = Sampler(7);
    let (mut free, mut hits, mut gradients) = (0, 0, 0);
    for group in GROUPS {
        for _ in 0..8 {
            let [q0, other] = [(); 2].map(|()| draw(&whole, &mut sampler));
            let frozen = Arc::new(whole.freeze(group, &q0).unwrap());
            let own = space(vec![frozen.clone()]);
            let own_set = sets(&own);
            let places = velocities(&whole, &frozen);
            let goal = frozen
                .to_whole(&frozen.from_whole(&other).unwrap())
                .unwrap();
            let [p0, p1] = [&q0, &goal].map(|q| frozen.from_whole(q).unwrap());
            assert_eq!(frozen.to_whole(&p0).unwrap(), q0);
            let mut query = QueryContext::new();
            for (q, p) in [(&q0, &p0), (&goal, &p1)] {
                let [ours, theirs] = [own.link_poses(p).unwrap(), all.link_poses(q).unwrap()];
                for (a, b) in ours.iter().zip(&theirs) {
                    assert!((a.translation - b.translation).amax() < 1e-14);
                    assert!((a.rotation - b.rotation).amax() < 1e-14);
                }
                let mut distance = |set: &CObject, q: &[f64]| {
                    let at = Configuration::Coordinates(q);
                    query.distance(set, at, f64::INFINITY).unwrap().distance
                };
                let apart = distance(&set, q);
                assert!((apart - distance(&own_set, p)).abs() < 1e-12);
                if apart == 0.0 {
                    continue;
                }
                let mut rows =
                    |set: &CObject, q: &[f64]| query.gradients(set, q, apart + 1e-9, 4).unwrap();
                let [ours, theirs] = [rows(&own_set, p), rows(&set, q)];
                assert_eq!(ours.contacts.len(), theirs.contacts.len());
                for k in 0..ours.contacts.len() {
                    gradients += 1;
                    for (i, &place) in places.iter().enumerate() {
                        let [a, b] = [
                            ours.gradients[k * ours.nv + i],
                            theirs.gradients[k * theirs.nv + place],
                        ];
                        assert!((a - b).abs() < 1e-12, "{a} {b}");
                    }
                }
            }
            // The way in the whole space leaves the frozen joints where they are.
            let mut v = vec![0.0; all.nv()];
            let u = own.difference(&p0, &p1);
            for (&place, &rate) in places.iter().zip(&u) {
                v[place] = rate;
            }
            let options = MotionOptions::default();
            let ours = query.motion_along(&own_set, &p0, &u, &options).unwrap();
            let theirs = query.motion_along(&set, &q0, &v, &options).unwrap();
            assert_eq!(ours.outcome, theirs.outcome, "{group:?}");
            free += usize::from(ours.outcome == MotionOutcome::Free);
            hits += usize::from(ours.outcome == MotionOutcome::Hit);
        }
    }
    println!("frozen groups: {free} free motions, {hits} hits, {gradients} gradients");
    assert!(
        free >= 3 && hits >= 10 && gradients >= 20,
        "{free} {hits} {gradients}"
    );
}

#[test]
fn what_is_left_keeps_order_ranges_and_followers() {
    let whole = whole();
    let mut q = vec![0.0; whole.nq()];
    for link in [0, 3] {
        let joint = &whole.links()[link].joint;
        q[joint.coordinate + joint.kind.nq() - 1] = 1.0;
    }
    q[7] = 0.5;
    // The follower alone keeps the coordinate, and so the joint that it follows.
    let frozen = whole.freeze(&[8], &q).unwrap();
    assert_eq!((frozen.nq(), frozen.nv()), (1, 1));
    let moves = |link: usize| frozen.links()[link].joint.kind.nq() > 0;
    let moving: Vec<usize> = (0..frozen.links().len())
        .filter(|&link| moves(link))
        .collect();
    assert_eq!(moving, [1, 8]);
    assert_eq!(frozen.ranges()[0], whole.ranges()[7]);
    assert_eq!(
        (
            frozen.links()[8].joint.multiplier,
            frozen.links()[8].joint.offset
        ),
        (-0.5, 0.25)
    );
    // A group of a group.
    let more = whole.freeze(&[1, 2, 3], &q).unwrap();
    let less = more.freeze(&[2], &more.from_whole(&q).unwrap()).unwrap();
    assert_eq!(less.to_whole(&[0.1]).unwrap().len(), more.nq());
    // Nothing left.
    let stone = whole.freeze(&[], &q).unwrap();
    assert_eq!((stone.nq(), stone.to_whole(&[]).unwrap()), (0, q.clone()));
    for (joints, at, kind) in [
        (&[99usize][..], &q[..], ErrorKind::NotFound),
        (&[1], &q[1..], ErrorKind::WrongSize),
        (&[1], &[&q[1..], &[f64::NAN]].concat(), ErrorKind::NotFinite),
    ] {
        assert_eq!(whole.freeze(joints, at).unwrap_err().kind, kind);
    }
    assert_eq!(whole.to_whole(&q).unwrap_err().kind, ErrorKind::Empty);
    assert_eq!(
        frozen.to_whole(&[0.0, 1.0]).unwrap_err().kind,
        ErrorKind::WrongSize
    );
    assert_eq!(
        frozen.from_whole(&q[1..]).unwrap_err().kind,
        ErrorKind::WrongSize
    );
}

/// Joints that follow one coordinate of a joint with several, and others that follow its others: all of these are left, and poses are
/// those of the whole robot.
#[test]
fn followers_of_one_of_several_coordinates_keep_them_all() {
    let mut random = helpers::random::Random::new(17);
    let mut shared = 0;
    for case in 0..400 {
        let mut links = Vec::new();
        let mut count = 0;
        // The lines of joints so far, which others may follow.
        let mut lines: Vec<usize> = Vec::new();
        for i in 0..8 {
            let parent = (i > 0).then(|| random.below(i));
            let kinds = [
                JointKind::Planar,
                JointKind::FreeEuler,
                JointKind::Revolute,
                JointKind::Prismatic,
            ];
            let kind = kinds[random.below(4)].clone();
            let has_one = kind.nq() == 1;
            let definition = LinkDefinition {
                at: Pose::from_translation(random.point(1.0)),
                ..link(parent, kind.clone(), random.unit())
            };
            if has_one && !lines.is_empty() && random.below(3) > 0 {
                links.push(LinkDefinition {
                    coordinate: Some(lines[random.below(lines.len())]),
                    multiplier: random.within(-2.0, 2.0),
                    ..definition
                });
                continue;
            }
            lines.extend(count..count + kind.nq());
            count += kind.nq();
            links.push(definition);
        }
        let whole = robot(3, links);
        let group: Vec<usize> = (0..1 + random.below(2)).map(|_| random.below(8)).collect();
        let draw = |random: &mut helpers::random::Random, n: usize| -> Vec<f64> {
            (0..n).map(|_| random.within(-1.0, 1.0)).collect()
        };
        let rest = draw(&mut random, whole.nq());
        let frozen = Arc::new(whole.freeze(&group, &rest).unwrap());
        for &link in &group {
            let [own, of] = [&frozen, &whole].map(|robot| robot.links()[link].joint.kind.nq());
            assert_eq!(own, of, "{case}");
        }
        let is_whole_joint = |(own, of): (&cstk::robot::Link, &cstk::robot::Link)| {
            [0, of.joint.kind.nq()].contains(&own.joint.kind.nq())
        };
        let mut pairs = frozen.links().iter().zip(whole.links());
        assert!(pairs.all(is_whole_joint), "{case}");
        shared += usize::from(frozen.nq() > 6);
        let q = draw(&mut random, frozen.nq());
        let all = frozen.to_whole(&q).unwrap();
        let [own, of] = [(frozen, &q), (whole, &all)].map(|(robot, q)| {
            let space = space(vec![robot]);
            space.link_poses(q).unwrap().to_vec()
        });
        for (a, b) in own.iter().zip(&of) {
            assert!((a.translation - b.translation).amax() < 1e-12, "{case}");
            assert!((a.rotation - b.rotation).amax() < 1e-12, "{case}");
        }
    }
    assert!(shared > 50, "{shared}");
}

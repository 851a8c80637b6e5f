//! Random robots among obstacles, for the tests of motions.

use std::sync::Arc;

use cstk::body::{Body, BodyBuilder};
use cstk::cobject::{CObject, Class, InducedOptions, PureShape};
use cstk::environment::{Attachment, Change};
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::{JointKind, LinkDefinition};
use cstk::space::Space;

use helpers::pure::pure;
use helpers::random::Random;
use helpers::robots::{against_with, environment, link, robot, space};
use helpers::shapes::{cube_surface, cuboid, hull};

pub fn built(add: impl FnOnce(&mut BodyBuilder)) -> Arc<Body> {
    let mut builder = BodyBuilder::new(3).unwrap();
    add(&mut builder);
    let body = builder.build(&HierarchyOptions::default(), &mut |_| Ok(()));
    Arc::new(body.unwrap())
}

/// A body of any kind, about 1 across.
pub fn body(random: &mut Random) -> Arc<Body> {
    let identity = Pose::identity();
    match random.below(9) {
        0 => hull(&random.points(12, 0.4)).body,
        1 => cuboid([1.2, 0.8, 1e-4]).body,
        2 => cube_surface(0.7).body,
        3 => built(|b| b.add_sphere(&random.point(0.2), 0.3, 0).unwrap()),
        4 => built(|b| {
            let [from, to] = [random.point(0.5), random.point(0.5)];
            b.add_capsule(&from, &to, 0.1, 0).unwrap();
        }),
        5 => built(|b| b.add_cylinder(&identity, 0.3, 0.4, 0).unwrap()),
        6 => built(|b| {
            let axes = Vec3::new(0.5, 0.2, 0.1);
            b.add_ellipsoid(&identity, &axes, 0).unwrap();
        }),
        7 => built(|b| {
            for _ in 0..12 {
                let around = random.point(0.4);
                let corners = random.points(3, 0.15).into_iter().map(|p| p + around);
                b.add_polygon(&corners.collect::<Vec<_>>(), 0).unwrap();
            }
        }),
        _ => built(|b| b.add_points(&random.points(30, 0.4), 0.02).unwrap()),
    }
}

/// About 150 triangles, each on a ball of radius .4 or a little off it.
pub fn rough_ball(random: &mut Random) -> Arc<Body> {
    built(|b| {
        for _ in 0..150 {
            let place = random.unit() * random.within(0.36, 0.4);
            let corners = random.points(3, 0.04).into_iter().map(|p| p + place);
            b.add_polygon(&corners.collect::<Vec<_>>(), 0).unwrap();
        }
    })
}

const KINDS: [JointKind; 6] = [
    JointKind::Revolute,
    JointKind::Prismatic,
    JointKind::Planar,
    JointKind::Spherical,
    JointKind::Free,
    JointKind::FreeEuler,
];

/// A robot of up to four links among objects, one of which it may hold, against them and itself.
pub fn scene(random: &mut Random) -> CObject {
    let length = 1 + random.below(4);
    let links = (0..length).map(|i| LinkDefinition {
        at: random.pose(0.8),
        body: (i == 0 || random.below(5) > 0).then(|| body(random)),
        ..link(
            i.checked_sub(1),
            KINDS[random.below(KINDS.len())].clone(),
            random.unit(),
        )
    });
    let links: Vec<LinkDefinition> = links.collect();
    let space = space(vec![robot(3, links)]);
    let objects: Vec<_> = (0..8).map(|_| (body(random), random.pose(3.0))).collect();
    let objects: Vec<_> = objects.iter().map(|(body, pose)| (body, *pose)).collect();
    let (environment, ids) = environment(&objects);
    if random.below(3) == 0 {
        let attachment = Attachment {
            space: space.serial(),
            link: length - 1,
            touch_links: vec![],
        };
        let change = Change::Attach {
            id: ids[0],
            pose: random.pose(0.5),
            attachment,
        };
        environment.apply(&[change]).unwrap();
    }
    let options = InducedOptions {
        margin: [0.0, 0.05][random.below(2)],
        ..InducedOptions::default()
    };
    let mut parts = vec![Arc::new(against_with(&space, &environment, options))];
    let pairs: Vec<[usize; 2]> = (0..length)
        .flat_map(|s| (0..s).map(move |r| [r, s]))
        .filter(|[r, s]| {
            r + 1 < *s
                && [*r, *s]
                    .iter()
                    .all(|&l| space.link(l).unwrap().body.is_some())
        })
        .collect();
    if !pairs.is_empty() {
        let itself = CObject::induced_links(space.clone(), &pairs, InducedOptions::default());
        parts.push(Arc::new(itself.unwrap()));
    }
    if random.below(2) == 0 {
        let floor = PureShape::Floor {
            links: (0..length).collect(),
            normal: Vec3::z(),
            offset: -2.5,
        };
        parts.push(pure(&space, floor, None));
    }
    CObject::union(&parts).unwrap()
}

pub fn class(context: &mut QueryContext, cobject: &CObject, q: &[f64]) -> Class {
    let at = Configuration::Coordinates(q);
    context.classify(cobject, at).unwrap()
}

pub fn at(space: &Space, q: &[f64], v: &[f64], t: f64) -> Vec<f64> {
    let part: Vec<f64> = v.iter().map(|x| x * t).collect();
    space.step(q, &part)
}

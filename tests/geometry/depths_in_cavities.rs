//! Depths in the walls of hollow solids: no translation into the cavity that is shorter than the lower bound parts the bodies.

use std::sync::Arc;

use cstk::body::{Body, BodyBuilder};
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::{Pose, Vec3};
use cstk::query::{DepthOptions, QueryContext};

use helpers::random::Random;
use helpers::surfaces::{hollow_cube, shifted, solid};

/// Half the side of the cavity of `hollow_cube`.
const CAVITY: f64 = 0.6;

fn built(add: impl FnOnce(&mut BodyBuilder)) -> Body {
    let mut builder = BodyBuilder::new(3).unwrap();
    add(&mut builder);
    let built = builder.build(&HierarchyOptions::default(), &mut |_| Ok(()));
    built.unwrap()
}

/// The walls around a cavity at `place`, with something more on one side, so that the middle of the body is elsewhere.
fn walls(place: [f64; 3], is_lopsided: bool) -> Arc<Body> {
    let mut meshes: Vec<_> = hollow_cube()
        .iter()
        .map(|mesh| shifted(mesh, place))
        .collect();
    if is_lopsided {
        let block = shifted(&hollow_cube()[0], [3.0, 0.5, 0.0]);
        meshes.push(shifted(&block, place));
    }
    solid(&meshes)
}

/// Bodies that are rounded, thin or sharp, in frames of their own.
fn small_bodies(random: &mut Random) -> Vec<Body> {
    let origin = random.point(0.5);
    let corners = [
        [0.24, 0.0, -0.05],
        [-0.24, 0.0, -0.05],
        [0.0, 0.24, 0.05],
        [0.0, -0.24, 0.05],
    ];
    let corners = corners.map(|corner| origin + Vec3::from(corner));
    let (a, b) = (corners[0], corners[1]);
    let at = Pose::from_translation(origin);
    let slanted = at.compose(&random.pose(0.1));
    vec![
        built(|builder| builder.add_sphere(&origin, 0.35, 0).unwrap()),
        built(|builder| builder.add_capsule(&a, &b, 0.2, 0).unwrap()),
        built(|builder| builder.add_rounded_polyhedron(&corners, 0.12, 0).unwrap()),
        built(|builder| {
            let flat = [corners[0], corners[2], corners[1]];
            builder.add_rounded_polygon(&flat, 0.12, 0).unwrap();
        }),
        built(|builder| {
            let half = Vec3::new(0.2, 0.1, 0.3);
            builder.add_box(&slanted, &half, 0).unwrap();
        }),
        built(|builder| builder.add_cylinder(&at, 0.2, 0.15, 0).unwrap()),
        built(|builder| {
            builder.add_rounded_polyhedron(&corners, 0.1, 0).unwrap();
            let end = origin + Vec3::new(0.0, 0.0, 0.3);
            builder.add_capsule(&origin, &end, 0.1, 0).unwrap();
        }),
    ]
}

/// The least and the largest coordinates of a body in its own frame.
fn extent(body: &Body) -> [Vec3; 2] {
    let farthest = |k: usize, sign: f64| {
        let mut way = Vec3::zeros();
        way[k] = sign;
        body.farthest(&way).point[k] + body.center()[k]
    };
    [-1.0, 1.0].map(|sign| Vec3::from_fn(|k, _| farthest(k, sign)))
}

/// Asks for depths in walls around a cavity: at the origin or elsewhere, with a seed.
fn check_cavities(is_at_origin: bool, seed: u64) {
    let mut random = Random::new(seed);
    let (mut asked, mut near) = (0, 0);
    for case in 0..8 {
        let place = match is_at_origin {
            true => [0.0; 3],
            false => random.point(2.0).into(),
        };
        let walls = walls(place, case % 2 == 1);
        let fixed = Pose::identity();
        for small in &small_bodies(&mut random) {
            let [low, high] = extent(small);
            for _ in 0..6 {
                let start = Vec3::from(place) + random.point(0.9) - 0.5 * (low + high);
                // The nearest place at which its box is in the cavity.
                let inside = Vec3::from_fn(|k, _| {
                    let (least, most) = (CAVITY + low[k] - 1e-6, CAVITY - high[k] - 1e-6);
                    place[k] + (start[k] - place[k]).clamp(-least, most)
                });
                let way = inside - start;
                let (from, to) = (
                    Pose::from_translation(start),
                    Pose::from_translation(inside),
                );
                let mut context = QueryContext::new();
                let left = context.pair_within((small, &to), (&walls, &fixed), 0.0);
                assert!(!left.unwrap(), "case {case}: not in the cavity");
                let options = DepthOptions {
                    tolerance: 0.01,
                    max_steps: 300,
                };
                for bodies in [
                    [(small, &from), (&*walls, &fixed)],
                    [(&*walls, &fixed), (small, &from)],
                ] {
                    let found = context.pair_depth(bodies[0], bodies[1], &options).unwrap();
                    assert!(
                        found.lower <= way.norm() + 1e-9,
                        "case {case}: {} {found:?}",
                        way.norm()
                    );
                    asked += 1;
                    near += usize::from(found.lower > 0.5 * way.norm() && found.lower > 0.0);
                }
            }
        }
    }
    assert!(asked > 500 && near > asked / 4, "{asked} {near}");
}

#[test]
fn nothing_shorter_than_the_lower_bound_leads_into_a_cavity() {
    check_cavities(true, 19);
}

#[test]
fn nor_into_one_whose_body_is_off_its_origin() {
    check_cavities(false, 20);
}

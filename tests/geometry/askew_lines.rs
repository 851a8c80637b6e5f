//! Edges, segments and cores of capsules that cross at angles down to 1e-12: a place of the crossing is off along both lines by rounding
//! over the angle, which must not show in the distance.

use cstk::body::{Body, BodyBuilder};
use cstk::pose::{Pose, Vec3};
use cstk::query::QueryContext;
use helpers::models::built;
use helpers::random::Random;

fn body(dimension: u32, add: impl FnOnce(&mut BodyBuilder)) -> Body {
    let mut builder = BodyBuilder::new(dimension).unwrap();
    add(&mut builder);
    built(&builder, &Default::default())
}

/// Two bodies whose lines cross at the origin, at a height of the second over the first.
fn pair(kind: usize, random: &mut Random, angle: f64, height: f64) -> [Body; 2] {
    let frame = match kind {
        3 => Pose::identity(),
        _ => Pose {
            rotation: random.rotation(),
            ..Pose::identity()
        },
    };
    let (y, x) = angle.sin_cos();
    [(Vec3::x(), 0.0, -1.0), (Vec3::new(x, y, 0.0), height, 1.0)].map(|(way, z, up)| {
        let ends = [-1.0, 1.0].map(|sign| way * (sign * random.within(0.1, 1.0)) + Vec3::z() * z);
        let placed = |points: &[Vec3]| -> Vec<Vec3> {
            points.iter().map(|p| frame.transform_point(p)).collect()
        };
        match kind {
            0 => body(3, |b| b.add_polyhedron(&placed(&ends), 0).unwrap()),
            1 => {
                // Thin enough that they do not reach one another.
                let ends = placed(&ends);
                body(3, |b| b.add_capsule(&ends[0], &ends[1], 1e-12, 0).unwrap())
            }
            // A roof whose ridge is the line.
            2 => {
                let side = Vec3::new(-way.y, way.x, 0.0);
                let eaves = ends
                    .iter()
                    .flat_map(|end| [side, -side].map(|side| end + 0.5 * (side + Vec3::z() * up)));
                let corners: Vec<Vec3> = ends.iter().copied().chain(eaves).collect();
                body(3, |b| b.add_polyhedron(&placed(&corners), 0).unwrap())
            }
            _ => body(2, |b| b.add_polyhedron(&ends, 0).unwrap()),
        }
    })
}

#[test]
fn lines_that_cross_at_a_small_angle_meet() {
    let random = &mut Random::new(61);
    let context = &mut QueryContext::new();
    for round in 0..8000 {
        let kind = round % 4;
        let angle = 10f64.powf(random.within(-12.0, -1.0));
        let height = match kind {
            3 => 0.0,
            _ => [0.0, 1e-9][round / 4 % 2],
        };
        let [a, b] = pair(kind, random, angle, height);
        let here = Pose::identity();
        let sides = ((&a, &here), (&b, &here));
        let found = context
            .pair_distance(sides.0, sides.1, f64::INFINITY)
            .unwrap();
        let truth = if kind == 1 {
            (height - 2e-12).max(0.0)
        } else {
            height
        };
        assert!(
            (found.distance - truth).abs() < 1e-14,
            "{kind} at {angle}: {} for {truth}",
            found.distance
        );
        assert!(
            found.lower <= truth && truth <= found.upper,
            "{kind} at {angle}: {found:?}"
        );
        let meets = context.pair_within(sides.0, sides.1, 0.0).unwrap();
        assert_eq!(meets, truth == 0.0, "{kind} at {angle}");
    }
}

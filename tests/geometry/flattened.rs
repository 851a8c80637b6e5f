//! Hulls too flat for a solid: they become polygons, segments or points, and nothing is proved apart by what that leaves out.

use cstk::pose::{Pose, Vec3};
use cstk::query::QueryContext;

use helpers::random::Random;
use helpers::shapes::{box_corners, cuboid, hull, mesh};

/// What is too flat, too thin or too small to be a solid is taken for a polygon, a segment or a point, and says how far it may be off.
#[test]
fn flattened_boxes_hold_their_middle() {
    let point = hull(&[Vec3::zeros()]);
    let here = Pose::identity();
    let mut random = Random::new(61);
    for scale in [1e-3, 1.0, 1e3] {
        for thin in [1e-10, 1e-11, 1e-12, 3e-13, 1e-13, 1e-14, 1e-15] {
            for sides in [[1.0, 1.0, thin], [1.0, thin, thin], [1.0, 1e-3, thin]] {
                let flat = hull(&box_corners(sides.map(|side| side * scale)));
                for turned in [here, random.pose(0.0)] {
                    let mut context = QueryContext::new();
                    for (a, b) in [
                        ((&point, &here), (&flat, &turned)),
                        ((&flat, &turned), (&point, &here)),
                    ] {
                        let sides = [(&*a.0.body, a.1), (&*b.0.body, b.1)];
                        let found = context
                            .pair_distance(sides[0], sides[1], f64::INFINITY)
                            .unwrap();
                        assert_eq!(found.lower, 0.0, "{sides:?} {found:?}");
                        assert!(context.pair_within(sides[0], sides[1], 0.0).unwrap());
                    }
                    // Beside it, at a height that is known.
                    for height in [0.0, 0.5, 1.0, 3.0, 10.0] {
                        let gap = height * thin * scale;
                        let above = Pose {
                            rotation: turned.rotation,
                            translation: turned.rotation * Vec3::z() * (0.5 * thin * scale + gap),
                        };
                        let found = context
                            .pair_distance(
                                (&point.body, &above),
                                (&flat.body, &turned),
                                f64::INFINITY,
                            )
                            .unwrap();
                        let rounding = 1e-14 * scale;
                        assert!(
                            found.lower <= gap + rounding && found.upper >= gap - rounding,
                            "{found:?}"
                        );
                    }
                }
            }
        }
    }
}

/// Polygons that are less than rounding where they stand: points, as their distance goes. Asked again, a context says the same.
#[test]
fn polygons_less_than_rounding_are_where_they_stand() {
    let mut random = Random::new(62);
    let here = Pose::identity();
    for extent in [1e-12, 1e-14, 1e-15, 1e-16, 1e-17, 1e-18, 1e-20, 1e-30] {
        for round in 0..60 {
            let tiny = |random: &mut Random| {
                let corners = 3 + random.below(3);
                match random.below(3) {
                    0 => mesh(&random.points(3, extent), &[[0, 1, 2]]),
                    1 => hull(&random.polygon(corners, extent)),
                    _ => hull(&random.points(3, extent)),
                }
            };
            let others = [hull(&[Vec3::zeros()]), tiny(&mut random), cuboid([0.2; 3])];
            let (a, b) = (&others[round % 3], tiny(&mut random));
            let far = 10f64.powf(random.within(-1.0, 1.0)).max(0.3);
            let place = random.unit() * far;
            let there = Pose {
                rotation: random.rotation(),
                translation: place,
            };
            // A box is as near as its nearest point; all others are points.
            let nearest = match round % 3 {
                2 => place.map(|x| x.clamp(-0.1, 0.1)),
                _ => Vec3::zeros(),
            };
            let truth = (place - nearest).norm();
            let allowed = 10.0 * extent + 1e-13 * far;
            let mut context = QueryContext::new();
            for (first, second) in [((a, &here), (&b, &there)), ((&b, &there), (a, &here))] {
                let sides = [(&*first.0.body, first.1), (&*second.0.body, second.1)];
                for _ in 0..2 {
                    let found = context.pair_distance(sides[0], sides[1], f64::INFINITY);
                    let found = found.unwrap();
                    assert!(
                        (found.distance - truth).abs() <= allowed,
                        "{extent:e} {truth} {found:?}"
                    );
                    assert!(found.lower <= truth + allowed && truth - allowed <= found.upper);
                }
            }
        }
    }
}

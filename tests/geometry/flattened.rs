//! Hulls too flat for a solid: they become polygons, segments or points, and nothing is proved apart by what that leaves out.

use cstk::pose::{Pose, Vec3};
use cstk::query::QueryContext;

use helpers::random::Random;
use helpers::shapes::{box_corners, hull};

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

//! Distances that must hold what every distance promises.

use cstk::pose::{Pose, Vec3};
use cstk::query::{Distance, DistanceKind, QueryContext};

use super::oracle::hull_distance;
use super::shapes::{Shape, pair_size};

pub fn at(x: f64, y: f64, z: f64) -> Pose {
    Pose::from_translation(Vec3::new(x, y, z))
}

pub fn vertices(list: &[(f64, f64, f64)]) -> Vec<Vec3> {
    list.iter().map(|&(x, y, z)| Vec3::new(x, y, z)).collect()
}

/// A19, the invariants of every distance: the points are as far apart as it says, each lies in its body, in the order of
/// the arguments and in the world; the bounds hold the distance; the arguments' order does not matter.
pub fn checked(a: (&Shape, &Pose), b: (&Shape, &Pose)) -> Distance {
    let measure = |a: (&Shape, &Pose), b: (&Shape, &Pose)| {
        QueryContext::new()
            .pair_distance((&a.0.body, a.1), (&b.0.body, b.1), f64::INFINITY)
            .unwrap()
    };
    let found = measure(a, b);
    let size = pair_size(a.0, a.1, b.0, b.1);
    assert_eq!(found.kind, DistanceKind::Exact);
    assert!(found.lower <= found.distance && found.distance <= found.upper);
    let [p, q] = found.points;
    // A point in the world is rounded to its own coordinates, which L does not count.
    let slack = 1e-12 * size + 4.0 * f64::EPSILON * p.amax().max(q.amax());
    assert!(
        ((p - q).norm() - found.distance).abs() <= slack,
        "{found:?}"
    );
    let witness = found.witness.expect("a distance has a witness");
    for (k, ((shape, pose), point)) in [(a, p), (b, q)].into_iter().enumerate() {
        let part = &shape.placed(pose, &Vec3::zeros())[witness.primitives[k] as usize];
        let corner = part.iter().map(|v| (v - point).norm());
        // Many-cornered parts are measured by their nearest corner where that is enough: brute force is cubic.
        let off = match corner.fold(f64::INFINITY, f64::min) {
            near if near <= slack => near,
            _ => hull_distance(part, &[point]).upper,
        };
        assert!(off <= slack, "point {k} is {off:e} off its body");
    }
    let back = measure(b, a);
    // Either order moves the second body into the frame of the first, and so rounds each coordinate elsewhere: six
    // roundings of a point, twice.
    let change = (back.distance - found.distance).abs();
    assert!(
        change <= 12.0 * f64::EPSILON * size,
        "the order changes {:e} by {change:e}",
        found.distance
    );
    found
}

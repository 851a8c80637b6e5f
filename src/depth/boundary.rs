//! Where a ray leaves the difference of two round primitives.

use super::difference::RoundShape;
use crate::pair::{Pairing, Scratch};
use crate::pose::Vec3;
use crate::tolerance::EPSILON;

/// The point of a round difference next to its boundary on a ray from its middle.
pub fn boundary(
    pairing: &Pairing,
    middle: &Vec3,
    shape: RoundShape,
    ray: &Vec3,
    scratch: &mut Scratch,
) -> Vec3 {
    let Some(ray) = ray.try_normalize(0.0) else {
        return *middle;
    };
    let places = match shape {
        RoundShape::Ball(radius) => return middle + ray * radius,
        RoundShape::Primitives(places) => places,
    };
    /// Steps from outside: each goes to the plane that parts the two, which is next to the boundary after a few.
    const MAX_STEPS: usize = 48;
    let error = pairing.precision.error;
    let mut measure = |along: f64| {
        scratch.meter_mut().count_primitives(1);
        let shifted = pairing.shifted(&(middle + ray * along));
        let found = shifted.closest_at(places, scratch.for_primitives());
        found
            .map(|found| found.closest)
            .filter(|closest| closest.distance > error)
    };
    let mut outside = 2.0 * (pairing.a.radius() + pairing.b.radius());
    let mut inside = 0.0;
    for _ in 0..MAX_STEPS {
        let Some(closest) = measure(outside) else {
            inside = outside;
            break;
        };
        let [on_a, on_b] = closest.points;
        let along = (on_a - on_b).dot(&ray) / closest.distance;
        let step = closest.distance / along;
        // Rounding may make the plane useless; then halving finds the boundary.
        if along.is_nan() || along <= 1e-6 {
            break;
        }
        outside -= step;
        if step <= 2.0 * error {
            break;
        }
    }
    if inside == 0.0 {
        let mut back = 2.0 * error;
        while back < outside {
            if measure(outside - back).is_none() {
                inside = outside - back;
                break;
            }
            back *= 4.0;
        }
        // Halve what is left.
        let mut outside = outside;
        while outside - inside > 4.0 * error && outside > inside * (1.0 + 4.0 * EPSILON) {
            let between = 0.5 * (outside + inside);
            match measure(between) {
                Some(_) => outside = between,
                None => inside = between,
            }
        }
    }
    middle + ray * inside.max(0.0)
}

//! Penetration: the shortest translation that separates two primitives, by the form of these.

use super::core::{is_curved, is_smooth};
use super::distance::measure;
use super::every_feature::DistanceScratch;
use super::placed::{PlacedPrimitive, Precision};
use super::polytope_penetration::{Penetration, polytope_penetration};
use crate::error::{Error, ErrorKind, Result};
use crate::gjk::DistanceLimits;
use crate::work_meter::WorkMeter;

/// The penetration of two sets that meet. Fails for smooth ones. The meter counts the edge pairs compared; if its limit is
/// exceeded, the result is meaningless.
pub fn penetration(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    precision: &Precision,
    meter: &mut WorkMeter,
) -> Result<Penetration> {
    if is_curved(r, s) {
        curved_penetration(r, s, precision, meter)
    } else {
        Ok(polytope_penetration(r, s, precision, meter))
    }
}

/// The penetration of two sets of which at least one is curved. Smooth cores are refused: their shortest way out has no closed
/// form.
fn curved_penetration(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    precision: &Precision,
    meter: &mut WorkMeter,
) -> Result<Penetration> {
    if is_smooth(r, s) {
        return Err(Error::new(
            ErrorKind::Unsupported,
            "the penetration of cylinders, cones, ellipsoids and support functions is not computed",
        ));
    }
    let radii = [r, s].map(|placed| placed.shape.radius());
    let cores = measure(
        r,
        s,
        precision,
        DistanceLimits::EXACT,
        &mut DistanceScratch::default(),
    );
    let cores = cores.expect("nothing is beyond infinity").cores;
    let inner = if cores.distance > precision.error {
        let between = cores.points[0] - cores.points[1];
        Penetration {
            depth: -cores.distance,
            direction: between / cores.distance,
            points: cores.points,
        }
    } else {
        polytope_penetration(r, s, precision, meter)
    };
    Ok(Penetration {
        depth: (inner.depth + radii[0] + radii[1]).max(0.0),
        direction: inner.direction,
        points: [
            inner.points[0] - inner.direction * radii[0],
            inner.points[1] + inner.direction * radii[1],
        ],
    })
}

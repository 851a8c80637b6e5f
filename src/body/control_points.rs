//! Control points with their weights, checked.

use nalgebra::Vector4;

use crate::error::{Error, ErrorKind, Result, require_coordinates, require_finite};
use crate::pose::Vec3;

/// The largest degree: the cost of a cell grows with the product of the degrees.
pub const MAX_DEGREE: usize = 32;

/// The largest weight over the smallest: digits are lost to it.
pub const MAX_WEIGHT_RATIO: f64 = 1e6;

/// Refuses degrees outside of 1 to [`MAX_DEGREE`].
pub(super) fn require_degrees(degrees: [usize; 2]) -> Result<()> {
    for (degree, name) in degrees.iter().zip(["degree_u", "degree_v"]) {
        if !(1..=MAX_DEGREE).contains(degree) {
            return Err(Error::invalid(format!(
                "{name} is {degree}; it must be from 1 to {MAX_DEGREE}"
            )));
        }
    }
    Ok(())
}

/// The points times their weights, with these. The largest weight becomes 1: what scales all weights changes nothing.
pub(super) fn weighted(points: &[Vec3], weights: Option<&[f64]>) -> Result<Vec<Vector4<f64>>> {
    for (i, point) in points.iter().enumerate() {
        require_coordinates(point.as_slice(), "coordinate")
            .map_err(|error| error.within(format_args!("control point {i}")))?;
    }
    let Some(given) = weights else {
        return Ok(points.iter().map(|point| point.push(1.0)).collect());
    };
    let count = points.len();
    if given.len() != count {
        return Err(Error::new(
            ErrorKind::WrongSize,
            format!(
                "{count} control points need as many weights, not {}",
                given.len()
            ),
        ));
    }
    require_finite(given, "weight")?;
    if let Some(i) = given.iter().position(|weight| *weight <= 0.0) {
        let weight = given[i];
        return Err(Error::invalid(format!(
            "weight {i} is {weight}; weights must be above 0"
        )));
    }
    let largest = given.iter().fold(0.0, |all: f64, weight| all.max(*weight));
    let weights: Vec<f64> = given.iter().map(|weight| weight / largest).collect();
    if let Some(i) = weights.iter().position(|w| *w < 1.0 / MAX_WEIGHT_RATIO) {
        return Err(Error::invalid(format!(
            "weight {i} is less than {:e} of the largest",
            1.0 / MAX_WEIGHT_RATIO
        )));
    }
    let both = points.iter().zip(&weights);
    Ok(both.map(|(point, w)| (point * *w).push(*w)).collect())
}

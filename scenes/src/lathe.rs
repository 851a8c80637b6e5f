//! Bodies of revolution about the z axis.

use std::f64::consts::TAU;

use crate::loft::{Ends, loft};
use crate::mesh::Mesh;
use crate::point::Point;

/// The directions (cos, sin) of the corners of a regular polygon, the first along x.
pub(crate) fn directions(sides: usize) -> Vec<[f64; 2]> {
    (0..sides)
        .map(|i| {
            let (s, c) = (TAU * i as f64 / sides as f64).sin_cos();
            [c, s]
        })
        .collect()
}

/// A horizontal ring of `sides` points, or the pole where the radius is 0.
pub(crate) fn circle([r, z]: [f64; 2], sides: usize) -> Vec<Point> {
    if r == 0.0 {
        return vec![[0.0, 0.0, z]];
    }
    directions(sides)
        .iter()
        .map(|[c, s]| [r * c, r * s, z])
        .collect()
}

/// The closed body with this profile of (radius, height), from bottom to top along the outside.
///
/// It has `sides` faces for each step of the profile, and one for each end that is not a pole.
pub(crate) fn lathe(profile: &[[f64; 2]], sides: usize) -> Mesh {
    revolve(profile, sides, Ends::Capped)
}

/// The closed ring whose cross-section is the closed profile, counter-clockwise with the radius to the right.
///
/// It has `sides` faces for each point of the profile.
pub(crate) fn ring(profile: &[[f64; 2]], sides: usize) -> Mesh {
    revolve(profile, sides, Ends::Joined)
}

/// A sphere about the origin of `sides` times `bands` faces.
pub(crate) fn sphere(radius: f64, sides: usize, bands: usize) -> Mesh {
    let at = |k: usize| {
        let (s, c) = (TAU / 2.0 * k as f64 / bands as f64).sin_cos();
        let pole = k == 0 || k == bands;
        [if pole { 0.0 } else { radius * s }, -radius * c]
    };
    lathe(&(0..=bands).map(at).collect::<Vec<_>>(), sides)
}

/// A torus about the z axis of `sides` times `around` faces; `around` is the number of corners of its section.
pub(crate) fn torus(radius: f64, thickness: f64, sides: usize, around: usize) -> Mesh {
    let section: Vec<[f64; 2]> = directions(around)
        .iter()
        .map(|[c, s]| [radius + thickness * c, thickness * s])
        .collect();
    ring(&section, sides)
}

fn revolve(profile: &[[f64; 2]], sides: usize, ends: Ends) -> Mesh {
    let rings: Vec<Vec<Point>> = profile.iter().map(|&p| circle(p, sides)).collect();
    loft(&rings, ends)
}

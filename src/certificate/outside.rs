//! Whether the parts of a body are outside of a solid, by the solid angles of the solid's faces.
//!
//! Seen from a point that is not on it, the faces of a closed surface cover 4 pi times the number of times that it winds around the
//! point: 0 for a point outside. Each primitive is connected and meets no face, so one of its points tells for all of it.

use std::f64::consts::PI;

use super::measure::Measure;
use super::statement::{Item, What};
use crate::body::Body;
use crate::error::Result;
use crate::pose::{Pose, Vec3};

/// A triangle whose corners are nearly opposite to each other, seen from the point, is not measured: half its solid angle is
/// computed as the angle of a complex number, and this is that number's least absolute value, for corners at distance 1. Then the angle's
/// rounding is at most 64 epsilon / 1e-5 < 2e-9.
const LEAST: f64 = 1e-5;

impl Measure<'_> {
    /// Whether no part of a body of an item is inside a solid at a time, for certain. The bodies must not meet.
    pub fn is_outside(&mut self, item: &Item, time: f64) -> Result<bool> {
        let What::Bodies(sides) = &item.what else {
            return Ok(true);
        };
        let places = [self.place(&sides[0], time)?, self.place(&sides[1], time)?];
        let [Some(a), Some(b)] = [sides[0].body, sides[1].body] else {
            return Ok(true);
        };
        Ok(are_outside((a, places[0]), (b, places[1]))
            && are_outside((b, places[1]), (a, places[0])))
    }
}

/// Whether every primitive of a body is certainly outside of another, both at their poses. Bodies that are no solids have no inside.
/// The two must not meet.
fn are_outside((body, pose): (&Body, Pose), (outer, at): (&Body, Pose)) -> bool {
    let Some(solid) = outer.solid() else {
        return true;
    };
    let into_outer = at.inverse().compose(&pose);
    let faces = (0..).zip(outer.primitives().iter());
    let faces = faces.map(|(i, face)| Face {
        vertices: face.vertices,
        sign: f64::from(solid.sign(i)),
        boundary: solid.boundary_of(i),
    });
    let scraps = solid.scraps().iter().enumerate().map(|(i, scrap)| Face {
        vertices: scrap,
        sign: 1.0,
        boundary: solid.boundary_of_scrap(i),
    });
    let faces: Vec<Face> = faces
        .chain(scraps)
        .filter(|face| face.sign != 0.0)
        .collect();
    let mut covered = vec![0.0; solid.boundary_count() as usize];
    body.primitives().iter().all(|primitive| {
        primitive.vertices.iter().any(|vertex| {
            let point = into_outer.transform_point(&(vertex + body.center())) - outer.center();
            solid.extent().outside(&point) > 0.0 || is_outside(&faces, &point, &mut covered)
        })
    })
}

/// A face of a boundary.
struct Face<'a> {
    vertices: &'a [Vec3],
    /// Which way the boundary runs round its vertices: 1 or -1.
    sign: f64,
    boundary: u32,
}

/// Whether no boundary winds around a point; `covered` is scratch memory for the solid angle of each.
fn is_outside(faces: &[Face], point: &Vec3, covered: &mut [f64]) -> bool {
    covered.fill(0.0);
    for face in faces {
        let mut arms = face
            .vertices
            .iter()
            .map(|vertex| (vertex - point).normalize());
        let (Some(first), Some(mut last)) = (arms.next(), arms.next()) else {
            continue;
        };
        for next in arms {
            // Van Oosterom and Strackee (1983).
            let triple = first.dot(&last.cross(&next));
            let cosines = 1.0 + first.dot(&last) + last.dot(&next) + next.dot(&first);
            let is_certain = triple.hypot(cosines) > LEAST;
            if !is_certain {
                return false;
            }
            covered[face.boundary as usize] += face.sign * 2.0 * triple.atan2(cosines);
            last = next;
        }
    }
    covered.iter().all(|angle| angle.abs() < 0.5 * PI)
}

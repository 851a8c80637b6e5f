//! Penetration: the shortest translation that takes two convex sets apart.
//!
//! The sets are apart after a translation of r along n when it is at least what s reaches along n less what r begins at. The
//! shortest one goes along the normal of a facet of the sets' Minkowski difference: a face's normal, or the cross product of
//! an edge of each (in the plane, an edge's normal). All of those are tried, so the result is exact to rounding and there is
//! no iteration that could stop early. Crossing edges are tried only where both support along their cross product, as far as
//! the neighbouring corners tell.

use std::collections::HashMap;

use super::curved::is_curved;
use super::curved_contact::curved_penetration;
use super::distance::{DistanceScratch, closest_polytopes};
use super::placed::{Placed, Precision};
use crate::error::Result;
use crate::pose::Vec3;

/// The shortest translation of r that leaves r and s touching: by `depth` along `direction`, a unit vector from s to r.
#[derive(Clone, Copy, Debug)]
pub struct Penetration {
    /// 0 for sets that only touch, or have no inside in common: flat ones in one plane, say.
    pub depth: f64,
    pub direction: Vec3,
    /// A point of r and one of s that the translation brings together: s = r + depth * direction.
    pub points: [Vec3; 2],
}

/// How far a corner may reach beyond an edge that supports, relative to the pair's size.
const SUPPORT_SLACK: f64 = 1e-9;

/// The penetration of two sets that meet. Fails for smooth ones.
pub fn penetration(r: &Placed, s: &Placed, precision: &Precision) -> Result<Penetration> {
    if is_curved(r, s) {
        curved_penetration(r, s, precision)
    } else {
        Ok(polytope_penetration(r, s, precision))
    }
}

/// The penetration of the hulls of two primitives' vertices that meet.
pub(super) fn polytope_penetration(r: &Placed, s: &Placed, precision: &Precision) -> Penetration {
    let mut shortest = Shortest {
        r,
        s,
        depth: f64::INFINITY,
        direction: Vec3::x(),
    };
    if precision.planar {
        for placed in [r, s] {
            for &edge in &placed.shape.edges {
                let (from, to) = placed.edge_ends(edge);
                let along = to - from;
                shortest.offer(&Vec3::new(-along.y, along.x, 0.0));
            }
        }
    } else {
        for placed in [r, s] {
            for face in 0..placed.shape.faces.len() {
                shortest.offer(&placed.normal(face));
            }
        }
        let slack = SUPPORT_SLACK * precision.size;
        let sides = [r, s].map(wings);
        for edge_r in &sides[0] {
            for edge_s in &sides[1] {
                let Some(normal) = edge_r.along.cross(&edge_s.along).try_normalize(0.0) else {
                    continue;
                };
                let [low_r, high_r] = edge_r.reach(&normal);
                let [low_s, high_s] = edge_s.reach(&normal);
                let supports =
                    (low_r >= -slack && high_s <= slack) || (high_r <= slack && low_s >= -slack);
                if supports {
                    shortest.offer(&normal);
                }
            }
        }
    }
    // Sets without an inside in common and without faces: upright to what there is of them.
    if shortest.depth == f64::INFINITY {
        let along = [r, s]
            .iter()
            .flat_map(|placed| {
                placed
                    .shape
                    .edges
                    .iter()
                    .map(|&edge| placed.edge_ends(edge))
            })
            .map(|(from, to)| to - from)
            .max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()))
            .unwrap_or_else(Vec3::zeros);
        let across = if along.x.abs() <= along.y.abs() {
            Vec3::x()
        } else {
            Vec3::y()
        };
        let upright = if along == Vec3::zeros() {
            across
        } else {
            along.cross(&across)
        };
        shortest.offer(&upright);
    }
    let Shortest {
        depth, direction, ..
    } = shortest;
    let depth = depth.max(0.0);
    Penetration {
        depth,
        direction,
        points: brought_together(r, s, depth * direction, precision),
    }
}

/// Points of both sets that meet when r has moved by `shift`.
fn brought_together(r: &Placed, s: &Placed, shift: Vec3, precision: &Precision) -> [Vec3; 2] {
    let vertices: Vec<Vec3> = r.vertices.iter().map(|v| v + shift).collect();
    let moved = Placed {
        vertices: &vertices,
        ..*r
    };
    let met = closest_polytopes(&moved, s, precision, &mut DistanceScratch::default());
    [met.points[0] - shift, met.points[1]]
}

struct Shortest<'a> {
    r: &'a Placed<'a>,
    s: &'a Placed<'a>,
    depth: f64,
    direction: Vec3,
}

impl Shortest<'_> {
    /// Tries a line, of any length, both ways. Ties go to the first.
    fn offer(&mut self, line: &Vec3) {
        let Some(normal) = line.try_normalize(0.0) else {
            return;
        };
        let (low_r, high_r) = self.r.extent_along(&normal);
        let (low_s, high_s) = self.s.extent_along(&normal);
        for (depth, direction) in [(high_s - low_r, normal), (high_r - low_s, -normal)] {
            if depth < self.depth {
                (self.depth, self.direction) = (depth, direction);
            }
        }
    }
}

/// An edge, and from it to a corner of each face beside it.
struct WingedEdge {
    along: Vec3,
    wings: Vec<Vec3>,
}

impl WingedEdge {
    /// How far the corners beside the edge reach along a normal of it.
    fn reach(&self, normal: &Vec3) -> [f64; 2] {
        self.wings
            .iter()
            .map(|wing| normal.dot(wing))
            .fold([0.0f64; 2], |[low, high], x| [low.min(x), high.max(x)])
    }
}

fn wings(placed: &Placed) -> Vec<WingedEdge> {
    let key = |a: u32, b: u32| [a.min(b), a.max(b)];
    let mut beside: HashMap<[u32; 2], Vec<u32>> = HashMap::new();
    for face in &placed.shape.faces {
        let ring = &face.vertices;
        for i in 0..ring.len() {
            let at = |k: usize| ring[(i + k) % ring.len()];
            beside.entry(key(at(0), at(1))).or_default().push(at(2));
        }
    }
    placed
        .shape
        .edges
        .iter()
        .map(|&[a, b]| {
            let from = placed.vertex(a);
            let corners = beside.get(&key(a, b)).into_iter().flatten();
            WingedEdge {
                along: placed.vertex(b) - from,
                wings: corners
                    .map(|&corner| placed.vertex(corner) - from)
                    .collect(),
            }
        })
        .collect()
}

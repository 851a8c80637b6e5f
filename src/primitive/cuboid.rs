//! Boxes among polyhedra: detected from their vertices, so that support points follow from their axes.

use super::{Convex, Feature};
use crate::gjk::{PointCloud, Support};
use crate::pose::{Mat3, Vec3, turned_back};
use crate::tolerance;

/// A polyhedron whose eight vertices are the corners of a box, up to rounding.
#[derive(Clone, Debug, PartialEq)]
pub struct Cuboid {
    /// The center, in the primitive's frame.
    pub center: Vec3,
    /// The directions of the edges, as columns: a rotation.
    pub axes: Mat3,
    /// The half extents along the axes.
    pub half: Vec3,
    /// The error of the corners and axes against the vertices, as a length.
    doubt: f64,
    /// The vertex at each corner: bit k of a corner's number is set if it is at the high end of axis k.
    corners: [u8; 8],
    /// The edge along each axis from each corner at its low end.
    edges: [[u8; 8]; 3],
    /// The face at the low and at the high end of each axis.
    faces: [[u8; 2]; 3],
}

/// The largest offset of a vertex from its corner, relative to the largest coordinate: the rounding of rotating and translating
/// a box's corners.
const CORNER_ERROR: f64 = 4.0 * tolerance::EPSILON;

impl Cuboid {
    /// The box that a polyhedron is, if it is one.
    pub fn of(shape: &Convex) -> Option<Self> {
        if [shape.vertices.len(), shape.edges.len(), shape.faces.len()] != [8, 12, 6] {
            return None;
        }
        let first = shape.vertices[0];
        let of_first = shape.edges.iter().filter(|ends| ends.contains(&0));
        let mut sides: Vec<Vec3> = of_first
            .map(|ends| shape.vertices[(ends[0] + ends[1]) as usize] - first)
            .collect();
        if sides.len() != 3 {
            return None;
        }
        // The longest sides are most accurate; the third axis follows from the other two.
        sides.sort_by(|a, b| b.norm_squared().total_cmp(&a.norm_squared()));
        let x = sides[0].try_normalize(0.0)?;
        let y = (sides[1] - x * x.dot(&sides[1])).try_normalize(0.0)?;
        // Orthogonalized once more, because the remainder may be small.
        let y = (y - x * x.dot(&y)).normalize();
        let axes = Mat3::from_columns(&[x, y, x.cross(&y)]);
        let center = shape.vertices.iter().sum::<Vec3>() / 8.0;
        let seen: Vec<Vec3> = shape
            .vertices
            .iter()
            .map(|v| turned_back(&axes, &(v - center)))
            .collect();
        let half = seen.iter().fold(Vec3::zeros(), |half, v| half + v.abs()) / 8.0;
        let number = |v: &Vec3| (0..3).fold(0, |bits, k| bits | usize::from(v[k] > 0.0) << k);
        let mut corners = [u8::MAX; 8];
        for (i, v) in (0..).zip(&seen) {
            corners[number(v)] = i;
        }
        let largest = shape
            .vertices
            .iter()
            .fold(0.0, |most, v| v.amax().max(most));
        let is_at_corner = |v: &Vec3| (v.abs() - half).amax() <= CORNER_ERROR * largest;
        let doubt = CORNER_ERROR * largest;
        // A box hardly thicker than the rounding of its corners could be any polyhedron.
        let is_thick = half.min() > 16.0 * doubt;
        if !is_thick || corners.contains(&u8::MAX) || !seen.iter().all(is_at_corner) {
            return None;
        }
        let mut cuboid = Self {
            center,
            axes,
            half,
            doubt,
            corners,
            edges: [[0; 8]; 3],
            faces: [[0; 2]; 3],
        };
        cuboid.number_features(shape)?;
        Some(cuboid)
    }

    fn number_features(&mut self, shape: &Convex) -> Option<()> {
        for axis in 0..3 {
            for corner in (0..8).filter(|corner| corner >> axis & 1 == 0) {
                let ends = [corner, corner | 1 << axis].map(|c| u32::from(self.corners[c]));
                let is_between = |edge: &[u32; 2]| edge.iter().all(|end| ends.contains(end));
                self.edges[axis][corner] = shape.edges.iter().position(is_between)? as u8;
            }
            for side in 0..2 {
                let on_side = |vertex: &u32| {
                    let corner = self.corners.iter().position(|c| u32::from(*c) == *vertex);
                    corner.is_some_and(|corner| corner >> axis & 1 == side)
                };
                let mut faces = shape.faces.iter();
                let face = faces.position(|face| face.vertices.iter().all(on_side))?;
                self.faces[axis][side] = face as u8;
            }
        }
        Some(())
    }

    /// The lowest number of the edges along an axis.
    pub fn edge_along(&self, axis: usize) -> u32 {
        let at_low_end = (0..8).filter(|corner| corner >> axis & 1 == 0);
        let edges = at_low_end.map(|corner| self.edges[axis][corner]);
        u32::from(edges.min().unwrap_or_default())
    }

    /// A point of the primitive's frame, in the box's frame.
    #[inline(always)]
    pub fn seen(&self, point: &Vec3) -> Vec3 {
        turned_back(&self.axes, &(point - self.center))
    }

    /// The support vertex along a direction; `vertices` are those that the box was detected from.
    #[inline(always)]
    pub fn farthest(&self, vertices: &[Vec3], direction: &Vec3) -> u32 {
        let along = turned_back(&self.axes, direction);
        // Where the two ends of an edge are about level, the exact vertices decide, not the corners.
        match self.corner_towards(&along) {
            Some(corner) => corner,
            None => PointCloud(vertices).extreme(direction).name,
        }
    }

    /// The corner farthest along a direction of the box's frame, as a vertex; `None` where the ends of an edge are about level.
    #[inline(always)]
    pub fn corner_towards(&self, along: &Vec3) -> Option<u32> {
        let level = self.level(along);
        let is_clear = |k: usize| along[k].abs() * self.half[k] > level;
        let bit = |k: usize| usize::from(along[k] > 0.0) << k;
        (is_clear(0) & is_clear(1) & is_clear(2))
            .then(|| u32::from(self.corners[bit(0) | bit(1) | bit(2)]))
    }

    /// The edge along an axis that is farthest along a direction of the box's frame across it; `None` where the ends of another
    /// edge are about level.
    #[inline(always)]
    pub fn edge_towards(&self, axis: usize, along: &Vec3) -> Option<Feature> {
        let level = self.level(along);
        let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
        let is_clear = |k: usize| along[k].abs() * self.half[k] > level;
        let bit = |k: usize| usize::from(along[k] > 0.0) << k;
        (is_clear(next) & is_clear(last))
            .then(|| Feature::edge(self.edges[axis][bit(next) | bit(last)].into()))
    }

    /// The face at the low or the high end of an axis.
    #[inline(always)]
    pub fn face_across(&self, axis: usize, is_high: bool) -> Feature {
        Feature::face(self.faces[axis][usize::from(is_high)].into())
    }

    /// Ends of an edge that are nearer to each other along a direction than this are told apart by the exact vertices only.
    #[inline(always)]
    fn level(&self, along: &Vec3) -> f64 {
        4.0 * self.doubt * (along.x.abs() + along.y.abs() + along.z.abs())
    }

    /// The feature that holds the box's nearest point to an outside point, given in the box's frame.
    pub fn feature_towards(&self, seen: &Vec3) -> Feature {
        self.feature_at(seen, 0.0)
    }

    /// The same where what is less than `slack` below a face counts as on it.
    #[inline(always)]
    pub fn feature_at(&self, seen: &Vec3, slack: f64) -> Feature {
        let beyond = |k: usize| seen[k].abs() > self.half[k] - slack;
        let high = |k: usize| usize::from(seen[k] > 0.0);
        let corner = high(0) | high(1) << 1 | high(2) << 2;
        let outside = [beyond(0), beyond(1), beyond(2)];
        match outside.iter().filter(|is_outside| **is_outside).count() {
            3 => Feature::vertex(self.corners[corner].into()),
            2 => {
                let along = (0..3).find(|&k| !outside[k]).unwrap_or(0);
                Feature::edge(self.edges[along][corner & !(1 << along)].into())
            }
            1 => {
                let across = (0..3).find(|&k| outside[k]).unwrap_or(0);
                Feature::face(self.faces[across][high(across)].into())
            }
            _ => Feature::interior(),
        }
    }

    /// The lowest-dimensional feature that holds all given vertices, at least one; `None` if only the interior does.
    pub fn feature_of(&self, vertices: &[u32]) -> Option<Feature> {
        let mut all = [0, 7];
        for vertex in vertices {
            let corner = self.corners.iter().position(|c| u32::from(*c) == *vertex);
            let corner = corner.unwrap_or(0);
            all = [all[0] | corner, all[1] & corner];
        }
        let (differ, corner) = (all[0] & !all[1], all[1]);
        let axis = |bits: usize| (bits.trailing_zeros() as usize).min(2);
        Some(match differ.count_ones() {
            0 => Feature::vertex(self.corners[corner].into()),
            1 => Feature::edge(self.edges[axis(differ)][corner].into()),
            2 => {
                let across = axis(7 & !differ);
                Feature::face(self.faces[across][corner >> across & 1].into())
            }
            _ => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pose::{Pose, rotation_about};
    use crate::primitive::{block, convex_polyhedron};

    #[test]
    fn boxes_are_found_and_numbered() {
        let pose = Pose {
            rotation: rotation_about(&Vec3::new(0.36, 0.48, 0.8), 0.9),
            translation: Vec3::new(3.0, -2.0, 0.5),
        };
        for half in [
            Vec3::new(0.4, 0.3, 0.1),
            Vec3::new(1.0, 1.0, 1.0),
            Vec3::new(5.0, 1e-3, 2.0),
        ] {
            let shape = block(&pose, &half).unwrap();
            let cuboid = Cuboid::of(&shape).unwrap();
            for (e, ends) in (0..).zip(&shape.edges) {
                assert_eq!(cuboid.feature_of(ends), Some(Feature::edge(e)));
            }
            for (f, face) in (0..).zip(&shape.faces) {
                let [a, b, c] = [0, 1, 2].map(|i| face.vertices[i]);
                for some in [&[a, b, c][..], &[a, c]] {
                    assert_eq!(cuboid.feature_of(some), Some(Feature::face(f)));
                }
                let middle = (shape.vertices[a as usize] + shape.vertices[c as usize]) * 0.5;
                let above = cuboid.seen(&(middle + face.normal));
                assert_eq!(cuboid.feature_towards(&above), Feature::face(f));
            }
            for (i, vertex) in (0..).zip(&shape.vertices) {
                let outwards = vertex - cuboid.center;
                assert_eq!(cuboid.farthest(&shape.vertices, &outwards), i);
                assert_eq!(cuboid.feature_of(&[i]), Some(Feature::vertex(i)));
                let beyond = cuboid.seen(&(vertex + outwards));
                assert_eq!(cuboid.feature_towards(&beyond), Feature::vertex(i));
            }
            assert_eq!(cuboid.feature_of(&[0, 1, 2, 3, 4, 5, 6]), None);
            // Directions perpendicular to an edge or a face, where rounding decides.
            for along in [shape.vertices[1] - shape.vertices[0], shape.faces[0].normal] {
                let found = shape.vertices[cuboid.farthest(&shape.vertices, &along) as usize];
                let heights = shape.vertices.iter().map(|v| along.dot(v));
                assert_eq!(along.dot(&found), heights.fold(f64::NEG_INFINITY, f64::max));
            }
        }
    }

    #[test]
    fn what_is_nearly_a_box_is_none() {
        let corner = |i: u32| Vec3::from([0, 1, 2].map(|k| f64::from(i >> k & 1)));
        let mut corners: Vec<Vec3> = (0..8).map(corner).collect();
        corners[7] += Vec3::new(1e-12, 0.0, 0.0);
        assert!(Cuboid::of(&convex_polyhedron(&corners).unwrap()).is_none());
        // A frustum.
        let frustum: Vec<Vec3> = (0..8)
            .map(|i| {
                corner(i).component_mul(&if i > 3 {
                    Vec3::new(0.5, 0.5, 1.0)
                } else {
                    Vec3::repeat(1.0)
                })
            })
            .collect();
        assert!(Cuboid::of(&convex_polyhedron(&frustum).unwrap()).is_none());
    }
}

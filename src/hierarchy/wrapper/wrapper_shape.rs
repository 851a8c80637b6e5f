//! A wrapper as a solid: its box, its faces, its volume and surface.

use std::f64::consts::{PI, TAU};

use super::wrapper::Wrapper;
use crate::boxes::Extent;
use crate::pose::Vec3;
use crate::primitive::{BLOCK_FACES, convex_polyhedron};

/// Rings and sectors of the polyhedron that a sphere is drawn as.
const RINGS: usize = 12;
const SECTORS: usize = 24;

/// A polygon mesh, faces counter-clockwise seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    pub vertices: Vec<Vec3>,
    pub faces: Vec<Vec<u32>>,
}

impl Wrapper<'_> {
    /// Whether the wrapper is a sphere, its only corner the centre.
    pub fn is_sphere(&self) -> bool {
        self.corners.len() == 1
    }

    /// The axis-aligned box around the wrapper.
    pub fn extent(&self) -> Extent {
        let corners = Extent::of(self.corners);
        Extent {
            low: corners.low.add_scalar(-self.excess),
            high: corners.high.add_scalar(self.excess),
        }
    }

    /// The wrapper's faces: those of the corners' hull (the excess of hulls and boxes is rounding, and not drawn), or a
    /// polyhedron whose vertices lie on the sphere.
    pub fn surface(&self) -> Surface {
        if self.is_sphere() && self.excess > 0.0 {
            return sphere(&self.corners[0], self.excess);
        }
        match convex_polyhedron(self.corners) {
            Ok(hull) => Surface {
                vertices: hull.vertices.into_vec(),
                faces: hull
                    .faces
                    .iter()
                    .map(|face| face.vertices.to_vec())
                    .collect(),
            },
            // A hull too thin to be checked is drawn as its box.
            Err(_) => aligned_box(&self.extent()),
        }
    }

    /// The volume and the surface area; a flat wrapper counts both sides.
    pub fn volume_and_area(&self) -> (f64, f64) {
        if self.is_sphere() {
            let r = self.excess;
            return (4.0 / 3.0 * PI * r * r * r, 4.0 * PI * r * r);
        }
        self.surface().volume_and_area()
    }
}

impl Surface {
    /// The volume inside and the area of all faces; a single face counts both sides.
    pub fn volume_and_area(&self) -> (f64, f64) {
        let Some(&origin) = self.vertices.first() else {
            return (0.0, 0.0);
        };
        let (mut volume, mut area) = (0.0, 0.0);
        for face in &self.faces {
            let corner = |k: usize| self.vertices[face[k] as usize] - origin;
            for k in 1..face.len() - 1 {
                let normal = (corner(k) - corner(0)).cross(&(corner(k + 1) - corner(0)));
                volume += corner(0).dot(&normal) / 6.0;
                area += 0.5 * normal.norm();
            }
        }
        if self.faces.len() == 1 {
            (0.0, 2.0 * area)
        } else {
            (volume, area)
        }
    }

    /// Adds another surface's faces.
    pub fn append(&mut self, other: &Surface) {
        let first = self.vertices.len() as u32;
        self.vertices.extend(&other.vertices);
        let moved = |face: &Vec<u32>| face.iter().map(|i| first + i).collect();
        self.faces.extend(other.faces.iter().map(moved));
    }
}

fn aligned_box(extent: &Extent) -> Surface {
    Surface {
        vertices: extent.corners().into(),
        faces: BLOCK_FACES.map(Vec::from).into(),
    }
}

fn sphere(center: &Vec3, radius: f64) -> Surface {
    let at = |ring: usize, sector: usize| {
        let (polar, azimuth) = (
            PI * ring as f64 / RINGS as f64,
            TAU * sector as f64 / SECTORS as f64,
        );
        let across = polar.sin();
        center + Vec3::new(across * azimuth.cos(), across * azimuth.sin(), polar.cos()) * radius
    };
    let mut vertices = vec![at(0, 0)];
    for ring in 1..RINGS {
        vertices.extend((0..SECTORS).map(|sector| at(ring, sector)));
    }
    vertices.push(at(RINGS, 0));
    let last = vertices.len() as u32 - 1;
    let index = |ring: usize, sector: usize| match ring {
        0 => 0,
        RINGS => last,
        _ => (1 + (ring - 1) * SECTORS + sector % SECTORS) as u32,
    };
    let mut faces = Vec::new();
    for ring in 0..RINGS {
        for s in 0..SECTORS {
            let mut face = vec![
                index(ring, s),
                index(ring + 1, s),
                index(ring + 1, s + 1),
                index(ring, s + 1),
            ];
            face.dedup();
            if face.first() == face.last() {
                face.pop();
            }
            faces.push(face);
        }
    }
    Surface { vertices, faces }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drawn_sphere_is_closed_and_about_as_large() {
        let corners = [Vec3::new(1.0, 2.0, 3.0)];
        let wrapper = Wrapper {
            corners: &corners,
            excess: 2.0,
            center: corners[0],
            radius: 2.0,
        };
        let (volume, area) = wrapper.volume_and_area();
        let (drawn_volume, drawn_area) = wrapper.surface().volume_and_area();
        assert!(drawn_volume < volume && drawn_volume > 0.95 * volume);
        assert!(drawn_area < area && drawn_area > 0.97 * area);
    }

    #[test]
    fn boxes_and_plates_are_measured() {
        let corners: Vec<Vec3> = aligned_box(&Extent {
            low: Vec3::zeros(),
            high: Vec3::new(1.0, 2.0, 3.0),
        })
        .vertices;
        let wrapper = |corners| Wrapper {
            corners,
            excess: 0.0,
            center: Vec3::zeros(),
            radius: 4.0,
        };
        let (volume, area) = wrapper(&corners[..]).volume_and_area();
        assert!((volume - 6.0).abs() < 1e-12 && (area - 22.0).abs() < 1e-12);
        let (volume, area) = wrapper(&corners[..4]).volume_and_area();
        assert!(volume == 0.0 && (area - 4.0).abs() < 1e-12);
    }
}

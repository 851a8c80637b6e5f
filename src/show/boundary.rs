//! The boundary of a set on a map over three coordinates, as a surface.
//!
//! Surface nets (Gibson 1998): a corner in every cube of eight neighbouring middles that are not all alike, at the mean of the places
//! halfway between unlike neighbours; a quadrangle between any two unlike neighbours, through the four cubes around them. Crates for
//! this take a field of floats around a level, which classes are not, and bring more code of others than stands here.

use std::io;
use std::path::Path;

use serde_json::json;

use super::glb::{Document, require_glb};
use super::triangles::TriangleStream;
use crate::cobject::Class;
use crate::error::Result;
use crate::map::{Map, MapAxis, MapValues};
use crate::pose::Vec3;

/// Writes a picture of a map: .png for two axes, the boundary of the set as .glb for three.
pub fn show_map(map: &Map, file: &Path) -> Result<()> {
    let axes: &[MapAxis; 3] = match map.axes().try_into() {
        Ok(axes) => axes,
        Err(_) => return map.show(file),
    };
    require_glb(file)?;
    let boundary = Boundary {
        axes,
        values: map.values(),
    };
    let mut document = Document::default();
    let material = document.add_material("boundary", [0.95, 0.5, 0.45, 1.0], true);
    let extras = json!({ "coordinates": axes.map(|axis| axis.coordinate) });
    document.save_with(file, extras, ("boundary", &boundary, material))
}

/// Two neighbouring cells along an axis, of which one is in the set; cells beyond the map are not.
struct Face {
    axis: usize,
    /// The cell that comes first, counted from 1: 0 is beyond the map.
    below: [usize; 3],
    /// That one is in the set.
    is_below: bool,
}

/// What is in the set on a map, and where its boundary runs. Cells are counted from 1 within the map's part of an axis.
struct Boundary<'a> {
    axes: &'a [MapAxis; 3],
    values: &'a MapValues,
}

impl Boundary<'_> {
    fn sides(&self) -> [usize; 3] {
        self.axes.map(|axis| axis.part_length())
    }

    fn is_in(&self, cell: [usize; 3]) -> bool {
        let [a, b, c] = self.sides();
        let [i, j, k] = cell;
        if i == 0 || j == 0 || k == 0 || i > a || j > b || k > c {
            return false;
        }
        let number = ((i - 1) * b + j - 1) * c + k - 1;
        match self.values {
            MapValues::Classes(classes) => classes[number] == Class::Inside as u8,
            MapValues::Distances(distances) => distances[number] == 0.0,
            MapValues::Cells(outcomes) => outcomes[number] != 0,
        }
    }

    fn try_each_face(&self, mut visit: impl FnMut(Face) -> io::Result<()>) -> io::Result<()> {
        let [a, b, c] = self.sides();
        for i in 0..=a {
            for j in 0..=b {
                for k in 0..=c {
                    let below = [i, j, k];
                    let is_below = self.is_in(below);
                    for axis in 0..3 {
                        let mut above = below;
                        above[axis] += 1;
                        if self.is_in(above) != is_below {
                            visit(Face {
                                axis,
                                below,
                                is_below,
                            })?;
                        }
                    }
                }
            }
        }
        Ok(())
    }

    /// The corner in the cube of the eight cells from `first` on, in cells.
    fn corner(&self, first: [usize; 3]) -> Vec3 {
        let is_in: [bool; 8] = std::array::from_fn(|cell| {
            self.is_in([0, 1, 2].map(|axis| first[axis] + (cell >> axis & 1)))
        });
        let (mut sum, mut count) = (Vec3::zeros(), 0.0);
        for axis in 0..3 {
            for below in (0..8).filter(|cell| cell >> axis & 1 == 0) {
                if is_in[below] != is_in[below | 1 << axis] {
                    sum += Vec3::from([0, 1, 2].map(|axis| (below >> axis & 1) as f64));
                    sum[axis] += 0.5;
                    count += 1.0;
                }
            }
        }
        Vec3::from(first.map(|place| place as f64)) + sum / count
    }

    /// The coordinates of a place that is given in cells: number n has its middle at n.
    fn coordinates(&self, place: &Vec3) -> Vec3 {
        let along = |i: usize| {
            let axis = &self.axes[i];
            axis.at(axis.part[0] as f64 + (place[i] - 0.5))
        };
        Vec3::new(along(0), along(1), along(2))
    }
}

/// Made anew each time: a map of many cells has more of them than bytes.
impl TriangleStream for Boundary<'_> {
    fn try_each(&self, visit: &mut dyn FnMut([Vec3; 3], Vec3) -> io::Result<()>) -> io::Result<()> {
        self.try_each_face(|face| {
            let [a, b] = [(face.axis + 1) % 3, (face.axis + 2) % 3];
            // The four cubes around, counter-clockwise about the axis.
            let mut corners = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[back_a, back_b]| {
                let mut first = face.below;
                first[a] = first[a] + back_a - 1;
                first[b] = first[b] + back_b - 1;
                self.coordinates(&self.corner(first))
            });
            if !face.is_below {
                corners.reverse();
            }
            let [p, q, r, s] = corners;
            for [p, q, r] in [[p, q, r], [p, r, s]] {
                let normal = (q - p).cross(&(r - p)).try_normalize(0.0);
                let any = || Vec3::ith(face.axis, 1.0);
                visit([p, q, r], normal.unwrap_or_else(any))?;
            }
            Ok(())
        })
    }
}

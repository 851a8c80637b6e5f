//! Bezier patches as triangles that are proved to be within a tolerance of them.
//!
//! A patch is halved until two triangles over the corners of each cell are near enough. Let L be the bilinear surface through the
//! corners P_ab, and w and b the weights and control points of a cell of degrees m and n, whose surface is S = sum w b B / sum w B.
//! Then (S - L) sum w B is a polynomial of degrees m + 1 and n + 1 whose Bezier coefficients are
//!
//!   c_kl = sum over a, b in {0, 1} of alpha_a(k) beta_b(l) w_(k-a)(l-b) (b_(k-a)(l-b) - P_ab),
//!
//! with alpha_0(k) = 1 - k / (m + 1) and alpha_1(k) = k / (m + 1), and beta likewise (the product of Bernstein polynomials). So no point
//! S(u, v) is farther than max |c| / min w from L(u, v), and L(u, v) is no farther than |P_00 - P_10 - P_01 + P_11| / 4 from the
//! triangles at (u, v), which takes every point of them: the sum of both bounds the Hausdorff distance.

use nalgebra::Vector4;

use super::builder::BodyBuilder;
use crate::error::{Error, ErrorKind, Result, require_coordinates, require_finite};
use crate::pose::Vec3;
use crate::primitive::{Convex, convex_polygon, convex_polyhedron};
use crate::tolerance::EPSILON;

/// The largest degree: the cost of a cell grows with the product of the degrees.
pub const MAX_DEGREE: usize = 32;

/// The largest weight over the smallest: digits are lost to it.
pub const MAX_WEIGHT_RATIO: f64 = 1e6;

/// The most cells of a patch, of two triangles each.
pub const MAX_CELLS: usize = 1 << 18;

/// A cell is halved at most this often: sides get shorter than coordinates are rounded to.
const MAX_HALVINGS: u32 = 80;

/// A tensor product Bezier patch, rational where it has weights. Control points come row by row: point j of row i belongs to degree i
/// of the first parameter and j of the second.
#[derive(Clone, Copy, Debug)]
pub struct BezierPatch<'a> {
    /// In the first and the second parameter.
    pub degrees: [usize; 2],
    /// The control points.
    pub points: &'a [Vec3],
    /// A positive weight for each; `None` for ones.
    pub weights: Option<&'a [f64]>,
}

impl BodyBuilder {
    /// Adds triangles that are within the tolerance of a patch. The body states how far they are from it at most, for this patch; it is
    /// no part of the boundary of a solid.
    pub fn add_bezier_patch(
        &mut self,
        patch: &BezierPatch,
        tolerance: f64,
        tag: u64,
    ) -> Result<()> {
        let whole = Cell::whole(patch)?;
        self.require_planar(patch.points)?;
        require_finite(&[tolerance], "tolerance")?;
        if tolerance <= 0.0 {
            return Err(Error::invalid(format!(
                "tolerance is {tolerance}; it must be above 0"
            )));
        }
        let mut added: Vec<(Convex, u64)> = Vec::new();
        let mut deviation = 0.0f64;
        for_each_cell(whole, tolerance, |cell, bound| {
            deviation = deviation.max(bound);
            let [a, b, c, d] = cell.corners();
            let triangles = match (a - d).norm() <= (b - c).norm() {
                true => [[a, b, d], [a, d, c]],
                false => [[a, b, c], [b, d, c]],
            };
            for triangle in triangles {
                let primitive = match convex_polygon(&triangle) {
                    // Where an edge of the patch is a point.
                    Err(error) if error.kind == ErrorKind::Degenerate => {
                        convex_polyhedron(&triangle)?
                    }
                    polygon => polygon?,
                };
                added.push((primitive, tag));
            }
            Ok(())
        })?;
        self.push_all(added, false)?;
        self.raise_deviation(deviation);
        Ok(())
    }
}

/// A part of a patch: control points times weights, and weights.
#[derive(Clone, Debug)]
struct Cell {
    /// The numbers of control points in the two parameters.
    sizes: [usize; 2],
    controls: Vec<Vector4<f64>>,
    /// How often the patch was halved.
    halvings: u32,
}

impl Cell {
    fn whole(patch: &BezierPatch) -> Result<Self> {
        for (degree, name) in patch.degrees.iter().zip(["degree_u", "degree_v"]) {
            if !(1..=MAX_DEGREE).contains(degree) {
                return Err(Error::invalid(format!(
                    "{name} is {degree}; it must be from 1 to {MAX_DEGREE}"
                )));
            }
        }
        let sizes = patch.degrees.map(|degree| degree + 1);
        let count = sizes[0] * sizes[1];
        if patch.points.len() != count {
            return Err(Error::new(
                ErrorKind::WrongSize,
                format!(
                    "degrees {} and {} need {count} control points, not {}",
                    patch.degrees[0],
                    patch.degrees[1],
                    patch.points.len()
                ),
            ));
        }
        for (i, point) in patch.points.iter().enumerate() {
            require_coordinates(point.as_slice(), "coordinate")
                .map_err(|error| error.within(format_args!("control point {i}")))?;
        }
        let mut weights = vec![1.0; count];
        if let Some(given) = patch.weights {
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
            // What scales all weights changes nothing.
            weights = given.iter().map(|weight| weight / largest).collect();
            if let Some(i) = weights.iter().position(|w| *w < 1.0 / MAX_WEIGHT_RATIO) {
                return Err(Error::invalid(format!(
                    "weight {i} is less than {:e} of the largest",
                    1.0 / MAX_WEIGHT_RATIO
                )));
            }
        }
        let controls = patch.points.iter().zip(&weights);
        Ok(Self {
            sizes,
            controls: controls.map(|(p, w)| (p * *w).push(*w)).collect(),
            halvings: 0,
        })
    }

    /// P_00, P_10, P_01 and P_11.
    fn corners(&self) -> [Vec3; 4] {
        let [rows, columns] = self.sizes;
        let last_row = (rows - 1) * columns;
        [0, last_row, columns - 1, last_row + columns - 1].map(|i| point(&self.controls[i]))
    }

    fn least_weight(&self) -> f64 {
        let weights = self.controls.iter().map(|control| control.w);
        weights.fold(f64::INFINITY, f64::min)
    }

    /// Bounds the Hausdorff distance of the cell's surface from two triangles over its corners, whichever the diagonal.
    fn deviation(&self) -> f64 {
        let [rows, columns] = self.sizes;
        let corners = self.corners();
        let mut largest = 0.0f64;
        for k in 0..=rows {
            for l in 0..=columns {
                let (s, t) = (k as f64 / rows as f64, l as f64 / columns as f64);
                let mut coefficient = Vec3::zeros();
                for (corner, p) in corners.iter().enumerate() {
                    let (a, b) = (corner & 1, corner >> 1);
                    if k < a || l < b || k - a >= rows || l - b >= columns {
                        continue;
                    }
                    let control = &self.controls[(k - a) * columns + l - b];
                    let share = [1.0 - s, s][a] * [1.0 - t, t][b];
                    coefficient += (control.xyz() - p * control.w) * share;
                }
                largest = largest.max(coefficient.norm());
            }
        }
        let [p00, p10, p01, p11] = corners;
        let twist = (p00 - p10) - (p01 - p11);
        largest / self.least_weight() + 0.25 * twist.norm() + self.rounding()
    }

    /// What rounding may add. Each halving averages `sizes` times; products, and what the body's own frame takes, are as small.
    fn rounding(&self) -> f64 {
        let [rows, columns] = self.sizes;
        let averages = (rows.max(columns) * (self.halvings as usize + 4)) as f64;
        let size = self.controls.iter().fold(0.0, |size: f64, control| {
            size.max(control.xyz().amax() / control.w)
        });
        8.0 * averages * EPSILON * size / self.least_weight()
    }

    /// How far the control points are from the straight line between those at the ends, along each parameter. Where they are on it, how
    /// long the sides are counts, which halve the twist.
    fn bends(&self) -> [f64; 2] {
        [0, 1].map(|along| {
            let Lines {
                count,
                step,
                lines,
                between,
            } = self.lines(along);
            let mut bend = 0.0f64;
            for line in 0..lines {
                let at = |k: usize| point(&self.controls[line * between + k * step]);
                let (first, last) = (at(0), at(count - 1));
                for k in 1..count - 1 {
                    let part = k as f64 / (count - 1) as f64;
                    bend = bend.max((at(k) - first - (last - first) * part).norm());
                }
                bend = bend.max(1e-6 * (last - first).norm());
            }
            bend
        })
    }

    fn lines(&self, along: usize) -> Lines {
        let [rows, columns] = self.sizes;
        match along {
            0 => Lines {
                count: rows,
                step: columns,
                lines: columns,
                between: 1,
            },
            _ => Lines {
                count: columns,
                step: 1,
                lines: rows,
                between: columns,
            },
        }
    }

    /// The two halves, by de Casteljau's averages.
    fn halves(self, along: usize) -> [Self; 2] {
        let Lines {
            count,
            step,
            lines,
            between,
        } = self.lines(along);
        let mut lower = self;
        lower.halvings += 1;
        let mut upper = lower.clone();
        for line in 0..lines {
            let at = |k: usize| line * between + k * step;
            for round in 1..count {
                for k in 0..count - round {
                    upper.controls[at(k)] =
                        (upper.controls[at(k)] + upper.controls[at(k + 1)]) * 0.5;
                }
                lower.controls[at(round)] = upper.controls[at(0)];
            }
        }
        [lower, upper]
    }
}

/// The lines of control points along a parameter: how many each has and how far apart they stand, how many lines there are and where
/// they begin.
struct Lines {
    count: usize,
    step: usize,
    lines: usize,
    between: usize,
}

fn point(control: &Vector4<f64>) -> Vec3 {
    control.xyz() / control.w
}

/// Halves a cell until each part is proved to be within the tolerance of two triangles; gives each with its bound.
fn for_each_cell(
    whole: Cell,
    tolerance: f64,
    mut visit: impl FnMut(&Cell, f64) -> Result<()>,
) -> Result<()> {
    let mut todo = vec![whole];
    let mut cells = 0;
    while let Some(cell) = todo.pop() {
        let bound = cell.deviation();
        if bound <= tolerance {
            cells += 1;
            visit(&cell, bound)?;
            continue;
        }
        if cells + todo.len() >= MAX_CELLS || cell.halvings == MAX_HALVINGS {
            return Err(Error::new(
                ErrorKind::Limit,
                format!(
                    "tolerance {tolerance:e} needs more than {MAX_CELLS} cells, or is less than what coordinates are rounded to"
                ),
            ));
        }
        let [in_u, in_v] = cell.bends();
        let [lower, upper] = cell.halves(usize::from(in_v > in_u));
        todo.extend([upper, lower]);
    }
    Ok(())
}

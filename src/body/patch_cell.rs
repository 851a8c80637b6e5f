//! A part of a Bezier patch, whose surface is proved to be near two triangles over its corners.
//!
//! Let L be the bilinear surface through the corners P_ab, and w and b the weights and control points of a cell of degrees m and n,
//! whose surface is S = sum w b B / sum w B. Then (S - L) sum w B is a polynomial of degrees m + 1 and n + 1 whose Bezier coefficients are
//!
//!   c_kl = sum over a, b in {0, 1} of alpha_a(k) beta_b(l) w_(k-a)(l-b) (b_(k-a)(l-b) - P_ab),
//!
//! with alpha_0(k) = 1 - k / (m + 1) and alpha_1(k) = k / (m + 1), and beta likewise (the product of Bernstein polynomials). So no point
//! S(u, v) is farther than max |c| / min w from L(u, v), and L(u, v) is no farther than |P_00 - P_10 - P_01 + P_11| / 4 from the
//! triangles at (u, v), which takes every point of them: the sum of both bounds the Hausdorff distance. It also bounds how far any
//! point x of the corners' convex hull is from S: x = sum l_ab P_ab with l_ab >= 0 of sum 1 differs from L(l_10 + l_11, l_01 + l_11) by
//! (l_11 - u v)(P_00 - P_10 - P_01 + P_11), and l_11 by at most 1 / 4 from u v.

use nalgebra::Vector4;

use crate::pose::{Pose, Vec3};
use crate::tolerance::EPSILON;

/// A part of a patch: control points times weights, and weights.
#[derive(Clone, Debug)]
pub(crate) struct Cell {
    /// The numbers of control points in the two parameters.
    sizes: [usize; 2],
    controls: Vec<Vector4<f64>>,
    /// The largest coordinate of the surface's control points.
    size: f64,
    /// How many rounds of averages knots that were inserted took.
    insertions: usize,
    place: CellPlace,
}

/// Which part of its patch a cell is: which halves were taken, along which parameter.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct CellPlace {
    halvings: u32,
    /// Bit k: whether the k-th halving was along the second parameter.
    along: u128,
    /// Bit k: whether its upper half was taken.
    upper: u128,
}

/// A cell is halved at most this often: sides get shorter than coordinates are rounded to.
pub(super) const MAX_HALVINGS: u32 = 80;

impl Cell {
    /// All of a patch: so many rows and columns of control points times their weights, with these. Control points of this [`size`] became
    /// those of the patch by so many rounds of averages, if knots were inserted.
    pub fn whole(
        sizes: [usize; 2],
        controls: Vec<Vector4<f64>>,
        size: f64,
        insertions: usize,
    ) -> Self {
        Self {
            sizes,
            controls,
            size,
            insertions,
            place: CellPlace::default(),
        }
    }

    /// P_00, P_10, P_01 and P_11.
    pub fn corners(&self) -> [Vec3; 4] {
        let [rows, columns] = self.sizes;
        let last_row = (rows - 1) * columns;
        [0, last_row, columns - 1, last_row + columns - 1].map(|i| point(&self.controls[i]))
    }

    /// The number of control points.
    pub fn control_count(&self) -> usize {
        self.controls.len()
    }

    /// Which part of its patch this is.
    pub fn place(&self) -> CellPlace {
        self.place
    }

    /// Whether it can be halved.
    pub fn has_halves(&self) -> bool {
        self.place.halvings < MAX_HALVINGS
    }

    /// The part of this whole patch at a place.
    pub fn part(&self, place: &CellPlace) -> Self {
        (0..place.halvings).fold(self.clone(), |cell, k| {
            let [lower, upper] = cell.halves((place.along >> k & 1) as usize);
            match place.upper >> k & 1 {
                0 => lower,
                _ => upper,
            }
        })
    }

    /// The same moved.
    pub fn moved(&self, pose: &Pose) -> Self {
        let moved = self.controls.iter().map(|control| {
            let point = pose.rotation * control.xyz() + pose.translation * control.w;
            point.push(control.w)
        });
        Self {
            controls: moved.collect(),
            // No coordinate is larger, before or after.
            size: 2.0 * self.size + pose.translation.amax(),
            ..*self
        }
    }

    fn least_weight(&self) -> f64 {
        let weights = self.controls.iter().map(|control| control.w);
        weights.fold(f64::INFINITY, f64::min)
    }

    /// The two triangles over the corners, parted by the shorter diagonal.
    pub fn triangles(&self) -> [[Vec3; 3]; 2] {
        let [a, b, c, d] = self.corners();
        match (a - d).norm() <= (b - c).norm() {
            true => [[a, b, d], [a, d, c]],
            false => [[a, b, c], [b, d, c]],
        }
    }

    /// Bounds the Hausdorff distance of the cell's surface from two triangles over its corners, whichever the diagonal.
    pub fn deviation(&self) -> f64 {
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

    /// What rounding may add. Each halving averages `sizes` times; products, and the motions to the frames of bodies, are as small. Errors
    /// are relative to the control points that were given, of which a cell has averages that may be much smaller.
    ///
    /// An inserted knot averages a (1 - s) + b s, where s is a quotient of two differences. Let u be EPSILON / 2. The three errors of s
    /// move the average by 3 u |b - a| <= 6 u size; 1 - s, the products and the sum add 3 u size. So coordinates and weights (at most 1)
    /// are off by 9 u, and the point by (sqrt(3) + 1) 9 u = 12.3 EPSILON: two averages are counted for it.
    fn rounding(&self) -> f64 {
        let [rows, columns] = self.sizes;
        let averages = rows.max(columns) * (self.place.halvings as usize + 4) + 2 * self.insertions;
        8.0 * averages as f64 * EPSILON * self.size / self.least_weight()
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

    /// Along which parameter it is bent more.
    pub fn bent_along(&self) -> usize {
        let [in_u, in_v] = self.bends();
        usize::from(in_v > in_u)
    }

    /// The two halves along a parameter, by de Casteljau's averages.
    pub fn halves(self, along: usize) -> [Self; 2] {
        let Lines {
            count,
            step,
            lines,
            between,
        } = self.lines(along);
        let mut lower = self;
        let CellPlace {
            halvings,
            along: second,
            ..
        } = &mut lower.place;
        *second |= (along as u128) << *halvings;
        *halvings += 1;
        let mut upper = lower.clone();
        upper.place.upper |= 1 << (upper.place.halvings - 1);
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

/// The largest coordinate of control points.
pub(super) fn size(controls: &[Vector4<f64>]) -> f64 {
    let sizes = controls.iter().map(|control| point(control).amax());
    sizes.fold(0.0, f64::max)
}

fn point(control: &Vector4<f64>) -> Vec3 {
    control.xyz() / control.w
}

//! NURBS surfaces.

use nalgebra::Vector4;

use super::b_spline::KnotVector;
use super::builder::BodyBuilder;
use super::control_points::{require_degrees, weighted};
use super::patch_cell::{Cell, size};
use super::patch_triangles::MAX_CELLS;
use crate::error::{Error, ErrorKind, Result};
use crate::pose::Vec3;

/// A tensor product B-spline surface, rational where it has weights. Control points come row by row: point j of row i belongs to index i
/// in the first parameter and j in the second.
#[derive(Clone, Copy, Debug)]
pub struct NurbsSurface<'a> {
    /// In the first and the second parameter.
    pub degrees: [usize; 2],
    /// In the first and the second parameter, never falling: `degree + 1` more than rows, or columns, of control points. The surface
    /// lies between knot `degree` and the one with as many after it; it does not tear at those between them.
    pub knots: [&'a [f64]; 2],
    /// The control points.
    pub points: &'a [Vec3],
    /// A positive weight for each; `None` for ones.
    pub weights: Option<&'a [f64]>,
}

impl BodyBuilder {
    /// Adds triangles that are within the tolerance of a surface, as [`BodyBuilder::add_bezier_patch`] does: those of one patch for each
    /// pair of knot spans that are not empty, the spans of the second parameter running fastest.
    pub fn add_nurbs_surface(
        &mut self,
        surface: &NurbsSurface,
        tolerance: f64,
        tag: u64,
    ) -> Result<()> {
        let patches = surface.patches()?;
        self.require_planar(surface.points)?;
        self.add_patches(patches, tolerance, tag)
    }
}

impl NurbsSurface<'_> {
    /// The patches of the checked surface. Each is made when it is asked for: where degrees are p and q, all of them have up to
    /// (p + 1) (q + 1) times as many control points as the surface.
    fn patches(&self) -> Result<impl ExactSizeIterator<Item = Cell>> {
        let [in_u, in_v] = self.knot_vectors()?;
        let [rows, columns] = [in_u, in_v].map(|knots| knots.point_count());
        if rows.checked_mul(columns) != Some(self.points.len()) {
            return Err(Error::new(
                ErrorKind::WrongSize,
                format!(
                    "the knots need {rows} x {columns} control points, not {}",
                    self.points.len()
                ),
            ));
        }
        let [spans_u, spans_v] = [in_u, in_v].map(|knots| knots.spans());
        let count = spans_u.len() * spans_v.len();
        if count > MAX_CELLS {
            return Err(Error::new(
                ErrorKind::Limit,
                format!(
                    "knots_u and knots_v have {} x {} spans, more than {MAX_CELLS} patches",
                    spans_u.len(),
                    spans_v.len()
                ),
            ));
        }
        let net = weighted(self.points, self.weights)?;
        let size = size(&net);
        let sizes = self.degrees.map(|degree| degree + 1);
        let insertions = in_u.rounds() + in_v.rounds();
        let mut strip = Vec::new();
        Ok((0..count).map(move |patch| {
            let [u, v] = [patch / spans_v.len(), patch % spans_v.len()];
            if v == 0 {
                strip = rows_of_span(&in_u, spans_u[u], &net, columns);
            }
            let controls = columns_of_span(&in_v, spans_v[v], &strip, columns, sizes);
            Cell::whole(sizes, controls, size, insertions)
        }))
    }

    fn knot_vectors(&self) -> Result<[KnotVector<'_>; 2]> {
        require_degrees(self.degrees)?;
        let checked = |along: usize, name: &str| {
            let knots = KnotVector::checked(self.degrees[along], self.knots[along]);
            knots.map_err(|error| error.within(name))
        };
        Ok([checked(0, "knots_u")?, checked(1, "knots_v")?])
    }
}

/// The rows of control points of a span of the first parameter: a Bezier curve down each column.
fn rows_of_span(
    knots: &KnotVector,
    span: usize,
    net: &[Vector4<f64>],
    columns: usize,
) -> Vec<Vector4<f64>> {
    let first = knots.first_point(span);
    let mut strip = net[first * columns..(span + 1) * columns].to_vec();
    for column in 0..columns {
        knots.insert_ends(span, &mut strip, |i| i * columns + column);
    }
    strip
}

/// The control points of the patch of a span of the second parameter, from the rows of a span of the first.
fn columns_of_span(
    knots: &KnotVector,
    span: usize,
    strip: &[Vector4<f64>],
    columns: usize,
    sizes: [usize; 2],
) -> Vec<Vector4<f64>> {
    let own = knots.first_point(span)..span + 1;
    let rows = strip.chunks_exact(columns);
    let mut controls: Vec<Vector4<f64>> = rows.flat_map(|row| row[own.clone()].to_vec()).collect();
    for row in 0..sizes[0] {
        knots.insert_ends(span, &mut controls, |j| row * sizes[1] + j);
    }
    controls
}

//! Adds ready-made shapes, point clouds and height fields to a body builder.

use std::sync::Arc;

use super::builder::BodyBuilder;
use crate::error::{Error, ErrorKind, Result, require_coordinates};
use crate::pose::{Pose, Vec3};
use crate::primitive::{
    Convex, SupportFunction, block, capsule, cone, convex_polygon, convex_polyhedron, cylinder,
    ellipsoid, rounded, sphere, support_set,
};
use crate::room::room_for;

/// Heights over the nodes of a grid in the xy plane.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightField<'a> {
    /// Number of nodes along x and along y, at least two each.
    pub nodes: [usize; 2],
    /// One height per node, x varying fastest: node (i, j) has index j * nodes[0] + i.
    pub heights: &'a [f64],
    /// The distance between nodes along x and along y. The first node is at the origin.
    pub cell: [f64; 2],
    /// The z of the ground's lower side; without it the field is a surface.
    pub base: Option<f64>,
}

impl BodyBuilder {
    /// Adds a ball; in the plane a disc. As exact as a point: 1e-12 L.
    pub fn add_sphere(&mut self, center: &Vec3, radius: f64, tag: u64) -> Result<()> {
        self.require_planar(&[*center])?;
        self.push(sphere(center, radius, self.is_planar())?, tag, false)
    }

    /// Adds all points within `radius` of the segment from a to b. As exact as a segment: 1e-12 L.
    pub fn add_capsule(&mut self, a: &Vec3, b: &Vec3, radius: f64, tag: u64) -> Result<()> {
        self.require_planar(&[*a, *b])?;
        self.push(capsule(&[*a, *b], radius, self.is_planar())?, tag, false)
    }

    /// Adds the solid box of these half extents around the origin of `pose`, along its axes: a polyhedron, exact to 1e-12 L.
    pub fn add_box(&mut self, pose: &Pose, half_extents: &Vec3, tag: u64) -> Result<()> {
        self.require_space("a box")?;
        self.push(block(pose, half_extents)?, tag, false)
    }

    /// Adds solid boxes along the axes, each with its lowest corner and its edges, tagged with their indices: polyhedra, exact to
    /// 1e-12 L.
    pub fn add_aligned_boxes(&mut self, boxes: &[(Vec3, Vec3)]) -> Result<()> {
        self.require_space("a box")?;
        // The hull is made once for each size.
        let mut made: Vec<(Vec3, Convex)> = Vec::new();
        let mut added = Vec::with_capacity(boxes.len());
        for (i, (low, edges)) in boxes.iter().enumerate() {
            let named = |e: Error| e.within(format_args!("box {i}"));
            require_coordinates(low.as_slice(), "coordinate").map_err(named)?;
            let half = edges * 0.5;
            let known = made.iter().position(|(of, _)| of == edges);
            let known = match known {
                Some(known) => known,
                None => {
                    let shape = block(&Pose::identity(), &half).map_err(named)?;
                    made.push((*edges, shape));
                    made.len() - 1
                }
            };
            let shape = made[known].1.clone().recentered(&-(low + half));
            added.push((shape, i as u64));
        }
        self.push_all(added, false)
    }

    /// Adds the solid cylinder around the z axis of `pose`, from -half_length to half_length. Distances are known to
    /// [`SMOOTH_ERROR`](crate::tolerance::SMOOTH_ERROR) times its diameter plus 1e-12 L. It gives one contact only, even
    /// if it stands or lies on a face, and no penetration depth.
    pub fn add_cylinder(
        &mut self,
        pose: &Pose,
        radius: f64,
        half_length: f64,
        tag: u64,
    ) -> Result<()> {
        self.require_space("a cylinder")?;
        self.push(cylinder(pose, radius, half_length)?, tag, false)
    }

    /// Adds the solid cone around the z axis of `pose`, its base at -height / 2 and its apex at height / 2. As exact as a
    /// cylinder.
    pub fn add_cone(&mut self, pose: &Pose, radius: f64, height: f64, tag: u64) -> Result<()> {
        self.require_space("a cone")?;
        self.push(cone(pose, radius, height)?, tag, false)
    }

    /// Adds the solid ellipsoid of these semi-axes around the origin of `pose`. As exact as a cylinder.
    pub fn add_ellipsoid(&mut self, pose: &Pose, semi_axes: &Vec3, tag: u64) -> Result<()> {
        self.require_space("an ellipsoid")?;
        self.push(ellipsoid(pose, semi_axes)?, tag, false)
    }

    /// Adds all points within `radius` of a convex polygon, vertices in cyclic order. As exact as the polygon: 1e-12 L.
    pub fn add_rounded_polygon(&mut self, vertices: &[Vec3], radius: f64, tag: u64) -> Result<()> {
        self.require_planar(vertices)?;
        let core = convex_polygon(vertices)?;
        self.push(rounded(core, radius, self.is_planar())?, tag, false)
    }

    /// Adds all points within `radius` of the convex hull of points. As exact as the hull: 1e-12 L.
    pub fn add_rounded_polyhedron(&mut self, points: &[Vec3], radius: f64, tag: u64) -> Result<()> {
        self.require_planar(points)?;
        let core = convex_polyhedron(points)?;
        self.push(rounded(core, radius, self.is_planar())?, tag, false)
    }

    /// Adds the bounded convex set of a support function, which is called for about 300 directions here. As exact as a
    /// cylinder if the function is exact to rounding; otherwise its own error adds.
    pub fn add_support(&mut self, function: Arc<dyn SupportFunction>, tag: u64) -> Result<()> {
        self.require_space("a support function")?;
        self.push(support_set(function)?, tag, false)
    }

    /// Adds balls of one radius around points, tagged with their indices; radius 0 adds the points themselves. Exact to
    /// 1e-12 L.
    pub fn add_points(&mut self, points: &[Vec3], radius: f64) -> Result<()> {
        self.require_planar(points)?;
        // The message names the first invalid point.
        for (i, point) in points.iter().enumerate() {
            let checked = require_coordinates(point.as_slice(), "coordinate");
            checked.map_err(|e| e.within(format_args!("point {i}: the center")))?;
            if i == 0 {
                sphere(point, radius, self.is_planar()).map_err(|e| e.within("point 0"))?;
            }
        }
        if points.is_empty() {
            return Ok(());
        }
        let shape = sphere(&Vec3::zeros(), radius, self.is_planar())?;
        self.push_points(&shape, points)
    }

    /// Adds a grid of heights over the xy plane: two triangles per cell, split along the diagonal from (i, j) to
    /// (i + 1, j + 1), both tagged with the cell's index j * (nodes[0] - 1) + i. With a base, which must be below all
    /// heights, each triangle becomes the solid prism from it down to the base. Exact to 1e-12 L.
    pub fn add_height_field(&mut self, field: &HeightField) -> Result<()> {
        self.require_space("a height field")?;
        let [nx, ny] = field.nodes;
        field.check()?;
        let node = |i: usize, j: usize| {
            let [dx, dy] = field.cell;
            Vec3::new(i as f64 * dx, j as f64 * dy, field.heights[j * nx + i])
        };
        let mut added = room_for(2 * (nx - 1) * (ny - 1))?;
        for j in 0..ny - 1 {
            for i in 0..nx - 1 {
                let tag = (j * (nx - 1) + i) as u64;
                let [from, to] = [node(i, j), node(i + 1, j + 1)];
                for triangle in [[from, node(i + 1, j), to], [from, to, node(i, j + 1)]] {
                    let primitive = ground(&triangle, field.base)
                        .map_err(|e| e.within(format_args!("cell ({i}, {j})")))?;
                    added.push((primitive, tag));
                }
            }
        }
        self.push_all(added, field.base.is_none())
    }

    fn is_planar(&self) -> bool {
        self.dimension == 2
    }

    fn require_space(&self, what: &str) -> Result<()> {
        if self.is_planar() {
            return Err(Error::new(
                ErrorKind::Unsupported,
                format!("{what} cannot be part of a planar body"),
            ));
        }
        Ok(())
    }
}

/// A triangle of the ground, or the prism from it down to the base.
fn ground(triangle: &[Vec3; 3], base: Option<f64>) -> Result<Convex> {
    let Some(base) = base else {
        return convex_polygon(triangle);
    };
    let below = triangle.map(|p| Vec3::new(p.x, p.y, base));
    convex_polyhedron(&[triangle.as_slice(), &below].concat())
}

impl HeightField<'_> {
    fn check(&self) -> Result<()> {
        let [nx, ny] = self.nodes;
        if nx < 2 || ny < 2 {
            return Err(Error::invalid(format!(
                "the field has {nx} by {ny} nodes; at least 2 by 2 are needed"
            )));
        }
        if nx.checked_mul(ny) != Some(self.heights.len()) {
            return Err(Error::new(
                ErrorKind::WrongSize,
                format!(
                    "{nx} by {ny} nodes need as many heights, got {}",
                    self.heights.len()
                ),
            ));
        }
        require_coordinates(self.heights, "height")?;
        for (&size, axis) in self.cell.iter().zip(["x", "y"]) {
            require_coordinates(&[size], "number")
                .map_err(|e| e.within(format_args!("the cell's size along {axis}")))?;
            if size <= 0.0 {
                return Err(Error::invalid(format!(
                    "the cell's size along {axis} is {size}; it must be positive"
                )));
            }
        }
        if let Some(base) = self.base {
            require_coordinates(&[base], "number").map_err(|e| e.within("the base"))?;
            if let Some(i) = self.heights.iter().position(|&height| height <= base) {
                return Err(Error::invalid(format!(
                    "height {i} is {}, not above the base {base}",
                    self.heights[i]
                )));
            }
        }
        Ok(())
    }
}

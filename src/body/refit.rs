//! A body whose vertices move while its topology stays.

use super::body::{Body, BodyStatistics};
use super::joints::Joints;
use super::solid::{Solid, Surfaces};
use crate::boxes::Extent;
use crate::error::{Error, ErrorKind, Result};
use crate::hierarchy::{Ball, refit_hierarchy};
use crate::pose::Vec3;

impl Body {
    /// The vertices of all primitives, one primitive after the other, in the frame in which the body was given.
    pub fn vertices(&self) -> impl Iterator<Item = Vec3> + '_ {
        let all = self
            .primitives
            .iter()
            .flat_map(|primitive| primitive.vertices);
        all.map(|vertex| vertex + self.center)
    }

    /// The number of [`Body::vertices`].
    pub fn vertex_count(&self) -> usize {
        self.primitives.vertex_count()
    }

    /// A body with other vertices, in the order of [`Body::vertices`]: its primitives, their tags and features, and the
    /// grouping of the hierarchy stay; boxes are refitted. Each primitive is checked as by a builder. Vertices of a solid's
    /// boundary that were one must stay one.
    pub fn refit(&self, vertices: &[Vec3]) -> Result<Self> {
        let count = self.vertex_count();
        if vertices.len() != count {
            return Err(Error::new(
                ErrorKind::WrongSize,
                format!("the body has {count} vertices, not {}", vertices.len()),
            ));
        }
        let is_off = |vertex: &Vec3| vertex.z != 0.0 && vertex.z.is_finite();
        if self.dimension == 2
            && let Some(i) = vertices.iter().position(is_off)
        {
            return Err(Error::new(
                ErrorKind::NotPlanar,
                format!(
                    "vertex {i} of a planar body has z = {}, not 0",
                    vertices[i].z
                ),
            ));
        }
        // Vertices that are not finite are refused next.
        let (low, high) = self.primitives.extent_with(vertices);
        let center = low * 0.5 + high * 0.5;
        let primitives = self.primitives.with_vertices(vertices, &center)?;
        let joints = self.solid.as_ref().map(|solid| {
            let joints = self
                .joints
                .get_or_init(|| Joints::of(&self.primitives, solid));
            (joints, solid)
        });
        if let Some((joints, _)) = joints {
            joints.check(&self.primitives, vertices)?;
        }
        let mut solid = None;
        if let Some((joints, old)) = joints {
            let surfaces = Surfaces {
                scraps: joints.scraps(vertices, &center)?,
                ..old.surfaces.clone()
            };
            solid = Solid::new(surfaces, &primitives);
        }
        let depth = self.statistics.depth as usize;
        let (radius, ball) = match primitives.are_hulls() {
            true => Ball::around_vertices(vertices, &center, &Extent { low, high }),
            false => (primitives.radius(), Ball::around(&primitives)),
        };
        let built = refit_hierarchy(&primitives, &self.wrappers, &self.packed, ball, depth)?;
        let statistics = BodyStatistics {
            nodes: built.nodes as u64,
            depth: built.depth as u64,
            low: low.into(),
            high: high.into(),
            times: built.times,
            ..self.statistics
        };
        let mut refitted = Self::assemble(
            self.dimension,
            center,
            radius,
            primitives,
            built.wrappers,
            built.packed,
            statistics,
        )
        .with_parts(self.parts.clone())
        .with_stated_deviation(self.stated_deviation);
        // The pieces of a solid are computed when they are first asked for, which is too late for a real-time query but
        // takes as long as all the rest.
        refitted.solid = solid;
        refitted.joints = self.joints.clone();
        Ok(refitted)
    }
}

//! A body whose vertices move while its topology stays.

use super::body::{Body, BodyStatistics};
use super::solid::{Solid, Surfaces};
use super::vertex_numbers::VertexNumbers;
use crate::error::{Error, ErrorKind, Result};
use crate::hierarchy::refit_hierarchy;
use crate::pose::Vec3;

/// Which vertices of a solid's boundary are one, by the places of the vertices among all of the body.
#[derive(Debug)]
pub(super) struct Joints {
    /// Of each vertex, the first one with the same coordinates. Vertices that no boundary uses are their own.
    same_as: Vec<u32>,
    /// Of the vertices of each scrap, a vertex of the body with the same coordinates, if there is one.
    scraps: Vec<Vec<Option<u32>>>,
}

impl Joints {
    fn of(body: &Body, solid: &Solid) -> Self {
        let mut numbers = VertexNumbers::default();
        // Of each numbered vertex, its place.
        let mut places: Vec<u32> = Vec::new();
        let mut same_as = Vec::with_capacity(body.primitives.vertex_count());
        for (i, primitive) in (0..).zip(body.primitives.iter()) {
            for vertex in primitive.vertices {
                let place = same_as.len() as u32;
                if solid.sign(i) == 0 {
                    same_as.push(place);
                    continue;
                }
                let number = numbers.number(vertex) as usize;
                if number == places.len() {
                    places.push(place);
                }
                same_as.push(places[number]);
            }
        }
        let mut of_scrap = |scrap: &Vec<Vec3>| {
            let numbers = scrap.iter().map(|vertex| numbers.number(vertex) as usize);
            numbers.map(|number| places.get(number).copied()).collect()
        };
        let scraps = solid.scraps().iter().map(&mut of_scrap).collect();
        Self { same_as, scraps }
    }

    /// Refuses vertices that move what was one vertex apart.
    fn check(&self, body: &Body, vertices: &[Vec3]) -> Result<()> {
        for (i, &first) in self.same_as.iter().enumerate() {
            if vertices[i] != vertices[first as usize] {
                let [a, b] = [first as usize, i].map(|place| {
                    let (primitive, vertex) = owner(body, place);
                    format!("vertex {vertex} of primitive {primitive}")
                });
                return Err(Error::new(
                    ErrorKind::NotClosed,
                    format!("{a} and {b} were one vertex of a solid, but are moved apart"),
                ));
            }
        }
        Ok(())
    }

    /// The scraps at the moved vertices.
    fn scraps(&self, vertices: &[Vec3], center: &Vec3) -> Result<Vec<Vec<Vec3>>> {
        let moved = |place: &Option<u32>| {
            let place = place.ok_or_else(|| {
                Error::new(
                    ErrorKind::Unsupported,
                    "the solid is closed by faces without area that have vertices of their own",
                )
            })?;
            Ok(vertices[place as usize] - center)
        };
        let of_scrap = |scrap: &Vec<Option<u32>>| scrap.iter().map(moved).collect();
        self.scraps.iter().map(of_scrap).collect()
    }
}

/// The primitive that a vertex of the body belongs to, and its number there.
fn owner(body: &Body, place: usize) -> (usize, usize) {
    let mut rest = place;
    for (i, primitive) in body.primitives.iter().enumerate() {
        match rest.checked_sub(primitive.vertices.len()) {
            Some(less) => rest = less,
            None => return (i, rest),
        }
    }
    (0, 0)
}

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
        let mut primitives = self.primitives.with_vertices(vertices)?;
        let joints = self.solid.as_ref().map(|solid| {
            let joints = self.joints.get_or_init(|| Joints::of(self, solid));
            (joints, solid)
        });
        if let Some((joints, _)) = joints {
            joints.check(self, vertices)?;
        }
        let (low, high) = primitives.extent();
        let center = low * 0.5 + high * 0.5;
        primitives.recenter(&center);
        let mut solid = None;
        if let Some((joints, old)) = joints {
            let surfaces = Surfaces {
                scraps: joints.scraps(vertices, &center)?,
                ..old.surfaces.clone()
            };
            solid = Solid::new(surfaces, &primitives);
        }
        let depth = self.statistics.depth as usize;
        let built = refit_hierarchy(&primitives, &self.wrappers, &self.packed, depth)?;
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
            primitives,
            built.wrappers,
            built.packed,
            statistics,
        )
        .with_parts(self.parts.clone());
        // The pieces of a solid are computed when they are first asked for, which is too late for a real-time query but
        // takes as long as all the rest.
        refitted.solid = solid;
        refitted.joints = self.joints.clone();
        Ok(refitted)
    }
}

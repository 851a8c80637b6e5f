//! The closed surface of a body that is declared solid.

use super::closed_surface::closed_surface;
use super::surface_edges::Outline;
use crate::boxes::Extent;
use crate::error::Result;
use crate::pose::Vec3;
use crate::primitive::Primitives;

/// The boundary of a solid: which polygons of a body it uses, and in which orientation. The solid is where the boundary's
/// winding number is not 0: also where shells overlap, and not in a cavity, whose shell faces the other way than the one
/// around it. A body that has solids as parts has several boundaries, and is the union of what they bound: they may face
/// different ways.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    pub(super) surfaces: Surfaces,
    extent: Extent,
}

/// What the boundaries of a solid are made of.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Surfaces {
    /// Per primitive how its boundary uses it: 1 in the order of its vertices, -1 reversed, 0 not at all.
    pub signs: Vec<i8>,
    /// The faces without area that the boundaries need to close: their vertices in the orientation of the boundary.
    pub scraps: Vec<Vec<Vec3>>,
    /// Of each scrap, its boundary.
    pub scrap_boundaries: Vec<u32>,
    /// Which boundaries the primitives belong to, in order; empty if all belong to boundary 0.
    pub runs: Vec<BoundaryRun>,
}

/// The primitives from one number on, up to the next run's, belong to this boundary, as far as they belong to any.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BoundaryRun {
    pub first: u32,
    pub boundary: u32,
}

impl Surfaces {
    /// The number of boundaries.
    pub fn count(&self) -> u32 {
        let last = self.runs.iter().map(|run| run.boundary).max();
        last.map_or(1, |last| last + 1)
    }

    /// Begins a run of primitives of a boundary.
    pub fn begin(&mut self, first: u32, boundary: u32) {
        self.runs.retain(|run| run.first < first);
        if self.runs.last().is_none_or(|run| run.boundary != boundary) {
            self.runs.push(BoundaryRun { first, boundary });
        }
    }
}

/// A face without area, which is no primitive.
#[derive(Clone, Debug)]
pub(super) struct DegenerateFace {
    pub vertices: Vec<Vec3>,
    pub tag: u64,
}

impl Solid {
    /// Checks that the faces and scraps bound a solid. Returns the signs of the primitives, and the scraps that the boundary
    /// needs. `is_face` says which of the shapes are faces, `number` which number a primitive will have in the body.
    pub(super) fn checked(
        primitives: &Primitives,
        is_face: &[bool],
        scraps: &[DegenerateFace],
        number: impl Fn(u32) -> u32,
    ) -> Result<(Vec<i8>, Vec<Vec<Vec3>>)> {
        let shapes = primitives.shapes().zip(is_face);
        let outlines: Vec<Outline> = shapes
            .filter(|(_, is_face)| **is_face)
            .map(|((index, shape, tag), _)| Outline {
                vertices: &shape.vertices,
                primitive: Some(number(index)),
                tag,
            })
            .chain(scraps.iter().map(|scrap| Outline {
                vertices: &scrap.vertices,
                primitive: None,
                tag: scrap.tag,
            }))
            .collect();
        let last = primitives.len().checked_sub(1);
        let mut signs = vec![0; last.map_or(0, |last| number(last as u32) as usize + 1)];
        let mut needed = Vec::new();
        for (outline, sign) in outlines.iter().zip(closed_surface(&outlines)?) {
            match (outline.primitive, sign) {
                (Some(primitive), _) => signs[primitive as usize] = sign,
                (None, 0) => {}
                (None, 1) => needed.push(outline.vertices.to_vec()),
                (None, _) => needed.push(outline.vertices.iter().rev().copied().collect()),
            }
        }
        Ok((signs, needed))
    }

    /// The solid of boundaries that [`Solid::checked`] returned, that were put together of such, or that a file holds, in the
    /// body's own frame; `None` if they are empty.
    pub(super) fn new(surfaces: Surfaces, primitives: &Primitives) -> Option<Self> {
        let used = primitives.iter().zip(&surfaces.signs);
        let used = used.filter(|(_, sign)| **sign != 0);
        let extent = used
            .map(|(primitive, _)| primitive.vertices)
            .chain(surfaces.scraps.iter().map(|scrap| &scrap[..]))
            .map(Extent::of)
            .reduce(|all, extent| all.union(&extent))?;
        Some(Self { surfaces, extent })
    }

    /// How the boundary uses a primitive: 1 in the order of its vertices, -1 reversed, 0 not at all.
    pub fn sign(&self, primitive: u32) -> i32 {
        self.surfaces.signs[primitive as usize].into()
    }

    /// The faces without area that close the boundary between the primitives, in its orientation.
    pub fn scraps(&self) -> &[Vec<Vec3>] {
        &self.surfaces.scraps
    }

    /// The number of boundaries. Each has a winding number of its own.
    pub fn boundary_count(&self) -> u32 {
        self.surfaces.count()
    }

    /// The boundary that a primitive belongs to, if its sign is not 0.
    #[inline]
    pub fn boundary_of(&self, primitive: u32) -> u32 {
        let runs = &self.surfaces.runs;
        if runs.len() < 2 {
            return runs.first().map_or(0, |run| run.boundary);
        }
        let after = runs.partition_point(|run| run.first <= primitive);
        after.checked_sub(1).map_or(0, |run| runs[run].boundary)
    }

    /// The boundary that a scrap belongs to.
    pub fn boundary_of_scrap(&self, scrap: usize) -> u32 {
        self.surfaces.scrap_boundaries[scrap]
    }

    /// The box of the boundary.
    pub fn extent(&self) -> &Extent {
        &self.extent
    }
}

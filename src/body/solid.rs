//! The closed surface of a body that is declared solid.

use super::closed_surface::closed_surface;
use super::surface_edges::Outline;
use crate::boxes::Extent;
use crate::error::Result;
use crate::pose::Vec3;
use crate::primitive::Primitives;

/// The boundary of a solid: which polygons of a body it uses, and in which orientation. The solid is where the boundary's
/// winding number is not 0: also where shells overlap, and not in a cavity, whose shell faces the other way than the one
/// around it.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// Per primitive how the boundary uses it: 1 in the order of its vertices, -1 reversed, 0 not at all.
    pub(super) signs: Vec<i8>,
    /// The faces without area that the boundary needs to close: their vertices in the orientation of the boundary.
    pub(super) scraps: Vec<Vec<Vec3>>,
    extent: Extent,
}

/// A face without area, which is no primitive.
#[derive(Clone, Debug)]
pub(super) struct DegenerateFace {
    pub vertices: Vec<Vec3>,
    pub tag: u64,
}

impl Solid {
    /// Checks that the faces and scraps bound a solid. Returns the signs of the primitives, and the scraps that the boundary
    /// needs. `is_face` says which of the shapes are faces.
    pub(super) fn checked(
        primitives: &Primitives,
        is_face: &[bool],
        scraps: &[DegenerateFace],
    ) -> Result<(Vec<i8>, Vec<Vec<Vec3>>)> {
        let shapes = primitives.shapes().zip(is_face);
        let outlines: Vec<Outline> = shapes
            .filter(|(_, is_face)| **is_face)
            .map(|((index, shape, tag), _)| Outline {
                vertices: &shape.vertices,
                primitive: Some(index),
                tag,
            })
            .chain(scraps.iter().map(|scrap| Outline {
                vertices: &scrap.vertices,
                primitive: None,
                tag: scrap.tag,
            }))
            .collect();
        let mut signs = vec![0; primitives.len()];
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

    /// The solid of the signs and scraps that [`Solid::checked`] returned or a file holds, in the body's own frame; `None` if
    /// the boundary is empty.
    pub(super) fn new(
        signs: Vec<i8>,
        scraps: Vec<Vec<Vec3>>,
        primitives: &Primitives,
    ) -> Option<Self> {
        let used = primitives.iter().zip(&signs);
        let used = used.filter(|(_, sign)| **sign != 0);
        let extent = used
            .map(|(primitive, _)| primitive.vertices)
            .chain(scraps.iter().map(|scrap| &scrap[..]))
            .map(Extent::of)
            .reduce(|all, extent| all.union(&extent))?;
        Some(Self {
            signs,
            scraps,
            extent,
        })
    }

    /// How the boundary uses a primitive: 1 in the order of its vertices, -1 reversed, 0 not at all.
    pub fn sign(&self, primitive: u32) -> i32 {
        self.signs[primitive as usize].into()
    }

    /// The faces without area that close the boundary between the primitives, in its orientation.
    pub fn scraps(&self) -> &[Vec<Vec3>] {
        &self.scraps
    }

    /// The box of the boundary.
    pub fn extent(&self) -> &Extent {
        &self.extent
    }
}

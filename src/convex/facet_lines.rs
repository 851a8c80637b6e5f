//! The lines across which the facets of two polytopes' Minkowski difference can be: normal to a face of one, or to an edge of each. They
//! are numbered, those of the faces of the first set before those of the second, and these before those of the pairs of edges, so that
//! ties do not depend on the way in which they were found.

use smallvec::SmallVec;

use super::placed::PlacedPrimitive;
use crate::pose::Vec3;
use crate::primitive::FeatureKind;

/// The lines of two sets, r and s.
pub struct FacetLines<'a> {
    pub sets: [&'a PlacedPrimitive<'a>; 2],
}

/// A line's number, and a unit vector along it.
pub type Line = (u64, Vec3);

impl FacetLines<'_> {
    /// Across a face of one of the sets.
    pub fn across_face(&self, side: usize, face: u32) -> Line {
        let before = match side {
            0 => 0,
            _ => self.sets[0].shape.faces.len() as u64,
        };
        let normal = self.sets[side].normal(face as usize);
        (before + u64::from(face), normal)
    }

    /// Across an edge of each; `None` where they are parallel.
    pub fn across_edges(&self, edges: [u32; 2]) -> Option<Line> {
        let [along_r, along_s] = [0, 1].map(|side| {
            let placed = self.sets[side];
            let (from, to) = placed.edge_ends(placed.shape.edges[edges[side] as usize]);
            to - from
        });
        let [r, s] = self.sets.map(|placed| placed.shape);
        let before = (r.faces.len() + s.faces.len()) as u64;
        let pair = u64::from(edges[0]) * s.edges.len() as u64 + u64::from(edges[1]);
        let normal = unit_across(&along_r, &along_s)?;
        Some((before + pair, normal))
    }

    /// Across a facet of the difference, by the features of both sets that make it; `None` where these are none.
    pub fn across_facet(&self, corners: &[[u32; 2]; 3]) -> Option<Line> {
        let features = [0, 1].map(|side| {
            let mut names: SmallVec<[u32; 3]> = corners.iter().map(|of| of[side]).collect();
            names.sort_unstable();
            names.dedup();
            self.sets[side].feature_of(&names)
        });
        let index = |side: usize, kind: FeatureKind| {
            let feature = features[side].filter(|feature| feature.kind == kind);
            feature.map(|feature| feature.index)
        };
        if let Some(side) = (0..2).find(|&side| index(side, FeatureKind::Face).is_some()) {
            return Some(self.across_face(side, index(side, FeatureKind::Face)?));
        }
        self.across_edges([index(0, FeatureKind::Edge)?, index(1, FeatureKind::Edge)?])
    }
}

/// The unit vector across two others. Where these are nearly parallel, rounding may turn it about them, but not towards them, so that
/// what lies along them stays level. `None` for parallel ones.
pub fn unit_across(a: &Vec3, b: &Vec3) -> Option<Vec3> {
    let [square_a, square_b] = [a, b].map(|x| x.norm_squared());
    let (along, square) = if square_a >= square_b {
        (a, square_a)
    } else {
        (b, square_b)
    };
    let across = a.cross(b).try_normalize(0.0)?;
    (across - along * (across.dot(along) / square)).try_normalize(0.0)
}

//! The normals that the facets of two polytopes' Minkowski difference can have: a face's normal, or the cross product of an edge of
//! each (in the plane, an edge's normal). Of the pairs of edges, those are compared whose arcs of the Gauss map may cross. A pair's
//! cross product is visited only if both edges support along it, which the corners next to them tell.

use super::facet_lines::FacetLines;
use super::gauss_arcs::GaussArcs;
use super::placed::{PlacedPrimitive, Precision};
use crate::pose::Vec3;
use crate::tolerance;
use crate::work_meter::WorkMeter;

/// Visits the normals of the facets of the Minkowski difference, of any length and of either sign, each with its number.
pub fn visit_normals(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    precision: &Precision,
    meter: &mut WorkMeter,
    mut visit: impl FnMut(u64, &Vec3),
) {
    if precision.planar {
        let edges = [r, s].into_iter().flat_map(|placed| {
            let edges = placed.shape.edges.iter();
            edges.map(|&edge| placed.edge_ends(edge))
        });
        for (number, (from, to)) in (0..).zip(edges) {
            let along = to - from;
            visit(number, &Vec3::new(-along.y, along.x, 0.0));
        }
        return;
    }
    let lines = FacetLines { sets: [r, s] };
    for (side, placed) in [r, s].into_iter().enumerate() {
        for face in 0..placed.shape.faces.len() as u32 {
            let (number, normal) = lines.across_face(side, face);
            visit(number, &normal);
        }
    }
    let slack = tolerance::SUPPORT_SLACK * precision.size;
    visit_edges(&lines, slack, meter, visit);
}

/// Visits the cross products of the edge pairs that support along them.
fn visit_edges(
    lines: &FacetLines,
    slack: f64,
    meter: &mut WorkMeter,
    mut visit: impl FnMut(u64, &Vec3),
) {
    let [r, s] = lines.sets;
    let (arcs_r, arcs_s) = (
        GaussArcs::new(r, true, slack),
        GaussArcs::new(s, false, slack),
    );
    arcs_r.visit_crossing(&arcs_s, meter, |edge_r, edge_s| {
        let Some((number, normal)) = lines.across_edges([edge_r, edge_s]) else {
            return;
        };
        let [low_r, high_r] = arcs_r.extent_at(edge_r, &normal);
        let [low_s, high_s] = arcs_s.extent_at(edge_s, &normal);
        let supports = (low_r >= -slack && high_s <= slack) || (high_r <= slack && low_s >= -slack);
        if supports {
            visit(number, &normal);
        }
    });
}

//! The normals that the facets of two polytopes' Minkowski difference can have: a face's normal, or the cross product of an edge of
//! each (in the plane, an edge's normal). Of the pairs of edges, those are compared whose arcs of the Gauss map may cross. A pair's
//! cross product is visited only if both edges support along it, which the corners next to them tell.

use super::gauss_arcs::GaussArcs;
use super::placed::{PlacedPrimitive, Precision};
use crate::pose::Vec3;
use crate::tolerance;
use crate::work_meter::WorkMeter;

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

/// Visits the normals of the facets of the Minkowski difference, of any length and of either sign, each with its number.
pub fn visit_normals(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    precision: &Precision,
    meter: &mut WorkMeter,
    mut visit: impl FnMut(u64, &Vec3),
) {
    let mut number = 0;
    let mut visit_next = |normal: &Vec3| {
        visit(number, normal);
        number += 1;
    };
    if precision.planar {
        for placed in [r, s] {
            for &edge in &placed.shape.edges {
                let (from, to) = placed.edge_ends(edge);
                let along = to - from;
                visit_next(&Vec3::new(-along.y, along.x, 0.0));
            }
        }
        return;
    }
    for placed in [r, s] {
        for face in 0..placed.shape.faces.len() {
            visit_next(&placed.normal(face));
        }
    }
    let slack = tolerance::SUPPORT_SLACK * precision.size;
    visit_edges(r, s, slack, meter, |pair, normal| {
        visit(number + pair, normal)
    });
}

/// Visits the cross products of the edge pairs that support along them, each with the number of its pair.
fn visit_edges(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    slack: f64,
    meter: &mut WorkMeter,
    mut visit: impl FnMut(u64, &Vec3),
) {
    let (arcs_r, arcs_s) = (
        GaussArcs::new(r, true, slack),
        GaussArcs::new(s, false, slack),
    );
    arcs_r.visit_crossing(&arcs_s, meter, |edge_r, edge_s| {
        let Some(normal) = unit_across(arcs_r.along(edge_r), arcs_s.along(edge_s)) else {
            return;
        };
        let [low_r, high_r] = arcs_r.extent_at(edge_r, &normal);
        let [low_s, high_s] = arcs_s.extent_at(edge_s, &normal);
        let supports = (low_r >= -slack && high_s <= slack) || (high_r <= slack && low_s >= -slack);
        if supports {
            let pair = u64::from(edge_r) * arcs_s.len() as u64 + u64::from(edge_s);
            visit(pair, &normal);
        }
    });
}

//! The shortest ways out of a polytope from another, among those along the normals of their Minkowski difference's facets.
//!
//! Of two boxes the depths along all lines have closed forms. Of others the nearest facets are found by a polytope that expands within
//! the difference, which proves that all others are farther.

use smallvec::SmallVec;

use super::cuboid_axes::{CuboidAxes, EdgeGap, GAP_ERROR};
use super::expanding_polytope::ExpandingPolytope;
use super::facet_lines::{FacetLines, Line};
use super::placed::{PlacedPrimitive, Precision};
use super::polytope_distance::cuboid;
use super::way::{NO_NUMBER, Way, ways_along};
use crate::primitive::Cuboid;
use crate::work_meter::WorkMeter;

/// The ways along the normals of the facets whose depth exceeds the least by no more than `within`, and some others; `None` where the
/// facets are not found.
pub fn near_ways(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    precision: &Precision,
    within: f64,
    meter: &mut WorkMeter,
) -> Option<Vec<Way>> {
    if precision.planar {
        return None;
    }
    if let Some(found) = near_ways_of_cuboids(r, s, precision, within) {
        return Some(found);
    }
    let lines = FacetLines { sets: [r, s] };
    let mut polytope = ExpandingPolytope::default();
    let facets = polytope.nearest_facets([r, s], precision.size, within, meter)?;
    let mut found = Vec::with_capacity(2 * facets.len());
    for facet in facets {
        let exact = lines.across_facet(&facet.corners);
        if let Some((number, normal)) = exact {
            // Facets of more than three corners are made of several triangles.
            if found.iter().any(|way: &Way| way.rank.0 == number) {
                continue;
            }
            found.extend(ways_along([r, s], number, &normal));
        }
        let is_as_short = |way: &Way| way.depth <= facet.height;
        if !found.iter().any(is_as_short) {
            found.extend(ways_along([r, s], NO_NUMBER, &facet.normal));
        }
    }
    Some(found)
}

/// The lowest number of the two faces across an axis.
fn lowest_face(cuboid: &Cuboid, axis: usize) -> u32 {
    let faces = [false, true].map(|is_high| cuboid.face_across(axis, is_high).index);
    faces[0].min(faces[1])
}

/// [`near_ways`] of two boxes: their 15 lines have depths in closed form, which say which of them are to be measured.
fn near_ways_of_cuboids(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    precision: &Precision,
    within: f64,
) -> Option<Vec<Way>> {
    let cuboids = [cuboid(r)?, cuboid(s)?];
    let lines = FacetLines { sets: [r, s] };
    let axes = CuboidAxes::new([r, s], cuboids);
    let error = GAP_ERROR * precision.size;
    // Each with a lower bound of its depth.
    let mut open: SmallVec<[(f64, Line); 15]> = SmallVec::new();
    let gaps = [axes.gaps_at_a(), axes.gaps_at_b()];
    for (side, axis) in [0, 1]
        .into_iter()
        .flat_map(|side| (0..3).map(move |i| (side, i)))
    {
        let line = lines.across_face(side, lowest_face(cuboids[side], axis));
        open.push((-gaps[side][axis] - error, line));
    }
    let edges = [0, 1].map(|side: usize| [0, 1, 2].map(|axis| cuboids[side].edge_along(axis)));
    for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
        let EdgeGap { gap, length } = axes.edge_gap(i, j);
        if let Some(line) = lines.across_edges([edges[0][i], edges[1][j]]) {
            open.push(((-gap - error) / length, line));
        }
    }
    open.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let mut least = f64::INFINITY;
    let mut found = Vec::new();
    for (lower, (number, normal)) in open {
        if lower > least + within {
            break;
        }
        let ways = ways_along([r, s], number, &normal);
        least = ways.iter().fold(least, |least, way| way.depth.min(least));
        found.extend(ways);
    }
    Some(found)
}

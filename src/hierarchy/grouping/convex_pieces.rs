//! Finds maximal convex pieces (§3.4): primitives whose union is a convex polygon, or that bound a convex part of a body.

use super::convex_patches::convex_patches;
use super::coplanar_pieces::coplanar_pieces;
use super::shared_edges::SharedEdges;
use crate::boxes::Extent;
use crate::error::Result;
use crate::hierarchy::{Pieces, Progress};
use crate::primitive::Convex;

/// The pieces of more than one primitive; no primitive is in two. Members are ascending, pieces ordered by lowest member.
pub fn convex_pieces(
    primitives: &[Convex],
    pieces: Pieces,
    progress: &mut Progress,
) -> Result<Vec<Vec<u32>>> {
    if pieces == Pieces::Off {
        return Ok(Vec::new());
    }
    let extents = primitives.iter().map(|p| Extent::of(p.bounding_points()));
    // A body of parts alone has no primitives of its own.
    let Some(whole) = extents.reduce(|all, extent| all.union(&extent)) else {
        return Ok(Vec::new());
    };
    let diameter = whole.diameter();
    let edges = SharedEdges::of(primitives);
    progress.at(0.1)?;
    let flat = coplanar_pieces(primitives, &edges, diameter);
    progress.at(0.3)?;
    let mut found: Vec<Vec<u32>> = match pieces {
        Pieces::Patches => {
            let mut rest = progress.part(0.3, 1.0);
            convex_patches(primitives, &edges, &flat, diameter, &mut rest)?
        }
        _ => flat.into_iter().map(|piece| piece.members).collect(),
    };
    for piece in &mut found {
        piece.sort_unstable();
    }
    found.retain(|piece| piece.len() > 1);
    found.sort_unstable();
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pose::Vec3;
    use crate::primitive::{convex_polygon, convex_polyhedron};

    /// The triangles of an outline extruded along z; `caps` are the triangles of both ends.
    fn prism(outline: &[(f64, f64)], caps: &[[usize; 3]], z: [f64; 2]) -> Vec<Convex> {
        let n = outline.len();
        let at = |i: usize, top: usize| Vec3::new(outline[i % n].0, outline[i % n].1, z[top]);
        let mut triangles = Vec::new();
        for i in 0..n {
            triangles.push([at(i, 0), at(i + 1, 0), at(i + 1, 1)]);
            triangles.push([at(i, 0), at(i + 1, 1), at(i, 1)]);
        }
        for &[a, b, c] in caps {
            triangles.push([at(a, 1), at(b, 1), at(c, 1)]);
            triangles.push([at(a, 0), at(c, 0), at(b, 0)]);
        }
        triangles
            .iter()
            .map(|t| convex_polygon(t).unwrap())
            .collect()
    }

    const SQUARE: [(f64, f64); 4] = [(0., 0.), (1., 0.), (1., 1.), (0., 1.)];
    const SQUARE_CAPS: [[usize; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

    fn pieces(primitives: &[Convex], kind: Pieces) -> Vec<Vec<u32>> {
        let mut ignored = |_| Ok(());
        let found = convex_pieces(primitives, kind, &mut Progress::new(&mut ignored)).unwrap();
        let mut members: Vec<u32> = found.iter().flatten().copied().collect();
        members.sort_unstable();
        assert!(members.windows(2).all(|w| w[0] < w[1]), "in two pieces");
        found
    }

    #[test]
    fn a_cube_of_triangles_has_six_squares_and_is_one_patch() {
        let cube = prism(&SQUARE, &SQUARE_CAPS, [0.0, 1.0]);
        let squares = pieces(&cube, Pieces::Coplanar);
        assert_eq!(squares.len(), 6);
        assert!(squares.iter().all(|piece| piece.len() == 2));
        let whole = pieces(&cube, Pieces::Patches);
        assert_eq!(whole, vec![(0..12).collect::<Vec<u32>>()]);
    }

    #[test]
    fn an_l_is_split_where_it_turns_inwards() {
        let outline = [(0., 0.), (2., 0.), (2., 1.), (1., 1.), (1., 2.), (0., 2.)];
        let caps = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]];
        let l = prism(&outline, &caps, [0.0, 1.0]);
        let flat = pieces(&l, Pieces::Coplanar);
        // Six sides; each cap in two convex parts.
        assert_eq!(flat.len(), 10);
        let patches = pieces(&l, Pieces::Patches);
        assert!(patches.len() < flat.len());
        for patch in &patches {
            let points: Vec<Vec3> = patch
                .iter()
                .flat_map(|&i| l[i as usize].vertices.clone())
                .collect();
            let hull = convex_polyhedron(&points).unwrap();
            // The middle of the notch is in no hull.
            let notch = Vec3::new(1.5, 1.5, 0.5);
            let outside = hull.faces.iter().any(|face| {
                let corner = hull.vertices[face.vertices[0] as usize];
                face.normal.dot(&(notch - corner)) > 1e-9
            });
            assert!(outside || !hull.is_solid(), "{patch:?}");
            // Each member is on a face of the hull.
            for &i in patch {
                let plane = &l[i as usize].faces[0].normal;
                let offset = plane.dot(&l[i as usize].vertices[0]);
                assert!(points.iter().all(|p| plane.dot(p) - offset < 1e-9));
            }
        }
    }

    /// The inner surface of a hollow box faces the void, so the hulls of its patches would lie in the void.
    #[test]
    fn a_void_and_an_open_surface_have_flat_pieces_only() {
        let mut hollow = prism(&SQUARE, &SQUARE_CAPS, [0.0, 1.0]);
        let inner = prism(
            &[(0.2, 0.2), (0.2, 0.8), (0.8, 0.8), (0.8, 0.2)],
            &[[0, 1, 2], [0, 2, 3]],
            [0.2, 0.8],
        );
        hollow.extend(inner);
        let sizes: Vec<usize> = pieces(&hollow, Pieces::Patches)
            .iter()
            .map(Vec::len)
            .collect();
        assert!(sizes.iter().all(|&size| size < 12), "{sizes:?}");
        assert!(sizes.len() >= 7);

        let mut open = prism(&SQUARE, &SQUARE_CAPS, [0.0, 1.0]);
        open.pop();
        let sizes: Vec<usize> = pieces(&open, Pieces::Patches)
            .iter()
            .map(Vec::len)
            .collect();
        assert_eq!(sizes, vec![2; 5]);
    }

    /// A box with a smaller one stuck into it: no patch's hull may contain a part of the other box's surface.
    #[test]
    fn patches_stay_out_of_each_other() {
        let mut boxes = prism(&SQUARE, &SQUARE_CAPS, [0.0, 1.0]);
        let low = [(0.4, 0.4), (0.6, 0.4), (0.6, 0.6), (0.4, 0.6)];
        boxes.extend(prism(&low, &SQUARE_CAPS, [0.8, 2.0]));
        let found = pieces(&boxes, Pieces::Patches);
        assert!(found.iter().all(|piece| piece.len() < 12), "{found:?}");
        assert!(found.iter().any(|piece| piece.len() > 2), "{found:?}");
    }

    #[test]
    fn overlapping_copies_and_solids_stay_apart() {
        let square: Vec<Vec3> = SQUARE.iter().map(|&(x, y)| Vec3::new(x, y, 0.0)).collect();
        let cube: Vec<Vec3> = square.iter().flat_map(|&p| [p, p + Vec3::z()]).collect();
        let primitives = [
            convex_polygon(&square).unwrap(),
            convex_polygon(&square).unwrap(),
            convex_polyhedron(&cube).unwrap(),
        ];
        assert!(pieces(&primitives, Pieces::Coplanar).is_empty());
        assert!(pieces(&primitives, Pieces::Patches).is_empty());
    }
}

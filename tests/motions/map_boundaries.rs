//! The surface that a picture of a map over three coordinates shows: closed, around the cells that are in the set.

use std::collections::HashMap;
use std::f64::consts::PI;
use std::path::Path;

use cstk::cobject::{CObject, PureOptions};
use cstk::error::ErrorKind;
use cstk::map::{Map, MapAxis, MapKind, MapOptions, MapValues};
use cstk::pose::Vec3;
use cstk::show::show_map;

use helpers::pure::{CENTER, ball as ball_with};

fn ball(radius: f64) -> CObject {
    ball_with(radius, PureOptions::default())
}

fn axes(cells: [usize; 3]) -> [MapAxis; 3] {
    let reach = [1.0, 1.25, 1.5];
    std::array::from_fn(|i| MapAxis::new(i, [-reach[i], reach[i]], cells[i]))
}

fn build(cobject: &CObject, axes: &[MapAxis], kind: MapKind) -> Map {
    let options = MapOptions {
        kind,
        ..MapOptions::default()
    };
    Map::build(cobject, &[0.0; 3], axes, &options, &mut |_| Ok(())).unwrap()
}

/// The least and the largest numbers that the picture states are those of its corners: viewers rely on them.
fn require_extent(text: &[u8], corners: &[[f32; 3]]) {
    let content: serde_json::Value = serde_json::from_slice(text).unwrap();
    let positions = &content["meshes"][0]["primitives"][0]["attributes"]["POSITION"];
    let accessor = &content["accessors"][positions.as_u64().unwrap() as usize];
    assert_eq!(accessor["count"], corners.len());
    for i in 0..3 {
        let along = corners.iter().map(|corner| corner[i]);
        let ends = [
            along.clone().fold(f32::INFINITY, f32::min),
            along.fold(f32::NEG_INFINITY, f32::max),
        ];
        for (stated, found) in ["min", "max"].iter().zip(ends) {
            assert_eq!(accessor[*stated][i].as_f64().unwrap() as f32, found);
        }
    }
}

/// The triangles of a picture with one mesh, as its numbers, and the lengths of its normals.
fn triangles(map: &Map, folder: &Path) -> Vec<[[f32; 3]; 3]> {
    let file = folder.join("map.glb");
    show_map(map, &file).unwrap();
    let bytes = std::fs::read(&file).unwrap();
    let text = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    let numbers: Vec<f32> = bytes[20 + text + 8..]
        .chunks_exact(4)
        .map(|bytes| f32::from_le_bytes(bytes.try_into().unwrap()))
        .collect();
    // Of each corner the place and the normal.
    let corners: Vec<[f32; 3]> = numbers
        .chunks_exact(6)
        .map(|corner| {
            let length: f32 = corner[3..].iter().map(|x| x * x).sum();
            assert!((length - 1.0).abs() < 1e-5);
            [corner[0], corner[1], corner[2]]
        })
        .collect();
    require_extent(&bytes[20..20 + text], &corners);
    corners.as_chunks().0.to_vec()
}

/// Each edge is run along as often one way as the other: there is no hole, and the surface has one outside.
fn require_closed(triangles: &[[[f32; 3]; 3]]) {
    let mut edges: HashMap<[[u32; 3]; 2], i32> = HashMap::new();
    for triangle in triangles {
        let corners = triangle.map(|corner| corner.map(f32::to_bits));
        for i in 0..3 {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            assert_ne!(a, b);
            *edges.entry([a, b]).or_default() += 1;
            *edges.entry([b, a]).or_default() -= 1;
        }
    }
    assert!(edges.values().all(|count| *count == 0));
}

/// By the divergence theorem: positive where the triangles face outwards.
fn volume(triangles: &[[[f32; 3]; 3]]) -> f64 {
    let parts = triangles.iter().map(|triangle| {
        let [a, b, c] = triangle.map(|corner| Vec3::from(corner.map(f64::from)));
        a.cross(&b).dot(&c) / 6.0
    });
    parts.sum()
}

#[test]
fn the_boundary_of_a_ball_is_a_sphere() {
    let folder = tempfile::tempdir().unwrap();
    for kind in [MapKind::Classes, MapKind::Cells] {
        let map = build(&ball(0.7), &axes([60, 70, 80]), kind);
        let triangles = triangles(&map, folder.path());
        require_closed(&triangles);
        let cell = (2.0 / 60.0f64).hypot(2.5 / 70.0).hypot(3.0 / 80.0);
        for corner in triangles.iter().flatten() {
            let radius = Vec3::from(CENTER) - Vec3::from(corner.map(f64::from));
            assert!((radius.norm() - 0.7).abs() < cell, "{}", radius.norm());
        }
        let truth = 4.0 / 3.0 * PI * 0.7f64.powi(3);
        // Cells that are not proved free are some more than those whose middle is inside.
        let share = volume(&triangles) / truth;
        assert!((0.97..1.2).contains(&share), "{kind:?} {share}");
    }
}

/// Where the set goes on beyond the map, the surface is closed along the map's end. Along a plane it runs halfway between cells.
#[test]
fn a_boundary_is_closed_at_the_end_of_the_map() {
    let folder = tempfile::tempdir().unwrap();
    let map = build(&ball(5.0), &axes([6, 5, 4]), MapKind::Classes);
    let all_inside = triangles(&map, folder.path());
    require_closed(&all_inside);
    // A box without its edges and corners, which are cut.
    let share = volume(&all_inside) / (2.0 * 2.5 * 3.0);
    assert!(share < 1.0 && share > 0.85, "{share}");
    for corner in all_inside.iter().flatten() {
        for (x, reach) in corner.iter().zip([1.0, 1.25, 1.5]) {
            assert!(x.abs() <= reach);
        }
    }
    let part = axes([60, 70, 80]).map(|mut axis| {
        axis.part = [axis.cells / 3, axis.cells / 3 + 20];
        axis
    });
    let map = build(&ball(0.7), &part, MapKind::Classes);
    let cut = triangles(&map, folder.path());
    require_closed(&cut);
    let MapValues::Classes(values) = map.values() else {
        panic!("classes are classes");
    };
    let inside = values.iter().filter(|&&value| value == 2).count() as f64;
    let share = volume(&cut) / (inside * (2.0 / 60.0) * (2.5 / 70.0) * (3.0 / 80.0));
    assert!((0.9..1.02).contains(&share), "{share}");
    for corner in cut.iter().flatten() {
        for (x, axis) in corner.iter().zip(&part) {
            let ends = axis.part.map(|cell| axis.edge(cell) as f32);
            assert!((ends[0]..=ends[1]).contains(x), "{x} {ends:?}");
        }
    }
}

#[test]
fn distances_show_where_they_are_zero() {
    let folder = tempfile::tempdir().unwrap();
    let options = PureOptions {
        scale: Some(1.0),
        ..PureOptions::default()
    };
    let scaled = ball_with(0.7, options);
    let [classes, distances] = [MapKind::Classes, MapKind::Distances].map(|kind| {
        let map = build(&scaled, &axes([30, 20, 25]), kind);
        triangles(&map, folder.path())
    });
    assert!(classes.len() > 500 && classes == distances);
}

#[test]
fn a_picture_of_a_boundary_is_empty_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("map.glb");
    let nothing = build(&ball(1e-9), &axes([6, 5, 4]), MapKind::Classes);
    show_map(&nothing, &file).unwrap();
    let refused = show_map(&nothing, &folder.path().join("map.png")).unwrap_err();
    assert_eq!(refused.kind, ErrorKind::Unsupported);
    let line = build(&ball(0.5), &axes([6, 5, 4])[..1], MapKind::Classes);
    assert_eq!(
        show_map(&line, &file).unwrap_err().kind,
        ErrorKind::Unsupported
    );
}

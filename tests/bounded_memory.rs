//! What calls hold at a time: queries as much as they are asked to list, not what they come upon; maps, when they are saved, no more than
//! they hold already; surfaces that become triangles as much as their control points and triangles.

use std::alloc::{GlobalAlloc, Layout, System};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use cstk::body::{Body, BodyBuilder, NurbsSurface};
use cstk::cobject::PureOptions;
use cstk::error::{ErrorKind, Result};
use cstk::hierarchy::HierarchyOptions;
use cstk::map::{Map, MapAxis, MapKind, MapOptions};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext, WitnessList};
use cstk::show::show_map;

use helpers::pure::{CENTER, ball};
use helpers::robots::{against, environment, free_body, space};

/// The system's allocator, and how much is allocated now and was at most.
struct Counting;

static NOW: AtomicUsize = AtomicUsize::new(0);
static MOST: AtomicUsize = AtomicUsize::new(0);

// SAFETY: all is passed on to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let now = NOW.fetch_add(layout.size(), Ordering::Relaxed) + layout.size();
        MOST.fetch_max(now, Ordering::Relaxed);
        // SAFETY: as the caller states.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, place: *mut u8, layout: Layout) {
        NOW.fetch_sub(layout.size(), Ordering::Relaxed);
        // SAFETY: as the caller states.
        unsafe { System.dealloc(place, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// How many bytes more than before an action holds at a time, at most.
fn held<T>(action: impl FnOnce() -> T) -> (T, usize) {
    let before = NOW.load(Ordering::Relaxed);
    MOST.store(before, Ordering::Relaxed);
    let found = action();
    (found, MOST.load(Ordering::Relaxed) - before)
}

/// Spheres about one point, of radius 1, each moved by less than that.
fn spheres(count: usize) -> Arc<Body> {
    let mut builder = BodyBuilder::new(3).unwrap();
    for i in 0..count {
        let angle = i as f64;
        let center = Vec3::new(angle.cos(), angle.sin(), (0.7 * angle).sin()) * 0.3;
        builder.add_sphere(&center, 1.0, i as u64).unwrap();
    }
    let options = HierarchyOptions::default();
    Arc::new(builder.build(&options, &mut |_| Ok(())).unwrap())
}

/// The same triangle many times.
fn triangles(count: usize) -> Arc<Body> {
    let mut builder = BodyBuilder::new(3).unwrap();
    let corners = [Vec3::zeros(), Vec3::x(), Vec3::y()];
    for i in 0..count {
        builder.add_polygon(&corners, i as u64).unwrap();
    }
    let options = HierarchyOptions::default();
    Arc::new(builder.build(&options, &mut |_| Ok(())).unwrap())
}

const MEGABYTE: usize = 1 << 20;

/// One test: the counts are those of the whole program.
#[test]
fn memory_is_bounded() {
    by_what_is_listed();
    by_pieces_of_maps();
    by_control_points_of_surfaces();
}

fn by_what_is_listed() {
    let here = Pose::identity();
    let mut query = QueryContext::new();

    // 16 million pairs meet; to list them takes a gigabyte.
    let many = spheres(4000);
    let (found, most) = held(|| query.pair_penetration((&many, &here), (&many, &here), 16));
    let found = found.unwrap();
    assert!(found.truncated && found.penetrations.len() == 16);
    // A sphere with itself is deepest, by the sum of the radii.
    for (i, deepest) in (0..).zip(&found.penetrations) {
        assert_eq!(deepest.primitives, [i; 2]);
        assert_eq!(deepest.penetration.depth, 2.0);
    }
    assert!(most < MEGABYTE, "{most} bytes for penetrations");

    let (found, most) = held(|| query.pair_witnesses((&many, &here), (&many, &here), 0.1, 16));
    let found = found.unwrap();
    assert!(found.truncated);
    assert_eq!(pairs(&found), (0..16).map(|i| [0, i]).collect::<Vec<_>>());
    assert!(most < MEGABYTE, "{most} bytes for witnesses of spheres");

    let coincident = triangles(2000);
    let bodies = ((&*coincident, &here), (&*coincident, &here));
    for max_count in [0, 1, 16, 1000] {
        let (found, most) = held(|| query.pair_witnesses(bodies.0, bodies.1, 0.1, max_count));
        let found = found.unwrap();
        assert!(found.truncated);
        let first = (0..max_count as u32).map(|i| [0, i]);
        assert_eq!(pairs(&found), first.collect::<Vec<_>>());
        assert!(
            most < 2 * MEGABYTE,
            "{most} bytes for {max_count} witnesses"
        );
    }

    let space = space(vec![free_body(&coincident)]);
    let (environment, _) = environment(&[(&coincident, here)]);
    let cobject = against(&space, &environment);
    let q = [0.0; 6];
    let (found, most) = held(|| query.gradients(&cobject, &q, 0.1, 16));
    assert!(found.unwrap().truncated && most < MEGABYTE, "{most} bytes");
    let at = Configuration::Coordinates(&q);
    let (found, most) = held(|| query.explain(&cobject, at, 16));
    assert!(
        found.unwrap().list.truncated && most < MEGABYTE,
        "{most} bytes"
    );
}

/// Maps go to their files in pieces of 64 KB.
fn by_pieces_of_maps() {
    const PIECES: usize = 1 << 18;
    let folder = tempfile::tempdir().unwrap();
    let ball = ball(
        0.8,
        PureOptions {
            scale: Some(1.0),
            ..PureOptions::default()
        },
    );
    let axis = |coordinate, cells| MapAxis::new(coordinate, [-1.5, 1.5], cells);
    let build = |axes: &[MapAxis], kind| {
        let options = MapOptions {
            kind,
            ..MapOptions::default()
        };
        Map::build(&ball, &CENTER, axes, &options, &mut |_| Ok(())).unwrap()
    };
    let require = |map: &Map, name: &str, save: fn(&Map, &Path) -> Result<()>, least: u64| {
        let file = folder.path().join(name);
        let (saved, most) = held(|| save(map, &file));
        saved.unwrap();
        let size = std::fs::metadata(&file).unwrap().len();
        assert!(size >= least, "{name} has {size} bytes");
        assert!(most < PIECES, "{most} bytes to write {size} of {name}");
        println!("{name}: {most} bytes held to write {size}");
    };
    let plane = [axis(0, 3000), axis(1, 2000)];
    let classes = build(&plane, MapKind::Classes);
    require(&classes, "classes.npy", Map::save, 6_000_000);
    require(&classes, "classes.png", show_map, 6_000_000);
    let plane = [axis(0, 600), axis(1, 1000)];
    let distances = build(&plane, MapKind::Distances);
    require(&distances, "distances.npy", Map::save, 4_800_000);
    require(&distances, "distances.png", show_map, 600_000);
    // 54,000 faces of 144 bytes, which took 31 MB where they were kept.
    let space = [axis(0, 200), axis(1, 200), axis(2, 200)];
    let boundary = build(&space, MapKind::Classes);
    require(&boundary, "boundary.glb", show_map, 5_000_000);
}

fn pairs(list: &WitnessList) -> Vec<[u32; 2]> {
    list.witnesses.iter().map(|w| w.primitives).collect()
}

/// The 92 x 92 patches have 81 control points each, 22 MB in all. No tolerance is near enough for the first of them.
fn by_control_points_of_surfaces() {
    const COUNT: usize = 100;
    let knots: Vec<f64> = (0..COUNT + 9).map(|k| k as f64).collect();
    let points: Vec<Vec3> = (0..COUNT * COUNT)
        .map(|k| Vec3::new((k / COUNT) as f64, (k % COUNT) as f64, (k % 7) as f64))
        .collect();
    let surface = NurbsSurface {
        degrees: [8, 8],
        knots: [&knots, &knots],
        points: &points,
        weights: None,
    };
    let mut builder = BodyBuilder::new(3).unwrap();
    let (added, bytes) = held(|| builder.add_nurbs_surface(&surface, 1e-300, 0));
    assert_eq!(added.unwrap_err().kind, ErrorKind::Limit);
    println!("{bytes} bytes for a surface");
    assert!(
        bytes < 4 * std::mem::size_of_val(&points[..]),
        "{bytes} bytes"
    );
}

//! Maps of C-space: their cells are what brute force says of them, and their cost follows the boundary.

use std::f64::consts::PI;
use std::sync::Arc;

use cstk::cobject::{CObject, Class, InducedOptions};
use cstk::error::{Error, ErrorKind};
use cstk::map::{Map, MapAxis, MapKind, MapOptions, MapValues};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::{BlockKind, JointKind, LinkDefinition};
use cstk::space::Space;

use helpers::random::Random;
use helpers::robots::{against, against_with, environment, link, robot, space};
use helpers::shapes::cuboid;

use crate::compound::{arm, compound};
use crate::random_scenes::{class, scene};

pub fn map(cobject: &CObject, q: &[f64], axes: &[MapAxis], options: &MapOptions) -> Map {
    Map::build(cobject, q, axes, options, &mut |_| Ok(())).unwrap()
}

pub fn of_kind(kind: MapKind) -> MapOptions {
    MapOptions {
        kind,
        threads: 1,
        ..MapOptions::default()
    }
}

/// The cells of a map in the order of its values.
pub fn cells(axes: &[MapAxis]) -> Vec<Vec<usize>> {
    axes.iter().fold(vec![Vec::new()], |cells, axis| {
        let longer = cells
            .iter()
            .flat_map(|cell| (0..axis.cells).map(move |place| [&cell[..], &[place]].concat()));
        longer.collect()
    })
}

/// The configuration of a cell, `at` telling where in the cell: 0.5 is its middle.
fn place(q: &[f64], axes: &[MapAxis], cell: &[usize], at: f64) -> Vec<f64> {
    let mut q = q.to_vec();
    for (axis, &place) in axes.iter().zip(cell) {
        let part = (place as f64 + at) / axis.cells as f64;
        q[axis.coordinate] = axis.low + (axis.high - axis.low) * part;
    }
    q
}

/// The coordinates that an axis may be over.
fn coordinates(space: &Space) -> Vec<usize> {
    let blocks = space.blocks().iter().flat_map(|block| {
        let count = match block.kind {
            BlockKind::Line => 1,
            BlockKind::Rotation => 0,
            BlockKind::Placement => 3,
        };
        (0..count).map(|i| block.coordinate + i)
    });
    blocks.collect()
}

/// A random scene, some of its coordinates, and where the others are.
fn random_grid(random: &mut Random) -> (Arc<CObject>, Vec<f64>, Vec<MapAxis>) {
    let cobject = if random.below(2) == 0 {
        Arc::new(scene(random))
    } else {
        let space = arm(random);
        compound(random, &space, 3)
    };
    let space = cobject.space();
    let v: Vec<f64> = (0..space.nv()).map(|_| random.within(-1.5, 1.5)).collect();
    let q = space.step(&space.neutral(), &v);
    let mut free = coordinates(space);
    let mut axes = Vec::new();
    let mut room: usize = 600;
    while axes.len() < 4 && !free.is_empty() && room > 1 {
        let coordinate = free.swap_remove(random.below(free.len()));
        let cells = 1 + random.below(room.min(60));
        room /= cells;
        let half = [0.05, 0.4, 1.5][random.below(3)];
        let ends = [q[coordinate] - half, q[coordinate] + half];
        axes.push(MapAxis::new(coordinate, ends, cells));
    }
    (cobject, q, axes)
}

fn case_count() -> u64 {
    let given = std::env::var("CSTK_MAPS").ok();
    given.and_then(|count| count.parse().ok()).unwrap_or(40)
}

/// Every cell of random maps beside the same question asked of its middle, and of samples of it.
#[test]
fn maps_are_what_brute_force_says() {
    let context = &mut QueryContext::new();
    let mut seen = [0; 4];
    for seed in 0..case_count() {
        let random = &mut Random::new(9000 + seed);
        let (cobject, q, axes) = random_grid(random);
        if axes.is_empty() {
            continue;
        }
        let cells = cells(&axes);
        let classes = map(&cobject, &q, &axes, &of_kind(MapKind::Classes));
        let MapValues::Classes(values) = classes.values() else {
            panic!("classes are classes");
        };
        for (cell, &value) in cells.iter().zip(values) {
            let expected = class(context, &cobject, &place(&q, &axes, cell, 0.5));
            assert_eq!(value, expected as u8, "seed {seed}, cell {cell:?}");
        }
        let few_boxes = MapOptions {
            max_boxes: 16,
            ..of_kind(MapKind::Cells)
        };
        let proved = map(&cobject, &q, &axes, &few_boxes);
        let MapValues::Cells(values) = proved.values() else {
            panic!("cells are cells");
        };
        for (cell, &value) in cells.iter().zip(values) {
            seen[usize::from(value)] += 1;
            for at in [0.01, 0.25, 0.5, 0.75, 0.99] {
                let q = place(&q, &axes, cell, at);
                let is_inside = class(context, &cobject, &q) == Class::Inside;
                assert!(value != 0 || !is_inside, "seed {seed}, cell {cell:?}");
                assert!(value != 1 || is_inside, "seed {seed}, cell {cell:?}");
            }
        }
        if cobject.require_one_metric().is_err() {
            continue;
        }
        let measured = map(&cobject, &q, &axes, &of_kind(MapKind::Distances));
        let MapValues::Distances(values) = measured.values() else {
            panic!("distances are distances");
        };
        for (cell, value) in cells.iter().zip(values) {
            let q = place(&q, &axes, cell, 0.5);
            let at = Configuration::Coordinates(&q);
            let expected = context.distance(&cobject, at, f64::INFINITY).unwrap();
            assert_eq!(value.to_bits(), expected.distance.to_bits(), "seed {seed}");
        }
    }
    assert!(seen[0] > 1000 && seen[1] > 100 && seen[2] > 100, "{seen:?}");
}

/// Two links in the plane of z = 0 among some boxes.
pub fn arm_among_boxes() -> CObject {
    let body = cuboid([1.0, 0.4, 0.1]).body;
    let links: Vec<LinkDefinition> = (0..2usize)
        .map(|i| LinkDefinition {
            at: Pose::from_translation(Vec3::x() * i as f64),
            body: Some(body.clone()),
            ..link(i.checked_sub(1), JointKind::Revolute, Vec3::z())
        })
        .collect();
    let block = cuboid([0.4, 0.6, 0.4]).body;
    let places = [[1.3, 0.7], [-0.9, 1.1], [0.2, -1.4]];
    let placed = places.map(|[x, y]| (&block, Pose::from_translation(Vec3::new(x, y, 0.0))));
    let (environment, _) = environment(&placed);
    against(&space(vec![robot(3, links)]), &environment)
}

pub fn turns(cells: usize) -> [MapAxis; 2] {
    [0, 1].map(|coordinate| MapAxis::new(coordinate, [-PI, PI], cells))
}

pub fn with_cells(axis: MapAxis, cells: usize) -> MapAxis {
    MapAxis::new(axis.coordinate, [axis.low, axis.high], cells)
}

/// The cells whose value differs from that of the cell after them, along either axis.
fn boundary(values: &[u8], side: usize) -> usize {
    let differs = |i: &usize| {
        let (row, column) = (i / side, i % side);
        let right = column + 1 < side && values[i + 1] != values[*i];
        right || (row + 1 < side && values[i + side] != values[*i])
    };
    (0..values.len()).filter(differs).count()
}

/// Once the cells are small beside the bodies: before, hardly a block is proved inside. CSTK_MAP_SIDE says up to how many cells a side.
#[test]
fn the_cost_of_a_map_follows_the_boundary() {
    let cobject = arm_among_boxes();
    let mut costs = Vec::new();
    let given = std::env::var("CSTK_MAP_SIDE").ok();
    let largest = given.and_then(|side| side.parse().ok()).unwrap_or(2048);
    let sides = std::iter::successors(Some(1024), |side| Some(2 * side));
    for side in sides.take_while(|&side| side <= largest) {
        let made = map(
            &cobject,
            &[0.0; 2],
            &turns(side),
            &of_kind(MapKind::Classes),
        );
        let MapValues::Classes(values) = made.values() else {
            panic!("classes are classes");
        };
        let cost = (made.proofs() + made.questions()) as f64;
        println!(
            "{side}^2: {} proofs, {} configurations, {} boundary cells",
            made.proofs(),
            made.questions(),
            boundary(values, side)
        );
        costs.push(cost / boundary(values, side) as f64);
        assert!(cost < 0.1 * (side * side) as f64, "{cost}");
    }
    // Blocks are halved: how their sizes fit the bodies makes the cost of a boundary cell waver by a third. That of all cells together
    // grows sixteen times from the first map to the third.
    assert!(costs.iter().all(|cost| *cost < 1.5 * costs[0]), "{costs:?}");
}

/// The values of parts put together, each at the places of its cells.
fn put_together(axes: &[MapAxis], parts: &[Map]) -> Vec<u64> {
    let all = cells(axes);
    let mut values = vec![u64::MAX; all.len()];
    for part in parts {
        let found: Vec<u64> = match part.values() {
            MapValues::Distances(distances) => distances.iter().map(|d| d.to_bits()).collect(),
            MapValues::Classes(bytes) | MapValues::Cells(bytes) => {
                bytes.iter().map(|&byte| u64::from(byte)).collect()
            }
        };
        let is_in = |cell: &[usize]| {
            let mut sides = cell.iter().zip(part.axes());
            sides.all(|(place, axis)| (axis.part[0]..axis.part[1]).contains(place))
        };
        let places = (0..all.len()).filter(|&i| is_in(&all[i]));
        let places: Vec<usize> = places.collect();
        assert_eq!(places.len(), found.len());
        for (place, value) in places.into_iter().zip(found) {
            assert_eq!(values[place], u64::MAX, "a cell is in two parts");
            values[place] = value;
        }
    }
    values
}

/// Also of proofs, of which a block decides many at once: wherever the parts are cut.
#[test]
fn parts_of_a_map_are_parts_of_the_whole() {
    for seed in 0..case_count().min(20) {
        let random = &mut Random::new(9500 + seed);
        let (cobject, q, axes) = random_grid(random);
        for kind in [MapKind::Classes, MapKind::Cells, MapKind::Distances] {
            let is_measured = cobject.require_one_metric().is_ok();
            if axes.is_empty() || (kind == MapKind::Distances && !is_measured) {
                continue;
            }
            let options = of_kind(kind);
            let mut parts = vec![axes.clone()];
            for _ in 0..6 {
                let mut part = parts.swap_remove(random.below(parts.len()));
                let i = random.below(part.len());
                let [first, end] = part[i].part;
                if end - first > 1 {
                    let cut = first + 1 + random.below(end - first - 1);
                    part[i].part = [first, cut];
                    parts.push(part.clone());
                    part[i].part = [cut, end];
                }
                parts.push(part);
            }
            let parts = parts.iter().map(|part| map(&cobject, &q, part, &options));
            let parts: Vec<Map> = parts.collect();
            let whole = map(&cobject, &q, &axes, &options);
            assert_eq!(
                put_together(&axes, &parts),
                put_together(&axes, &[whole]),
                "seed {seed}, {kind:?}"
            );
        }
    }
}

#[test]
fn maps_do_not_depend_on_threads() {
    let cobject = arm_among_boxes();
    for kind in [MapKind::Classes, MapKind::Cells, MapKind::Distances] {
        let maps = [1, 2, 7].map(|threads| {
            let options = MapOptions {
                threads,
                ..of_kind(kind)
            };
            map(&cobject, &[0.0; 2], &turns(60), &options)
        });
        for other in &maps[1..] {
            assert_eq!(other.values(), maps[0].values());
            assert_eq!(other.proofs(), maps[0].proofs());
            assert_eq!(other.questions(), maps[0].questions());
        }
    }
}

/// Where contact is a class of its own, it is found in the middle of what is proved free.
#[test]
fn contacts_are_on_the_map() {
    let free = arm_among_boxes();
    let environment = free.environments()[0].clone();
    let options = InducedOptions {
        contact_epsilon: 0.1,
        ..InducedOptions::default()
    };
    let cobject = against_with(&free.space().clone(), &environment, options);
    let made = map(&cobject, &[0.0; 2], &turns(100), &of_kind(MapKind::Classes));
    let MapValues::Classes(values) = made.values() else {
        panic!("classes are classes");
    };
    let context = &mut QueryContext::new();
    for (cell, &value) in cells(&turns(100)).iter().zip(values) {
        let q = place(&[0.0; 2], &turns(100), cell, 0.5);
        assert_eq!(value, class(context, &cobject, &q) as u8);
    }
    assert!(values.iter().filter(|&&value| value == 1).count() > 100);
}

#[test]
fn a_map_is_cancelled_and_refused() {
    let cobject = Arc::new(arm_among_boxes());
    let q = [0.0; 2];
    let mut heard = Vec::new();
    let axes = turns(40);
    let mut hear = |fraction: f64| {
        heard.push(fraction);
        Ok(())
    };
    Map::build(&cobject, &q, &axes, &MapOptions::default(), &mut hear).unwrap();
    assert!(heard.is_sorted() && heard.first() == Some(&0.0) && heard.last() == Some(&1.0));
    let mut end = |fraction: f64| match fraction {
        late if late > 0.3 => Err(Error::new(ErrorKind::Cancelled, "enough")),
        _ => Ok(()),
    };
    let ended = Map::build(&cobject, &q, &axes, &MapOptions::default(), &mut end);
    assert_eq!(ended.unwrap_err().kind, ErrorKind::Cancelled);
    let refused = |axes: &[MapAxis], options: &MapOptions| {
        let nothing = &mut |_| Ok(());
        Map::build(&cobject, &q, axes, options, nothing)
            .unwrap_err()
            .kind
    };
    let good = MapOptions::default();
    let [a, b] = axes;
    assert_eq!(refused(&[], &good), ErrorKind::WrongSize);
    assert_eq!(refused(&[a; 7], &good), ErrorKind::WrongSize);
    assert_eq!(refused(&[a, a], &good), ErrorKind::InvalidArgument);
    for (axis, kind) in [
        (MapAxis { coordinate: 2, ..b }, ErrorKind::NotFound),
        (MapAxis { part: [0, 0], ..b }, ErrorKind::InvalidArgument),
        (MapAxis { part: [7, 41], ..b }, ErrorKind::InvalidArgument),
        (with_cells(b, 0), ErrorKind::InvalidArgument),
        (MapAxis { low: b.high, ..b }, ErrorKind::InvalidArgument),
        (MapAxis { low: f64::NAN, ..b }, ErrorKind::NotFinite),
        (
            MapAxis {
                high: f64::INFINITY,
                ..b
            },
            ErrorKind::NotFinite,
        ),
        (MapAxis { high: 1e300, ..b }, ErrorKind::InvalidArgument),
        (with_cells(b, usize::MAX), ErrorKind::WrongSize),
        (with_cells(b, usize::MAX / 64), ErrorKind::OutOfMemory),
    ] {
        assert_eq!(refused(&[a, axis], &good), kind, "{axis:?}");
    }
    let no_boxes = MapOptions {
        max_boxes: 0,
        ..good
    };
    assert_eq!(refused(&[a, b], &no_boxes), ErrorKind::InvalidArgument);
    let no_distance = MapOptions {
        max_distance: -1.0,
        ..of_kind(MapKind::Distances)
    };
    assert_eq!(refused(&[a, b], &no_distance), ErrorKind::InvalidArgument);
}

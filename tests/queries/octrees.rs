//! Octrees: their cells against a set of cells.

use std::collections::BTreeSet;
use std::sync::Arc;

use cstk::environment::Environment;
use cstk::error::ErrorKind;
use cstk::octree::Octree;
use cstk::pose::{Pose, Vec3};

use helpers::random::Random;

/// Cells by how many steps they begin from the origin.
pub type Model = BTreeSet<[i64; 3]>;

fn middle(cell: &[i64; 3], resolution: f64) -> Vec3 {
    Vec3::from(cell.map(|c| (c as f64 + 0.5) * resolution))
}

/// Changes a box of cells, in the octree and the model.
pub fn change(
    octree: &mut Octree,
    model: &mut Model,
    low: [i64; 3],
    edges: [i64; 3],
    occupied: bool,
) {
    let mut points = Vec::new();
    let mut changed = 0;
    for x in 0..edges[0] {
        for y in 0..edges[1] {
            for z in 0..edges[2] {
                let cell = [low[0] + x, low[1] + y, low[2] + z];
                points.push(middle(&cell, octree.resolution()));
                changed += usize::from(match occupied {
                    true => model.insert(cell),
                    false => model.remove(&cell),
                });
            }
        }
    }
    assert_eq!(octree.set(&points, occupied).unwrap(), changed);
}

pub fn random_change(random: &mut Random, octree: &mut Octree, model: &mut Model, half: i64) {
    let mut any = |n: i64| random.below(n as usize) as i64;
    let edge = [1, 1, 2, 4, 8][any(5) as usize];
    // Often along the cubes of the octree.
    let step = [1, edge][any(2) as usize];
    let low = [0; 3].map(|_| (any(2 * half) - half).div_euclid(step) * step);
    let edges = [0; 3].map(|_| if step == edge { edge } else { 1 + any(edge) });
    let occupied = any(3) > 0;
    change(octree, model, low, edges, occupied);
}

/// The cells of a cube.
fn cells_of(cube: &(Vec3, f64), resolution: f64) -> (Vec<[i64; 3]>, i64) {
    let low = [0, 1, 2].map(|axis| (cube.0[axis] / resolution).round() as i64);
    let edge = (cube.1 / resolution).round() as i64;
    let mut cells = Vec::new();
    for x in 0..edge {
        for y in 0..edge {
            cells.extend((0..edge).map(|z| [low[0] + x, low[1] + y, low[2] + z]));
        }
    }
    (cells, edge)
}

#[test]
fn cubes_are_the_largest_and_hold_each_occupied_cell_once() {
    let mut random = Random::new(2);
    let resolution = 0.1;
    for _ in 0..20 {
        let mut octree = Octree::new(resolution).unwrap();
        let mut model = Model::new();
        for _ in 0..40 {
            random_change(&mut random, &mut octree, &mut model, 12);
        }
        assert_eq!(octree.cell_count(), model.len() as u64);
        let cubes = octree.cubes();
        let mut covered = Model::new();
        for cube in &cubes {
            let (cells, edge) = cells_of(cube, resolution);
            assert!(edge & (edge - 1) == 0 && cells[0].iter().all(|c| c % edge == 0));
            for cell in &cells {
                assert!(covered.insert(*cell));
            }
            // The next larger cube is not full.
            let parent = (
                Vec3::from(
                    cells[0]
                        .map(|c| c.div_euclid(2 * edge) as f64 * 2.0 * edge as f64 * resolution),
                ),
                2.0 * edge as f64 * resolution,
            );
            let (around, _) = cells_of(&parent, resolution);
            assert!(!around.iter().all(|cell| model.contains(cell)));
        }
        assert_eq!(covered, model);
        // The same cells in another order.
        let mut again = Octree::new(resolution).unwrap();
        let mut cells: Vec<[i64; 3]> = model.iter().copied().collect();
        while !cells.is_empty() {
            let cell = cells.swap_remove(random.below(cells.len()));
            change(&mut again, &mut Model::new(), cell, [1; 3], true);
        }
        assert_eq!(again.cubes(), cubes);
        let mut points: Vec<Vec3> = Vec::new();
        let mut expected = Vec::new();
        for _ in 0..200 {
            let cell = [0; 3].map(|_| random.below(40) as i64 - 20);
            points.push(middle(&cell, resolution));
            expected.push(model.contains(&cell));
        }
        assert_eq!(octree.are_occupied(&points).unwrap(), expected);
    }
}

#[test]
fn the_grid_ends_where_it_says() {
    let mut octree = Octree::new(0.5).unwrap();
    let end = 16384.0;
    let corners = [Vec3::repeat(-end), Vec3::repeat(end - 1e-9)];
    assert_eq!(octree.set(&corners, true).unwrap(), 2);
    let cubes = octree.cubes();
    assert_eq!(
        cubes,
        [(Vec3::repeat(-end), 0.5), (Vec3::repeat(end - 0.5), 0.5)]
    );
    for (beyond, kind) in [
        (Vec3::new(end, 0.0, 0.0), ErrorKind::InvalidArgument),
        (Vec3::new(0.0, -end - 1e-9, 0.0), ErrorKind::InvalidArgument),
        (Vec3::new(0.0, 0.0, f64::NAN), ErrorKind::NotFinite),
        (Vec3::new(f64::INFINITY, 0.0, 0.0), ErrorKind::NotFinite),
    ] {
        let error = octree.set(&[Vec3::zeros(), beyond], true).unwrap_err();
        assert!(
            error.kind == kind && error.message.contains("point 1"),
            "{error}"
        );
    }
    assert_eq!(octree.cell_count(), 2);
    for resolution in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e60, 1e-60] {
        assert!(Octree::new(resolution).is_err());
    }
}

#[test]
fn octrees_are_united() {
    let mut random = Random::new(19);
    let world = Arc::new(Environment::default());
    for _ in 0..10 {
        let (mut one, mut other) = (Octree::new(0.2).unwrap(), Octree::new(0.2).unwrap());
        let (mut a, mut b) = (Model::new(), Model::new());
        for _ in 0..10 {
            random_change(&mut random, &mut one, &mut a, 12);
            random_change(&mut random, &mut other, &mut b, 12);
        }
        one.place(&world, &Pose::identity(), None).unwrap();
        one.insert(&other).unwrap();
        assert_eq!(one.cell_count(), a.union(&b).count() as u64);
        let mut same = Octree::new(0.2).unwrap();
        same.insert(&one).unwrap();
        same.place(&world, &Pose::identity(), None).unwrap();
        assert_eq!(
            (same.cubes(), same.object_count()),
            (one.cubes(), one.object_count())
        );
        one.remove().unwrap();
        same.remove().unwrap();
    }
    let coarse = Octree::new(0.4).unwrap();
    assert!(Octree::new(0.2).unwrap().insert(&coarse).is_err());
}

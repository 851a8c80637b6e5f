//! Pairs of links with cells in which they are proved apart. What is proved is held against the distances of the same bodies, which know
//! nothing of cells, and what queries answer against those of the set without proofs.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use cstk::cobject::{CObject, CellAxis, Class, ClearCells, InducedOptions};
use cstk::error::{Error, ErrorKind, Result};
use cstk::motion::{ClearPairOptions, MotionOptions, MotionOutcome};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::{Coordinate, JointKind, LinkDefinition};
use cstk::space::{Space, WorldBox};
use cstk::user_data::UserData;

use helpers::random::Random;
use helpers::robots::{against, environment, link, robot, space};
use helpers::shapes::cuboid;
use helpers::surfaces::{cube, solid_one};

use crate::random_scenes::{at, body, class};

fn proved(cobject: &CObject, max_blocks: usize) -> CObject {
    let options = ClearPairOptions { max_blocks };
    QueryContext::new()
        .prove_clear_pairs(cobject, &options, &mut |_| Ok(()))
        .unwrap()
}

/// A chain of bodies with joints that turn and shift, with limits of all kinds, and sometimes a fork or a mimic joint.
fn chain(random: &mut Random) -> Arc<Space> {
    let length = 3 + random.below(3);
    let mut ranges = Vec::new();
    let links: Vec<LinkDefinition> = (0..length)
        .map(|i| {
            let kind = [
                JointKind::Revolute,
                JointKind::Revolute,
                JointKind::Prismatic,
                JointKind::Fixed,
            ][random.below(4)]
            .clone();
            let parent = match i {
                0 => None,
                _ if random.below(4) == 0 => Some(random.below(i)),
                _ => Some(i - 1),
            };
            let interval = |lower, upper| Some(Coordinate::Interval { lower, upper });
            match kind {
                JointKind::Revolute => ranges.push(
                    [
                        None,
                        interval(-TAU, TAU),
                        interval(-1.0, 2.0),
                        interval(-0.3, 0.0),
                    ][random.below(4)],
                ),
                JointKind::Prismatic => {
                    ranges.push([interval(-0.5, 0.5), None][usize::from(random.below(5) == 0)]);
                }
                _ => {}
            }
            LinkDefinition {
                at: random.pose(0.9),
                body: Some(match random.below(6) {
                    0 => solid_one(&cube(random.within(0.3, 1.5))),
                    _ => body(random),
                }),
                ..link(parent, kind, random.unit())
            }
        })
        .collect();
    let robots = vec![robot(3, links)];
    Arc::new(Space::new(robots, &ranges, WorldBox::unbounded()).unwrap())
}

/// The pairs of links that are not joined, or all, with a margin and a contact epsilon.
fn pairs(space: &Arc<Space>, random: &mut Random, with_joined: bool) -> CObject {
    let links = space.link_count();
    let pairs: Vec<[usize; 2]> = (0..links)
        .flat_map(|s| (0..s).map(move |r| [r, s]))
        .filter(|[r, s]| with_joined || space.parent(*s) != Some(*r))
        .map(|[r, s]| [[r, s], [s, r]][(r + s) % 2])
        .collect();
    let options = InducedOptions {
        contact_epsilon: [0.0, 0.02][random.below(2)],
        margin: [0.0, 0.01][random.below(2)],
    };
    CObject::induced_links(space.clone(), &pairs, options).unwrap()
}

/// Any configuration: coordinates with cells also at the sides of cells, beyond their range, and turns away.
fn configuration(random: &mut Random, space: &Space, grid: Option<&ClearCells>) -> Vec<f64> {
    let mut q: Vec<f64> = (0..space.nq()).map(|_| random.within(-3.0, 3.0)).collect();
    for axis in grid.into_iter().flat_map(ClearCells::axes) {
        let cell = random.below(axis.count as usize + 1) as f64;
        let shift = [0.0, random.within(0.0, 1.0), 1e-12, -1e-12][random.below(4)];
        let turns = f64::from(axis.is_periodic) * [0.0, 0.0, TAU, -3.0 * TAU][random.below(4)];
        q[axis.coordinate] = axis.low + (cell + shift) * axis.width + turns;
    }
    q
}

/// Of each cell that is proved, the distance of the two bodies exceeds the contact epsilon wherever it is looked at.
#[test]
fn bodies_are_apart_in_cells_that_are_proved() {
    let mut random = Random::new(811);
    let context = &mut QueryContext::new();
    let (mut grids, mut inside, mut near) = (0, 0, 0);
    for _ in 0..if helpers::all_cases() { 400 } else { 40 } {
        let space = chain(&mut random);
        let plain = pairs(&space, &mut random, true);
        let (induced, pairs) = plain.link_pairs().unwrap();
        for &pair in pairs {
            let one = CObject::induced_links(space.clone(), &[pair], induced.options).unwrap();
            let with_proofs = proved(&one, 300);
            let Some(grid) = with_proofs.clear_grids().first() else {
                continue;
            };
            grids += 1;
            assert!(grid.proved_share() > 0.0 && grid.bytes() > 0);
            for _ in 0..300 {
                let q = configuration(&mut random, &space, Some(grid));
                if grid.contain(&q) {
                    let at = Configuration::Coordinates(&q);
                    let distance = context.distance(&one, at, f64::INFINITY).unwrap().distance;
                    assert!(
                        distance > induced.options.contact_epsilon,
                        "{distance}: {q:?}"
                    );
                    inside += 1;
                    near += u32::from(distance < 0.1);
                }
            }
        }
    }
    assert!(
        grids > 100 && inside > 10_000 && near > 200,
        "{grids} {inside} {near}"
    );
}

#[test]
fn classes_are_the_same_with_and_without_proofs() {
    let mut random = Random::new(812);
    let context = &mut QueryContext::new();
    let mut seen = [0; 3];
    for _ in 0..if helpers::all_cases() { 300 } else { 30 } {
        let space = chain(&mut random);
        let plain = pairs(&space, &mut random, false);
        let with_proofs = proved(&plain, 200);
        assert_eq!(plain.clear_grids().len(), 0);
        for i in 0..500 {
            let grids = with_proofs.clear_grids();
            let q = configuration(&mut random, &space, grids.get(i % grids.len().max(1)));
            let expected = class(context, &plain, &q);
            assert_eq!(class(context, &with_proofs, &q), expected, "{q:?}");
            seen[expected as usize] += 1;
            let poses = space.link_poses(&q).unwrap();
            let at = Configuration::LinkPoses(&poses);
            assert_eq!(context.classify(&with_proofs, at).unwrap(), expected);
            for threshold in [0.0, 0.005, 0.05] {
                let within = [&plain, &with_proofs].map(|set| {
                    let at = Configuration::Coordinates(&q);
                    context.within(set, at, threshold).unwrap()
                });
                assert_eq!(within[0], within[1], "{threshold}: {q:?}");
            }
            let at = Configuration::Coordinates(&q);
            let [a, b] = [&plain, &with_proofs]
                .map(|set| context.distance(set, at, f64::INFINITY).unwrap().distance);
            assert_eq!(a, b);
        }
    }
    assert!(seen.iter().all(|&count| count > 50), "{seen:?}");
}

/// Motions end alike, and what is free is so at every sample.
#[test]
fn motions_end_as_they_do_without_proofs() {
    let mut random = Random::new(813);
    let context = &mut QueryContext::new();
    let (mut free, mut hits) = (0, 0);
    for _ in 0..if helpers::all_cases() { 300 } else { 30 } {
        let space = chain(&mut random);
        let plain = pairs(&space, &mut random, false);
        let with_proofs = proved(&plain, 500);
        for i in 0..40 {
            let grids = with_proofs.clear_grids();
            let q = configuration(&mut random, &space, grids.get(i % grids.len().max(1)));
            let length = [0.01, 0.3, 2.0, 20.0][random.below(4)];
            let v: Vec<f64> = (0..space.nv())
                .map(|_| {
                    random.within(-length, length) * f64::from(random.below(4) as u32).min(1.0)
                })
                .collect();
            let options = MotionOptions {
                threshold: [0.0, 0.0, 0.01, 0.05][random.below(4)],
                any_contact: random.below(3) == 0,
                ..MotionOptions::default()
            };
            let [a, b] = [&plain, &with_proofs]
                .map(|set| context.motion_along(set, &q, &v, &options).unwrap());
            assert_eq!(a.outcome, b.outcome, "{q:?} {v:?} {options:?}");
            match a.outcome {
                MotionOutcome::Free => {
                    free += 1;
                    for k in 0..=100 {
                        let q = at(&space, &q, &v, f64::from(k) / 100.0);
                        assert_ne!(class(context, &plain, &q), Class::Inside, "{q:?}");
                    }
                }
                MotionOutcome::Hit if !options.any_contact => {
                    hits += 1;
                    let apart = (a.times[1] - b.times[1]).abs();
                    assert!(
                        apart <= 2.0 * options.tolerance,
                        "{:?} {:?}",
                        a.times,
                        b.times
                    );
                }
                _ => {}
            }
        }
    }
    assert!(free > 200 && hits > 100, "{free} {hits}");
}

fn axis(coordinate: usize, low: f64, width: f64, count: u32, is_periodic: bool) -> CellAxis {
    CellAxis {
        coordinate,
        velocity: coordinate,
        low,
        width,
        count,
        is_periodic,
    }
}

/// A motion stays in proved cells only if each of its places does, on grids in which any cell may be proved.
#[test]
fn a_motion_passes_every_cell_on_its_way() {
    let mut random = Random::new(814);
    let (mut stays, mut leaves) = (0, 0);
    for _ in 0..3000 {
        let axes = [
            axis(0, -1.0, 0.25, 8, false),
            axis(1, -PI, TAU / 7.0, 7, true),
            axis(2, 0.0, 0.5, 5, false),
        ];
        let count = 1 + random.below(3);
        let mut grid = ClearCells::new(axes[..count].iter().copied().collect());
        let holes = random.below(30) as u32;
        let cells: u32 = axes[..count].iter().map(|axis| axis.count).product();
        let mut is_hole = vec![false; cells as usize];
        for _ in 0..holes {
            is_hole[random.below(cells as usize)] = true;
        }
        for (cell, _) in is_hole.iter().enumerate().filter(|(_, is_hole)| !**is_hole) {
            let mut rest = cell as u32;
            let block = axes[..count].iter().map(|axis| {
                let place = rest % axis.count;
                rest /= axis.count;
                [place, place + 1]
            });
            grid.prove(&block.collect::<Vec<_>>());
        }
        let share =
            1.0 - is_hole.iter().filter(|is_hole| **is_hole).count() as f64 / f64::from(cells);
        assert!((grid.proved_share() - share).abs() < 1e-12);
        for _ in 0..20 {
            let place = |random: &mut Random, k: usize| match k {
                0 => [-1.0, 1.0, random.within(-1.0, 1.0), 0.25][random.below(4)],
                1 => [-PI, 0.0, random.within(-20.0, 20.0)][random.below(3)],
                _ => [0.0, 2.5, 0.5, random.within(0.0, 2.5)][random.below(4)],
            };
            let q: Vec<f64> = (0..3).map(|k| place(&mut random, k)).collect();
            let v: Vec<f64> = (0..3).map(|k| place(&mut random, k) - q[k]).collect();
            let stay = grid.contain_motion(&q, &v);
            let samples = (0..=2000).map(|i| f64::from(i) / 2000.0);
            let mut are_in = samples.map(|t| {
                let at: Vec<f64> = (0..3).map(|k| q[k] + t * v[k]).collect();
                // Nearer to a side than the pad, either cell will do.
                let is_at_side = axes[..count].iter().any(|axis| {
                    let place = (at[axis.coordinate] - axis.low) / axis.width;
                    (place - place.round()).abs() < 1e-9
                });
                grid.contain(&at) || is_at_side
            });
            let all = are_in.all(|is_in| is_in);
            assert!(!stay || all, "{q:?} {v:?}");
            stays += u32::from(stay);
            leaves += u32::from(!all);
            // What no sample finds is a corner that is cut.
        }
    }
    assert!(stays > 3000 && leaves > 3000, "{stays} {leaves}");
}

/// Beyond its limits nothing is known of a coordinate, and far from 0 nothing of an angle.
#[test]
fn cells_end_with_their_coordinates() {
    let mut grid = ClearCells::new([axis(0, -1.0, 0.5, 4, false)].into_iter().collect());
    grid.prove(&[[0, 4]]);
    for (x, is_in) in [
        (-1.0, true),
        (1.0, true),
        (1.0 + 1e-12, false),
        (-1.5, false),
    ] {
        assert_eq!(grid.contain(&[x]), is_in, "{x}");
        assert_eq!(grid.contain_motion(&[0.0], &[x]), is_in, "{x}");
        assert_eq!(grid.contain_motion(&[x], &[-x]), is_in, "{x}");
    }
    let mut grid = ClearCells::new([axis(0, -PI, TAU / 8.0, 8, true)].into_iter().collect());
    grid.prove(&[[0, 8]]);
    for (x, is_in) in [
        (900.0, true),
        (-900.0, true),
        (1e4, false),
        (f64::MAX, false),
    ] {
        assert_eq!(grid.contain(&[x]), is_in, "{x}");
        assert_eq!(grid.contain_motion(&[0.0], &[x]), is_in, "{x}");
    }
}

/// Two links that can never meet are proved so at once; two that always do are not; and what cannot be divided is left as it is.
#[test]
fn what_is_proved_is_told() {
    let cube = cuboid([0.2, 0.2, 0.2]).body;
    let arm = |distance: f64, kind: JointKind| {
        let base = LinkDefinition {
            body: Some(cube.clone()),
            ..link(None, JointKind::Revolute, Vec3::z())
        };
        let tip = LinkDefinition {
            at: Pose::from_translation(Vec3::new(distance, 0.0, 0.0)),
            body: Some(cube.clone()),
            ..link(Some(0), kind, Vec3::x())
        };
        let space = space(vec![robot(3, vec![base, tip])]);
        CObject::induced_links(space, &[[0, 1]], InducedOptions::default()).unwrap()
    };
    let share = |cobject: &CObject| {
        let proofs = proved(cobject, 1000);
        let grids = proofs.clear_grids();
        (
            grids.len(),
            grids.iter().map(ClearCells::proved_share).sum::<f64>(),
        )
    };
    assert_eq!(share(&arm(1.0, JointKind::Revolute)), (1, 1.0));
    assert_eq!(share(&arm(0.05, JointKind::Revolute)), (0, 0.0));
    // Without limits, without a joint, and a joint of three coordinates.
    for kind in [JointKind::Prismatic, JointKind::Fixed, JointKind::Planar] {
        assert_eq!(share(&arm(1.0, kind)), (0, 0.0));
    }
}

/// The data of the set, of which its leaf tells, and its shell go with the copy.
#[test]
fn a_copy_keeps_the_data_and_the_shell() {
    let space = chain(&mut Random::new(815));
    let options = InducedOptions::default();
    let plain = CObject::induced_links(space, &[[0, 2]], options).unwrap();
    let plain = plain
        .with_data(UserData::new(7, None))
        .with_shell(0.1)
        .unwrap();
    let copy = proved(&plain, 10);
    let [(a, _), (b, _)] = [&plain, &copy].map(|set| set.link_pairs().unwrap());
    assert_eq!((a.leaf.data, a.shell), (7, Some(0.1)));
    assert_eq!((b.leaf.data, b.shell), (7, Some(0.1)));
    assert_ne!(a.leaf.serial, b.leaf.serial);
    assert_eq!(b.leaf.serial, copy.serial());
}

#[test]
fn bad_input_is_refused() {
    let mut context = QueryContext::new();
    let cube = cuboid([0.2, 0.2, 0.2]).body;
    let links = (0..3usize).map(|i| LinkDefinition {
        at: Pose::from_translation(Vec3::new(1.0, 0.0, 0.0)),
        body: Some(cube.clone()),
        ..link(i.checked_sub(1), JointKind::Revolute, Vec3::z())
    });
    let space = space(vec![robot(3, links.collect())]);
    let pairs = CObject::induced_links(space.clone(), &[[0, 2]], InducedOptions::default());
    let pairs = Arc::new(pairs.unwrap());
    let (environment, _) = environment(&[(&cube, Pose::identity())]);
    let objects = Arc::new(against(&space, &environment));
    let union = CObject::union(&[pairs.clone(), objects.clone()]).unwrap();
    let options = ClearPairOptions::default();
    for other in [&*objects, &union] {
        let refused = context.prove_clear_pairs(other, &options, &mut |_| Ok(()));
        assert_eq!(refused.unwrap_err().kind, ErrorKind::Unsupported);
    }
    let none = ClearPairOptions { max_blocks: 0 };
    let refused = context.prove_clear_pairs(&pairs, &none, &mut |_| Ok(()));
    assert!(refused.unwrap_err().to_string().contains("max_blocks"));
    let mut calls = 0;
    let stop = &mut |_: f64| -> Result<()> {
        calls += 1;
        Err(Error::new(ErrorKind::Cancelled, "enough"))
    };
    let refused = context.prove_clear_pairs(&pairs, &options, stop);
    assert_eq!(refused.unwrap_err().kind, ErrorKind::Cancelled);
    assert_eq!(calls, 1);
}

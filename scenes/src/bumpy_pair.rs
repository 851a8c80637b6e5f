//! One bumpy body near another.

use crate::ball_tree::{BallTree, approach};
use crate::bumpy_sphere::bumpy_sphere;
use crate::mesh::Mesh;
use crate::motion::Pose;
use crate::point::{Point, across, times};
use crate::random::Random;
use crate::scene::Scene;

/// Of a bumpy sphere, so that its diameter is about 1.
const SCALE: f64 = 0.5;

/// From the centre of a body to its farthest point, at most.
const REACH: f64 = 1.24 * SCALE;

/// Poses of each kind.
const EACH: usize = 50;

/// How the surfaces of two bodies are to each other; the bodies are about 1 in diameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Placement {
    /// 0.5 to 2 apart.
    Far,
    /// 0.001 to 0.1 apart, as many in each decade.
    Near,
    /// At most 10⁻⁴ apart, or intersecting so that at most 10⁻⁴ back along the line of the centres they only touch.
    Touching,
    /// Intersecting so that 0.03 to 0.5 back along the line of the centres they only touch.
    Overlapping,
}

/// A scene of single poses, and what each of them is.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedScene {
    /// The bodies and the poses.
    pub scene: Scene,
    /// What the poses are, one for each.
    pub placements: Vec<Placement>,
}

/// Two bumpy spheres of different shape, about 1 in diameter and of `polygons` triangles each: one about the origin,
/// the other in 200 random poses all around it, 50 of each [`Placement`] in random order.
///
/// Distances are those asked for up to 10⁻⁶. `polygons` is as for [`bumpy_sphere`].
pub fn bumpy_pair(polygons: usize, seed: u64) -> PlacedScene {
    let random = &mut Random::new(seed);
    let pair = Pair::new(polygons, random);
    let mut placements: Vec<Placement> = [
        Placement::Far,
        Placement::Near,
        Placement::Touching,
        Placement::Overlapping,
    ]
    .repeat(EACH);
    for left in (2..=placements.len()).rev() {
        placements.swap(left - 1, (random.bits() % left as u64) as usize);
    }
    let poses = placements
        .iter()
        .map(|placement| {
            let (direction, turn) = (random.direction(), random.rotation());
            let (gap, back) = match placement {
                Placement::Far => (random.within(0.5, 2.0), 0.0),
                Placement::Near => (10f64.powf(random.within(-3.0, -1.0)), 0.0),
                // Less than the bound by what the approach leaves.
                Placement::Touching => (0.0, random.within(-0.98e-4, 0.98e-4)),
                Placement::Overlapping => (0.0, -random.within(0.03, 0.5)),
            };
            pair.placed(direction, &turn, gap, back)
        })
        .collect();
    PlacedScene {
        scene: pair.scene(format!("bumpy pair {polygons} {seed}"), poses),
        placements,
    }
}

/// The bodies of [`bumpy_pair`], one going an arc of half a radian round the other and turning by as much, in 200
/// poses, always `gap` apart up to 10⁻⁶.
///
/// No point moves by more than about 0.01 from pose to pose. Bodies and arc depend on the seed alone, but for the size
/// of the triangles: a family for studies of how the effort grows with `polygons`.
pub fn bumpy_pair_coherent(polygons: usize, gap: f64, seed: u64) -> Scene {
    let random = &mut Random::new(seed);
    let pair = Pair::new(polygons, random);
    let (start, first) = (random.direction(), random.rotation());
    let (around, _) = across(start);
    let axis = random.direction();
    let count = 4 * EACH;
    let poses = (0..count)
        .map(|k| {
            let angle = 0.5 * k as f64 / (count - 1) as f64;
            let direction = Pose::rotation(around, angle).apply(start);
            let turn = Pose::rotation(axis, angle).compose(&first);
            pair.placed(direction, &turn, gap, 0.0)
        })
        .collect();
    pair.scene(format!("bumpy pair {polygons} {gap} {seed}"), poses)
}

/// The bodies, ready to be placed.
struct Pair {
    moving: (Mesh, BallTree),
    fixed: (Mesh, BallTree),
}

impl Pair {
    fn new(polygons: usize, random: &mut Random) -> Pair {
        let mut body = || {
            let mut mesh = bumpy_sphere(polygons, random.bits());
            for p in &mut mesh.vertices {
                *p = times(SCALE, *p);
            }
            let tree = BallTree::new(&mesh);
            (mesh, tree)
        };
        Pair {
            moving: body(),
            fixed: body(),
        }
    }

    /// The moving body turned and come in from `direction` until it is `gap` from the other, and then gone back by
    /// `back`.
    fn placed(&self, direction: Point, turn: &Pose, gap: f64, back: f64) -> Pose {
        let at = |away: f64| Pose::translation(times(away, direction)).compose(turn);
        let distance = |away: f64| {
            self.moving
                .1
                .distance(&at(away), &self.fixed.1, f64::INFINITY)
        };
        at(approach(2.0 * REACH + gap, gap, distance) + back)
    }

    fn scene(self, name: String, poses: Vec<Pose>) -> Scene {
        Scene {
            name,
            moving: self.moving.0,
            obstacles: vec![self.fixed.0],
            poses,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::point::{minus, norm};

    #[test]
    fn fifty_poses_of_each_kind_in_mixed_order() {
        let made = bumpy_pair(100, 4);
        assert_eq!(made.scene.poses.len(), 200);
        for kind in made.placements.iter().take(4) {
            let same = made.placements.iter().filter(|k| *k == kind);
            assert_eq!(same.count(), 50);
        }
        let changes = made.placements.windows(2).filter(|k| k[0] != k[1]);
        assert!(changes.count() > 120);
    }

    #[test]
    fn coherent_poses_move_little() {
        for gap in [0.01, 1.0] {
            let scene = bumpy_pair_coherent(1000, gap, 2);
            for pair in scene.poses.windows(2) {
                for &p in &scene.moving.vertices {
                    let step = norm(minus(pair[0].apply(p), pair[1].apply(p)));
                    assert!(step < 0.015, "{step}");
                }
            }
        }
    }
}

//! A body that flies through many small ones.

use std::f64::consts::TAU;

use crate::ball_tree::{BallTree, approach};
use crate::lathe::{circle, directions, lathe, torus};
use crate::loft::{Ends, loft};
use crate::mesh::Mesh;
use crate::motion::Pose;
use crate::point::{Point, cross, minus, norm, plus, times, unit};
use crate::prism::{cuboid, prism};
use crate::random::Random;
use crate::robot_base::robot_base;
use crate::scene::Scene;
use crate::tube::bar;

/// Half the side of the world.
const HALF: f64 = 5.0;

const POSES: usize = 200;

/// How near the motion comes to five of the obstacles, which stand equally far apart along it; negative is beyond
/// contact.
const NARROWS: [f64; 5] = [-0.01, 0.0, 0.003, 0.01, 0.03];

/// The robot base, 1 wide and 276 polygons, flies a round of about 25 through `obstacles` small bodies in the cube of
/// side 10 about the origin, turning on the way, in 200 poses; meant for 500 obstacles.
///
/// The obstacles are boxes, prisms, vases, toothed wheels, lamps and rings of 12 to 96 polygons, 0.24 to 0.6 across
/// (less if there are more than 500), and do not overlap. The distance goes from 0, where the motion runs 0.01 into
/// one of them, to about 1, five times: at poses 0, 40, 80, 120 and 160 the motion passes an obstacle at up to 0.03,
/// halfway between them all others are kept away 1, and in between more than 0.05.
pub fn scattered(obstacles: usize, seed: u64) -> Scene {
    let random = &mut Random::new(seed);
    let flight = Flight::new(random);
    let scale = (500.0 / obstacles as f64).cbrt().min(1.0);
    let mut placed: Vec<Obstacle> = Vec::new();
    for number in 0..obstacles {
        let obstacle = small_body(number, random, scale);
        let at = match NARROWS.get(number) {
            Some(&gap) => flight.beside(number, &obstacle, gap, random),
            None => loop {
                let at = random.point(HALF - obstacle.radius);
                let clear = |other: &Obstacle| {
                    norm(minus(at, other.centre)) > obstacle.radius + other.radius
                };
                if placed.iter().all(clear) && flight.avoids(&obstacle, at) {
                    break at;
                }
            },
        };
        placed.push(Obstacle {
            mesh: obstacle.mesh.moved(&Pose::translation(at)),
            centre: at,
            ..obstacle
        });
    }
    Scene {
        name: format!("scattered {obstacles} {seed}"),
        moving: flight.mesh,
        obstacles: placed.into_iter().map(|o| o.mesh).collect(),
        poses: flight.poses,
    }
}

/// The moving body and its way.
struct Flight {
    mesh: Mesh,
    tree: BallTree,
    poses: Vec<Pose>,
}

impl Flight {
    fn new(random: &mut Random) -> Flight {
        let mut mesh = robot_base();
        for p in &mut mesh.vertices {
            let [x, y, z] = *p;
            *p = times(1.25, [x, y, z - 0.375]);
        }
        let (phase, start) = (random.within(0.0, TAU), random.within(0.0, TAU));
        let (axis, other) = (random.direction(), random.direction());
        let poses = (0..POSES)
            .map(|k| {
                let angle = TAU * k as f64 / POSES as f64;
                let (s, c) = (start + angle).sin_cos();
                let place = [3.2 * c, 3.2 * s, 2.0 * (2.0 * angle + phase).sin()];
                let turn = Pose::rotation(axis, angle).compose(&Pose::rotation(other, 2.0 * angle));
                Pose::translation(place).compose(&turn)
            })
            .collect();
        Flight {
            tree: BallTree::new(&mesh),
            mesh,
            poses,
        }
    }

    /// The least distance on the whole way of an obstacle at `at`.
    fn distance(&self, obstacle: &Obstacle, at: Point) -> f64 {
        let back = times(-1.0, at);
        self.poses.iter().fold(f64::INFINITY, |least, pose| {
            let seen = Pose::translation(back).compose(pose);
            self.tree.distance(&seen, &obstacle.tree, least)
        })
    }

    /// A place beside the way at the narrow with this number, `gap` from the moving body.
    fn beside(&self, number: usize, obstacle: &Obstacle, gap: f64, random: &mut Random) -> Point {
        let index = number * POSES / NARROWS.len();
        let place = |k: usize| self.poses[k % POSES].offset();
        let along = minus(place(index + 1), place(index));
        let aside = unit(cross(along, random.direction()));
        let at = |away: f64| plus(place(index), times(away, aside));
        // Beyond the reach of both bodies.
        let beside = approach(2.0, gap.max(0.0), |away| self.distance(obstacle, at(away)));
        at(beside + gap.min(0.0))
    }

    /// Whether an obstacle at `at` leaves the moving body as much room as it should have at each pose.
    fn avoids(&self, obstacle: &Obstacle, at: Point) -> bool {
        let back = Pose::translation(times(-1.0, at));
        self.poses.iter().enumerate().all(|(k, pose)| {
            let share = (k * NARROWS.len()) as f64 / POSES as f64;
            let room = 0.05 + 0.475 * (1.0 - (TAU * share).cos());
            self.tree
                .distance(&back.compose(pose), &obstacle.tree, room)
                >= room
        })
    }
}

/// A small body, and a ball around it.
struct Obstacle {
    mesh: Mesh,
    /// Of the mesh about the origin.
    tree: BallTree,
    centre: Point,
    radius: f64,
}

/// The small body with this number, about the origin, in a random position.
fn small_body(number: usize, random: &mut Random, scale: f64) -> Obstacle {
    let shape = match number % 6 {
        0 => small_box(random),
        1 => small_prism(random),
        2 => vase(random),
        3 => toothed_wheel(random),
        4 => small_lamp(),
        _ => torus(0.35, random.within(0.08, 0.15), 12, 8),
    };
    let (centre, reach) = BallTree::new(&shape).ball();
    let radius = scale * random.within(0.12, 0.3);
    let turn = random.rotation();
    let mut mesh = shape;
    for p in &mut mesh.vertices {
        *p = turn.apply(times(radius / reach, minus(*p, centre)));
    }
    Obstacle {
        tree: BallTree::new(&mesh),
        mesh,
        centre: [0.0; 3],
        radius,
    }
}

/// A whole number of at least `low` and below `high`.
fn whole(random: &mut Random, low: usize, high: usize) -> usize {
    low + (random.bits() % (high - low) as u64) as usize
}

/// A box of 12 triangles.
fn small_box(random: &mut Random) -> Mesh {
    let half: Point = std::array::from_fn(|_| random.within(0.15, 0.5));
    let mut mesh = cuboid(times(-1.0, half), half);
    mesh.faces = mesh
        .faces
        .iter()
        .flat_map(|f| [vec![f[0], f[1], f[2]], vec![f[0], f[2], f[3]]])
        .collect();
    mesh
}

/// A prism of 10 to 24 sides, two polygons more.
fn small_prism(random: &mut Random) -> Mesh {
    let high = random.within(0.1, 1.0);
    let outline = directions(whole(random, 10, 25)).into_iter();
    let outline: Vec<[f64; 2]> = outline.map(|[c, s]| [0.5 * c, 0.5 * s]).collect();
    prism(&outline, 0.0, high)
}

/// A waisted body of revolution, 26 to 62 polygons.
fn vase(random: &mut Random) -> Mesh {
    let waist = random.within(0.1, 0.3);
    let profile = [
        [0.25, 0.0],
        [0.4, 0.2],
        [waist, 0.6],
        [waist, 0.8],
        [0.35, 1.0],
    ];
    lathe(&profile, whole(random, 6, 16))
}

/// A wheel of 3 to 6 teeth with a bore, 48 to 96 polygons.
fn toothed_wheel(random: &mut Random) -> Mesh {
    let sides = 4 * whole(random, 3, 7);
    let thick = random.within(0.1, 0.3);
    let toothed = |z: f64| -> Vec<Point> {
        let radii = [0.38, 0.5, 0.5, 0.38].into_iter().cycle();
        directions(sides)
            .iter()
            .zip(radii)
            .map(|([c, s], r)| [r * c, r * s, z])
            .collect()
    };
    let bore = |z: f64| circle([0.15, z], sides);
    let rings = [toothed(0.0), toothed(thick), bore(thick), bore(0.0)];
    loft(&rings, Ends::Joined)
}

/// A lamp of a foot, an arm and a shade, 50 polygons.
fn small_lamp() -> Mesh {
    let foot = lathe(&[[0.3, 0.0], [0.3, 0.06], [0.08, 0.12]], 10);
    let shade = lathe(&[[0.3, 0.7], [0.12, 1.0]], 10).moved(&Pose::translation([0.2, 0.0, 0.0]));
    let lower = bar([0.0, 0.0, 0.1], [-0.2, 0.0, 0.5], 0.04, 6);
    let upper = bar([-0.2, 0.0, 0.5], [0.2, 0.0, 0.8], 0.04, 6);
    Mesh::union([foot, shade, lower, upper])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_small_obstacles_as_asked_for_inside_the_world() {
        let scene = scattered(500, 3);
        assert_eq!(scene.moving.polygons(), 276);
        assert_eq!(scene.poses.len(), 200);
        assert_eq!(scene.obstacles.len(), 500);
        for mesh in &scene.obstacles {
            assert!((12..=96).contains(&mesh.polygons()), "{}", mesh.polygons());
            let (low, high) = mesh.bounds();
            assert!(low.iter().all(|&x| x >= -HALF) && high.iter().all(|&x| x <= HALF));
        }
    }

    #[test]
    fn obstacles_do_not_overlap() {
        let scene = scattered(500, 5);
        let trees: Vec<BallTree> = scene.obstacles.iter().map(BallTree::new).collect();
        for (i, a) in trees.iter().enumerate() {
            for b in &trees[..i] {
                assert!(a.distance(&Pose::identity(), b, 1e-9) > 0.0);
            }
        }
    }

    #[test]
    fn more_obstacles_still_fit() {
        assert_eq!(scattered(2000, 1).obstacles.len(), 2000);
    }
}

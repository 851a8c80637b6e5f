//! A Puma 560 in a workcell.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::lathe::lathe;
use crate::mesh::Mesh;
use crate::motion::Pose;
use crate::point::Point;
use crate::prism::cuboid;
use crate::random::Random;

const JOINTS: usize = 6;

/// Reaching up, in degrees: where the coherent configurations swing about.
const MIDDLE: [f64; JOINTS] = [0.0, 50.0, -40.0, 0.0, 0.0, 0.0];

/// Sets of poses in a scene.
const POSES: usize = 200;

/// The standard Denavit-Hartenberg parameters d, a (in metres) and alpha (in radians) of each joint, from Corke and
/// Armstrong-Hélouvry 1994; the base adds its height of 0.67183 to the first d.
const DENAVIT_HARTENBERG: [[f64; 3]; JOINTS] = [
    [0.67183, 0.0, FRAC_PI_2],
    [0.0, 0.4318, 0.0],
    [0.15005, 0.0203, -FRAC_PI_2],
    [0.4318, 0.0, FRAC_PI_2],
    [0.0, 0.0, -FRAC_PI_2],
    [0.0, 0.0, 0.0],
];

/// How far each joint goes either way from 0, in degrees.
const LIMITS: [f64; JOINTS] = [160.0, 110.0, 135.0, 266.0, 100.0, 266.0];

/// A robot arm among obstacles that do not move; the meshes of its links are files, not part of this crate.
#[derive(Clone, Debug, PartialEq)]
pub struct ArmScene {
    /// What to call it in tables.
    pub name: String,
    /// The obstacles, in the frame of the world.
    pub obstacles: Vec<Mesh>,
    /// Where the fixed base and the six links behind it are, in the order of the arm.
    pub link_poses: Vec<[Pose; JOINTS + 1]>,
}

/// The Puma 560 in its workcell in 200 random configurations, each joint uniform within its limits; lengths in metres.
///
/// The link poses are the frames of the standard Denavit-Hartenberg table, which the meshes of the links, `link0.stl`
/// to `link6.stl` as `scripts/fetch_puma560.sh` gets them, are in. The workcell has a table, two posts, a crate, a drum
/// and a bumpy rock, 1038 polygons, so near that links 1 to 6 run into them in about half of the configurations; in the
/// others they keep up to 0.19 away.
pub fn puma_random(seed: u64) -> ArmScene {
    let random = &mut Random::new(seed);
    let configurations = (0..POSES).map(|_| {
        LIMITS.map(|limit| {
            let limit = limit.to_radians();
            random.within(-limit, limit)
        })
    });
    ArmScene {
        name: format!("Puma 560 random {seed}"),
        obstacles: workcell(),
        link_poses: configurations.map(|q| link_poses(&q)).collect(),
    }
}

/// The Puma 560 of [`puma_random`] on a smooth closed way of 200 configurations: each joint swings once about where it
/// is when the arm reaches up, by half its limits either way and at most 0.074 radians from one configuration to the
/// next.
pub fn puma_coherent(seed: u64) -> ArmScene {
    let random = &mut Random::new(seed);
    let phases = LIMITS.map(|_| random.within(0.0, TAU));
    let configurations = (0..POSES).map(|k| {
        let time = TAU * k as f64 / POSES as f64;
        std::array::from_fn(|i| {
            let degrees = MIDDLE[i] + 0.5 * LIMITS[i] * (time + phases[i]).sin();
            degrees.to_radians()
        })
    });
    ArmScene {
        name: format!("Puma 560 coherent {seed}"),
        obstacles: workcell(),
        link_poses: configurations.map(|q| link_poses(&q)).collect(),
    }
}

/// The frames of base and links with the joints at these angles, in radians.
fn link_poses(angles: &[f64; JOINTS]) -> [Pose; JOINTS + 1] {
    let mut poses = [Pose::identity(); JOINTS + 1];
    for (i, [d, a, alpha]) in DENAVIT_HARTENBERG.into_iter().enumerate() {
        let joint = Pose::rotation([0.0, 0.0, 1.0], angles[i]);
        let twist = Pose::rotation([1.0, 0.0, 0.0], alpha);
        let link = Pose::translation([a, 0.0, d]).compose(&twist);
        poses[i + 1] = poses[i].compose(&joint.compose(&link));
    }
    poses
}

/// What stands around the arm.
fn workcell() -> Vec<Mesh> {
    let centred = |[x, y, z]: Point| {
        let half = [0.5 * x, 0.5 * y, 0.5 * z];
        cuboid(half.map(|h| -h), half)
    };
    let crate_turn = Pose::rotation([0.0, 0.0, 1.0], 0.4);
    let post = centred([0.08, 0.08, 1.6]);
    let drum = lathe(&[[0.15, -0.25], [0.15, 0.25]], 24);
    let placed = |mesh: &Mesh, at: Point| mesh.moved(&Pose::translation(at));
    vec![
        placed(&centred([0.6, 1.2, 0.05]), [0.55, 0.0, 0.3]),
        placed(&post, [-0.33, 0.39, 0.8]),
        placed(&post, [-0.33, -0.39, 0.8]),
        placed(
            &centred([0.3, 0.25, 0.2]).moved(&crate_turn),
            [0.52, 0.2, 0.45],
        ),
        placed(&drum, [0.07, -0.52, 0.9]),
        placed(&rock(), [0.13, 0.46, 1.1]),
    ]
}

/// A bumpy ball about the origin, 0.2 in radius but for the bumps, 988 triangles.
fn rock() -> Mesh {
    const BANDS: usize = 20;
    const SECTORS: usize = 26;
    let mut mesh = Mesh::default();
    let top = mesh.add_vertex([0.0, 0.0, 0.2]);
    for i in 1..BANDS {
        for j in 0..SECTORS {
            let u = PI * i as f64 / BANDS as f64;
            let v = TAU * j as f64 / SECTORS as f64;
            let wave = (5.0 * v).sin() * (4.0 * u).sin() + 0.5 * (7.0 * u).cos();
            let r = 0.2 * (1.0 + 0.18 * wave * u.sin());
            mesh.add_vertex([r * u.sin() * v.cos(), r * u.sin() * v.sin(), r * u.cos()]);
        }
    }
    let bottom = mesh.add_vertex([0.0, 0.0, -0.2]);
    let at = |i: usize, j: usize| (1 + (i - 1) * SECTORS + j % SECTORS) as u32;
    for j in 0..SECTORS {
        mesh.faces.push(vec![top, at(1, j), at(1, j + 1)]);
        mesh.faces
            .push(vec![bottom, at(BANDS - 1, j + 1), at(BANDS - 1, j)]);
        for i in 1..BANDS - 1 {
            let (a, b) = (at(i, j), at(i + 1, j));
            let (c, d) = (at(i + 1, j + 1), at(i, j + 1));
            mesh.faces.push(vec![a, b, c]);
            mesh.faces.push(vec![a, c, d]);
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::point::{dot, minus, norm};

    fn near(a: Point, b: Point) -> bool {
        norm(minus(a, b)) < 1e-14
    }

    #[test]
    fn the_arm_at_zero_reaches_where_the_table_says() {
        let poses = link_poses(&[0.0; JOINTS]);
        assert_eq!(poses[0], Pose::identity());
        // Upper arm and forearm: out along x, aside by d3, up by d4.
        assert!(near(poses[2].offset(), [0.4318, 0.0, 0.67183]));
        assert!(near(
            poses[6].offset(),
            [0.4521, -0.15005, 0.67183 + 0.4318]
        ));
    }

    #[test]
    fn joints_turn_what_is_behind_them() {
        let poses = link_poses(&[FRAC_PI_2, FRAC_PI_2, 0.0, 0.0, 0.0, 0.0]);
        assert!(near(poses[1].offset(), [0.0, 0.0, 0.67183]));
        // Turned to y, then up.
        assert!(near(poses[2].offset(), [0.0, 0.0, 0.67183 + 0.4318]));
        assert!(near(
            poses[4].offset(),
            [0.15005, -0.4318, 0.67183 + 0.4521]
        ));
    }

    #[test]
    fn links_keep_their_lengths() {
        for scene in [puma_random(3), puma_coherent(3)] {
            assert_eq!(scene.link_poses.len(), 200);
            for poses in scene.link_poses {
                assert_eq!(poses[0], Pose::identity());
                for (i, [d, a, _]) in DENAVIT_HARTENBERG.into_iter().enumerate() {
                    let step = minus(poses[i + 1].offset(), poses[i].offset());
                    assert!((dot(step, step) - d * d - a * a).abs() < 1e-14);
                }
            }
        }
    }

    #[test]
    fn coherent_links_move_little() {
        let scene = puma_coherent(5);
        let ends = (0..POSES).map(|k| (k, (k + 1) % POSES));
        for (k, next) in ends {
            for i in 0..=JOINTS {
                let (a, b) = (&scene.link_poses[k][i], &scene.link_poses[next][i]);
                assert!(norm(minus(a.offset(), b.offset())) < 0.12);
            }
        }
    }

    #[test]
    fn polygons_of_the_workcell() {
        let counts: Vec<usize> = workcell().iter().map(Mesh::polygons).collect();
        assert_eq!(counts, [6, 6, 6, 6, 26, 988]);
    }
}

//! Two bumpy spheres at random poses.

use crate::bumpy_sphere::bumpy_sphere;
use crate::mesh::{Mesh, Point};
use crate::motion::{Pose, dot, norm};
use crate::random::Random;
use crate::scene::Scene;

/// Two bumpy spheres of radius about 1, `polygons` faces each: one at 200 random poses about the other, no pose near the
/// one before. In turn, shuffled by the seed, the gap along the line of the centres is far (0.5 to 2 between the supporting
/// planes), near (0.001 to 0.1 between them), grazing (bumps reach over the other's supporting plane without meeting on the
/// line of the centres) and overlapping (5 to 50 % of the radius on that line).
pub fn random_pair(polygons: usize, seed: u64) -> Scene {
    let mut random = Random::new(seed);
    let moving = bumpy_sphere(polygons, 2 * seed);
    let obstacle = bumpy_sphere(polygons, 2 * seed + 1);
    let poses = (0..200).map(|_| {
        let rotation = random.rotation();
        let direction = random.direction();
        let reach = |mesh: &Mesh, along: Point| {
            let farthest = mesh.vertices.iter().map(|&v| dot(v, along));
            farthest.fold(0.0, f64::max)
        };
        let turned = moving.moved(&rotation);
        let opposite = direction.map(|x| -x);
        let planes = reach(&obstacle, direction) + reach(&turned, opposite);
        let line = surface(&obstacle, direction) + surface(&turned, opposite);
        let apart = match random.bits() % 4 {
            0 => planes + random.within(0.5, 2.0),
            1 => planes + random.within(0.001, 0.1),
            2 => line + (planes - line) * random.within(0.1, 0.9),
            _ => line * (1.0 - random.within(0.025, 0.25)),
        };
        Pose::translation(direction.map(|x| x * apart)).compose(&rotation)
    });
    Scene {
        name: format!("RND {polygons} seed {seed}"),
        poses: poses.collect(),
        moving,
        obstacles: vec![obstacle],
    }
}

/// How far the surface of a star-shaped mesh is from the origin in a direction, by the vertex nearest to that direction.
fn surface(mesh: &Mesh, direction: Point) -> f64 {
    let cosine = |v: &Point| dot(*v, direction) / norm(*v);
    let nearest = mesh
        .vertices
        .iter()
        .max_by(|a, b| cosine(a).total_cmp(&cosine(b)));
    nearest.map_or(0.0, |v| norm(*v))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poses_are_of_all_kinds_and_follow_the_seed() {
        let scene = random_pair(2000, 3);
        assert_eq!(scene, random_pair(2000, 3));
        assert_ne!(scene.poses, random_pair(2000, 4).poses);
        let distances: Vec<f64> = scene.poses.iter().map(|p| norm(p.offset())).collect();
        let count =
            |low: f64, high: f64| distances.iter().filter(|&&d| low < d && d < high).count();
        assert!(
            count(0.9, 2.0) > 30 && count(2.5, 5.0) > 30,
            "{distances:?}"
        );
    }
}

//! A ball that moves in a plane among cylinders across it: a point among discs, of which everything is known in closed form.

use cstk::cobject::CObject;
use cstk::pose::{Pose, Vec3};
use cstk::robot::{JointKind, LinkDefinition};

use helpers::random::Random;
use helpers::robots::{against, environment, link, robot, space};

use super::random_scenes::built;

/// The radius of the ball.
const BALL: f64 = 0.1;

/// A disc, by its middle and radius.
pub type Disc = [f64; 3];

pub struct Discs {
    pub cell: CObject,
    /// As the ball's middle meets them: wider than the cylinders by the ball's radius.
    wide: Vec<Disc>,
}

impl Discs {
    pub fn new(discs: &[Disc]) -> Self {
        let ball = built(|b| b.add_sphere(&Vec3::zeros(), BALL, 0).unwrap());
        let links = vec![
            link(None, JointKind::Prismatic, Vec3::x()),
            LinkDefinition {
                body: Some(ball),
                ..link(Some(0), JointKind::Prismatic, Vec3::y())
            },
        ];
        let bodies: Vec<_> = discs
            .iter()
            .map(|&[x, y, radius]| {
                let body = built(|b| {
                    b.add_cylinder(&Pose::identity(), radius, 1.0, 0).unwrap();
                });
                (body, Pose::from_translation(Vec3::new(x, y, 0.0)))
            })
            .collect();
        let placed: Vec<_> = bodies.iter().map(|(body, pose)| (body, *pose)).collect();
        Self {
            cell: against(&space(vec![robot(3, links)]), &environment(&placed).0),
            wide: discs.iter().map(|&[x, y, r]| [x, y, r + BALL]).collect(),
        }
    }

    /// Up to six discs of any size about the origin.
    pub fn random(random: &mut Random) -> Self {
        let discs: Vec<Disc> = (0..1 + random.below(6))
            .map(|_| {
                let [x, y] = [0, 1].map(|_| random.within(-2.0, 2.0));
                [x, y, random.within(0.05, 0.5)]
            })
            .collect();
        Self::new(&discs)
    }

    /// The least distance on a segment, negative where it leads through a disc.
    pub fn on_segment(&self, from: &[f64], to: &[f64]) -> f64 {
        let of_disc = |&[x, y, radius]: &Disc| {
            let (u, v) = (
                [to[0] - from[0], to[1] - from[1]],
                [x - from[0], y - from[1]],
            );
            let square = u[0] * u[0] + u[1] * u[1];
            let t = if square > 0.0 {
                ((u[0] * v[0] + u[1] * v[1]) / square).clamp(0.0, 1.0)
            } else {
                0.0
            };
            (v[0] - t * u[0]).hypot(v[1] - t * u[1]) - radius
        };
        self.wide.iter().map(of_disc).fold(f64::INFINITY, f64::min)
    }

    /// The same of each segment of a path.
    pub fn on_path(&self, points: &[f64]) -> Vec<f64> {
        let points: Vec<&[f64]> = points.chunks(2).collect();
        let pairs = points.windows(2);
        pairs.map(|two| self.on_segment(two[0], two[1])).collect()
    }
}

pub fn length(points: &[f64]) -> f64 {
    let points: Vec<&[f64]> = points.chunks(2).collect();
    let pairs = points.windows(2);
    pairs
        .map(|two| (two[1][0] - two[0][0]).hypot(two[1][1] - two[0][1]))
        .sum()
}

/// The shortest way from (-a, 0) to (a, 0) around a disc of a radius about the origin: two tangents and an arc.
pub fn shortest_around(a: f64, radius: f64) -> f64 {
    let tangent = (a * a - radius * radius).sqrt();
    let free = (radius / a).acos();
    2.0 * tangent + radius * (std::f64::consts::PI - 2.0 * free)
}

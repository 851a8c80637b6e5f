//! The coordinates' ranges and the world box as half-spaces of steps.

use super::half_spaces::{HalfSpace, dot};
use crate::error::Result;
use crate::pose::{Pose, Vec3};
use crate::robot::{BlockKind, Coordinate, RobotState};
use crate::space::Space;

/// Limits farther away than this many times the requested length are left out.
const FAR: f64 = 8.0;

/// How far inside the world box a step aims, relative to the box's coordinates: covers the rounding of poses.
const INSIDE: f64 = 1e-12;

/// The half-spaces that keep a step of about `length` within the coordinates' ranges, and the links' origins within the
/// world box; exact for ranges of single coordinates, else to first order.
pub fn step_limits(space: &Space, q: &[f64], length: f64) -> Result<Vec<HalfSpace>> {
    let mut half_spaces = Vec::new();
    // Keeps a value with derivative `row` between two bounds.
    let mut keep = |value: f64, lower: f64, upper: f64, row: &[f64]| {
        let farthest = FAR * length * dot(row, row).sqrt();
        if upper - value <= farthest {
            half_spaces.push(HalfSpace {
                row: row.iter().map(|x| -x).collect(),
                least: value - upper,
            });
        }
        if value - lower <= farthest {
            half_spaces.push(HalfSpace {
                row: row.to_vec(),
                least: lower - value,
            });
        }
    };
    for block in space.blocks() {
        for k in 0..block.kind.lines() {
            let c = block.coordinate + k;
            let Coordinate::Interval { lower, upper } = space.coordinates()[c] else {
                continue;
            };
            let mut row = vec![0.0; space.nv()];
            if block.kind == BlockKind::Line {
                row[block.velocity] = 1.0;
            } else {
                // Velocities of free joints are in the moved frame.
                let own = &q[block.coordinate..block.coordinate + 7];
                let turned =
                    Pose::from_quaternion(Vec3::zeros(), [own[3], own[4], own[5], own[6]])?;
                for j in 0..3 {
                    row[block.velocity + j] = turned.rotation[(k, j)];
                }
            }
            keep(q[c], lower, upper, &row);
        }
    }
    let world = space.world();
    if world.low.iter().chain(&world.high).all(|x| x.is_infinite()) {
        return Ok(half_spaces);
    }
    let poses = &space.link_poses(q)?;
    for (link, pose) in poses.iter().enumerate() {
        let origin = &pose.translation;
        let jacobian = space.jacobian(RobotState { q, poses }, link, origin)?;
        for (axis, row) in jacobian.chunks_exact(space.nv().max(1)).take(3).enumerate() {
            if row.iter().any(|x| *x != 0.0) {
                // Aims inside, since rounding of the pose could put the origin outside.
                let [low, high] = [world.low[axis], world.high[axis]];
                let doubt = |bound: f64| match bound.is_finite() {
                    true => INSIDE * (1.0 + bound.abs()),
                    false => 0.0,
                };
                keep(origin[axis], low + doubt(low), high - doubt(high), row);
            }
        }
    }
    Ok(half_spaces)
}

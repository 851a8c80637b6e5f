//! What curves and functions of the caller's have in common: each coordinate goes its own way, so that quaternions rest.

use crate::error::{Error, ErrorKind, Result};
use crate::robot::BlockKind;
use crate::space::Space;

/// Refuses quaternions that move, on what the message calls a motion of this kind.
pub(super) fn check_quaternions(
    space: &Space,
    rests: impl Fn(usize) -> bool,
    kind: &str,
) -> Result<()> {
    let mut tied = space.blocks().iter().flat_map(|b| b.tied_coordinates());
    match tied.find(|&c| !rests(c)) {
        None => Ok(()),
        Some(c) => Err(Error::new(
            ErrorKind::Unsupported,
            format!(
                "coordinate {c} belongs to a joint with a quaternion, which cannot move {kind}"
            ),
        )),
    }
}

/// The largest speed of every coordinate, with signs that lead away from zero.
pub(super) fn speeds(space: &Space, start: &[f64], largest: impl Fn(usize) -> f64) -> Vec<f64> {
    let mut speeds = vec![0.0; space.nv()];
    for block in space.blocks() {
        if block.kind == BlockKind::Line {
            let c = block.coordinate;
            speeds[block.velocity] = largest(c).copysign(start[c]);
        }
    }
    speeds
}

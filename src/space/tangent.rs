//! Steps, differences, interpolation and distance: the tangent space of a C-space.
//!
//! A step follows a constant velocity: straight for intervals, round circles, at constant angular velocity for quaternions,
//! and along a screw for free joints.

use std::f64::consts::{PI, TAU};

use smallvec::SmallVec;

use super::Space;
use super::rigid_step::{Placement, entries, rotation, turn_between};
use crate::error::{Error, ErrorKind, Result, require_coordinates};
use crate::nonzero::{PLAIN_SQUARES, length};
use crate::pose::Vec3;
use crate::robot::{Block, BlockKind, Coordinate};
use crate::room::room_for;
use crate::tolerance::EPSILON;

impl Space {
    /// Refuses a velocity that has the wrong number of entries, or an entry that is not a usable number.
    pub fn check_velocity(&self, v: &[f64], name: &str) -> Result<()> {
        if v.len() != self.nv() {
            return Err(Error::new(
                ErrorKind::WrongSize,
                format!(
                    "the {name} has {} entries, but the space has {} velocities",
                    v.len(),
                    self.nv()
                ),
            ));
        }
        require_coordinates(v, &format!("{name} entry"))
    }

    /// Refuses weights of velocities that have the wrong number of entries, or an entry that is negative or no usable number.
    pub fn check_weights(&self, weights: &[f64]) -> Result<()> {
        self.check_velocity(weights, "list of weights")?;
        match weights.iter().position(|&weight| weight < 0.0) {
            None => Ok(()),
            Some(i) => Err(Error::invalid(format!(
                "weight {i} is negative: {}",
                weights[i]
            ))),
        }
    }

    /// The configuration reached from `q` with velocity `v` after a unit of time. Circles are not wrapped.
    pub fn step(&self, q: &[f64], v: &[f64]) -> Vec<f64> {
        let mut reached = q.to_vec();
        self.make_step(&mut reached, q, v);
        reached
    }

    /// The same, from `reached` on, which is q.
    fn make_step(&self, reached: &mut [f64], q: &[f64], v: &[f64]) {
        for block in self.blocks() {
            let (c, k) = (block.coordinate, block.velocity);
            let vector = |at: usize| Vec3::new(v[at], v[at + 1], v[at + 2]);
            match block.kind {
                BlockKind::Line => reached[c] += v[k],
                BlockKind::Rotation => {
                    let turn = nalgebra::UnitQuaternion::from_scaled_axis(vector(k));
                    let turned = rotation(&q[c..c + 4]) * turn;
                    reached[c..c + 4].copy_from_slice(&entries(&turned));
                }
                BlockKind::Placement => Placement::read(&q[c..c + 7])
                    .step(&vector(k), &vector(k + 3))
                    .write(&mut reached[c..c + 7]),
            }
        }
    }

    /// The smallest velocity that leads from `q0` to `q1` in a unit of time: circles go the shorter way round, and
    /// between opposite angles that of `q1 - q0`; quaternions turn by at most half a turn. The way back is the same.
    pub fn difference(&self, q0: &[f64], q1: &[f64]) -> Vec<f64> {
        let mut v = vec![0.0; self.nv()];
        self.write_difference(q0, q1, &mut v);
        v
    }

    fn write_difference(&self, q0: &[f64], q1: &[f64], v: &mut [f64]) {
        self.write_displacement(q0, q1, v);
        for block in self.blocks() {
            let c = block.coordinate;
            if self.coordinates()[c] == Coordinate::Circle {
                v[block.velocity] = way_round(q0[c], q1[c]);
            }
        }
    }

    /// The velocity that leads from `q0` to `q1` with circles unrolled: angles that differ by more than half a turn go the
    /// longer way.
    pub fn displacement(&self, q0: &[f64], q1: &[f64]) -> Vec<f64> {
        let mut v = vec![0.0; self.nv()];
        self.write_displacement(q0, q1, &mut v);
        v
    }

    fn write_displacement(&self, q0: &[f64], q1: &[f64], v: &mut [f64]) {
        for block in self.blocks() {
            let (c, k) = (block.coordinate, block.velocity);
            match block.kind {
                BlockKind::Line => v[k] = q1[c] - q0[c],
                BlockKind::Rotation => {
                    let [from, to] = [q0, q1].map(|q| rotation(&q[c..c + 4]));
                    v[k..k + 3].copy_from_slice(turn_between(&from, &to).as_slice());
                }
                BlockKind::Placement => {
                    let [from, to] = [q0, q1].map(|q| Placement::read(&q[c..c + 7]));
                    let [linear, angular] = from.difference(&to);
                    v[k..k + 3].copy_from_slice(linear.as_slice());
                    v[k + 3..k + 6].copy_from_slice(angular.as_slice());
                }
            }
        }
    }

    /// The configuration at parameter `t` of the shortest way from `q0` (at 0) to `q1` (at 1). For `t` in [0, 1] interval
    /// coordinates stay between their ends, to the last bit; of free joints' positions those that go straight (see
    /// [`Space::straight`]).
    pub fn interpolate(&self, q0: &[f64], q1: &[f64], t: f64) -> Vec<f64> {
        let mut way: Velocity = SmallVec::from_elem(0.0, self.nv());
        self.write_difference(q0, q1, &mut way);
        let part: Velocity = way.iter().map(|x| x * t).collect();
        let mut reached = self.step(q0, &part);
        if (0.0..=1.0).contains(&t) {
            for c in self.straight(q0, &way) {
                reached[c] = if t == 1.0 {
                    q1[c]
                } else {
                    reached[c].clamp(q0[c].min(q1[c]), q0[c].max(q1[c]))
                };
            }
        }
        reached
    }

    /// The interval coordinates that stay between their values at the ends of the motion from q with velocity v for a unit of time: all that
    /// move alone, and of free joints' positions those that go straight, but for what rounding does to them in any case.
    pub fn straight<'a>(&'a self, q: &'a [f64], v: &'a [f64]) -> impl Iterator<Item = usize> + 'a {
        let of_block = move |block: &Block| {
            let (c, k) = (block.coordinate, block.velocity);
            let vector = |at: usize| Vec3::new(v[at], v[at + 1], v[at + 2]);
            match block.kind {
                BlockKind::Line => [Some(c), None, None],
                BlockKind::Rotation => [None; 3],
                BlockKind::Placement => {
                    let (linear, angular) = (vector(k), vector(k + 3));
                    let bends = Placement::read(&q[c..c + 7]).bends(&linear, &angular);
                    [0, 1, 2].map(|i| {
                        let size = q[c + i].abs() + linear.norm();
                        (bends[i] <= POSITION_ERROR * size).then_some(c + i)
                    })
                }
            }
        };
        let coordinates = self.blocks().iter().flat_map(of_block).flatten();
        coordinates.filter(|&c| matches!(self.coordinates()[c], Coordinate::Interval { .. }))
    }

    /// Converts a derivative with respect to the coordinates into one with respect to the velocities. Entries of
    /// quaternions are ignored.
    pub fn by_velocity(&self, q: &[f64], by_coordinate: &[f64]) -> Vec<f64> {
        let mut row = vec![0.0; self.nv()];
        for block in self.blocks() {
            let (c, k) = (block.coordinate, block.velocity);
            match block.kind {
                BlockKind::Line => row[k] = by_coordinate[c],
                BlockKind::Rotation => {}
                BlockKind::Placement => {
                    let here = Placement::read(&q[c..c + 7]);
                    let turned =
                        here.rotation.inverse() * Vec3::from_column_slice(&by_coordinate[c..c + 3]);
                    row[k..k + 3].copy_from_slice(turned.as_slice());
                }
            }
        }
        row
    }

    /// The offset of q1 from q0, block by block: angles the shorter way round, translations in the robot's frame, rotations
    /// in the moved frame. Unlike in [`Space::difference`], translation and rotation of free joints are separate, so that
    /// the length is a metric: that of the product of lines, circles and rotations.
    pub fn offset(&self, q0: &[f64], q1: &[f64]) -> Vec<f64> {
        let mut offset = self.difference(q0, q1);
        for block in self.blocks() {
            if block.kind == BlockKind::Placement {
                let (c, k) = (block.coordinate, block.velocity);
                let [from, to] = [q0, q1].map(|q| Placement::read(&q[c..c + 7]));
                let shift = to.translation - from.translation;
                let turn = turn_between(&from.rotation, &to.rotation);
                offset[k..k + 3].copy_from_slice(shift.as_slice());
                offset[k + 3..k + 6].copy_from_slice(turn.as_slice());
            }
        }
        offset
    }

    /// An offset as a velocity at q1, translations turned into the moved frame: the direction in which the offset's length
    /// grows.
    pub fn offset_as_velocity(&self, q1: &[f64], offset: &[f64]) -> Vec<f64> {
        let mut v = offset.to_vec();
        for block in self.blocks() {
            if block.kind == BlockKind::Placement {
                let (c, k) = (block.coordinate, block.velocity);
                let to = Placement::read(&q1[c..c + 7]);
                let shift = to.rotation.inverse() * Vec3::from_column_slice(&offset[k..k + 3]);
                v[k..k + 3].copy_from_slice(shift.as_slice());
            }
        }
        v
    }

    /// The length of the difference, each velocity multiplied by its weight; without weights each counts as 1.
    pub fn distance(&self, q0: &[f64], q1: &[f64], weights: Option<&[f64]>) -> f64 {
        if weights.is_none() && self.blocks().len() == self.nq() {
            // Lines and circles alone: other blocks have several coordinates.
            let squares = self.squares_of_lines(q0, q1);
            if PLAIN_SQUARES.contains(&squares) {
                return squares.sqrt();
            }
        }
        let mut v: Velocity = SmallVec::from_elem(0.0, self.nv());
        self.write_difference(q0, q1, &mut v);
        if let Some(weights) = weights {
            for (x, weight) in v.iter_mut().zip(weights) {
                *x *= weight;
            }
        }
        length(&v)
    }

    /// The sum of the squares of the difference, in a space of lines and circles.
    #[inline]
    fn squares_of_lines(&self, q0: &[f64], q1: &[f64]) -> f64 {
        let ends = q0.iter().zip(q1);
        let squares = ends
            .zip(self.coordinates())
            .map(|((from, to), coordinate)| {
                let way = match coordinate {
                    Coordinate::Circle => way_round(*from, *to),
                    _ => to - from,
                };
                way * way
            });
        squares.sum()
    }

    /// The distances of `count` configurations from one, given one after the other; or the number of the first that is no
    /// configuration, and why.
    pub fn distances(
        &self,
        q: &[f64],
        others: &[f64],
        count: usize,
        weights: Option<&[f64]>,
    ) -> std::result::Result<SmallVec<[f64; 64]>, (usize, Error)> {
        let nq = self.nq();
        let mut distances = SmallVec::new();
        if count > distances.inline_size() {
            distances = SmallVec::from_vec(room_for(count).map_err(|error| (0, error))?);
        }
        for i in 0..count {
            let other = &others[i * nq..(i + 1) * nq];
            self.check_configuration(other)
                .map_err(|error| (i, error))?;
            distances.push(self.distance(q, other, weights));
        }
        Ok(distances)
    }
}

/// A coordinate of a free joint's position counts as going straight where it bends by no more than this, relative to its size: less than
/// what a step is rounded by.
const POSITION_ERROR: f64 = 4.0 * EPSILON;

/// A velocity, in memory of its own for most robots.
type Velocity = SmallVec<[f64; 16]>;

/// The shorter way round a circle. The way back is the same to the last bit, for opposite angles too: these go as the angles do.
#[inline]
fn way_round(from: f64, to: f64) -> f64 {
    let given = within_turns(to) - within_turns(from);
    let size = given.abs();
    let way = if size <= PI {
        size
    } else if size < 3.0 * PI {
        size - TAU
    } else {
        let reduced = shorter_way(size);
        if reduced == -PI { PI } else { reduced }
    };
    way * given.signum()
}

/// An angle, or the same direction within half a turn where the angle is large: there multiples of a rounded turn would be off by more
/// than the angle is rounded.
#[inline]
fn within_turns(angle: f64) -> f64 {
    if angle.abs() <= LARGE_ANGLE {
        return angle;
    }
    let (sine, cosine) = angle.sin_cos();
    sine.atan2(cosine)
}

/// Ten turns are off by 1e-15.
const LARGE_ANGLE: f64 = 10.0 * TAU;

/// The same angle within [-pi, pi).
pub fn shorter_way(angle: f64) -> f64 {
    if (-PI..PI).contains(&angle) {
        return angle;
    }
    let shifted = angle + PI;
    // As rem_euclid reduces it, to the last bit; within a turn without its division.
    let reduced = if (-TAU..0.0).contains(&shifted) {
        shifted + TAU
    } else if (TAU..2.0 * TAU).contains(&shifted) {
        shifted - TAU
    } else {
        shifted.rem_euclid(TAU)
    };
    let wrapped = reduced - PI;
    if wrapped >= PI { -PI } else { wrapped }
}

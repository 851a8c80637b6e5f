//! Poses in registers, a column in each. What was just stored would have to be waited for where it is loaded again in other widths: chains
//! of joints stay in registers.

use super::pose::{Mat3, Pose, Rows, Vec3, rotation_by};
use crate::lanes::{Doubles, Instructions, Plain, along64};
use crate::turn::Turn;

/// A pose in registers: its axes and its origin. The fourth lanes mean nothing.
#[derive(Clone, Copy)]
pub(crate) struct PoseColumns<I: Instructions> {
    axes: [Doubles<I>; 3],
    origin: Doubles<I>,
}

impl<I: Instructions> PoseColumns<I> {
    #[inline(always)]
    pub fn of(lanes: I, pose: &Pose) -> Self {
        Self {
            axes: columns(lanes, &pose.rotation),
            origin: column(lanes, pose, 3),
        }
    }

    #[inline(always)]
    pub fn pose(&self) -> Pose {
        Pose {
            rotation: of_columns(self.axes),
            translation: vector(self.origin),
        }
    }

    /// See [`Pose::compose`].
    #[inline(always)]
    pub fn compose(&self, child: &Pose) -> Self {
        let child_at = self.turned_axes(&child.rotation);
        Self {
            origin: self.turned(&child.translation) + self.origin,
            ..child_at
        }
    }

    /// A vector of the pose's own frame.
    #[inline(always)]
    pub fn turned(&self, v: &Vec3) -> Doubles<I> {
        along64(&self.axes, &of_vector(v))
    }

    /// Other axes, given in the pose's own frame, at the same origin.
    #[inline(always)]
    pub fn turned_axes(&self, axes: &Mat3) -> Self {
        Self {
            axes: turned_columns(&self.axes, axes),
            ..*self
        }
    }

    /// The pose with its origin moved.
    #[inline(always)]
    pub fn moved(&self, way: Doubles<I>) -> Self {
        Self {
            origin: self.origin + way,
            ..*self
        }
    }

    /// The pose after a turn about a unit axis of its own frame. Of a turn about x, y or z, the case of most joints, only two columns
    /// change.
    #[inline(always)]
    pub fn turned_by(&self, axis: &Vec3, turn: Turn) -> Self {
        let axes = match [axis.x, axis.y, axis.z].map(f64::abs) {
            [0.0, 0.0, 1.0] => turned_about_axis::<2, I>(self.axes, turn.signed(axis.z)),
            [0.0, 1.0, 0.0] => turned_about_axis::<1, I>(self.axes, turn.signed(axis.y)),
            [1.0, 0.0, 0.0] => turned_about_axis::<0, I>(self.axes, turn.signed(axis.x)),
            _ => turned_columns(&self.axes, &rotation_by(axis, turn)),
        };
        Self { axes, ..*self }
    }

    /// See [`Pose::shifted_along`].
    #[inline(always)]
    pub fn shifted_along(&self, axis: &Vec3, length: f64) -> Self {
        self.moved(self.turned(axis) * length)
    }
}

impl Pose {
    /// The product self * child: the pose of the child's child in this pose's parent frame.
    #[inline(always)]
    pub fn compose(&self, child: &Pose) -> Pose {
        PoseColumns::of(Plain, self).compose(child).pose()
    }

    /// The pose after a turn by `angle` radians about a unit axis of its own frame.
    pub fn turned_about(&self, axis: &Vec3, angle: f64) -> Pose {
        let columns = PoseColumns::of(Plain, self);
        columns.turned_by(axis, Turn::by(angle)).pose()
    }

    /// The pose after a shift along a unit axis of its own frame.
    #[inline(always)]
    pub fn shifted_along(&self, axis: &Vec3, length: f64) -> Pose {
        let columns = PoseColumns::of(Plain, self);
        columns.shifted_along(axis, length).pose()
    }
}

/// matrix * axes, a column at a time.
#[inline(always)]
pub fn turned_axes(matrix: &Mat3, axes: &Mat3) -> Mat3 {
    of_columns(turned_columns(&columns(Plain, matrix), axes))
}

/// matrix * axes of a matrix whose columns are in registers: to the last bit what [`turned`](super::turned) has.
#[inline(always)]
fn turned_columns<I: Instructions>(matrix: &[Doubles<I>; 3], axes: &Mat3) -> [Doubles<I>; 3] {
    let x = along64(matrix, &[axes[(0, 0)], axes[(1, 0)], axes[(2, 0)]]);
    let y = along64(matrix, &[axes[(0, 1)], axes[(1, 1)], axes[(2, 1)]]);
    let z = along64(matrix, &[axes[(0, 2)], axes[(1, 2)], axes[(2, 2)]]);
    [x, y, z]
}

/// A rotation, by its columns, after a turn about one of its own axes.
#[inline(always)]
fn turned_about_axis<const AXIS: usize, I: Instructions>(
    mut columns: [Doubles<I>; 3],
    Turn { sine, cosine }: Turn,
) -> [Doubles<I>; 3] {
    let [i, j] = [(AXIS + 1) % 3, (AXIS + 2) % 3];
    let (x, y) = (columns[i], columns[j]);
    columns[i] = x * cosine + y * sine;
    columns[j] = y * cosine - x * sine;
    columns
}

/// The columns of a matrix in registers. The fourth lanes mean nothing.
#[inline(always)]
pub(crate) fn columns<I: Instructions>(lanes: I, matrix: &Mat3) -> [Doubles<I>; 3] {
    let [[a, b, c], [d, e, f], [g, h, i]] = matrix.data.0;
    [
        Doubles::four(lanes, &[a, b, c, d]),
        Doubles::four(lanes, &[d, e, f, g]),
        Doubles::four(lanes, &[g, h, i, 0.0]),
    ]
}

#[inline(always)]
fn of_columns<I: Instructions>([x, y, z]: [Doubles<I>; 3]) -> Mat3 {
    let ([x, y, z], [a, b, c]) = ([x.array().0, y.array().0, z.array().0], [0, 1, 2]);
    Mat3::new(x[a], y[a], z[a], x[b], y[b], z[b], x[c], y[c], z[c])
}

/// The first three lanes of a register.
#[inline(always)]
pub(crate) fn vector<I: Instructions>(lanes: Doubles<I>) -> Vec3 {
    let [x, y, z, _] = lanes.array().0;
    Vec3::new(x, y, z)
}

#[inline(always)]
fn of_vector(v: &Vec3) -> [f64; 3] {
    [v.x, v.y, v.z]
}

/// A column of a pose in a register, and 0.
#[inline(always)]
pub(crate) fn column<I: Instructions>(lanes: I, pose: &impl Rows, j: usize) -> Doubles<I> {
    let entries = [pose.entry(0, j), pose.entry(1, j), pose.entry(2, j), 0.0];
    Doubles::four(lanes, &entries)
}

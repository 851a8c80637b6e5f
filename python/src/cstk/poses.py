"""Poses: 4 x 4 arrays, from child to parent frame: x_parent = R x_child + t.

Every function that takes a pose takes (4, 4), (3, 4) or 12 numbers, row by row; (3, 4) arrays of doubles are not copied. Poses in
answers are (4, 4), so that they compose with `@`. R may be off orthonormal by 1e-6; the nearest rotation is then used.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import doubles, empty, finite, numbers, pose, scalar, vector
from ._native import lib
from .enums import AngularFrame
from .errors import WrongSizeError, check

Array = NDArray[np.float64]


def identity() -> Array:
    """The pose that moves nothing."""
    return np.eye(4)


def translation(x: float, y: float, z: float) -> Array:
    """The pose that shifts by x, y, z."""
    out = np.eye(4)
    out[:3, 3] = (scalar("x", x), scalar("y", y), scalar("z", z))
    return finite("translation", out)


def _pose_of(call: Any, *arguments: Any) -> Array:
    """The pose that a call writes as its last argument."""
    out = np.eye(4)
    check(call(*arguments, doubles(out)))
    return out


def _array_of(call: Any, shape: Any, *arguments: Any) -> Array:
    out, pointer = empty(*shape)
    check(call(*arguments, pointer))
    return out


def pose_from_euler(xyz_ypr: ArrayLike) -> Array:
    """The pose of the report's x, y, z, yaw (about Y), pitch (about the new Z) and roll (about the new X), in radians (§4.1).
    This is not the order of ROS.
    """
    return _pose_of(lib.cstk_pose_from_euler, doubles(vector("xyz_ypr", xyz_ypr, 6)))


def pose_to_euler(pose_12: ArrayLike) -> Array:
    """x, y, z, yaw, pitch, roll: the inverse of pose_from_euler. Where cos(pitch) = 0 roll is 0."""
    return _array_of(lib.cstk_pose_to_euler, (6,), doubles(pose("pose_12", pose_12)))


def pose_from_rpy(xyz_rpy: ArrayLike) -> Array:
    """The pose of x, y, z, roll, pitch, yaw as URDF and ROS have them: about the fixed X, then the fixed Y, then the fixed Z."""
    return _pose_of(lib.cstk_pose_from_rpy, doubles(vector("xyz_rpy", xyz_rpy, 6)))


def pose_from_quaternion(xyz_quaternion: ArrayLike) -> Array:
    """The pose of x, y, z and the unit quaternion x, y, z, w, whose norm must be 1 to within 1e-6."""
    return _pose_of(lib.cstk_pose_from_quaternion, doubles(vector("xyz_quaternion", xyz_quaternion, 7)))


def pose_to_quaternion(pose_12: ArrayLike) -> Array:
    """x, y, z, and the unit quaternion x, y, z, w with w >= 0."""
    return _array_of(lib.cstk_pose_to_quaternion, (7,), doubles(pose("pose_12", pose_12)))


def pose_compose(a: ArrayLike, b: ArrayLike) -> Array:
    """a after b: `a @ b`, with what is not quite a rotation made one."""
    return _pose_of(lib.cstk_pose_compose, doubles(pose("a", a)), doubles(pose("b", b)))


def pose_inverse(pose_12: ArrayLike) -> Array:
    """The pose of the parent in the child's frame."""
    return _pose_of(lib.cstk_pose_inverse, doubles(pose("pose_12", pose_12)))


def pose_transform_point(pose_12: ArrayLike, point: ArrayLike) -> Array:
    """R point + t."""
    return _array_of(lib.cstk_pose_transform_point, (3,), doubles(pose("pose_12", pose_12)), doubles(vector("point", point, 3)))


def euler_to_rotation(yaw_pitch_roll: ArrayLike) -> Array:
    """The 3 x 3 rotation of yaw, pitch, roll (eq. 6)."""
    return _array_of(lib.cstk_euler_to_rotation, (3, 3), doubles(vector("yaw_pitch_roll", yaw_pitch_roll, 3)))


def euler_from_rotation(rotation: ArrayLike) -> Array:
    """yaw, pitch, roll of a 3 x 3 rotation (eq. 7)."""
    array = numbers("rotation", rotation)
    if array.shape != (3, 3):
        raise WrongSizeError(f"rotation has shape {array.shape}; needed: (3, 3)")
    return _array_of(lib.cstk_euler_from_rotation, (3,), doubles(array))


def euler_rates(yaw_pitch_roll: ArrayLike, frame: AngularFrame = AngularFrame.WORLD) -> Array:
    """The 3 x 3 matrix of eq. (31), from the rates of yaw, pitch and roll to an angular velocity."""
    angles = doubles(vector("yaw_pitch_roll", yaw_pitch_roll, 3))
    return _array_of(lib.cstk_euler_rates, (3, 3), angles, AngularFrame(frame))


def euler_rates_inverse(yaw_pitch_roll: ArrayLike, frame: AngularFrame = AngularFrame.WORLD) -> Array:
    """The inverse of euler_rates; DegenerateError where cos(pitch) = 0."""
    angles = doubles(vector("yaw_pitch_roll", yaw_pitch_roll, 3))
    return _array_of(lib.cstk_euler_rates_inverse, (3, 3), angles, AngularFrame(frame))


def _jacobian(call: Any, yaw_pitch_roll: ArrayLike, jacobian: ArrayLike) -> Array:
    angles = doubles(vector("yaw_pitch_roll", yaw_pitch_roll, 3))
    out = np.array(numbers("jacobian", jacobian))
    if out.ndim != 2 or out.shape[0] != 6:
        raise WrongSizeError(f"jacobian has shape {out.shape}; needed: (6, nv)")
    check(call(angles, doubles(out), out.shape[1]))
    return out


def jacobian_to_euler(yaw_pitch_roll: ArrayLike, jacobian: ArrayLike) -> Array:
    """From a basic Jacobian of shape (6, nv) (eq. 33) to that of x, y, z, yaw, pitch, roll (eq. 22, 23)."""
    return _jacobian(lib.cstk_jacobian_to_euler, yaw_pitch_roll, jacobian)


def jacobian_from_euler(yaw_pitch_roll: ArrayLike, jacobian: ArrayLike) -> Array:
    """The inverse of jacobian_to_euler."""
    return _jacobian(lib.cstk_jacobian_from_euler, yaw_pitch_roll, jacobian)

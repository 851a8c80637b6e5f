"""What SRDF files say of a robot: joint groups, named states, end effectors, virtual joints."""

from __future__ import annotations

from typing import Any, NamedTuple, Optional

import numpy as np
from numpy.typing import NDArray

from ._native import ffi
from .enums import JointKind

Numbers = NDArray[np.uint32]


class Semantics(NamedTuple):
    """Counts of what SRDF files say of a robot, and its passive joints."""

    group_count: int
    state_count: int
    end_effector_count: int
    virtual_joint_count: int
    passive_joints: Numbers
    """By the number of the link that each moves, ascending."""


class JointGroup(NamedTuple):
    """A joint group."""

    name: str
    joints: Numbers
    """By the number of the link that each moves, ascending, as Robot.frozen takes them; also joints that are fixed."""
    coordinates: Numbers
    """Where their coordinates stand in q, ascending."""


class NamedState(NamedTuple):
    """A named state: values for some coordinates, which Robot.apply_state puts into a configuration."""

    name: str
    group: Optional[int]
    """The index of its group; None where the file names none."""
    coordinates: Numbers
    values: NDArray[np.float64]


class EndEffector(NamedTuple):
    """An end effector."""

    name: str
    group: int
    """The index of the group of its joints."""
    parent_group: Optional[int]
    """The index of the arm's group; None where the file names none."""
    parent_link: int
    """The link that carries it."""
    touch_links: Numbers
    """The links with bodies that an object it holds may touch, for Environment.attach."""


class VirtualJoint(NamedTuple):
    """How the file means the robot to be carried. What carries it is the `base` of RobotBuilder.load_urdf."""

    name: str
    parent_frame: str
    kind: JointKind
    child_link: int
    """The root link."""


def _array(first: Any, count: int, dtype: Any) -> NDArray[Any]:
    out = np.empty(count, dtype)
    if count:
        ffi.memmove(ffi.from_buffer(out), first, out.nbytes)
    return out


def _name(given: Any) -> str:
    return str(ffi.string(given).decode())


def _index_or_none(number: int) -> Optional[int]:
    return None if number < 0 else int(number)


# The structures belong to the robot: what is asked of it is copied while its pointer is held.


def semantics_of(given: Any) -> Semantics:
    return Semantics(
        int(given.group_count),
        int(given.state_count),
        int(given.end_effector_count),
        int(given.virtual_joint_count),
        _array(given.passive_joints, given.passive_joint_count, np.uint32),
    )


def group_of(given: Any) -> JointGroup:
    joints = _array(given.joints, given.joint_count, np.uint32)
    return JointGroup(_name(given.name), joints, _array(given.coordinates, given.coordinate_count, np.uint32))


def state_of(given: Any) -> NamedState:
    coordinates = _array(given.coordinates, given.count, np.uint32)
    values = _array(given.values, given.count, np.float64)
    return NamedState(_name(given.name), _index_or_none(given.group), coordinates, values)


def end_effector_of(given: Any) -> EndEffector:
    touched = _array(given.touch_links, given.touch_count, np.uint32)
    parent_group = _index_or_none(given.parent_group)
    return EndEffector(_name(given.name), int(given.group), parent_group, int(given.parent_link), touched)


def virtual_joint_of(given: Any) -> VirtualJoint:
    return VirtualJoint(_name(given.name), _name(given.parent_frame), JointKind(given.kind), int(given.child_link))

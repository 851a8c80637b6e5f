"""Spaces: the C-space of one or more robots, with the ranges of its coordinates and the world box."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import doubles, empty, index, numbers, pointer, pointers, rows, same_length, scalar, text, vector
from ._handle import Handle, pointer_of
from ._native import ffi, lib
from .enums import RangeKind
from .errors import check
from .records import NONE, SpaceOffset
from .robot import Robot, name_of

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Range:
    """The range of a coordinate."""

    kind: RangeKind
    lower: float = 0.0
    upper: float = 0.0


def circle() -> Range:
    """Angles, equal modulo 2 pi."""
    return Range(RangeKind.CIRCLE)


def interval(lower: float, upper: float) -> Range:
    """The closed interval; either end may be infinite."""
    return Range(RangeKind.INTERVAL, lower, upper)


def default_range() -> Range:
    """What the joint says."""
    return Range(RangeKind.DEFAULT)


class Random:
    """A stream of random numbers for Space.sample. Equal states give equal configurations, on every machine."""

    def __init__(self, state: int = 0) -> None:
        self.state = index("state", state, 64)


class Space(Handle):
    """The C-space of robots. Links and coordinates are numbered through all of them, in the order given.

    `ranges` holds one range for each coordinate, or is None for what the joints say; `world_box` holds low x, y, z, high x, y, z,
    bounds for the links' origins.
    """

    __slots__ = ()
    _noun = "space"

    def __init__(
        self,
        robots: Union[Robot, Sequence[Robot]],
        ranges: Optional[Sequence[Range]] = None,
        world_box: Optional[ArrayLike] = None,
    ) -> None:
        given = [robots] if isinstance(robots, Robot) else list(robots)
        handles = [pointer_of(Robot, f"robots[{i}]", robot) for i, robot in enumerate(given)]
        kinds = [] if ranges is None else [_range(f"ranges[{i}]", r) for i, r in enumerate(ranges)]
        box = None if world_box is None else vector("world_box", world_box, 6)
        out = ffi.new("cstk_space **")
        check(
            lib.cstk_space_create(
                pointers(handles, "cstk_robot"),
                len(handles),
                ffi.new("cstk_range[]", kinds) if ranges is not None else ffi.NULL,
                len(kinds),
                ffi.NULL if box is None else doubles(box),
                out,
            )
        )
        self._c = ffi.gc(out[0], lib.cstk_space_release)

    def _size(self, place: int) -> int:
        out = ffi.new("size_t[3]")
        check(lib.cstk_space_get_size(self._pointer, out, out + 1, out + 2))
        return int(out[place])

    @property
    def nq(self) -> int:
        """The number of entries of a configuration."""
        return self._size(0)

    @property
    def nv(self) -> int:
        """The number of entries of a velocity or gradient."""
        return self._size(1)

    @property
    def link_count(self) -> int:
        return self._size(2)

    def link_name(self, link: int) -> str:
        """The name of a link, numbered through the space."""
        return name_of(lib.cstk_space_get_link_name, self._pointer, index("link", link))

    def find_link(self, name: str) -> int:
        """The number of the link with this name. NotFoundError if there is none, InvalidArgumentError if several robots have one."""
        out = ffi.new("uint32_t *")
        check(lib.cstk_space_find_link(self._pointer, text("name", name), out))
        return int(out[0])

    def offset(self, robot: int) -> SpaceOffset:
        """Where the numbers of the `robot`-th robot begin."""
        out = ffi.new("cstk_space_offset *")
        check(lib.cstk_space_get_offset(self._pointer, index("robot", robot, 64), out))
        return SpaceOffset(out)

    def enabled_pairs(self) -> NDArray[np.uint32]:
        """All pairs of links with bodies but those that SRDF files or RobotBuilder.disable_pair rule out, (n, 2), as
        CObject.induced_links takes them. Nothing is sampled; see Query.find_link_pairs.
        """
        count = ffi.new("size_t *")
        check(lib.cstk_space_get_enabled_pairs(self._pointer, 0, ffi.NULL, count))
        out = np.empty((count[0], 2), np.uint32)
        check(lib.cstk_space_get_enabled_pairs(self._pointer, count[0], pointer(out, "uint32_t"), count))
        return out

    def range(self, coordinate: int) -> Range:
        """The range of a coordinate; its kind is never DEFAULT."""
        out = ffi.new("cstk_range *")
        check(lib.cstk_space_get_range(self._pointer, index("coordinate", coordinate, 64), out))
        return Range(RangeKind(out.kind), out.lower, out.upper)

    def contains(self, q: ArrayLike) -> bool:
        """Whether every coordinate is in its range and every link's origin in the world box."""
        array, out = vector("q", q), ffi.new("bool *")
        check(lib.cstk_space_contains(self._pointer, doubles(array), array.size, out))
        return bool(out[0])

    def _within(self, call: Any, q: ArrayLike) -> Tuple[bool, Optional[int]]:
        array, out, first = vector("q", q), ffi.new("bool *"), ffi.new("uint32_t *")
        check(call(self._pointer, doubles(array), array.size, out, first))
        return bool(out[0]), None if first[0] == NONE else int(first[0])

    def within_limits(self, q: ArrayLike) -> Tuple[bool, Optional[int]]:
        """Whether every coordinate is in its range, and the first that is not."""
        return self._within(lib.cstk_space_within_limits, q)

    def within_world(self, q: ArrayLike) -> Tuple[bool, Optional[int]]:
        """Whether every link's origin is in the world box, and the first link that is not."""
        return self._within(lib.cstk_space_within_world, q)

    def link_poses(self, q: ArrayLike) -> Array:
        """The poses of all links at q, (link_count, 3, 4): rows [R | t], as the _at_link_poses queries take them without a copy. Of
        several configurations, (n, nq), those of each: (n, link_count, 3, 4).
        """
        array = numbers("q", q)
        if array.ndim == 2:
            out = np.empty((len(array), self.link_count, 3, 4))
            for row, poses in zip(array, out):
                check(lib.cstk_space_link_poses(self._pointer, doubles(row), row.size, doubles(poses)))
            return out
        array = vector("q", array)
        out, to = empty(self.link_count, 3, 4)
        check(lib.cstk_space_link_poses(self._pointer, doubles(array), array.size, to))
        return out

    def jacobian(self, q: ArrayLike, link: int, point: ArrayLike = (0, 0, 0)) -> Array:
        """As Robot.jacobian, with the space's links and velocities."""
        array, at = vector("q", q), doubles(vector("point", point, 3))
        out, jacobian = empty(6, self.nv)
        check(lib.cstk_space_jacobian(self._pointer, doubles(array), array.size, index("link", link), at, jacobian))
        return out

    def neutral(self) -> Array:
        """All coordinates 0, and identity quaternions 0, 0, 0, 1. It may be out of range."""
        out, q = empty(self.nq)
        check(lib.cstk_space_get_neutral(self._pointer, q))
        return out

    def step(self, q: ArrayLike, v: ArrayLike) -> Array:
        """The configuration reached from q with velocity v after a unit of time."""
        array, velocity = vector("q", q), vector("v", v)
        out, to = empty(self.nq)
        check(lib.cstk_space_step(self._pointer, doubles(array), array.size, doubles(velocity), velocity.size, to))
        return out

    def difference(self, q0: ArrayLike, q1: ArrayLike) -> Array:
        """The smallest velocity that leads from q0 to q1 in a unit of time."""
        a, b = vector("q0", q0), vector("q1", q1)
        nq = same_length("q0", a, "q1", b)
        out, v = empty(self.nv)
        check(lib.cstk_space_difference(self._pointer, doubles(a), doubles(b), nq, v))
        return out

    def interpolate(self, q0: ArrayLike, q1: ArrayLike, t: ArrayLike) -> Array:
        """The configuration at parameter t of the way from q0 (t = 0) to q1 (t = 1); of several parameters, (n,), a row for each."""
        a, b = vector("q0", q0), vector("q1", q1)
        nq = same_length("q0", a, "q1", b)
        if np.ndim(t) == 0:
            out, q = empty(self.nq)
            check(lib.cstk_space_interpolate(self._pointer, doubles(a), doubles(b), nq, scalar("t", t), q))
            return out
        times = vector("t", t)
        out = np.empty((times.size, self.nq))
        for time, row in zip(times.tolist(), out):
            check(lib.cstk_space_interpolate(self._pointer, doubles(a), doubles(b), nq, time, doubles(row)))
        return out

    def distance(self, q0: ArrayLike, q1: ArrayLike, weights: Optional[ArrayLike] = None) -> float:
        """The length of the difference of two configurations, each velocity multiplied by its weight."""
        a, b = vector("q0", q0), vector("q1", q1)
        nq = same_length("q0", a, "q1", b)
        given = ffi.NULL if weights is None else doubles(vector("weights", weights, self.nv))
        out = ffi.new("double *")
        check(lib.cstk_space_distance(self._pointer, doubles(a), doubles(b), nq, given, out))
        return float(out[0])

    def distances(self, q: ArrayLike, others: ArrayLike, weights: Optional[ArrayLike] = None) -> Array:
        """The distances of several configurations, the rows of others, from q; see distance."""
        a = vector("q", q)
        table = rows("others", others, a.size)
        given = ffi.NULL if weights is None else doubles(vector("weights", weights, self.nv))
        out, to = empty(len(table))
        check(lib.cstk_space_distances(self._pointer, doubles(a), doubles(table), len(table), a.size, given, to))
        return out

    def sample(self, random: Random, count: Optional[int] = None) -> Array:
        """A configuration drawn uniformly, or `count` of them, (count, nq); advances the stream."""
        if not isinstance(random, Random):
            raise TypeError(f"random must be a cstk.Random, not {type(random).__name__}")
        out = np.empty((1 if count is None else index("count", count, 64), self.nq))
        state = ffi.new("uint64_t *", random.state)
        for row in out:
            check(lib.cstk_space_sample(self._pointer, state, doubles(row)))
        random.state = int(state[0])
        return out[0] if count is None else out

    def clamp(self, q: ArrayLike) -> Array:
        """The nearest configuration with all coordinates in range."""
        array = vector("q", q)
        out, to = empty(self.nq)
        check(lib.cstk_space_clamp(self._pointer, doubles(array), array.size, to))
        return out

    def wrap(self, q: ArrayLike) -> Array:
        """The same configuration with circles in [0, 2 pi) and unit quaternions with w >= 0."""
        array = vector("q", q)
        out, to = empty(self.nq)
        check(lib.cstk_space_wrap(self._pointer, doubles(array), array.size, to))
        return out


def _range(name: str, value: Range) -> Any:
    if not isinstance(value, Range):
        raise TypeError(f"{name} must be a cstk.Range, not {type(value).__name__}")
    return {"kind": RangeKind(value.kind), "lower": scalar(name, value.lower), "upper": scalar(name, value.upper)}

"""Octrees: occupied cells that change while they are part of an environment."""

from __future__ import annotations

import os
from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import doubles, file_name, frame_or_identity, rows, scalar
from ._handle import Handle, pointer_of
from ._native import ffi, lib
from ._progress import Progress, reporting
from ._user_data import Kept
from .body import Body
from .environment import Environment
from .errors import check
from .hierarchy import HierarchyOptions, hierarchy_options


class Octree(Handle):
    """Which cells of a grid are occupied; `resolution` is the edge of a cell. Serves one thread at a time, while others query the
    environment that it is placed in.
    """

    __slots__ = ()
    _noun = "octree"

    def __init__(self, resolution: float) -> None:
        self._created(scalar("resolution", resolution))

    @classmethod
    def load(cls, file: "os.PathLike[str] | str", min_occupancy: float = 0.5) -> "Octree":
        """Reads an OctoMap file: .bt, or .ot, whose leaves are occupied if their probability is at least `min_occupancy`."""
        out = ffi.new("cstk_octree **")
        check(lib.cstk_octree_load(file_name("file", file), scalar("min_occupancy", min_occupancy), out))
        return cls._take(out[0])

    def set(self, points: ArrayLike, occupied: bool = True) -> int:
        """Makes the cells around points, (n, 3) in the octree's frame, occupied or empty; returns how many changed. Where the octree is
        placed, the environment follows in one change.
        """
        xyz = rows("points", points, 3)
        changed = ffi.new("size_t *")
        check(lib.cstk_octree_set(self._pointer, doubles(xyz), len(xyz), bool(occupied), changed))
        return int(changed[0])

    def get(self, points: ArrayLike) -> NDArray[np.bool_]:
        """Whether the cells around points, (n, 3), are occupied."""
        xyz = rows("points", points, 3)
        occupied = np.zeros(len(xyz), np.bool_)
        check(lib.cstk_octree_get(self._pointer, doubles(xyz), len(xyz), ffi.from_buffer("_Bool[]", occupied)))
        return occupied

    def insert(self, other: "Octree") -> None:
        """Makes the cells occupied that are occupied in another octree of the same resolution."""
        check(lib.cstk_octree_insert(self._pointer, pointer_of(Octree, "other", other)))

    @property
    def resolution(self) -> float:
        """The edge of a cell."""
        out = ffi.new("double *")
        check(lib.cstk_octree_get_state(self._pointer, out, ffi.NULL, ffi.NULL))
        return float(out[0])

    @property
    def cell_count(self) -> int:
        """The number of occupied cells."""
        out = ffi.new("uint64_t *")
        check(lib.cstk_octree_get_state(self._pointer, ffi.NULL, out, ffi.NULL))
        return int(out[0])

    @property
    def object_count(self) -> int:
        """The number of s-objects that it is in its environment."""
        out = ffi.new("size_t *")
        check(lib.cstk_octree_get_state(self._pointer, ffi.NULL, ffi.NULL, out))
        return int(out[0])

    def cubes(self) -> NDArray[np.float64]:
        """The occupied cells as cubes, as large as can be: (n, 4), the lowest corner and the edge."""
        count = ffi.new("size_t *")
        check(lib.cstk_octree_get_cubes(self._pointer, 0, ffi.NULL, count))
        cubes = np.empty((count[0], 4))
        check(lib.cstk_octree_get_cubes(self._pointer, len(cubes), doubles(cubes), count))
        # Another thread may have changed cells meanwhile.
        return cubes[: count[0]]

    def build_body(
        self, hierarchy: Optional[HierarchyOptions] = None, *, progress: Optional[Progress] = None
    ) -> Body:
        """A body of the occupied cells, a box for each cube, which does not change any more."""
        pointer, tree = self._pointer, hierarchy_options(hierarchy)
        out = ffi.new("cstk_body **")
        reporting(lambda function, user: lib.cstk_octree_build_body(pointer, tree, function, user, out), progress)
        return Body._take(out[0])

    def place(self, environment: Environment, pose: Optional[ArrayLike] = None, data: Any = None) -> None:
        """Places the octree in an environment, which follows its changes from now on. It is several objects there; witnesses return
        `data`.
        """
        world, frame = pointer_of(Environment, "environment", environment), frame_or_identity("pose", pose)
        with Kept(data) as kept:
            check(lib.cstk_octree_place(self._pointer, world, frame, kept.pointer, kept.destroy))

    def move(self, pose: ArrayLike) -> None:
        """Moves the octree within its environment."""
        check(lib.cstk_octree_move(self._pointer, frame_or_identity("pose", pose)))

    def remove(self) -> None:
        """Takes the octree out of its environment."""
        check(lib.cstk_octree_remove(self._pointer))

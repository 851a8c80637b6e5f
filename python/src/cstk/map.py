"""Maps: what is free on a grid over one to six coordinates, the others held."""

import os
from dataclasses import dataclass
from typing import Any, Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import doubles, file_name, index, scalar, vector
from ._handle import Handle, pointer_of
from ._native import ffi, lib
from ._options import options
from ._progress import Progress, reporting
from .cobject import CObject
from .enums import MapKind
from .errors import check


@dataclass(frozen=True)
class MapAxis:
    """An interval of a coordinate, cut into equal cells."""

    coordinate: int
    low: float
    high: float
    cells: int

    def middles(self) -> NDArray[np.float64]:
        """The middles of the cells."""
        return self.low + (self.high - self.low) * ((np.arange(self.cells) + 0.5) / self.cells)


class Map(Handle):
    """A map of C-space. It refers to no other object."""

    __slots__ = ()
    _noun = "map"

    def __init__(self) -> None:
        raise TypeError("maps are built: Map.build(cobject, q, axes)")

    @classmethod
    def build(
        cls,
        cobject: CObject,
        q: ArrayLike,
        axes: Sequence[MapAxis],
        kind: MapKind = MapKind.CLASSES,
        *,
        threads: Optional[int] = None,
        max_distance: Optional[float] = None,
        max_boxes: Optional[int] = None,
        progress: Optional[Progress] = None,
    ) -> "Map":
        """Builds a map; coordinates without an axis are those of q. Classes and proofs cost in proportion to the boundary of the set."""
        array = vector("q", q)
        intervals = ffi.new("cstk_map_axis[]", [_axis(f"axes[{i}]", axis) for i, axis in enumerate(axes)])
        given = options(
            "map_options",
            kind=MapKind(kind),
            threads=None if threads is None else index("threads", threads),
            max_distance=None if max_distance is None else scalar("max_distance", max_distance),
            max_boxes=None if max_boxes is None else index("max_boxes", max_boxes, 64),
        )
        out = ffi.new("cstk_map **")
        what = pointer_of(CObject, "cobject", cobject), doubles(array), array.size, intervals, len(axes), given
        reporting(lambda function, user: lib.cstk_map_build(*what, function, user, out), progress)
        return cls._take(out[0])

    def _view(self) -> Any:
        view = ffi.new("cstk_map_view *")
        check(lib.cstk_map_get_view(self._pointer, view))
        return view

    @property
    def kind(self) -> MapKind:
        return MapKind(self._view().kind)

    @property
    def axes(self) -> "list[MapAxis]":
        view = self._view()
        given = (view.axes[i] for i in range(view.axis_count))
        return [MapAxis(axis.coordinate, axis.low, axis.high, axis.cells) for axis in given]

    @property
    def values(self) -> NDArray[Any]:
        """A copy of what is told of the cells, one dimension for each axis: numbers of Class or RegionOutcome, or distances."""
        owner = self._pointer
        view = self._view()
        shape = [axis.cells for axis in self.axes]
        if view.distances != ffi.NULL:
            numbers = np.frombuffer(ffi.buffer(view.distances, 8 * view.cell_count), np.float64)
        else:
            numbers = np.frombuffer(ffi.buffer(view.values, view.cell_count), np.uint8)
        copied = numbers.reshape(shape).copy()
        del owner  # The map lives until here, whatever other threads release.
        return copied

    @property
    def proofs(self) -> int:
        """How many boxes were proved."""
        return int(self._view().proofs)

    @property
    def questions(self) -> int:
        """How many configurations were asked one by one."""
        return int(self._view().questions)

    def save(self, file: "os.PathLike[str] | str") -> None:
        """Saves the values; the file's name ends in .npy."""
        check(lib.cstk_map_save(self._pointer, file_name("file", file)))

    def show(self, file: "os.PathLike[str] | str") -> None:
        """A picture of a map of two coordinates; the file's name ends in .png."""
        check(lib.cstk_map_show(self._pointer, file_name("file", file)))


def _axis(name: str, axis: MapAxis) -> Any:
    if not isinstance(axis, MapAxis):
        raise TypeError(f"{name} must be a cstk.MapAxis, not {type(axis).__name__}")
    return {
        "coordinate": index(f"{name}.coordinate", axis.coordinate),
        "low": scalar(f"{name}.low", axis.low),
        "high": scalar(f"{name}.high", axis.high),
        "cells": index(f"{name}.cells", axis.cells, 64),
    }

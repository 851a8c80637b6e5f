"""Maps: what is free on a grid over one to six coordinates, as an array."""

from __future__ import annotations

import os
from typing import Any, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import doubles, file_name, index, scalar, vector
from ._handle import Handle, pointer_of
from ._native import ffi, lib
from ._options import options
from ._progress import Progress, reporting
from .cobject import CObject
from .enums import MapKind
from .errors import InvalidArgumentError, WrongSizeError, check


class MapAxis(NamedTuple):
    """An interval of a coordinate of the space, cut into equal cells. The map is of a part of them: from number `first` to before
    `end`, or to the last. They have the values that they have on a map of all cells.
    """

    coordinate: int
    low: float
    high: float
    cells: int
    first: int = 0
    end: Optional[int] = None

    def middles(self) -> NDArray[np.float64]:
        """The coordinate at the middle of each cell of the map, where it has its classes and distances."""
        end = self.cells if self.end is None else self.end
        return self.low + (self.high - self.low) * ((np.arange(self.first, end) + 0.5) / self.cells)


class _Cells:
    """Keeps a map's memory as long as an array shows it."""

    __slots__ = ("_c", "__array_interface__")

    def __init__(self, c: Any, first: Any, dtype: Any, shape: Tuple[int, ...]) -> None:
        self._c = c
        address = int(ffi.cast("uintptr_t", first))
        kind = np.dtype(dtype).str
        self.__array_interface__ = {"version": 3, "typestr": kind, "shape": shape, "data": (address, True)}


def _axis(name: str, given: Any) -> Any:
    """An axis as C takes it."""
    try:
        coordinate, low, high, cells, first, end = MapAxis(*given)
    except (TypeError, ValueError):
        raise WrongSizeError(f"{name} must be a cstk.MapAxis, or its coordinate, low, high and cells") from None
    first = index(f"{name}.first", first, 64)
    count = 0 if end is None else index(f"{name}.end", end, 64) - first
    if end is not None and count <= 0:
        raise InvalidArgumentError(f"{name}.end {end} is not beyond first {first}")
    return {
        "coordinate": index(f"{name}.coordinate", coordinate),
        "low": scalar(f"{name}.low", low),
        "high": scalar(f"{name}.high", high),
        "cells": index(f"{name}.cells", cells, 64),
        "first": first,
        "count": count,
    }


class Map(Handle):
    """A map of C-space. It never changes, refers to no other object, and threads may share it."""

    __slots__ = ()
    _noun = "map"

    def __init__(self) -> None:
        raise TypeError("maps come from Map.build")

    @classmethod
    def build(
        cls,
        cobject: CObject,
        q: ArrayLike,
        axes: Sequence[Union[MapAxis, Tuple[int, float, float, int]]],
        kind: MapKind = MapKind.CLASSES,
        *,
        threads: Optional[int] = None,
        max_distance: Optional[float] = None,
        max_boxes: Optional[int] = None,
        progress: Optional[Progress] = None,
    ) -> "Map":
        """Maps a C-object over one to six coordinates; the others are those of q. `kind` says what of: by default the classes at the
        middles of the cells, built coarse to fine. Distances above `max_distance` are infinite in the map; the proof of a cell halves it
        into at most `max_boxes` parts (default 64); `threads` is by default as many as the machine runs at once.
        """
        place, at = pointer_of(CObject, "cobject", cobject), vector("q", q)
        try:
            cuts = list(axes)
        except TypeError:
            raise TypeError(f"axes must be a sequence of cstk.MapAxis, not {type(axes).__name__}") from None
        given = options(
            "map_options",
            kind=MapKind(kind),
            threads=None if threads is None else index("threads", threads),
            max_distance=None if max_distance is None else scalar("max_distance", max_distance),
            max_boxes=None if max_boxes is None else index("max_boxes", max_boxes, 64),
        )
        grid = ffi.new("cstk_map_axis[]", [_axis(f"axes[{i}]", cut) for i, cut in enumerate(cuts)])
        arguments = place, doubles(at), at.size, grid, len(cuts), given
        out = ffi.new("cstk_map **")
        reporting(lambda function, user: lib.cstk_map_build(*arguments, function, user, out), progress)
        return cls._take(out[0])

    def _view(self) -> Tuple[Any, Any]:
        """The map's arrays, and the pointer that keeps them."""
        c, view = self._pointer, ffi.new("cstk_map_view *")
        check(lib.cstk_map_get_view(c, view))
        return c, view

    @property
    def values(self) -> NDArray[Any]:
        """An entry a cell: a `Class` or a `RegionOutcome` in 8 bits, or a distance. A view of the map's memory, which it keeps; it cannot
        be written to.
        """
        c, view = self._view()
        shape = self.shape
        if view.kind == MapKind.DISTANCES:
            return np.asarray(_Cells(c, view.distances, np.float64, shape))
        return np.asarray(_Cells(c, view.values, np.uint8, shape))

    @property
    def shape(self) -> Tuple[int, ...]:
        """The number of cells of each axis that are on the map."""
        _keeping, view = self._view()
        return tuple(int(view.axes[i].count) for i in range(view.axis_count))

    @property
    def axes(self) -> Tuple[MapAxis, ...]:
        """The axes, in the order given: that of the dimensions of `values`. Their `end` is not None."""
        _keeping, view = self._view()
        cuts = (view.axes[i] for i in range(view.axis_count))
        return tuple(MapAxis(cut.coordinate, cut.low, cut.high, cut.cells, cut.first, cut.first + cut.count) for cut in cuts)

    @property
    def kind(self) -> MapKind:
        """What the map tells of its cells."""
        return MapKind(self._view()[1].kind)

    @property
    def proofs(self) -> int:
        """How many boxes it took to prove."""
        return int(self._view()[1].proofs)

    @property
    def questions(self) -> int:
        """How many configurations were asked one by one."""
        return int(self._view()[1].questions)

    def save(self, file: "os.PathLike[str] | str") -> None:
        """Writes `values` to a file for numpy.load (.npy)."""
        check(lib.cstk_map_save(self._pointer, file_name("file", file)))

    def show(self, file: "os.PathLike[str] | str") -> None:
        """Writes a picture of a map. With two axes (.png), a pixel a cell: the first axis goes to the right, the second up. Classes are
        white (outside), orange (contact) and dark red (inside); cells white (free), dark red (inside), light gray (mixed) and gray
        (undecided); a distance of 0 is black, the largest white. With three axes (.glb), the boundary of the cells that are inside, at
        distance 0, or not proved free.
        """
        check(lib.cstk_map_show(self._pointer, file_name("file", file)))

"""Regions: whole boxes of C-space, proved free or inside, or grown around a configuration."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import doubles, empty, index, same_length, scalar, vector
from ._handle import Handle, pointer_of
from ._native import ffi, lib
from ._options import options
from ._record import Records
from .cobject import CObject
from .errors import check
from .records import RegionResult, RegionSide
from .space import Space

Array = NDArray[np.float64]


class Region(RegionResult):
    """What was found of a box."""

    __slots__ = ("inside", "outside")
    inside: Optional[Array]
    """A configuration of the box that is inside, where one is known."""
    outside: Optional[Array]
    """A configuration of the box that is not inside, where one is known."""

    def __init__(self, structure: Any, inside: Array, outside: Array) -> None:
        super().__init__(structure)
        self.inside = inside if structure.has_inside else None
        self.outside = outside if structure.has_outside else None


class GrownRegion:
    """A box that is proved free, and what stops its sides: the lower and the upper one of each velocity's coordinate."""

    __slots__ = ("low", "high", "sides")

    def __init__(self, low: Array, high: Array, sides: "Records[RegionSide]") -> None:
        self.low = low
        self.high = high
        self.sides = sides

    def __repr__(self) -> str:
        return f"GrownRegion(low={self.low!r}, high={self.high!r})"


class Regions(Handle):
    """The part of Query that asks about boxes of C-space."""

    __slots__ = ()

    def region_classify(
        self, cobject: CObject, low: ArrayLike, high: ArrayLike, *, max_boxes: Optional[int] = None
    ) -> Region:
        """Proves that no configuration between low and high is inside, or that all are, or finds one of each. On a circle the box is the
        arc from low upwards to high. It is halved into at most `max_boxes` parts (default 1000).
        """
        a, b = vector("low", low), vector("high", high)
        nq = same_length("low", a, "high", b)
        (inside, inside_out), (outside, outside_out) = empty(nq), empty(nq)
        given = options("region_options", max_boxes=None if max_boxes is None else index("max_boxes", max_boxes, 64))
        out = ffi.new("cstk_region_result *")
        box = pointer_of(CObject, "cobject", cobject), doubles(a), doubles(b), nq
        check(lib.cstk_region_classify(self._pointer, *box, given, inside_out, outside_out, out))
        return Region(out, inside, outside)

    def region_grow(
        self,
        cobject: CObject,
        space: Space,
        q: ArrayLike,
        *,
        weights: Optional[ArrayLike] = None,
        tolerance: Optional[float] = None,
        max_side: Optional[float] = None,
        max_boxes: Optional[int] = None,
    ) -> GrownRegion:
        """Grows a box around q that is proved free; `space` is that of the C-object. A side of weight 2 grows twice as far as one of
        weight 1, one of weight 0 not at all; weights are 1 by default.
        """
        nv = space.nv if pointer_of(Space, "space", space) else 0
        array = vector("q", q)
        scale = np.ones(nv) if weights is None else vector("weights", weights, nv)
        (low, low_out), (high, high_out) = empty(array.size), empty(array.size)
        sides = ffi.new("cstk_region_side[]", 2 * nv)
        given = options(
            "growth_options",
            tolerance=None if tolerance is None else scalar("tolerance", tolerance),
            max_side=None if max_side is None else scalar("max_side", max_side),
            max_boxes=None if max_boxes is None else index("max_boxes", max_boxes, 64),
        )
        around = pointer_of(CObject, "cobject", cobject), doubles(array), array.size, doubles(scale), nv
        check(lib.cstk_region_grow(self._pointer, *around, given, low_out, high_out, sides, 2 * nv))
        return GrownRegion(low, high, Records(RegionSide, sides))

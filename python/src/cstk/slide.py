"""Slides: steps along contacts, proved free on their whole way, and their two halves."""

from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import doubles, empty, index, scalar, vector
from ._handle import Handle, pointer_of
from ._lists import WitnessList
from ._native import ffi, lib
from ._options import options
from .cobject import CObject
from .errors import check
from .records import SlideResult

Array = NDArray[np.float64]


class Slide(SlideResult):
    """How a slide ended, and where."""

    __slots__ = ("reached",)
    reached: Array
    """The configuration reached; q unless the outcome is MOVED."""

    def __init__(self, structure: Any, reached: Array) -> None:
        super().__init__(structure)
        self.reached = reached


class Slides(Handle):
    """The part of Query that slides."""

    __slots__ = ()

    def slide(
        self,
        cobject: CObject,
        q: ArrayLike,
        step: ArrayLike,
        max_shell: float,
        *,
        desired_distance: Optional[float] = None,
        normalize: bool = False,
        max_witnesses: Optional[int] = None,
        floor: Optional[float] = None,
    ) -> Slide:
        """Takes one step from q that slides along contacts instead of running into them. `step` is a velocity for a unit of time;
        contacts up to `max_shell` constrain it: two or three times as far as a step moves the robot works well.
        """
        array, velocity = vector("q", q), vector("step", step)
        reached, reached_out = empty(array.size)
        given = options(
            "slide_options",
            max_shell=scalar("max_shell", max_shell),
            desired_distance=None if desired_distance is None else scalar("desired_distance", desired_distance),
            normalize=int(normalize),
            max_witnesses=None if max_witnesses is None else index("max_witnesses", max_witnesses),
            floor=None if floor is None else scalar("floor", floor),
        )
        out = ffi.new("cstk_slide_result *")
        at = pointer_of(CObject, "cobject", cobject), doubles(array), array.size, doubles(velocity), velocity.size
        check(lib.cstk_slide(self._pointer, *at, given, reached_out, out))
        return Slide(out, reached)


def _list(witnesses: WitnessList) -> Any:
    if not isinstance(witnesses, WitnessList):
        raise TypeError(f"witnesses must be a cstk.WitnessList, not {type(witnesses).__name__}")
    return witnesses._c


def slide_step(
    witnesses: WitnessList, step: ArrayLike, desired_distance: float, normalize: bool = False
) -> Optional[Array]:
    """The step nearest to `step` that brings no contact of a list with gradients nearer than `desired_distance`, to first order; None
    where less than 1 % of it would be left.
    """
    velocity = vector("step", step)
    out, out_pointer = empty(velocity.size)
    found = ffi.new("bool *")
    wanted = doubles(velocity), velocity.size, scalar("desired_distance", desired_distance), bool(normalize)
    check(lib.cstk_slide_step(_list(witnesses), *wanted, out_pointer, found))
    return out if found[0] else None


def spring_step(witnesses: WitnessList, desired_distance: float) -> Optional[Array]:
    """The shortest step that takes all contacts of a list with gradients out to `desired_distance`, to first order; None where no
    contact is nearer, or none can move out.
    """
    given = _list(witnesses)
    out, out_pointer = empty(given.nv)
    found = ffi.new("bool *")
    check(lib.cstk_spring_step(given, given.nv, scalar("desired_distance", desired_distance), out_pointer, found))
    return out if found[0] else None

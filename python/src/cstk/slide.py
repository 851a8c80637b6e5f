"""Slides: steps along contacts, proved free on their whole way, one or as many as lead to a goal, and the two halves of a step."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import doubles, empty, index, same_length, scalar, vector
from ._handle import Handle, pointer_of
from ._lists import WitnessList, path_from
from ._native import ffi, lib
from ._options import options
from ._progress import Progress, reporting
from .cobject import CObject
from .enums import SlideToOutcome
from .errors import check
from .records import SlideResult, SlideToResult

Array = NDArray[np.float64]


class Slide(SlideResult):
    """How a slide ended, and where."""

    __slots__ = ("reached",)
    reached: Array
    """The configuration reached; q unless the outcome is MOVED."""

    def __init__(self, structure: Any, reached: Array) -> None:
        super().__init__(structure)
        self.reached = reached


class SlideTo(SlideToResult):
    """Where a slide to a goal led. It is true where it arrived."""

    __slots__ = ("path",)
    path: Array
    """(n, nq): the configurations from q on, with motions between them that are proved free."""

    def __init__(self, structure: Any) -> None:
        super().__init__(structure)
        self.path = path_from(structure.path)

    def __bool__(self) -> bool:
        return bool(self._c.outcome == SlideToOutcome.ARRIVED)


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
        given = _slide_options(max_shell, desired_distance, normalize, max_witnesses, floor)
        out = ffi.new("cstk_slide_result *")
        at = pointer_of(CObject, "cobject", cobject), doubles(array), array.size, doubles(velocity), velocity.size
        check(lib.cstk_slide(self._pointer, *at, given, reached_out, out))
        return Slide(out, reached)

    def slide_to(
        self,
        cobject: CObject,
        q: ArrayLike,
        goal: ArrayLike,
        step: float,
        max_shell: float,
        *,
        goal_high: Optional[ArrayLike] = None,
        weights: Optional[ArrayLike] = None,
        tolerance: Optional[float] = None,
        min_gain: Optional[float] = None,
        max_steps: Optional[int] = None,
        max_idle_steps: Optional[int] = None,
        steps_between_motions: Optional[int] = None,
        desired_distance: Optional[float] = None,
        normalize: bool = False,
        max_witnesses: Optional[int] = None,
        floor: Optional[float] = None,
        progress: Optional[Progress] = None,
    ) -> SlideTo:
        """Leads the robot from q towards `goal`, straight as far as that is proved free, else by sliding steps of length `step`, until it
        arrives or is stopped. With `goal_high` the goal is the box of configurations between the two.
        """
        start, low = vector("q", q), vector("goal", goal)
        high = low if goal_high is None else vector("goal_high", goal_high)
        nq = same_length("q", start, "goal", low)
        same_length("goal", low, "goal_high", high)
        scale = None if weights is None else vector("weights", weights)
        slide = _slide_options(max_shell, desired_distance, normalize, max_witnesses, floor)
        given = options(
            "slide_to_options",
            step=scalar("step", step),
            tolerance=None if tolerance is None else scalar("tolerance", tolerance),
            min_gain=None if min_gain is None else scalar("min_gain", min_gain),
            max_steps=None if max_steps is None else index("max_steps", max_steps, 64),
            max_idle_steps=None if max_idle_steps is None else index("max_idle_steps", max_idle_steps, 64),
            steps_between_motions=None
            if steps_between_motions is None
            else index("steps_between_motions", steps_between_motions, 64),
        )
        out = ffi.new("cstk_slide_to_result *")
        ends = doubles(start), doubles(low), doubles(high), nq
        scaled = (ffi.NULL, 0) if scale is None else (doubles(scale), scale.size)
        arguments = self._pointer, pointer_of(CObject, "cobject", cobject), *ends, *scaled, slide, given
        reporting(lambda function, user: lib.cstk_slide_to(*arguments, function, user, out), progress)
        return SlideTo(out)


def _slide_options(
    max_shell: float, desired_distance: Optional[float], normalize: bool, max_witnesses: Optional[int], floor: Optional[float]
) -> Any:
    return options(
        "slide_options",
        max_shell=scalar("max_shell", max_shell),
        desired_distance=None if desired_distance is None else scalar("desired_distance", desired_distance),
        normalize=int(normalize),
        max_witnesses=None if max_witnesses is None else index("max_witnesses", max_witnesses),
        floor=None if floor is None else scalar("floor", floor),
    )


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

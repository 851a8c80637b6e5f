"""Motions: proved free, or followed to their first contact. Nothing is sampled."""

from __future__ import annotations

from typing import Any, Callable, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import doubles, empty, index, pose, rows, same_length, scalar, vector
from ._callback import callback
from ._callback_errors import keep_to_raise
from ._handle import Handle, pointer_of
from ._lists import path_from
from ._native import ffi, lib
from ._options import options
from ._progress import Progress, reporting
from ._user_data import Kept, data_of
from .body import Body
from .certificate import Certificate
from .cobject import CObject
from .enums import MotionOutcome
from .errors import WrongSizeError, check
from .records import ClearanceResult, MotionResult, PathClearanceResult, PathResult, ShortcutResult

Array = NDArray[np.float64]


class Motion(MotionResult):
    """How a motion ends, and where. It is true where the motion is proved free."""

    __slots__ = ("reached",)
    reached: Array
    """The configuration at times[1]; of a pair, both poses, (2, 4, 4)."""

    def __init__(self, structure: Any, reached: Array) -> None:
        super().__init__(structure)
        self.reached = reached

    def __bool__(self) -> bool:
        return bool(self._c.outcome == MotionOutcome.FREE)


class Path(PathResult):
    """How a path ends, and where. It is true where the path is proved free."""

    __slots__ = ("reached",)
    reached: Array
    """The configuration at motion.times[1] of the segment."""

    def __init__(self, structure: Any, reached: Array) -> None:
        super().__init__(structure)
        self.reached = reached

    def __bool__(self) -> bool:
        return bool(self._c.motion.outcome == MotionOutcome.FREE)


class Clearance(ClearanceResult):
    """The least distance along a motion, between proved bounds."""

    __slots__ = ("nearest",)
    nearest: Array
    """The configuration at `time`."""

    def __init__(self, structure: Any, nearest: Array) -> None:
        super().__init__(structure)
        self.nearest = nearest


class PathClearance(PathClearanceResult):
    """The least distance along a path, between proved bounds."""

    __slots__ = ("nearest",)
    nearest: Array
    """The configuration at the nearest place."""

    def __init__(self, structure: Any, nearest: Array) -> None:
        super().__init__(structure)
        self.nearest = nearest


class Shortcut(ShortcutResult):
    """A path made shorter."""

    __slots__ = ("path",)
    path: Array
    """(n, nq). Unless the outcome is NOT_FREE, each segment is proved free."""

    def __init__(self, structure: Any) -> None:
        super().__init__(structure)
        self.path = path_from(structure.path)


def clearance_options(tolerance: float, relative_tolerance: Optional[float], max_distance: Optional[float]) -> Any:
    """The C structure."""
    return options(
        "clearance_options",
        tolerance=scalar("tolerance", tolerance),
        relative_tolerance=None if relative_tolerance is None else scalar("relative_tolerance", relative_tolerance),
        max_distance=None if max_distance is None else scalar("max_distance", max_distance),
    )


def motion_options(threshold: float, tolerance: Optional[float], any_contact: bool) -> Any:
    return options(
        "motion_options",
        threshold=scalar("threshold", threshold),
        tolerance=None if tolerance is None else scalar("tolerance", tolerance),
        any_contact=int(any_contact),
    )


def _ends(q0: ArrayLike, q1: ArrayLike) -> Tuple[Any, Any, int]:
    a, b = vector("q0", q0), vector("q1", q1)
    return doubles(a), doubles(b), same_length("q0", a, "q1", b)


MotionFunction = Callable[[float], Tuple[ArrayLike, ArrayLike, ArrayLike]]
"""From a time to the configuration, and the first and second derivatives of its coordinates."""


@callback("int32_t(double, double *, double *, double *, size_t, void *)", keep_to_raise)
def _motion_at(t: float, q: Any, rates: Any, accelerations: Any, nq: int, user: Any) -> int:
    found = data_of(user)(t)
    if len(found) != 3:
        raise WrongSizeError("a motion's function gives the configuration, its rates and its accelerations")
    names = "the motion's configuration", "the motion's rates", "the motion's accelerations"
    for out, name, given in zip((q, rates, accelerations), names, found):
        out[0:nq] = vector(name, given, nq).tolist()
    return 0


class Motions(Handle):
    """The part of Query that asks about whole motions.

    A distance of at most `threshold` counts as contact; `tolerance` is how exactly the time of the first contact is found, as a part
    of the motion (default 1e-6); with `any_contact` any contact will do, found in less time than the first.
    """

    __slots__ = ()

    def motion(
        self,
        cobject: CObject,
        q0: ArrayLike,
        q1: ArrayLike,
        *,
        threshold: float = 0.0,
        tolerance: Optional[float] = None,
        any_contact: bool = False,
    ) -> Motion:
        """Proves the motion from q0 to q1 free, that of Space.interpolate, or finds its first contact."""
        *ends, nq = _ends(q0, q1)
        reached, reached_out = empty(nq)
        out = ffi.new("cstk_motion_result *")
        given = motion_options(threshold, tolerance, any_contact)
        place = pointer_of(CObject, "cobject", cobject)
        check(lib.cstk_motion(self._pointer, place, *ends, nq, given, reached_out, out))
        return Motion(out, reached)

    def motion_certificate(
        self,
        cobject: CObject,
        q0: ArrayLike,
        q1: ArrayLike,
        *,
        threshold: float = 0.0,
        tolerance: Optional[float] = None,
        any_contact: bool = False,
    ) -> Tuple[Motion, Optional[Certificate]]:
        """The same with a certificate, or None where the motion is not free."""
        *ends, nq = _ends(q0, q1)
        reached, reached_out = empty(nq)
        out, certificate = ffi.new("cstk_motion_result *"), ffi.new("cstk_certificate **")
        given = motion_options(threshold, tolerance, any_contact)
        place = pointer_of(CObject, "cobject", cobject)
        check(lib.cstk_motion_certificate(self._pointer, place, *ends, nq, given, reached_out, out, certificate))
        return Motion(out, reached), Certificate._take(certificate[0]) if certificate[0] != ffi.NULL else None

    def motion_path(
        self,
        cobject: CObject,
        points: ArrayLike,
        *,
        threshold: float = 0.0,
        tolerance: Optional[float] = None,
        any_contact: bool = False,
        progress: Optional[Progress] = None,
    ) -> Path:
        """The same for a path through `points`, (n, nq), segment by segment, in one state of the environments."""
        array = rows("points", points)
        reached, reached_out = empty(array.shape[1])
        out = ffi.new("cstk_path_result *")
        given = motion_options(threshold, tolerance, any_contact)
        arguments = self._pointer, pointer_of(CObject, "cobject", cobject), doubles(array), *array.shape, given
        reporting(lambda function, user: lib.cstk_motion_path(*arguments, function, user, reached_out, out), progress)
        return Path(out, reached)

    def motion_curve(
        self,
        cobject: CObject,
        points: ArrayLike,
        *,
        threshold: float = 0.0,
        tolerance: Optional[float] = None,
        any_contact: bool = False,
    ) -> Motion:
        """The same on a Bezier curve with control points (n, nq), 1 to 17 of them."""
        array = rows("points", points)
        reached, reached_out = empty(array.shape[1])
        out = ffi.new("cstk_motion_result *")
        given = motion_options(threshold, tolerance, any_contact)
        place = pointer_of(CObject, "cobject", cobject)
        check(lib.cstk_motion_curve(self._pointer, place, doubles(array), *array.shape, given, reached_out, out))
        return Motion(out, reached)

    def motion_spline(
        self,
        cobject: CObject,
        degree: int,
        knots: ArrayLike,
        points: ArrayLike,
        *,
        threshold: float = 0.0,
        tolerance: Optional[float] = None,
        any_contact: bool = False,
    ) -> Motion:
        """The same on a B-spline with control points (n, nq) and n + degree + 1 knots."""
        array, ticks = rows("points", points), vector("knots", knots)
        reached, reached_out = empty(array.shape[1])
        out = ffi.new("cstk_motion_result *")
        given = motion_options(threshold, tolerance, any_contact)
        place = pointer_of(CObject, "cobject", cobject)
        spline = index("degree", degree, 64), doubles(ticks), ticks.size, doubles(array), *array.shape
        check(lib.cstk_motion_spline(self._pointer, place, *spline, given, reached_out, out))
        return Motion(out, reached)

    def motion_function(
        self,
        cobject: CObject,
        function: MotionFunction,
        max_rates: ArrayLike,
        max_accelerations: ArrayLike,
        *,
        threshold: float = 0.0,
        tolerance: Optional[float] = None,
        any_contact: bool = False,
    ) -> Motion:
        """The same on a motion that a function gives. What is proved holds if the rates are the derivatives of q, and `max_rates` and
        `max_accelerations` bound the absolute derivatives of every coordinate at all times from 0 to 1; all is compared with what
        the function gives where it is asked.
        What it raises passes through.
        """
        speeds, bends = vector("max_rates", max_rates), vector("max_accelerations", max_accelerations)
        nq = same_length("max_rates", speeds, "max_accelerations", bends)
        if not callable(function):
            raise TypeError(f"function must be a function, not {type(function).__name__}")
        reached, reached_out = empty(nq)
        out = ffi.new("cstk_motion_result *")
        given = motion_options(threshold, tolerance, any_contact)
        place = pointer_of(CObject, "cobject", cobject)
        kept = Kept(function)
        try:
            bounds = doubles(speeds), doubles(bends), nq
            arguments = _motion_at, kept.pointer, *bounds, given, reached_out, out
            status = lib.cstk_motion_function(self._pointer, place, *arguments)
        finally:
            kept.drop()
        check(status)
        return Motion(out, reached)

    def pair_motion(
        self,
        body_a: Body,
        start_a: ArrayLike,
        end_a: ArrayLike,
        body_b: Body,
        start_b: ArrayLike,
        end_b: ArrayLike,
        *,
        threshold: float = 0.0,
        tolerance: Optional[float] = None,
        any_contact: bool = False,
    ) -> Motion:
        """The same of two bodies, each on a screw from its start to its end."""
        both = np.empty((2, 3, 4))
        out = ffi.new("cstk_motion_result *")
        given = motion_options(threshold, tolerance, any_contact)
        a = pointer_of(Body, "body_a", body_a), doubles(pose("start_a", start_a)), doubles(pose("end_a", end_a))
        b = pointer_of(Body, "body_b", body_b), doubles(pose("start_b", start_b)), doubles(pose("end_b", end_b))
        check(lib.cstk_pair_motion(self._pointer, *a, *b, given, doubles(both), out))
        reached = np.tile(np.eye(4), (2, 1, 1))
        reached[:, :3] = both
        return Motion(out, reached)

    def motion_clearance(
        self,
        cobject: CObject,
        q0: ArrayLike,
        q1: ArrayLike,
        tolerance: float,
        *,
        relative_tolerance: Optional[float] = None,
        max_distance: Optional[float] = None,
    ) -> Clearance:
        """The least distance along the motion from q0 to q1: two bounds at most `tolerance` apart, or that part of the upper one that
        `relative_tolerance` says. Clearances above `max_distance` are only known to be so.
        """
        *ends, nq = _ends(q0, q1)
        nearest, nearest_out = empty(nq)
        out = ffi.new("cstk_clearance_result *")
        given = clearance_options(tolerance, relative_tolerance, max_distance)
        place = pointer_of(CObject, "cobject", cobject)
        check(lib.cstk_motion_clearance(self._pointer, place, *ends, nq, given, nearest_out, out))
        return Clearance(out, nearest)

    def path_clearance(
        self,
        cobject: CObject,
        points: ArrayLike,
        tolerance: float,
        *,
        relative_tolerance: Optional[float] = None,
        max_distance: Optional[float] = None,
        progress: Optional[Progress] = None,
    ) -> PathClearance:
        """The same for a path through `points`, (n, nq), in one state of the environments."""
        array = rows("points", points)
        nearest, nearest_out = empty(array.shape[1])
        out = ffi.new("cstk_path_clearance_result *")
        given = clearance_options(tolerance, relative_tolerance, max_distance)
        arguments = self._pointer, pointer_of(CObject, "cobject", cobject), doubles(array), *array.shape, given
        reporting(lambda function, user: lib.cstk_path_clearance(*arguments, function, user, nearest_out, out), progress)
        return PathClearance(out, nearest)

    def path_shortcut(
        self,
        cobject: CObject,
        points: ArrayLike,
        *,
        attempts: Optional[int] = None,
        seed: Optional[int] = None,
        threshold: float = 0.0,
        progress: Optional[Progress] = None,
    ) -> Shortcut:
        """Makes a path through `points`, (n, nq), shorter by straight motions that are proved free, between places drawn by `seed`. The
        same call has the same answer.
        """
        array = rows("points", points)
        out = ffi.new("cstk_shortcut_result *")
        given = options(
            "shortcut_options",
            attempts=None if attempts is None else index("attempts", attempts, 64),
            seed=None if seed is None else index("seed", seed, 64),
            threshold=scalar("threshold", threshold),
        )
        arguments = self._pointer, pointer_of(CObject, "cobject", cobject), doubles(array), *array.shape, given
        reporting(lambda function, user: lib.cstk_path_shortcut(*arguments, function, user, out), progress)
        return Shortcut(out)

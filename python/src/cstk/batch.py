"""Batches: many configurations, motions or pairs of poses in one call, on several threads."""

from __future__ import annotations

from typing import Any, Callable, Optional, Tuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import doubles, empty, index, pointer, poses, rows, same_length, scalar
from ._callback_errors import take_callback_error
from ._handle import Handle, pointer_of
from ._native import ffi, lib
from ._options import options
from ._progress import Progress, reporting
from ._record import Records
from .body import Body
from .cobject import CObject
from .errors import CancelledError, Error, check, error_of
from .motion import motion_options
from .records import BatchResult, DistanceResult, MotionResult, QueryStatistics
from .space import Space

Array = NDArray[np.float64]
Call = Callable[[Any, Any, Any, Any, Any], int]
"""A C function that wants the options, the progress function, its user data, the statuses and the result."""


class BatchAnswers:
    """What a batch tells of its items, in their order. An item that was not answered stands out: its class or outcome is -1, numbers
    are NaN, and it counts as within.
    """

    __slots__ = ("statuses", "result", "failure")

    statuses: NDArray[np.int32]
    """The status of each item, as C has it: 0 if it was answered, CancelledError.status if it was not reached."""
    result: Optional[BatchResult]
    """How the batch ended; None where progress ended it."""
    failure: Optional[Error]
    """Why the first item that failed did. What a function of yours raised is its cause if it was called on the calling thread; of
    several failures the last.
    """

    def __init__(self, count: int) -> None:
        self.statuses = np.full(count, CancelledError.status, np.int32)
        self.result = None
        self.failure = None

    def __len__(self) -> int:
        return len(self.statuses)

    def __repr__(self) -> str:
        return f"<cstk.{type(self).__name__}: {np.count_nonzero(self.answered)} of {len(self)} items answered>"

    @property
    def answered(self) -> NDArray[np.bool_]:
        """Which items were answered."""
        return np.equal(self.statuses, 0)

    @property
    def first_hit(self) -> Optional[int]:
        """The item that the batch stopped at, if stop_at_hit was set and it did."""
        return self.result.first_hit if self.result else None

    def check(self) -> None:
        """Raises the failure of the first item that failed, if one did."""
        if self.failure is not None:
            raise self.failure

    def _blank(self, missing: NDArray[np.bool_]) -> None:
        """Marks the items that were not answered: C may have written anything there, or nothing."""
        raise NotImplementedError


class BatchClasses(BatchAnswers):
    """The classes of many configurations."""

    __slots__ = ("classes",)
    classes: NDArray[np.int32]
    """A `Class` for each item: compare it with Class.INSIDE."""

    def __init__(self, count: int) -> None:
        super().__init__(count)
        self.classes = np.empty(count, np.int32)

    def _blank(self, missing: NDArray[np.bool_]) -> None:
        self.classes[missing] = -1


class BatchWithin(BatchAnswers):
    """Which of many configurations or pairs of poses are within the threshold."""

    __slots__ = ("within",)
    within: NDArray[np.bool_]

    def __init__(self, count: int) -> None:
        super().__init__(count)
        self.within = np.empty(count, np.bool_)

    def _blank(self, missing: NDArray[np.bool_]) -> None:
        self.within[missing] = True


class BatchDistances(BatchAnswers):
    """The distances of many configurations or pairs of poses."""

    __slots__ = ("distances", "results", "gradients")
    distances: Array
    results: Optional[Records[DistanceResult]]
    """The whole answers, if asked for; `results.array` shows them as one structured array."""
    gradients: Optional[Array]
    """The gradient of each item's contact, if asked for, (n, nv); 0 where it has no contact."""

    def __init__(self, count: int, results: bool, nv: Optional[int]) -> None:
        super().__init__(count)
        self.distances = np.empty(count)
        self.results = Records(DistanceResult, ffi.new("cstk_distance_result[]", count)) if results else None
        self.gradients = None if nv is None else np.empty((count, nv))

    def _blank(self, missing: NDArray[np.bool_]) -> None:
        self.distances[missing] = np.nan
        if self.results is not None:
            array = self.results.array
            array[missing] = np.zeros((), array.dtype)
            array["distance"][missing] = np.nan
        if self.gradients is not None:
            self.gradients[missing] = np.nan


class BatchMotions(BatchAnswers):
    """How many motions end."""

    __slots__ = ("results", "reached")
    results: Records[MotionResult]
    """`results.array["outcome"]` has a `MotionOutcome` for each motion."""
    reached: Array
    """The configurations at times[1], (n, nq)."""

    def __init__(self, count: int, nq: int) -> None:
        super().__init__(count)
        self.results = Records(MotionResult, ffi.new("cstk_motion_result[]", count))
        self.reached = np.empty((count, nq))

    @property
    def free(self) -> NDArray[np.bool_]:
        """Which motions are proved free."""
        return np.equal(self.results.array["outcome"], lib.CSTK_MOTION_FREE)

    def _blank(self, missing: NDArray[np.bool_]) -> None:
        array = self.results.array
        array[missing] = np.zeros((), array.dtype)
        array["outcome"][missing] = -1
        array["times"][missing] = np.nan
        self.reached[missing] = np.nan


AnyAnswers = TypeVar("AnyAnswers", bound=BatchAnswers)


def _items(name: str, q: ArrayLike) -> Tuple[Any, int, int]:
    """Configurations as C takes them."""
    array = rows(name, q)
    return doubles(array), *array.shape


def _pairs(body_a: Body, poses_a: ArrayLike, body_b: Body, poses_b: ArrayLike) -> Tuple[Any, Any, Any, Any, int]:
    """Two bodies at many pairs of poses, as C takes them."""
    a, b = pointer_of(Body, "body_a", body_a), pointer_of(Body, "body_b", body_b)
    at_a, at_b = poses("poses_a", poses_a), poses("poses_b", poses_b)
    return a, doubles(at_a), b, doubles(at_b), same_length("poses_a", at_a, "poses_b", at_b)


class Batch(Handle):
    """Asks about many items in one call, on several threads, all in the state that the environments are in at the call. Answers are those
    of single calls, bit for bit. Arrays of doubles that are contiguous are not copied.

    An item that fails (of a NaN, say) fails alone: see `BatchAnswers`. With `stop_at_hit` the batch ends at its first hit, the one with
    the lowest number: what is INSIDE, within, at distance 0, or a motion that is not proved free. Where `progress` ends a batch, the
    CancelledError has the answers until then, as `answers`.

    A batch serves one call at a time; a call while another runs raises BusyError. It keeps the caches of its threads from call to call.
    """

    __slots__ = ("threads", "limit")
    _noun = "batch"
    threads: Optional[int]
    """How many threads work, the caller's among them; None for as many as the machine runs at once."""
    limit: Optional[int]
    """Limits the work of each item, as Query.set_limit does: an item that needs more fails with LimitError. None for no limit."""

    def __init__(self, *, threads: Optional[int] = None, limit: Optional[int] = None) -> None:
        self.threads = None if threads is None else index("threads", threads)
        self.limit = None if limit is None else index("limit", limit, 64)
        self._created()

    def classify(
        self, cobject: CObject, q: ArrayLike, *, stop_at_hit: bool = False, progress: Optional[Progress] = None
    ) -> BatchClasses:
        """Query.classify for configurations (n, nq)."""
        place, items = pointer_of(CObject, "cobject", cobject), _items("q", q)
        answers = BatchClasses(items[1])
        classes = pointer(answers.classes, "int32_t")

        def call(given: Any, function: Any, user: Any, statuses: Any, out: Any) -> int:
            arguments = given, function, user, classes, statuses, out
            return int(lib.cstk_classify_batch(self._pointer, place, *items, *arguments))

        return self._asked(call, answers, stop_at_hit, progress)

    def within(
        self,
        cobject: CObject,
        q: ArrayLike,
        threshold: float,
        *,
        stop_at_hit: bool = False,
        progress: Optional[Progress] = None,
    ) -> BatchWithin:
        """Query.within for configurations (n, nq)."""
        place, items, limit = pointer_of(CObject, "cobject", cobject), _items("q", q), scalar("threshold", threshold)
        answers = BatchWithin(items[1])
        within = pointer(answers.within, "bool")

        def call(given: Any, function: Any, user: Any, statuses: Any, out: Any) -> int:
            arguments = given, function, user, within, statuses, out
            return int(lib.cstk_within_batch(self._pointer, place, *items, limit, *arguments))

        return self._asked(call, answers, stop_at_hit, progress)

    def distance(
        self,
        cobject: CObject,
        q: ArrayLike,
        max_distance: float = np.inf,
        *,
        results: bool = False,
        space: Optional[Space] = None,
        stop_at_hit: bool = False,
        progress: Optional[Progress] = None,
    ) -> BatchDistances:
        """Query.distance for configurations (n, nq): the distances alone, with `results` the whole answers too, and with `space`, that of
        the C-object, the gradients.
        """
        place, items, most = pointer_of(CObject, "cobject", cobject), _items("q", q), scalar("max_distance", max_distance)
        nv = space.nv if space is not None and pointer_of(Space, "space", space) else None
        answers = BatchDistances(items[1], results, nv)
        wholes = ffi.NULL if answers.results is None else answers.results._c
        gradients = ffi.NULL if answers.gradients is None else pointer(answers.gradients, "double")
        outputs = pointer(answers.distances, "double"), wholes, gradients, 0 if gradients == ffi.NULL else nv

        def call(given: Any, function: Any, user: Any, statuses: Any, out: Any) -> int:
            arguments = given, function, user, *outputs, statuses, out
            return int(lib.cstk_distance_batch(self._pointer, place, *items, most, *arguments))

        return self._asked(call, answers, stop_at_hit, progress)

    def motion(
        self,
        cobject: CObject,
        q0: ArrayLike,
        q1: ArrayLike,
        *,
        threshold: float = 0.0,
        tolerance: Optional[float] = None,
        any_contact: bool = False,
        stop_at_hit: bool = False,
        progress: Optional[Progress] = None,
    ) -> BatchMotions:
        """Query.motion from each row of q0 to that of q1, both (n, nq): `motion(cobject, path[:-1], path[1:])` for those of a path."""
        place, starts, ends = pointer_of(CObject, "cobject", cobject), rows("q0", q0), rows("q1", q1)
        count, nq = same_length("q0", starts, "q1", ends), starts.shape[1]
        how = motion_options(threshold, tolerance, any_contact)
        answers = BatchMotions(count, nq)
        items = doubles(starts), doubles(ends), count, nq, how
        outputs = pointer(answers.reached, "double"), answers.results._c

        def call(given: Any, function: Any, user: Any, statuses: Any, out: Any) -> int:
            arguments = given, function, user, *outputs, statuses, out
            return int(lib.cstk_motion_batch(self._pointer, place, *items, *arguments))

        return self._asked(call, answers, stop_at_hit, progress)

    def pair_within(
        self,
        body_a: Body,
        poses_a: ArrayLike,
        body_b: Body,
        poses_b: ArrayLike,
        threshold: float = 0.0,
        *,
        stop_at_hit: bool = False,
        progress: Optional[Progress] = None,
    ) -> BatchWithin:
        """Query.pair_within for pairs of poses: both (n, 3, 4), or (n, 4, 4), which are copied."""
        items, limit = _pairs(body_a, poses_a, body_b, poses_b), scalar("threshold", threshold)
        answers = BatchWithin(items[4])
        within = pointer(answers.within, "bool")

        def call(given: Any, function: Any, user: Any, statuses: Any, out: Any) -> int:
            arguments = given, function, user, within, statuses, out
            return int(lib.cstk_pair_within_batch(self._pointer, *items, limit, *arguments))

        return self._asked(call, answers, stop_at_hit, progress)

    def pair_distance(
        self,
        body_a: Body,
        poses_a: ArrayLike,
        body_b: Body,
        poses_b: ArrayLike,
        max_distance: float = np.inf,
        *,
        results: bool = False,
        stop_at_hit: bool = False,
        progress: Optional[Progress] = None,
    ) -> BatchDistances:
        """Query.pair_distance for pairs of poses, both (n, 3, 4), or (n, 4, 4), which are copied: the distances alone, with `results` the
        whole answers too.
        """
        items, most = _pairs(body_a, poses_a, body_b, poses_b), scalar("max_distance", max_distance)
        answers = BatchDistances(items[4], results, None)
        wholes = ffi.NULL if answers.results is None else answers.results._c
        outputs = pointer(answers.distances, "double"), wholes

        def call(given: Any, function: Any, user: Any, statuses: Any, out: Any) -> int:
            arguments = given, function, user, *outputs, statuses, out
            return int(lib.cstk_pair_distance_batch(self._pointer, *items, most, *arguments))

        return self._asked(call, answers, stop_at_hit, progress)

    def statistics(self, reset: bool = False) -> QueryStatistics:
        """The work done by all threads since the batch was created, or since the last call with `reset`."""
        out = ffi.new("cstk_query_statistics *")
        check(lib.cstk_batch_get_statistics(self._pointer, bool(reset), out))
        return QueryStatistics(out)

    def _asked(
        self, call: Call, answers: AnyAnswers, stop_at_hit: bool, progress: Optional[Progress]
    ) -> AnyAnswers:
        """Makes a call that fills the arrays of `answers`."""
        given = options(
            "batch_options",
            threads=None if self.threads is None else index("threads", self.threads),
            limit=None if self.limit is None else index("limit", self.limit, 64),
            stop_at_hit=int(bool(stop_at_hit)),
        )
        statuses, out = pointer(answers.statuses, "int32_t"), ffi.new("cstk_batch_result *")
        take_callback_error()  # Of an earlier batch.
        try:
            reporting(lambda function, user: call(given, function, user, statuses, out), progress)
        except CancelledError as error:
            answers._blank(~answers.answered)
            error.answers = answers
            raise
        answers.result = BatchResult(out)
        if out.failed:
            answers.failure = error_of(int(answers.statuses[out.first_failed]))
        if out.answered < len(answers):
            answers._blank(~answers.answered)
        return answers

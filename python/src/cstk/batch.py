"""Batches: many configurations, motions or pairs of poses in one call, on several threads, without copies of arrays."""

from typing import Any, Callable, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import doubles, index, pointer, poses, rows, scalar
from ._handle import Handle, pointer_of
from ._native import ffi, lib
from ._options import options
from ._progress import Progress, reporting
from ._record import dtype_of
from .body import Body
from .cobject import CObject
from .errors import Error, WrongSizeError, check, error_of
from .motion import motion_options
from .records import BatchResult, QueryStatistics


class BatchAnswers:
    """The answers to a batch, in order of its items. Entries of items whose status is not 0 mean nothing."""

    __slots__ = ("values", "results", "gradients", "reached", "statuses", "done", "error")

    def __init__(self, count: int) -> None:
        self.values: NDArray[Any] = np.empty(0)
        """Classes as numbers of Class, truths of within, or distances."""
        self.results: Optional[NDArray[Any]] = None
        """Whole answers as a structured array, where they were asked for: `results["r_point"]`."""
        self.gradients: Optional[NDArray[np.float64]] = None
        self.reached: Optional[NDArray[np.float64]] = None
        """Of motions: the configurations at times[1]."""
        self.statuses: NDArray[np.int32] = np.empty(count, np.int32)
        """0 for each item that was answered."""
        self.done: BatchResult
        self.error: Optional[Error] = None
        """What the first item that failed would have raised alone."""

    def __len__(self) -> int:
        return len(self.statuses)


class Batch(Handle):
    """The caches of a batch's threads, kept from one call to the next. A batch serves one call at a time.

    Every call takes `threads` (0, the default, for as many as the machine runs at once), `stop_at_hit` (it then ends at the first item
    that is inside, within, at distance 0 or not free), `limit` (the work of each item, as Query.set_limit) and `progress`. Answers are
    those of single calls, bit for bit. Items that fail do so alone. Arrays of doubles, row by row in memory, are not copied.
    """

    __slots__ = ()
    _noun = "batch"

    def __init__(self) -> None:
        self._created()

    def statistics(self, reset: bool = False) -> QueryStatistics:
        """The work done by all threads since the batch was created, or since the last call with `reset`."""
        out = ffi.new("cstk_query_statistics *")
        check(lib.cstk_batch_get_statistics(self._pointer, bool(reset), out))
        return QueryStatistics(out)

    def classify_batch(self, cobject: CObject, q: ArrayLike, **how: Any) -> BatchAnswers:
        """Query.classify for each row of q, (n, nq)."""
        array = rows("q", q)
        answers = BatchAnswers(len(array))
        answers.values = np.empty(len(array), np.int32)
        items = self._pointer, pointer_of(CObject, "cobject", cobject), doubles(array), *array.shape
        return _run(lib.cstk_classify_batch, items, answers, (pointer(answers.values, "cstk_class"),), **how)

    def within_batch(self, cobject: CObject, q: ArrayLike, threshold: float, **how: Any) -> BatchAnswers:
        """Query.within for each row of q, (n, nq)."""
        array = rows("q", q)
        answers = BatchAnswers(len(array))
        answers.values = np.empty(len(array), np.bool_)
        place, limit = pointer_of(CObject, "cobject", cobject), scalar("threshold", threshold)
        items = self._pointer, place, doubles(array), *array.shape, limit
        return _run(lib.cstk_within_batch, items, answers, (pointer(answers.values, "bool"),), **how)

    def distance_batch(
        self,
        cobject: CObject,
        q: ArrayLike,
        max_distance: float = np.inf,
        *,
        nv: int = 0,
        whole: bool = False,
        **how: Any,
    ) -> BatchAnswers:
        """Query.distance for each row of q, (n, nq): the distances; with `nv`, the number of the space's velocities, also the gradients
        of the nearest pairs, (n, nv); with `whole` also the whole answers.
        """
        array = rows("q", q)
        answers = _distances(len(array), whole)
        if nv:
            answers.gradients = np.empty((len(array), index("nv", nv)))
        place, limit = pointer_of(CObject, "cobject", cobject), scalar("max_distance", max_distance)
        items = self._pointer, place, doubles(array), *array.shape, limit
        gradients = ffi.NULL if answers.gradients is None else doubles(answers.gradients)
        return _run(lib.cstk_distance_batch, items, answers, (*_distance_arrays(answers), gradients, nv), **how)

    def motion_batch(
        self,
        cobject: CObject,
        q0: ArrayLike,
        q1: ArrayLike,
        *,
        threshold: float = 0.0,
        tolerance: Optional[float] = None,
        any_contact: bool = False,
        **how: Any,
    ) -> BatchAnswers:
        """Query.motion from each row of q0 to that of q1: `results` has the outcomes and times, `reached` the configurations there. Of the
        segments of a path, q0 is path[:-1] and q1 path[1:].
        """
        a, b = rows("q0", q0), rows("q1", q1)
        if a.shape != b.shape:
            raise WrongSizeError(f"q0 has shape {a.shape}, q1 has {b.shape}")
        answers = BatchAnswers(len(a))
        answers.results = np.zeros(len(a), dtype_of("cstk_motion_result"))
        answers.values = answers.results["outcome"]
        answers.reached = np.empty(a.shape)
        given = motion_options(threshold, tolerance, any_contact)
        items = self._pointer, pointer_of(CObject, "cobject", cobject), doubles(a), doubles(b), *a.shape, given
        outputs = doubles(answers.reached), pointer(answers.results, "cstk_motion_result")
        return _run(lib.cstk_motion_batch, items, answers, outputs, **how)

    def pair_within_batch(
        self, body_a: Body, poses_a: ArrayLike, body_b: Body, poses_b: ArrayLike, threshold: float = 0.0, **how: Any
    ) -> BatchAnswers:
        """Query.pair_within for each pair of poses, (n, 3, 4) or (n, 4, 4)."""
        pairs, count = _pairs(body_a, poses_a, body_b, poses_b)
        answers = BatchAnswers(count)
        answers.values = np.empty(count, np.bool_)
        items = self._pointer, *pairs, scalar("threshold", threshold)
        return _run(lib.cstk_pair_within_batch, items, answers, (pointer(answers.values, "bool"),), **how)

    def pair_distance_batch(
        self,
        body_a: Body,
        poses_a: ArrayLike,
        body_b: Body,
        poses_b: ArrayLike,
        max_distance: float = np.inf,
        *,
        whole: bool = False,
        **how: Any,
    ) -> BatchAnswers:
        """Query.pair_distance for each pair of poses, (n, 3, 4) or (n, 4, 4)."""
        pairs, count = _pairs(body_a, poses_a, body_b, poses_b)
        answers = _distances(count, whole)
        items = self._pointer, *pairs, scalar("max_distance", max_distance)
        return _run(lib.cstk_pair_distance_batch, items, answers, _distance_arrays(answers), **how)


def _distances(count: int, whole: bool) -> BatchAnswers:
    answers = BatchAnswers(count)
    answers.values = np.empty(count)
    if whole:
        answers.results = np.zeros(count, dtype_of("cstk_distance_result"))
    return answers


def _distance_arrays(answers: BatchAnswers) -> Any:
    whole = ffi.NULL if answers.results is None else pointer(answers.results, "cstk_distance_result")
    return pointer(answers.values, "double"), whole


def _pairs(body_a: Body, poses_a: ArrayLike, body_b: Body, poses_b: ArrayLike) -> Any:
    a, b = poses("poses_a", poses_a), poses("poses_b", poses_b)
    if len(a) != len(b):
        raise WrongSizeError(f"poses_a has {len(a)} poses, poses_b has {len(b)}")
    first, second = pointer_of(Body, "body_a", body_a), pointer_of(Body, "body_b", body_b)
    return (first, doubles(a), second, doubles(b), len(a)), len(a)


def _run(
    call: Callable[..., int],
    items: Any,
    answers: BatchAnswers,
    outputs: Any,
    *,
    threads: Optional[int] = None,
    stop_at_hit: bool = False,
    limit: Optional[int] = None,
    progress: Optional[Progress] = None,
) -> BatchAnswers:
    """Makes a call: its items, the options, the progress function, its outputs, the statuses, and how it ended."""
    given = options(
        "batch_options",
        threads=None if threads is None else index("threads", threads),
        stop_at_hit=int(stop_at_hit),
        limit=None if limit is None else index("limit", limit, 64),
    )
    done = ffi.new("cstk_batch_result *")
    statuses = pointer(answers.statuses, "cstk_status")
    reporting(lambda function, user: call(*items, given, function, user, *outputs, statuses, done), progress)
    answers.done = BatchResult(done)
    if done.failed:
        answers.error = error_of(int(answers.statuses[done.first_failed]))
    return answers

"""Objects against objects: those of an environment among themselves, or against those of another."""

from __future__ import annotations

from typing import Any, Callable, Iterator, Optional, Tuple

import numpy as np

from ._arrays import index, scalar
from ._at_configuration import MAX_COUNT
from ._callback import callback
from ._callback_errors import keep_callback_error
from ._handle import Handle, pointer_of
from ._lists import WitnessList
from ._native import ffi, lib
from ._options import options
from ._record import Records
from ._user_data import Kept, data_of
from .environment import Environment
from .errors import check
from .records import DistanceResult, ObjectPair

Filter = Callable[[int, int], Any]
"""Whether a pair of objects is asked about, by their ids. It must be pure."""


class ObjectPairList:
    """Pairs of objects that are near each other, in order of ids. It is a sequence of them."""

    __slots__ = ("pairs", "distances", "truncated", "environment_version")

    pairs: Records[ObjectPair]
    distances: Optional[Records[DistanceResult]]
    """The distance of each pair, if asked for."""

    def __init__(self, given: Any, with_distances: bool) -> None:
        self.pairs = Records.copied(ObjectPair, given.pairs, given.count)
        self.distances = Records.copied(DistanceResult, given.distances, given.count) if with_distances else None
        self.truncated = bool(given.truncated)
        """There are more pairs than max_count; these have the lowest ids."""
        self.environment_version = int(given.environment_version)

    def __len__(self) -> int:
        return len(self.pairs)

    def __getitem__(self, number: int) -> ObjectPair:
        return self.pairs[number]

    def __iter__(self) -> Iterator[ObjectPair]:
        return iter(self.pairs)


@callback("int32_t(uint64_t, uint64_t, void *, void *, bool *, void *)", keep_callback_error)
def _admit(r_object: int, s_object: int, r_data: Any, s_data: Any, out: Any, user: Any) -> int:
    out[0] = bool(data_of(user)(r_object, s_object))
    return 0


def _sides(environment: Environment, other: Optional[Environment]) -> Tuple[Any, Any]:
    first = pointer_of(Environment, "environment", environment)
    return first, ffi.NULL if other is None else pointer_of(Environment, "other", other)


def _asking(call: Callable[[Any], int], filter: Optional[Filter], with_distances: bool = False) -> None:
    """Makes a call that takes options."""
    if filter is not None and not callable(filter):
        raise TypeError(f"filter must be a function, not {type(filter).__name__}")
    kept = Kept(filter)
    given = options("object_pair_options", with_distances=int(bool(with_distances)))
    if filter is not None:
        given.filter = _admit
        given.user = kept.pointer
    try:
        check(call(given))
    finally:
        if filter is not None:
            kept.drop()


class ObjectPairs(Handle):
    """The part of Query that asks about objects against objects: of an environment with `other`, or, without it, within the
    environment. `filter` gets two ids and returns whether the pair is asked about. Attached objects raise UnsupportedError.
    """

    __slots__ = ()

    def environment_pairs(
        self,
        environment: Environment,
        other: Optional[Environment] = None,
        distance: float = 0.0,
        max_count: int = MAX_COUNT,
        with_distances: bool = False,
        filter: Optional[Filter] = None,
    ) -> ObjectPairList:
        """The pairs at most a distance apart, in order of ids; with 0, those that meet."""
        out = ffi.new("cstk_object_pair_list *")
        sides = _sides(environment, other)
        limits = scalar("distance", distance), index("max_count", max_count, 64)
        query = self._pointer
        _asking(lambda given: lib.cstk_environment_pairs(query, *sides, *limits, given, out), filter, with_distances)
        return ObjectPairList(out[0], with_distances)

    def environment_within(
        self,
        environment: Environment,
        other: Optional[Environment] = None,
        threshold: float = 0.0,
        filter: Optional[Filter] = None,
    ) -> bool:
        """Whether any two objects are at most a threshold apart; with 0, whether any two meet."""
        out = ffi.new("bool *")
        sides, limit, query = _sides(environment, other), scalar("threshold", threshold), self._pointer
        _asking(lambda given: lib.cstk_environment_within(query, *sides, limit, given, out), filter)
        return bool(out[0])

    def environment_distance(
        self,
        environment: Environment,
        other: Optional[Environment] = None,
        max_distance: float = np.inf,
        filter: Optional[Filter] = None,
    ) -> DistanceResult:
        """The distance of the nearest two objects; its witness names them."""
        out = ffi.new("cstk_distance_result *")
        sides, limit, query = _sides(environment, other), scalar("max_distance", max_distance), self._pointer
        _asking(lambda given: lib.cstk_environment_distance(query, *sides, limit, given, out), filter)
        return DistanceResult(out)

    def environment_witnesses(
        self,
        environment: Environment,
        other: Optional[Environment] = None,
        epsilon: float = 0.0,
        max_count: int = MAX_COUNT,
        filter: Optional[Filter] = None,
    ) -> WitnessList:
        """All pairs of primitives of two objects at most `epsilon` apart, nearest first, and their contacts."""
        out = ffi.new("cstk_witness_list *")
        sides, query = _sides(environment, other), self._pointer
        limits = scalar("epsilon", epsilon), index("max_count", max_count, 64)
        _asking(lambda given: lib.cstk_environment_witnesses(query, *sides, *limits, given, out), filter)
        return WitnessList(out[0])

"""Query contexts."""

from __future__ import annotations

from typing import Optional

from ._arrays import index
from ._at_configuration import AtConfiguration
from ._handle import pointer_of
from ._native import ffi, lib
from ._pair import PairQueries
from .enums import ContactsListed
from .environment import Environment
from .errors import check
from .motion import Motions
from .object_pairs import ObjectPairs
from .records import QueryStatistics
from .region import Regions
from .slide import Slides


class Query(AtConfiguration, PairQueries, ObjectPairs, Motions, Regions, Slides):
    """One thread's caches and scratch memory: make one for each thread; a call while another runs raises BusyError. Caches change how
    long an answer takes, never the answer. Calls release Python's lock while they run.
    """

    __slots__ = ()
    _noun = "query"

    def __init__(self) -> None:
        self._created()

    def version(self, environment: Environment) -> int:
        """The version of an environment that the last query saw."""
        out = ffi.new("uint64_t *")
        place = pointer_of(Environment, "environment", environment)
        check(lib.cstk_query_get_version(self._pointer, place, out))
        return int(out[0])

    def set_contacts(self, listed: ContactsListed) -> None:
        """Which contacts come with the witnesses of lists from now on."""
        check(lib.cstk_query_set_contacts(self._pointer, ContactsListed(listed)))

    def set_limit(self, node_and_primitive_pairs: int) -> None:
        """Limits the work of each query from now on; 0 for no limit. A query that needs more raises LimitError."""
        pairs = index("node_and_primitive_pairs", node_and_primitive_pairs, 64)
        check(lib.cstk_query_set_limit(self._pointer, pairs))

    def set_refinement(self, gap: Optional[float]) -> None:
        """Refines curved surfaces until later distances, thresholds and classes are known to `gap`; None for never."""
        check(lib.cstk_query_set_refinement(self._pointer, float("inf") if gap is None else float(gap)))

    def statistics(self, reset: bool = False) -> QueryStatistics:
        """The work done since the context was created, or since the last call with `reset`."""
        out = ffi.new("cstk_query_statistics *")
        check(lib.cstk_query_get_statistics(self._pointer, bool(reset), out))
        return QueryStatistics(out)

"""Pair queries: two bodies at two poses, without a robot."""

from __future__ import annotations

from typing import Any, Tuple

import numpy as np
from numpy.typing import ArrayLike

from ._arrays import doubles, index, pose, scalar
from ._at_configuration import MAX_COUNT
from ._handle import Handle, pointer_of
from ._lists import PenetrationList, WitnessList
from ._native import ffi, lib
from ._options import options
from .body import Body
from .errors import check
from .records import DepthResult, DistanceResult


def pair_at(body_a: Body, pose_a: ArrayLike, body_b: Body, pose_b: ArrayLike) -> Tuple[Any, Any, Any, Any]:
    """Two bodies at two poses, as C takes them."""
    a, b = pointer_of(Body, "body_a", body_a), pointer_of(Body, "body_b", body_b)
    return a, doubles(pose("pose_a", pose_a)), b, doubles(pose("pose_b", pose_b))


class PairQueries(Handle):
    """The part of Query that asks about two bodies."""

    __slots__ = ()

    def pair_distance(
        self, body_a: Body, pose_a: ArrayLike, body_b: Body, pose_b: ArrayLike, max_distance: float = np.inf
    ) -> DistanceResult:
        """The distance of two bodies, and the nearest primitive pair. Distances above `max_distance` are not computed."""
        out = ffi.new("cstk_distance_result *")
        pair = pair_at(body_a, pose_a, body_b, pose_b)
        check(lib.cstk_pair_distance(self._pointer, *pair, scalar("max_distance", max_distance), out))
        return DistanceResult(out)

    def pair_within(
        self, body_a: Body, pose_a: ArrayLike, body_b: Body, pose_b: ArrayLike, threshold: float = 0.0
    ) -> bool:
        """Whether two bodies are at most a threshold apart; with 0, whether they meet. Doubt within rounding counts as within."""
        out = ffi.new("bool *")
        pair = pair_at(body_a, pose_a, body_b, pose_b)
        check(lib.cstk_pair_within(self._pointer, *pair, scalar("threshold", threshold), out))
        return bool(out[0])

    def pair_witnesses(
        self,
        body_a: Body,
        pose_a: ArrayLike,
        body_b: Body,
        pose_b: ArrayLike,
        epsilon: float,
        max_count: int = MAX_COUNT,
    ) -> WitnessList:
        """All primitive pairs at most `epsilon` apart, none missing, none twice, and their contacts."""
        out = ffi.new("cstk_witness_list *")
        pair = pair_at(body_a, pose_a, body_b, pose_b)
        limits = scalar("epsilon", epsilon), index("max_count", max_count, 64)
        check(lib.cstk_pair_witnesses(self._pointer, *pair, *limits, out))
        return WitnessList(out[0])

    def pair_penetration(
        self, body_a: Body, pose_a: ArrayLike, body_b: Body, pose_b: ArrayLike, max_count: int = MAX_COUNT
    ) -> PenetrationList:
        """All primitive pairs that meet, and the shortest translation that separates each: of two bodies of one convex primitive, the
        bodies themselves.
        """
        out = ffi.new("cstk_penetration_list *")
        pair = pair_at(body_a, pose_a, body_b, pose_b)
        check(lib.cstk_pair_penetration(self._pointer, *pair, index("max_count", max_count, 64), out))
        return PenetrationList(out[0])

    def pair_depth(
        self,
        body_a: Body,
        pose_a: ArrayLike,
        body_b: Body,
        pose_b: ArrayLike,
        tolerance: float = 0.0,
        max_steps: int = 0,
    ) -> DepthResult:
        """Bounds of the depth of two bodies, also unions and solids, and a translation of body a that parts them. With 0 the tolerance
        and the steps are the library's.
        """
        out = ffi.new("cstk_depth_result *")
        pair = pair_at(body_a, pose_a, body_b, pose_b)
        limits = {"tolerance": scalar("tolerance", tolerance), "max_steps": index("max_steps", max_steps, 64)}
        check(lib.cstk_pair_depth(self._pointer, *pair, options("depth_options", **limits), out))
        return DepthResult(out)

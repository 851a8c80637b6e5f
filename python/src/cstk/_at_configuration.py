"""Queries at a configuration: class, distance, witnesses, gradients."""

from __future__ import annotations

from typing import Any, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import doubles, index, poses, scalar, vector
from ._handle import Handle, pointer_of
from ._lists import Explanation, LinkPairs, PseudoNormal, SignedDistanceList, WitnessList
from ._native import ffi, lib
from ._options import options
from ._progress import Progress, reporting
from .cobject import CObject
from .enums import Class
from .errors import check
from .records import DistanceResult
from .space import Space

MAX_COUNT = 4096
"""How many witnesses are listed where the caller does not say."""


def set_at_q(cobject: CObject, q: ArrayLike) -> Tuple[Any, Any, int]:
    """A C-object and a configuration, as C takes them."""
    array = vector("q", q)
    return pointer_of(CObject, "cobject", cobject), doubles(array), array.size


def set_at_poses(cobject: CObject, link_poses: ArrayLike) -> Tuple[Any, Any, int]:
    array = poses("link_poses", link_poses)
    return pointer_of(CObject, "cobject", cobject), doubles(array), len(array)


class AtConfiguration(Handle):
    """The part of Query that asks about a C-object at a configuration q."""

    __slots__ = ()

    def classify(self, cobject: CObject, q: ArrayLike) -> Class:
        """INSIDE the C-object, in CONTACT with it, or OUTSIDE."""
        out = ffi.new("int32_t *")
        check(lib.cstk_classify(self._pointer, *set_at_q(cobject, q), out))
        return Class(out[0])

    def within(self, cobject: CObject, q: ArrayLike, threshold: float) -> bool:
        """Whether the distance is at most a threshold. Doubt within rounding counts as within. Cheaper than a distance."""
        out = ffi.new("bool *")
        check(lib.cstk_within(self._pointer, *set_at_q(cobject, q), scalar("threshold", threshold), out))
        return bool(out[0])

    def distance(self, cobject: CObject, q: ArrayLike, max_distance: float = np.inf) -> DistanceResult:
        """The distance from contact, and the nearest primitive pair. Distances above `max_distance` are not computed."""
        out = ffi.new("cstk_distance_result *")
        check(lib.cstk_distance(self._pointer, *set_at_q(cobject, q), scalar("max_distance", max_distance), out))
        return DistanceResult(out)

    def distance_with_gradient(
        self, cobject: CObject, q: ArrayLike, max_distance: float = np.inf
    ) -> Tuple[DistanceResult, NDArray[np.float64]]:
        """distance(), and its derivative with respect to each velocity, (nv,): 0 where the answer has no contact."""
        out = ffi.new("cstk_distance_result *")
        set_at_q(cobject, q)
        gradient = np.zeros(cobject.space.nv)
        limit = scalar("max_distance", max_distance)
        to = doubles(gradient), gradient.size
        check(lib.cstk_distance_with_gradient(self._pointer, *set_at_q(cobject, q), limit, out, *to))
        return DistanceResult(out), gradient

    def witnesses(self, cobject: CObject, q: ArrayLike, epsilon: float, max_count: int = MAX_COUNT) -> WitnessList:
        """All primitive pairs at most `epsilon` apart, none missing, none twice, and their contacts; the nearest `max_count`."""
        out = ffi.new("cstk_witness_list *")
        limits = scalar("epsilon", epsilon), index("max_count", max_count, 64)
        check(lib.cstk_witnesses(self._pointer, *set_at_q(cobject, q), *limits, out))
        return WitnessList(out[0])

    def gradients(self, cobject: CObject, q: ArrayLike, epsilon: float, max_count: int = MAX_COUNT) -> WitnessList:
        """witnesses(), with the gradient of each contact's distance: the way out in joint space."""
        out = ffi.new("cstk_witness_list *")
        limits = scalar("epsilon", epsilon), index("max_count", max_count, 64)
        check(lib.cstk_gradients(self._pointer, *set_at_q(cobject, q), *limits, out))
        return WitnessList(out[0])

    def signed_distances(
        self,
        cobject: CObject,
        q: ArrayLike,
        max_distance: float,
        max_count: int = MAX_COUNT,
        tolerance: float = 0.0,
        max_steps: int = 0,
    ) -> SignedDistanceList:
        """The signed distances of all pairs of bodies at most `max_distance` apart, each with its derivative: minus the depth where
        they meet. With 0 the tolerance of depths and the steps are the library's.
        """
        out = ffi.new("cstk_signed_distance_list *")
        limits = scalar("max_distance", max_distance), index("max_count", max_count, 64)
        depths = {"tolerance": scalar("tolerance", tolerance), "max_steps": index("max_steps", max_steps, 64)}
        given = options("depth_options", **depths)
        check(lib.cstk_signed_distances(self._pointer, *set_at_q(cobject, q), *limits, given, out))
        return SignedDistanceList(out[0])

    def pseudo_normal(
        self, cobject: CObject, q: ArrayLike, max_shell: float, max_count: int = MAX_COUNT, normalize: bool = False
    ) -> PseudoNormal:
        """Class, distance, and the witnesses and gradients within `max_shell`. `normalize` scales gradients to length 1."""
        out = ffi.new("cstk_pseudo_normal_result *")
        limits = scalar("max_shell", max_shell), index("max_count", max_count, 64), bool(normalize)
        check(lib.cstk_pseudo_normal(self._pointer, *set_at_q(cobject, q), *limits, out))
        return PseudoNormal(out)

    def explain(self, cobject: CObject, q: ArrayLike, max_count: int = MAX_COUNT) -> Explanation:
        """The class, and which leaves and pairs made it. Slower than classify()."""
        out = ffi.new("cstk_explanation *")
        check(lib.cstk_explain(self._pointer, *set_at_q(cobject, q), index("max_count", max_count, 64), out))
        return Explanation(out)

    def classify_at_link_poses(self, cobject: CObject, link_poses: ArrayLike) -> Class:
        """classify() for callers with their own kinematics: the pose of every link of the space, (n, 3, 4) or (n, 4, 4)."""
        out = ffi.new("int32_t *")
        check(lib.cstk_classify_at_link_poses(self._pointer, *set_at_poses(cobject, link_poses), out))
        return Class(out[0])

    def within_at_link_poses(self, cobject: CObject, link_poses: ArrayLike, threshold: float) -> bool:
        """within() at link poses."""
        out = ffi.new("bool *")
        arguments = *set_at_poses(cobject, link_poses), scalar("threshold", threshold)
        check(lib.cstk_within_at_link_poses(self._pointer, *arguments, out))
        return bool(out[0])

    def distance_at_link_poses(
        self, cobject: CObject, link_poses: ArrayLike, max_distance: float = np.inf
    ) -> DistanceResult:
        """distance() at link poses."""
        out = ffi.new("cstk_distance_result *")
        arguments = *set_at_poses(cobject, link_poses), scalar("max_distance", max_distance)
        check(lib.cstk_distance_at_link_poses(self._pointer, *arguments, out))
        return DistanceResult(out)

    def witnesses_at_link_poses(
        self, cobject: CObject, link_poses: ArrayLike, epsilon: float, max_count: int = MAX_COUNT
    ) -> WitnessList:
        """witnesses() at link poses."""
        out = ffi.new("cstk_witness_list *")
        limits = scalar("epsilon", epsilon), index("max_count", max_count, 64)
        check(lib.cstk_witnesses_at_link_poses(self._pointer, *set_at_poses(cobject, link_poses), *limits, out))
        return WitnessList(out[0])

    def explain_at_link_poses(
        self, cobject: CObject, link_poses: ArrayLike, max_count: int = MAX_COUNT
    ) -> Explanation:
        """explain() at link poses."""
        out = ffi.new("cstk_explanation *")
        arguments = *set_at_poses(cobject, link_poses), index("max_count", max_count, 64)
        check(lib.cstk_explain_at_link_poses(self._pointer, *arguments, out))
        return Explanation(out)

    def find_link_pairs(
        self,
        space: Space,
        *,
        samples: Optional[int] = None,
        seed: Optional[int] = None,
        rest: Optional[ArrayLike] = None,
        margin: Optional[float] = None,
        always: Optional[float] = None,
        skip_never: bool = False,
        progress: Optional[Progress] = None,
    ) -> LinkPairs:
        """Which pairs of links to test for self-collision, and why the others are left out: links that are joined, that touch at rest,
        or in at least `always` (default 0.95) of the sampled configurations (default 1000).
        """
        place = pointer_of(Space, "space", space)
        at_rest = None if rest is None else doubles(vector("rest", rest, space.nq))
        given = options(
            "link_pair_options",
            samples=None if samples is None else index("samples", samples, 64),
            seed=None if seed is None else index("seed", seed, 64),
            rest=at_rest,
            margin=None if margin is None else scalar("margin", margin),
            always=None if always is None else scalar("always", always),
            skip_never=int(skip_never),
        )
        out = ffi.new("cstk_link_pair_list *")
        query = self._pointer
        reporting(lambda function, user: lib.cstk_find_link_pairs(query, place, given, function, user, out), progress)
        return LinkPairs(out)

    def prove_clear_pairs(
        self, cobject: CObject, *, max_blocks: Optional[int] = None, progress: Optional[Progress] = None
    ) -> CObject:
        """A copy of a set of link pairs (CObject.induced_links) that knows by proof where its links are apart, so that classes and
        motions need not look at them there. Takes up to some seconds, once for a robot; `max_blocks` (default 20000) a pair bounds it.
        """
        given = options(
            "clear_pair_options", max_blocks=None if max_blocks is None else index("max_blocks", max_blocks, 64)
        )
        query, of = self._pointer, pointer_of(CObject, "cobject", cobject)
        out = ffi.new("cstk_cobject **")
        reporting(
            lambda function, user: lib.cstk_prove_clear_pairs(query, of, given, function, user, ffi.NULL, out), progress
        )
        return CObject._take(out[0])

"""Hierarchies: how bodies' trees of bounding volumes are built, and what is seen of them. They affect the speed of queries, never
their answers.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any, NamedTuple, Optional

import numpy as np
from numpy.typing import NDArray

from ._native import ffi, lib
from ._options import options
from .enums import Grouping, Pieces, WrapperKind
from .errors import check


@dataclass(frozen=True)
class HierarchyOptions:
    """How a hierarchy is built. What is None is the library's default."""

    hull_vertex_limit: Optional[int] = None
    """The most vertices of a convex hull; larger ones become oriented boxes. At least 8; default 32."""
    threads: Optional[int] = None
    """Threads to build on; 0 for as many as the machine runs at once. Default 1. The hierarchy does not depend on it."""
    grouping: Optional[Grouping] = None
    wrapper: Optional[WrapperKind] = None
    pieces: Optional[Pieces] = None
    cost_diameter: Optional[float] = None
    """A (at most 16), B and C of the cost of merging two clusters, diameter^A (B Fill + C Balance)."""
    cost_fill: Optional[float] = None
    cost_balance: Optional[float] = None
    diameter_limit: Optional[float] = None
    """The largest diameter of clusters merged in the first round, and the largest gap; both double from round to round."""
    gap_limit: Optional[float] = None
    aspect_limit: Optional[float] = None
    """Primitives longer than this many times their width get several leaves. At least 1.5, or 0, the default, for one each."""


def hierarchy_options(given: Optional[HierarchyOptions]) -> Any:
    """The structure of C; NULL for the defaults."""
    if given is None:
        return ffi.NULL
    if not isinstance(given, HierarchyOptions):
        raise TypeError(f"hierarchy must be a cstk.HierarchyOptions, not {type(given).__name__}")
    return options("hierarchy_options", **asdict(given))


class Mesh(NamedTuple):
    """Polygons for display."""

    vertices: NDArray[np.float64]
    """(n, 3)"""
    face_sizes: NDArray[np.uint32]
    """For each face, its number of vertices."""
    face_nodes: NDArray[np.uint32]
    """For each face, the node it stands for."""
    indices: NDArray[np.uint32]
    """The vertex indices of the faces, face after face, counter-clockwise seen from outside."""


def _copied(first: Any, count: int, dtype: Any) -> NDArray[Any]:
    if not count:
        return np.empty(0, dtype)
    return np.frombuffer(ffi.buffer(first, count * np.dtype(dtype).itemsize), dtype).copy()


def mesh_of(owned: Any) -> Mesh:
    """Copies a mesh of the library, and releases it."""
    try:
        view = ffi.new("cstk_mesh_view *")
        check(lib.cstk_mesh_get_view(owned, view))
        return Mesh(
            _copied(view.vertices, 3 * view.vertex_count, np.float64).reshape(-1, 3),
            _copied(view.face_sizes, view.face_count, np.uint32),
            _copied(view.face_nodes, view.face_count, np.uint32),
            _copied(view.indices, view.index_count, np.uint32),
        )
    finally:
        lib.cstk_mesh_release(owned)

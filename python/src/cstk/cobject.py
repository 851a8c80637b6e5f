"""C-objects: sets in C-space, induced by contact, given by coordinates or functions, or combined from others."""

from __future__ import annotations

import os
from typing import Any, Callable, Iterable, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import doubles, file_name, index, integers, pointer, pointers, rows, same_length, scalar, vector
from ._callback import callback
from ._callback_errors import keep_callback_error
from ._handle import Handle, pointer_of
from ._native import ffi, lib
from ._options import options
from ._user_data import Kept, data_of
from .enums import Class
from .environment import Environment
from .errors import WrongSizeError, check
from .space import Space

Array = NDArray[np.float64]
AllowedPair = Union[Tuple[int, int], Tuple[int, int, int]]
"""A link and an s-object that it may meet; third, where it is the one that meets, an s-object attached to the link."""


class CObject(Handle):
    """A set in C-space. It never changes, but for the environments it refers to; threads may share it.

    The operators are those of sets: `a | b`, `a & b`, `a - b`, `~a`.
    """

    __slots__ = ()
    _noun = "cobject"

    def __init__(self) -> None:
        raise TypeError("C-objects are made by class methods: CObject.induced(space, environment)")

    @classmethod
    def _made(cls, call: Any, *arguments: Any) -> "CObject":
        out = ffi.new("cstk_cobject **")
        check(call(*arguments, out))
        return cls._take(out[0])

    @classmethod
    def induced(
        cls,
        space: Space,
        environment: Environment,
        *,
        links: ArrayLike = (),
        ids: ArrayLike = (),
        contact_epsilon: float = 0.0,
        margin: float = 0.0,
        allowed: Iterable[AllowedPair] = (),
        leave_out_unmoved: bool = False,
    ) -> "CObject":
        """Where a link meets an s-object. No links: all of the space, with what is attached to them, be it to a frame without a body. Of
        given links no other is tested, nor what is attached to others. No ids: all objects, those added later too. Distances up to
        `contact_epsilon` are Class.CONTACT; `margin` is subtracted from every distance; pairs in `allowed` may meet.
        `leave_out_unmoved` leaves out pairs that no coordinate moves: a base and the table that it stands on.
        """
        numbers, objects = integers("links", links, np.uint32), integers("ids", ids, np.uint64)
        pairs = [_allowed(f"allowed[{i}]", pair) for i, pair in enumerate(allowed)]
        pairs_array = ffi.new("cstk_allowed_pair[]", pairs) if pairs else ffi.NULL
        given = _induced(
            contact_epsilon,
            margin,
            allowed=pairs_array,
            allowed_count=len(pairs),
            leave_out_unmoved=int(bool(leave_out_unmoved)),
        )
        return cls._made(
            lib.cstk_cobject_induced,
            pointer_of(Space, "space", space),
            pointer(numbers, "uint32_t"),
            numbers.size,
            pointer_of(Environment, "environment", environment),
            pointer(objects, "uint64_t"),
            objects.size,
            given,
        )

    @classmethod
    def induced_links(
        cls, space: Space, pairs: ArrayLike, *, contact_epsilon: float = 0.0, margin: float = 0.0
    ) -> "CObject":
        """Where two links meet: a robot with itself, robots with each other. `pairs` is (n, 2); see Query.find_link_pairs."""
        numbers = integers("pairs", pairs, np.uint32)
        if numbers.size and (numbers.ndim != 2 or numbers.shape[1] != 2):
            raise WrongSizeError(f"pairs has shape {numbers.shape}; needed: (n, 2)")
        given = _induced(contact_epsilon, margin)
        place = pointer_of(Space, "space", space)
        return cls._made(lib.cstk_cobject_induced_links, place, pointer(numbers, "uint32_t"), numbers.size // 2, given)

    @property
    def space(self) -> Space:
        """The space that the set is in."""
        out = ffi.new("cstk_space **")
        check(lib.cstk_cobject_get_space(self._pointer, out))
        return Space._take(out[0])

    @classmethod
    def beyond_limits(cls, space: Space, *, contact_epsilon: float = 0.0, scale: float = 0.0) -> "CObject":
        """Where a coordinate is outside its range. `scale` is the length that a unit of C-space stands for: 0 makes distances of the
        set not comparable with those of induced sets.
        """
        given = _pure(contact_epsilon, scale)
        return cls._made(lib.cstk_cobject_beyond_limits, pointer_of(Space, "space", space), given)

    @classmethod
    def beyond_world(cls, space: Space, *, contact_epsilon: float = 0.0, scale: float = 0.0) -> "CObject":
        """Where the origin of a link is outside the world box."""
        given = _pure(contact_epsilon, scale)
        return cls._made(lib.cstk_cobject_beyond_world, pointer_of(Space, "space", space), given)

    @classmethod
    def below_floor(
        cls,
        space: Space,
        normal: ArrayLike,
        offset: float,
        *,
        links: ArrayLike = (),
        contact_epsilon: float = 0.0,
        scale: float = 0.0,
    ) -> "CObject":
        """Where a link's body reaches the half-space normal . x <= offset of the world. No links: all with a body."""
        numbers = integers("links", links, np.uint32)
        return cls._made(
            lib.cstk_cobject_below_floor,
            pointer_of(Space, "space", space),
            pointer(numbers, "uint32_t"),
            numbers.size,
            doubles(vector("normal", normal, 3)),
            scalar("offset", offset),
            _pure(contact_epsilon, scale),
        )

    @classmethod
    def box(
        cls, space: Space, low: ArrayLike, high: ArrayLike, *, contact_epsilon: float = 0.0, scale: float = 0.0
    ) -> "CObject":
        """Where every coordinate is in [low, high]; infinite ends leave it free, and on a circle it is the arc from low upwards."""
        a, b = vector("low", low), vector("high", high)
        nq = same_length("low", a, "high", b)
        given = _pure(contact_epsilon, scale)
        return cls._made(lib.cstk_cobject_box, pointer_of(Space, "space", space), doubles(a), doubles(b), nq, given)

    @classmethod
    def halfspace(
        cls, space: Space, normal: ArrayLike, offset: float, *, contact_epsilon: float = 0.0, scale: float = 0.0
    ) -> "CObject":
        """Where normal . q <= offset."""
        array = vector("normal", normal)
        place, given = pointer_of(Space, "space", space), _pure(contact_epsilon, scale)
        arguments = doubles(array), array.size, scalar("offset", offset)
        return cls._made(lib.cstk_cobject_halfspace, place, *arguments, given)

    @classmethod
    def ball(
        cls, space: Space, center: ArrayLike, radius: float, *, contact_epsilon: float = 0.0, scale: float = 0.0
    ) -> "CObject":
        """Where q is within a radius of the center."""
        array = vector("center", center)
        place, given = pointer_of(Space, "space", space), _pure(contact_epsilon, scale)
        arguments = doubles(array), array.size, scalar("radius", radius)
        return cls._made(lib.cstk_cobject_ball, place, *arguments, given)

    @classmethod
    def predicate(
        cls,
        space: Space,
        classify: Callable[[Array], Class],
        distance: Optional[Callable[[Array], float]] = None,
        gradient: Optional[Callable[[Array], ArrayLike]] = None,
        *,
        distance_is_bound: bool = False,
        knows_depth: bool = False,
        contact_epsilon: float = 0.0,
        scale: float = 0.0,
    ) -> "CObject":
        """A set by functions of q: its class, its signed distance (positive outside) and the derivative of that, `nv` numbers. Threads
        may call them at once; they must be pure and must not use the running Query. What they raise is the `__cause__` of a
        CallbackFailedError. Slides and motions refuse sets that do not measure.
        """
        functions = _Predicate(classify, distance, gradient)
        place = pointer_of(Space, "space", space)
        with Kept(functions) as kept:
            given = options(
                "predicate",
                classify=_classify,
                distance=None if distance is None else _distance,
                gradient=None if gradient is None else _gradient,
                user=kept.pointer,
                destroy=kept.destroy,
                distance_is_bound=int(distance_is_bound),
                knows_depth=int(knows_depth),
            )
            return cls._made(lib.cstk_cobject_predicate, place, given, _pure(contact_epsilon, scale))

    @classmethod
    def union(cls, parts: Sequence["CObject"]) -> "CObject":
        """Its class is the largest of the parts'. Queries on a union of induced sets are exact."""
        return cls._combined(lib.cstk_cobject_union, parts)

    @classmethod
    def intersection(cls, parts: Sequence["CObject"]) -> "CObject":
        """Its class is the smallest of the parts'."""
        return cls._combined(lib.cstk_cobject_intersection, parts)

    @classmethod
    def _combined(cls, call: Any, parts: Sequence["CObject"]) -> "CObject":
        handles = [pointer_of(CObject, f"parts[{i}]", part) for i, part in enumerate(parts)]
        return cls._made(call, pointers(handles, "cstk_cobject"), len(handles))

    def complement(self) -> "CObject":
        """Exchanges INSIDE and OUTSIDE; contact stays."""
        return self._made(lib.cstk_cobject_complement, self._pointer)

    def difference(self, without: "CObject") -> "CObject":
        """This set without another."""
        return self._made(lib.cstk_cobject_difference, self._pointer, pointer_of(CObject, "without", without))

    def __or__(self, other: "CObject") -> "CObject":
        return self.union([self, other]) if isinstance(other, CObject) else NotImplemented

    def __and__(self, other: "CObject") -> "CObject":
        return self.intersection([self, other]) if isinstance(other, CObject) else NotImplemented

    def __sub__(self, other: "CObject") -> "CObject":
        return self.difference(other) if isinstance(other, CObject) else NotImplemented

    def __invert__(self) -> "CObject":
        return self.complement()

    def with_data(self, data: Any) -> "CObject":
        """The same set, carrying an object that answers hand back where it is a leaf."""
        with Kept(data) as kept:
            return self._made(lib.cstk_cobject_with_data, self._pointer, kept.pointer, kept.destroy)

    def with_shell(self, shell: float) -> "CObject":
        """The same induced or pure set with a shell of its own for slides."""
        return self._made(lib.cstk_cobject_with_shell, self._pointer, scalar("shell", shell))

    def with_known(self, within: "CObject", known: Class) -> "CObject":
        """The same set with what the caller knows of it: its class, OUTSIDE or INSIDE, in the interior of `within`, a box, a ball, a
        half-space, an intersection of these, or a union of those. No geometry is asked there, and the caller's word is taken for it."""
        return self._made(lib.cstk_cobject_with_known, self._pointer, pointer_of(CObject, "within", within), int(Class(known)))

    @property
    def data(self) -> Any:
        """What with_data attached, or None."""
        out = ffi.new("void **")
        check(lib.cstk_cobject_get_data(self._pointer, out, ffi.NULL))
        return data_of(out[0])

    @property
    def number(self) -> int:
        """By which witnesses and explanations name it as a leaf."""
        out = ffi.new("uint64_t *")
        check(lib.cstk_cobject_get_data(self._pointer, ffi.NULL, out))
        return int(out[0])

    def show(self, q: ArrayLike, file: "os.PathLike[str] | str") -> None:
        """Writes the scene at q to a .glb file: links, s-objects, the nearest points, contacts, normals and gradients."""
        array = vector("q", q)
        check(lib.cstk_show(self._pointer, doubles(array), array.size, file_name("file", file)))

    def show_path(self, points: ArrayLike, seconds: float, file: "os.PathLike[str] | str") -> None:
        """Writes a .glb file in which the robots move along a path through `points`, (n, nq), within so many seconds."""
        array = rows("points", points)
        path = doubles(array), *array.shape, scalar("seconds", seconds)
        check(lib.cstk_show_path(self._pointer, *path, file_name("file", file)))


class _Predicate:
    def __init__(self, classify: Any, distance: Any, gradient: Any) -> None:
        for name, function in ("classify", classify), ("distance", distance), ("gradient", gradient):
            if not callable(function) and (function is not None or name == "classify"):
                raise TypeError(f"{name} must be a function, not {type(function).__name__}")
        self.classify, self.distance, self.gradient = classify, distance, gradient


@callback("int32_t(double *, size_t, int32_t *, void *)", keep_callback_error)
def _classify(q: Any, nq: int, out: Any, user: Any) -> int:
    out[0] = Class(data_of(user).classify(np.array(ffi.unpack(q, nq))))
    return 0


@callback("int32_t(double *, size_t, double *, void *)", keep_callback_error)
def _distance(q: Any, nq: int, out: Any, user: Any) -> int:
    out[0] = scalar("the predicate's distance", data_of(user).distance(np.array(ffi.unpack(q, nq))))
    return 0


@callback("int32_t(double *, size_t, double *, size_t, void *)", keep_callback_error)
def _gradient(q: Any, nq: int, row: Any, nv: int, user: Any) -> int:
    found = vector("the predicate's gradient", data_of(user).gradient(np.array(ffi.unpack(q, nq))), nv)
    row[0:nv] = found.tolist()
    return 0


def _induced(contact_epsilon: float, margin: float, **more: Any) -> Any:
    lengths = {"contact_epsilon": scalar("contact_epsilon", contact_epsilon), "margin": scalar("margin", margin)}
    return options("induced_options", **lengths, **more)


def _pure(contact_epsilon: float, scale: float) -> Any:
    epsilon = scalar("contact_epsilon", contact_epsilon)
    return options("pure_options", contact_epsilon=epsilon, scale=scalar("scale", scale))


def _allowed(name: str, pair: AllowedPair) -> Any:
    if len(pair) not in (2, 3):
        raise WrongSizeError(f"{name} has {len(pair)} entries; needed: link and object, or link, object and attached object")
    link, object_id, *attached = pair
    return {
        "link": index(f"{name}[0]", link),
        "object": index(f"{name}[1]", object_id, 64),
        "attached": index(f"{name}[2]", attached[0], 64) if attached else 0,
    }

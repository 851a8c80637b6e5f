"""One reference to an object of the library."""

from __future__ import annotations

from typing import Any, ClassVar, Optional, Type, TypeVar

from ._native import ffi, lib
from .errors import ReleasedError, check

AnyHandle = TypeVar("AnyHandle", bound="Handle")


class Handle:
    """One reference to an object of the library. It is dropped by release(), at the end of a `with` block, or with the Python object;
    calls that still run in other threads keep theirs until they end. The library keeps what it needs itself: a body may be released
    as soon as the robot is built.
    """

    __slots__ = ("_c", "__weakref__")
    _noun: ClassVar[str]
    _c: Any

    @classmethod
    def _take(cls: Type[AnyHandle], owned: Any) -> AnyHandle:
        """Takes over the reference that a call gave."""
        handle = cls.__new__(cls)
        handle._c = ffi.gc(owned, getattr(lib, f"cstk_{cls._noun}_release"))
        return handle

    def _created(self, *arguments: Any) -> None:
        """Takes over what `cstk_<noun>_create` makes."""
        out = ffi.new(f"cstk_{self._noun} **")
        check(getattr(lib, f"cstk_{self._noun}_create")(*arguments, out))
        self._c = ffi.gc(out[0], getattr(lib, f"cstk_{self._noun}_release"))

    @property
    def _pointer(self) -> Any:
        c = self._c
        if c is None:
            raise ReleasedError(f"the {type(self).__name__} was released")
        return c

    def release(self) -> None:
        """Drops the reference; using the object afterwards raises ReleasedError. A second call does nothing."""
        # Calls that run hold the pointer too: the last of them drops it.
        self._c = None

    @property
    def released(self) -> bool:
        return self._c is None

    def __enter__(self: AnyHandle) -> AnyHandle:
        self._pointer
        return self

    def __exit__(self, *error: Any) -> None:
        self.release()

    def __repr__(self) -> str:
        return f"<cstk.{type(self).__name__}{' (released)' if self.released else ''}>"

    def __reduce__(self) -> Any:
        raise TypeError(f"a cstk.{type(self).__name__} cannot be pickled")


def pointer_of(kind: Type[Handle], name: str, value: Optional[Handle]) -> Any:
    """The pointer of an argument."""
    if not isinstance(value, kind):
        raise TypeError(f"{name} must be a cstk.{kind.__name__}, not {type(value).__name__}")
    c = value._c
    if c is None:
        raise ReleasedError(f"{name} is a cstk.{kind.__name__} that was released")
    return c

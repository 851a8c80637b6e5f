"""Objects of the caller's behind the void pointers of C.

A pointer is a number that is never used again, not an address: an answer that outlives its body asks for nothing freed. Only the
names of a planning scene's objects are the library's, at addresses that it may use again; so each counts for its object only.
"""

from __future__ import annotations

import itertools
from typing import Any, Dict, Optional, Tuple

from ._callback import callback
from ._callback_errors import keep_to_raise
from ._native import ffi

_numbers = itertools.count(1)
_kept: Dict[int, Any] = {}
# By the address of the name, so that they are no more than there were names at once.
_names: Dict[int, Tuple[int, str]] = {}


@callback("void(void *)", keep_to_raise)
def drop(user: Any, kept: Dict[int, Any] = _kept, address: Any = ffi.cast) -> None:
    """The library's last reference is gone. This may be when the process ends, and the names of this module with it. An interrupt
    meanwhile is raised by the call that runs, or by the next one where Python collects garbage.
    """
    kept.pop(int(address("uintptr_t", user)), None)


def keep(value: Any) -> Any:
    """The pointer that stands for an object until drop."""
    number = next(_numbers)
    _kept[number] = value
    return ffi.cast("void *", number)


def data_of(pointer: Any) -> Any:
    """The object that a pointer stands for; None for NULL, and once it was dropped."""
    return _kept.get(int(ffi.cast("uintptr_t", pointer)))


def keep_name(pointer: Any, id: int) -> None:
    """Copies the name of a planning scene's object, which the caller keeps from being deleted meanwhile."""
    _names[int(ffi.cast("uintptr_t", pointer))] = id, ffi.string(ffi.cast("char *", pointer)).decode()


def data_of_object(pointer: Any, id: int) -> Any:
    """The data of an s-object, or of its body: as data_of, or the name that a planning scene gave it."""
    named = _names.get(int(ffi.cast("uintptr_t", pointer)))
    return named[1] if named is not None and named[0] == id else data_of(pointer)


class Kept:
    """Keeps an object while a call takes it over: it is dropped again unless the call succeeds."""

    def __init__(self, value: Optional[Any]) -> None:
        self.pointer = ffi.NULL if value is None else keep(value)
        self.destroy = ffi.NULL if value is None else drop

    def __enter__(self) -> "Kept":
        return self

    def __exit__(self, kind: Any, error: Any, trace: Any) -> None:
        if error is not None:
            self.drop()

    def drop(self) -> None:
        _kept.pop(int(ffi.cast("uintptr_t", self.pointer)), None)


def kept_count() -> int:
    """The number of objects that the library holds; for tests of leaks."""
    return len(_kept)

"""Exceptions: one class for each status of the C API, with the library's message, which names the culprit.

All are `Error`; each is also the exception of Python's that fits best, so that `except ValueError` does what it should.
"""

from __future__ import annotations

from typing import Any, Dict, Optional, Type

from ._callback_errors import raise_kept, take_callback_error
from ._native import ffi, lib

__all__ = [
    "Error",
    "NullArgumentError",
    "WrongHandleError",
    "ReleasedError",
    "NotInitialisedError",
    "InvalidArgumentError",
    "NotFiniteError",
    "WrongSizeError",
    "EmptyError",
    "DegenerateError",
    "NotConvexError",
    "NotPlanarError",
    "NotARotationError",
    "NotFoundError",
    "UnsupportedError",
    "IoError",
    "ParseError",
    "NotConvergedError",
    "CancelledError",
    "BusyError",
    "InternalError",
    "CallbackFailedError",
    "NotClosedError",
    "LimitError",
    "OutOfMemoryError",
    "NotProvedError",
]


class Error(Exception):
    """A call that failed. `status` is the number that C programs see, `status_name` its name."""

    status: int = 0

    @property
    def status_name(self) -> str:
        return str(ffi.string(lib.cstk_status_name(self.status)).decode())


class NullArgumentError(Error, TypeError):
    """An argument that must be given is not."""


class WrongHandleError(Error, ValueError):
    """An object is of another kind, or was released."""


class ReleasedError(WrongHandleError):
    """An object was released, by release() or by the end of its `with` block."""


class NotInitialisedError(Error, ValueError):
    """Options are damaged."""


class InvalidArgumentError(Error, ValueError):
    """An argument is outside its documented range."""


class NotFiniteError(Error, ValueError):
    """A number is NaN or infinite where a finite one is needed."""


class WrongSizeError(Error, ValueError):
    """An array has the wrong shape."""


class EmptyError(Error, ValueError):
    """No item was given where at least one is needed: a body without primitives, a robot without links."""


class DegenerateError(Error, ValueError):
    """Geometry without extent: a repeated vertex, a polygon without area, an axis of length 0."""


class NotConvexError(Error, ValueError):
    """A polygon that turns inwards, winds more than once, or crosses itself."""


class NotPlanarError(Error, ValueError):
    """A polygon whose vertices leave its plane, or a planar body that leaves z = 0."""


class NotARotationError(Error, ValueError):
    """The 3 x 3 part of a pose is not a rotation."""


class NotFoundError(Error, LookupError):
    """An id, index or name that does not exist."""


class UnsupportedError(Error, NotImplementedError):
    """Something that the library does not support: an unknown file format, a change to a snapshot."""


class IoError(Error, OSError):
    """The operating system could not read or write a file."""


class ParseError(Error, ValueError):
    """A file's contents cannot be understood; it may be truncated."""


class NotConvergedError(Error, ArithmeticError):
    """A result could not be certified."""


class CancelledError(Error, RuntimeError):
    """The progress function stopped the call. Of a batch, `answers` has what was answered until then."""

    answers: Any = None


class BusyError(Error, RuntimeError):
    """The object is in use by another thread, or by the call whose callback makes this one."""


class InternalError(Error, RuntimeError):
    """An internal fault of the library, which was contained; please report it with the message."""


class CallbackFailedError(Error, RuntimeError):
    """A function of yours failed; `__cause__` is what it raised, where this thread called it. KeyboardInterrupt and SystemExit pass
    through instead.
    """


class NotClosedError(Error, ValueError):
    """A body was declared solid whose surface is not closed; the message names open edges."""


class LimitError(Error, RuntimeError):
    """The query needs more work than `Query.set_limit` allows."""


class OutOfMemoryError(Error, MemoryError):
    """There is not enough memory for the input."""


class NotProvedError(Error):
    """A certificate does not prove what is asked; the message names the entry."""


def _by_status() -> Dict[int, Type[Error]]:
    """Each class by the status whose name it has: NotFiniteError by CSTK_ERROR_NOT_FINITE."""
    found = {}
    for name, number in ffi.typeof("enum cstk_status").relements.items():
        words = name.removeprefix("CSTK_ERROR_").replace("_", " ").title().replace(" ", "")
        kind = globals().get(f"{words}Error")
        if kind is not None:
            kind.status = number
            found[number] = kind
    ReleasedError.status = WrongHandleError.status
    return found


BY_STATUS: Dict[int, Type[Error]] = _by_status()


def error_of(status: int) -> Error:
    """The exception of a call that failed on this thread."""
    message = ffi.string(lib.cstk_last_error_message()).decode()
    error = BY_STATUS.get(status, Error)(message)
    error.status = status
    cause: Optional[Exception] = take_callback_error()
    if isinstance(error, CallbackFailedError):
        error.__cause__ = cause
    return error


def check(status: int) -> None:
    """Raises unless the call succeeded, and what a function of the caller's raised to end the program."""
    raise_kept()
    if status:
        raise error_of(status)

"""Arrays on their way in: checked, with exceptions that name the argument. What C can check (numbers that are not finite, ranges)
C checks; its messages use the same names.
"""

from __future__ import annotations

import os
from typing import Any, Optional, Sequence, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._native import ffi
from .errors import InvalidArgumentError, NotFiniteError, WrongSizeError

Doubles = NDArray[np.float64]

# Nearly every array's own, which is found sooner than one that is equal; and a type that need not be parsed at each call.
_FLOAT64 = np.dtype(np.float64)
_DOUBLES = ffi.typeof("double[]")


def numbers(name: str, value: ArrayLike) -> Doubles:
    """An array of doubles, row by row in memory: the given one where it is that already."""
    if type(value) is np.ndarray and value.dtype is _FLOAT64:
        flags = value.flags
        if flags.c_contiguous and flags.aligned:
            return value
    _not_masked(name, value)
    try:
        array = np.asarray(value)
    except ValueError as error:
        raise WrongSizeError(f"{name} is no array: {error}") from None
    if array.dtype != np.float64:
        if array.dtype.kind not in "fiu" and array.size:
            raise TypeError(f"{name} holds {array.dtype}, not real numbers")
        array = array.astype(np.float64)
    return as_in_c(array) if array.ndim else array


def as_in_c(array: NDArray[Any]) -> NDArray[Any]:
    """Row by row in memory, at addresses that C may read its type from: a copy where it is not."""
    return np.atleast_1d(np.require(array, requirements=("C", "A")))


def _not_masked(name: str, value: Any) -> None:
    """Refuses arrays with a mask, which the library would not see, and lists of them."""
    of_rows = isinstance(value, (list, tuple)) and len(value) > 0 and hasattr(value[0], "__len__")
    if isinstance(value, np.ma.MaskedArray) or (of_rows and any(isinstance(row, np.ma.MaskedArray) for row in value)):
        raise TypeError(f"{name} is a masked array; fill it, or leave out what is masked")


def finite(name: str, array: Doubles) -> Doubles:
    """Refuses NaN and infinity; for what C does not look at."""
    if not np.isfinite(array).all():
        where = tuple(int(index) for index in np.argwhere(~np.isfinite(array))[0])
        raise NotFiniteError(f"{name}{list(where) if where else ''} is not finite")
    return array


def vector(name: str, value: ArrayLike, length: Optional[int] = None) -> Doubles:
    """A vector, of a length if it is given."""
    array = numbers(name, value)
    if array.ndim != 1 or (length is not None and array.shape[0] != length):
        wanted = "one dimension" if length is None else f"({length},)"
        raise WrongSizeError(f"{name} has shape {array.shape}; needed: {wanted}")
    return array


def rows(name: str, value: ArrayLike, columns: Optional[int] = None) -> Doubles:
    """Several vectors of one length, as rows."""
    array = numbers(name, value)
    if array.ndim == 1 and array.size == 0 and columns is not None:
        array = array.reshape(0, columns)
    if array.ndim != 2 or (columns is not None and array.shape[1] != columns):
        raise WrongSizeError(f"{name} has shape {array.shape}; needed: (n, {'m' if columns is None else columns})")
    return array


def scalar(name: str, value: Any) -> float:
    """A number. NaN and infinity are C's to refuse."""
    if isinstance(value, float):
        return value
    try:
        return float(numbers(name, value)) if not isinstance(value, int) else float(value)
    except TypeError:
        raise TypeError(f"{name} must be a number, not {type(value).__name__}") from None
    except OverflowError:
        raise InvalidArgumentError(f"{name} is too large for a double") from None


def poses(name: str, value: ArrayLike) -> Doubles:
    """Poses as C has them, 12 doubles each: from (n, 3, 4), without a copy, or (n, 4, 4)."""
    array = numbers(name, value)
    if array.ndim == 3 and array.shape[1:] == (4, 4):
        if not (array[:, 3] == (0, 0, 0, 1)).all():
            finite(name, array)
            raise InvalidArgumentError(f"{name}: the last row of a 4 x 4 pose is 0, 0, 0, 1")
        return as_in_c(array[:, :3])
    if array.ndim == 3 and array.shape[1:] == (3, 4):
        return array
    raise WrongSizeError(f"{name} has shape {array.shape}; needed: (n, 4, 4) or (n, 3, 4)")


def pose(name: str, value: ArrayLike) -> Doubles:
    """A pose as C has it: from (3, 4), without a copy, (4, 4) or 12 numbers."""
    array = numbers(name, value)
    if array.shape == (12,) or array.shape == (3, 4):
        return array
    if array.shape == (4, 4):
        if array[3].tolist() != [0, 0, 0, 1]:
            finite(name, array)
            raise InvalidArgumentError(f"{name}: the last row of a 4 x 4 pose is 0, 0, 0, 1")
        return array[:3]
    raise WrongSizeError(f"{name} has shape {array.shape}; needed: (4, 4) or (3, 4)")


def frame_or_identity(name: str, value: Optional[ArrayLike]) -> Any:
    """The pointer to a pose of 12 doubles: the identity for None."""
    return doubles(np.eye(4) if value is None else pose(name, value))


def integers(name: str, value: ArrayLike, dtype: Any) -> NDArray[Any]:
    """Whole numbers that fit into a type of C."""
    _not_masked(name, value)
    try:
        array = np.asarray(value)
    except (ValueError, OverflowError) as error:
        raise WrongSizeError(f"{name} is no array: {error}") from None
    if array.dtype == dtype:
        return as_in_c(array)
    if array.dtype.kind not in "iu" and array.size:
        raise TypeError(f"{name} holds {array.dtype}, not whole numbers")
    limits = np.iinfo(dtype)
    if array.size and (int(array.min()) < limits.min or int(array.max()) > limits.max):
        raise InvalidArgumentError(f"{name} holds a number beyond {limits.min} to {limits.max}")
    return as_in_c(array.astype(dtype))


def index(name: str, value: Any, bits: int = 32) -> int:
    """A number, index or tag that is not negative."""
    try:
        number = value.__index__()
    except AttributeError:
        raise TypeError(f"{name} must be a whole number, not {type(value).__name__}") from None
    if not 0 <= number < 1 << bits:
        raise InvalidArgumentError(f"{name} is {number}; it must be from 0 to 2^{bits} - 1")
    return int(number)


def same_length(name_0: str, array_0: Doubles, name_1: str, array_1: Doubles) -> int:
    """The length of both."""
    if array_0.shape != array_1.shape:
        raise WrongSizeError(f"{name_0} has shape {array_0.shape}, {name_1} has {array_1.shape}")
    return int(array_0.shape[0])


def doubles(array: Doubles) -> Any:
    """The pointer to an array's numbers; the array must outlive it."""
    return ffi.from_buffer(_DOUBLES, array)


def pointer(array: NDArray[Any], ctype: str) -> Any:
    """The pointer to an array of another type, NULL for an empty one."""
    return ffi.from_buffer(f"{ctype}[]", array) if array.size else ffi.NULL


def text(name: str, value: Any) -> bytes:
    """A string for C."""
    if not isinstance(value, str):
        raise TypeError(f"{name} must be a string, not {type(value).__name__}")
    if "\0" in value:
        raise InvalidArgumentError(f"{name} holds a NUL")
    return value.encode()


def file_name(name: str, value: Any) -> bytes:
    """A file's name for C: a string or a path."""
    try:
        path = os.fsencode(value)
    except TypeError:
        raise TypeError(f"{name} must be a path, not {type(value).__name__}") from None
    if b"\0" in path:
        raise InvalidArgumentError(f"{name} holds a NUL")
    return path


def empty(*shape: int) -> Tuple[Doubles, Any]:
    """An array for an answer, and its pointer."""
    array = np.empty(shape)
    return array, doubles(array)


def pointers(items: Sequence[Any], ctype: str) -> Any:
    """An array of handles; the items must outlive it."""
    return ffi.new(f"{ctype} *[]", list(items)) if items else ffi.NULL

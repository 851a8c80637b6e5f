"""Answers: views of C structures that belong to Python."""

from __future__ import annotations

from copy import copy
from functools import lru_cache
from typing import Any, ClassVar, Dict, Generic, Iterator, Sequence, Tuple, Type, TypeVar, Union, overload

import numpy as np
from numpy.typing import NDArray

from ._native import ffi
from .errors import ParseError


def vector_from(array: Any) -> NDArray[np.float64]:
    """A copy of a C array of doubles."""
    return np.array(list(array))


def pose_from(array: Any) -> NDArray[np.float64]:
    """A 4 x 4 pose of 12 doubles."""
    out = np.zeros((4, 4))
    out[:3] = np.frombuffer(ffi.buffer(array)).reshape(3, 4)
    out[3, 3] = 1
    return out


@lru_cache(maxsize=None)
def _pointers(ctype: Any) -> Tuple[int, ...]:
    """Where the pointers of a C type are."""
    if ctype.kind == "pointer":
        return (0,)
    if ctype.kind == "array":
        size = ffi.sizeof(ctype.item)
        return tuple(size * i + at for i in range(ctype.length) for at in _pointers(ctype.item))
    if ctype.kind == "struct":
        return tuple(field.offset + at for _, field in ctype.fields for at in _pointers(field.type))
    return ()


def _contents(ctype: str, first: Any, count: int) -> bytes:
    """The bytes of structures, without their pointers, which no other process could follow."""
    size, width = ffi.sizeof(ctype), ffi.sizeof("void *")
    contents = bytearray(ffi.buffer(first, count * size)) if count else bytearray()
    for at in _pointers(ffi.typeof(ctype)):
        for begin in range(at, len(contents), size):
            contents[begin : begin + width] = bytes(width)
    return bytes(contents)


def _structures(kind: "Type[Record]", ctype: str, size: int, contents: bytes) -> Any:
    """An array of structures with these contents."""
    if ctype != kind._type or size != ffi.sizeof(kind._type) or len(contents) % size:
        raise ParseError(f"the cstk.{kind.__name__} was pickled by another version of cstk: a {ctype} of {size} bytes")
    array = ffi.new(f"{ctype}[]", len(contents) // size)
    ffi.memmove(array, contents, len(contents))
    return array


def _unpickled(kind: "Type[AnyRecord]", ctype: str, size: int, contents: bytes, more: Dict[str, Any]) -> "AnyRecord":
    array = _structures(kind, ctype, size, contents)
    if len(array) != 1:
        raise ParseError(f"the pickled cstk.{kind.__name__} holds {len(array)} structures")
    return kind._of(array[0], array, more)


def _unpickled_all(kind: "Type[AnyRecord]", ctype: str, size: int, contents: bytes) -> "Records[AnyRecord]":
    return Records(kind, _structures(kind, ctype, size, contents))


class Record:
    """An answer. Its properties read the structure that C wrote; no later call changes it. It is pickled without your data, which are None
    in what is unpickled; numbers of objects stay.
    """

    __slots__ = ("_c", "_owner")
    _type: ClassVar[str]
    _fields: ClassVar[Tuple[str, ...]]

    def __init__(self, structure: Any, owner: Any = None) -> None:
        self._c = structure
        # Part of a structure does not keep the whole alive.
        self._owner = structure if owner is None else owner

    @classmethod
    def _of(cls: "Type[AnyRecord]", structure: Any, owner: Any, more: Dict[str, Any]) -> "AnyRecord":
        """A record with what its class adds to the structure."""
        record = cls.__new__(cls)
        record._c, record._owner = structure, owner
        for name, value in more.items():
            setattr(record, name, value)
        return record

    def _more(self) -> Dict[str, Any]:
        """What the class adds to the structure: arrays."""
        return {name: getattr(self, name) for name in type(self).__slots__}

    def __reduce__(self) -> Any:
        first = self._c if ffi.typeof(self._c).kind == "pointer" else ffi.addressof(self._c)
        return _unpickled, (type(self), self._type, ffi.sizeof(self._type), _contents(self._type, first, 1), self._more())

    def __copy__(self: "AnyRecord") -> "AnyRecord":
        return self._of(self._c, self._owner, self._more())

    def __deepcopy__(self: "AnyRecord", memo: Any) -> "AnyRecord":
        return self._of(self._c, self._owner, {name: copy(value) for name, value in self._more().items()})

    def __repr__(self) -> str:
        fields = ", ".join(f"{name}={getattr(self, name)!r}" for name in self._fields)
        return f"{type(self).__name__}({fields})"


AnyRecord = TypeVar("AnyRecord", bound=Record)


@lru_cache(maxsize=None)
def dtype_of(ctype: str) -> np.dtype[Any]:
    """The numpy dtype of a C structure: arrays of it go to C and back without copies. Reserved fields are padding."""
    return _dtype_of_type(ffi.typeof(ctype))


def _dtype_of_type(ctype: Any) -> np.dtype[Any]:
    if ctype.kind == "array":
        return np.dtype((_dtype_of_type(ctype.item), (ctype.length,)))
    if ctype.kind == "pointer":
        return np.dtype(np.uintp)
    if ctype.kind == "primitive":
        kind = "f" if ctype.cname == "double" else "u" if ctype.cname[0] == "u" or ctype.cname == "size_t" else "i"
        return np.dtype(np.bool_) if ctype.cname == "_Bool" else np.dtype(f"{kind}{ffi.sizeof(ctype)}")
    fields = [(name, field) for name, field in ctype.fields if not name.startswith("reserved")]
    return np.dtype(
        {
            "names": [name for name, _ in fields],
            "formats": [_dtype_of_type(field.type) for _, field in fields],
            "offsets": [field.offset for _, field in fields],
            "itemsize": ffi.sizeof(ctype),
        }
    )


class Records(Sequence[AnyRecord], Generic[AnyRecord]):
    """A sequence of answers in one array. `array` is a view of it as a structured numpy array, one row an answer."""

    __slots__ = ("_kind", "_c")

    def __init__(self, kind: Type[AnyRecord], array: Any) -> None:
        self._kind = kind
        self._c = array

    @classmethod
    def copied(cls, kind: Type[AnyRecord], first: Any, count: int) -> "Records[AnyRecord]":
        """A copy of `count` structures that belong to a query context."""
        array = ffi.new(f"{kind._type}[]", count)
        if count:
            ffi.memmove(array, first, count * ffi.sizeof(kind._type))
        return cls(kind, array)

    def __reduce__(self) -> Any:
        ctype = self._kind._type
        return _unpickled_all, (self._kind, ctype, ffi.sizeof(ctype), _contents(ctype, self._c, len(self)))

    def __copy__(self) -> "Records[AnyRecord]":
        return Records.copied(self._kind, self._c, len(self))

    def __deepcopy__(self, memo: Any) -> "Records[AnyRecord]":
        return self.__copy__()

    def __len__(self) -> int:
        return len(self._c)

    @overload
    def __getitem__(self, index: int) -> AnyRecord: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[AnyRecord]: ...
    def __getitem__(self, index: Union[int, slice]) -> Union[AnyRecord, Sequence[AnyRecord]]:
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(len(self)))]
        number = index + len(self) if index < 0 else index
        if not 0 <= number < len(self):
            raise IndexError(index)
        return self._kind(self._c[number], self._c)

    def __iter__(self) -> Iterator[AnyRecord]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        return repr(list(self))

    @property
    def array(self) -> NDArray[Any]:
        """The same as a structured array, without a copy: `records.array["distance"]` is an array of all distances."""
        if not len(self):
            return np.empty(0, dtype_of(self._kind._type))
        return np.frombuffer(ffi.buffer(self._c), dtype_of(self._kind._type))

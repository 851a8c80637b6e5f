"""Options structures: the library's defaults, and what the caller sets."""

from typing import Any

from ._native import ffi, lib
from .errors import check


def options(noun: str, **fields: Any) -> Any:
    """A structure that its _default function wrote, with the fields that are not None."""
    structure = ffi.new(f"cstk_{noun} *")
    check(getattr(lib, f"cstk_{noun}_default")(structure, ffi.sizeof(f"cstk_{noun}")))
    for name, value in fields.items():
        if value is not None:
            try:
                setattr(structure, name, value)
            except (TypeError, OverflowError) as error:
                raise type(error)(f"{name}: {error}") from None
    return structure

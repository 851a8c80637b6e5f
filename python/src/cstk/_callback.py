"""Functions that C calls."""

from __future__ import annotations

import platform
from typing import Any, Callable, Optional

from ._native import ffi


def callback(signature: str, keep: Optional[Callable[[BaseException], None]] = None) -> Callable[[Callable[..., Any]], Any]:
    """Makes a function callable from C, for the whole life of the process. What it raises goes to `keep`; a signal may make it raise
    KeyboardInterrupt before its first line.

    CPython takes modules down at the end of the process before it collects objects that are in cycles: their release may then still call.
    An int that the function does not get to return is 1, which is a failure.
    """

    def decorate(function: Callable[..., Any]) -> Any:
        error = None if signature.startswith("void") else 1
        made = ffi.callback(signature, function, error, None if keep is None else lambda kind, raised, trace: keep(raised))
        if platform.python_implementation() == "CPython":
            import ctypes

            ctypes.pythonapi.Py_IncRef(ctypes.py_object(made))
        return made

    return decorate

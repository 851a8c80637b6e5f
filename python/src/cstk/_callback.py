"""Functions that C calls."""

import platform
from typing import Any, Callable

from ._native import ffi


def callback(signature: str) -> Callable[[Callable[..., Any]], Any]:
    """Makes a function callable from C, for the whole life of the process.

    CPython takes modules down at the end of the process before it collects objects that are in cycles: their release may then still call.
    An int that the function does not get to return is 1, which is a failure.
    """

    def decorate(function: Callable[..., Any]) -> Any:
        error = None if signature.startswith("void") else 1
        made = ffi.callback(signature, function, error)
        if platform.python_implementation() == "CPython":
            import ctypes

            ctypes.pythonapi.Py_IncRef(ctypes.py_object(made))
        return made

    return decorate

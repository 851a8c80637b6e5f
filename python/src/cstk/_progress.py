"""Functions that hear the progress of long calls."""

from __future__ import annotations

from typing import Any, Callable, Optional

import numpy as np

from ._callback import callback
from ._callback_errors import has_to_raise, keep_to_raise
from ._native import ffi
from ._user_data import Kept, data_of
from .errors import check

Progress = Callable[[float], Any]
"""Hears the part that is done, from 0 to 1. Returning False, or NumPy's false, ends the call with CancelledError; what it raises passes through."""


@callback("int32_t(double, void *)", keep_to_raise)
def _call(fraction: float, user: Any) -> int:
    # Another function of the caller's may have raised something meanwhile.
    if has_to_raise():
        return 1
    answer = data_of(user)(fraction)
    return 1 if answer is False or (isinstance(answer, np.bool_) and not answer) else 0


def reporting(call: Callable[[Any, Any], int], progress: Optional[Progress]) -> None:
    """Makes a call that takes a progress function and its user data."""
    if progress is None:
        check(call(ffi.NULL, ffi.NULL))
        return
    if not callable(progress):
        raise TypeError(f"progress must be a function, not {type(progress).__name__}")
    kept = Kept(progress)
    try:
        status = call(_call, kept.pointer)
    finally:
        kept.drop()
    check(status)

"""Functions that hear the progress of long calls."""

from typing import Any, Callable, Optional

from ._callback import callback
from ._native import ffi
from ._user_data import Kept, data_of
from .errors import check

Progress = Callable[[float], Any]
"""Hears the part that is done, from 0 to 1. Returning False ends the call with CancelledError; what it raises passes through."""


class Report:
    """A progress function for the time of one call."""

    def __init__(self, progress: Progress) -> None:
        self.progress = progress
        self.raised: Optional[BaseException] = None


@callback("int32_t(double, void *)")
def _call(fraction: float, user: Any) -> int:
    report: Report = data_of(user)
    try:
        return 1 if report.progress(fraction) is False else 0
    except BaseException as error:
        report.raised = error
        return 1


def reporting(call: Callable[[Any, Any], int], progress: Optional[Progress]) -> None:
    """Makes a call that takes a progress function and its user data."""
    if progress is None:
        check(call(ffi.NULL, ffi.NULL))
        return
    report = Report(progress)
    kept = Kept(report)
    try:
        status = call(_call, kept.pointer)
    finally:
        kept.drop()
    if report.raised is not None:
        raise report.raised
    check(status)

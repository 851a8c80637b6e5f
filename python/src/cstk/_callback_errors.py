"""What functions of the caller's raise cannot pass through C: it is kept until the call that made them has ended."""

from __future__ import annotations

import threading
from typing import Optional


class _Kept(threading.local):
    """Of this thread."""

    cause: Optional[Exception] = None
    to_raise: Optional[BaseException] = None


_kept = _Kept()


def keep_callback_error(error: BaseException) -> None:
    """Keeps what a function raised on this thread: the cause of the call's failure, or, if it is to end the program (KeyboardInterrupt,
    SystemExit), what the call raises itself.
    """
    if isinstance(error, Exception):
        _kept.cause = error
    elif not isinstance(threading.current_thread(), threading._DummyThread):  # Threads of the library have no call to raise it.
        keep_to_raise(error)


def keep_to_raise(error: BaseException) -> None:
    """Keeps what the call that runs on this thread raises itself."""
    _kept.to_raise = error


def has_to_raise() -> bool:
    """Whether the call that runs on this thread is to end."""
    return _kept.to_raise is not None


def raise_kept() -> None:
    """Raises what was kept to be raised on this thread, once."""
    error = _kept.to_raise
    if error is not None:
        _kept.to_raise = None
        raise error


def take_callback_error() -> Optional[Exception]:
    """The cause that was kept on this thread, once."""
    error = _kept.cause
    _kept.cause = None
    return error

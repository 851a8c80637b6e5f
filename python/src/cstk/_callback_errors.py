"""What functions of the caller's raise cannot pass through C: it is kept until the call that made them has failed."""

import threading
from typing import Optional

_last = threading.local()


def keep_callback_error(error: BaseException) -> None:
    """Keeps what a function raised on this thread."""
    _last.error = error


def take_callback_error() -> Optional[BaseException]:
    """What was kept on this thread, once."""
    error: Optional[BaseException] = getattr(_last, "error", None)
    _last.error = None
    return error

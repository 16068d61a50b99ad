"""What every command shares: one line for a user's error, exit codes 0, 1, 2, and a clean stop on Ctrl-C."""

from __future__ import annotations

import errno
import signal
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

from attnlab.errors import ConfigError

UNWRITABLE = (errno.EACCES, errno.EPERM, errno.EROFS, errno.ENOSPC)


class Terminated(KeyboardInterrupt):
    """SIGTERM, which clusters send before they kill: as clean a stop as Ctrl-C."""


def _terminated(*_: object) -> None:
    raise Terminated


@contextmanager
def undisturbed() -> Iterator[None]:
    """Let a clean stop come to its end: Ctrl-C again, or SIGTERM, is not heard in this block."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = {number: signal.signal(number, signal.SIG_IGN) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def guarded(main: Callable[[Sequence[str]], int], argv: Sequence[str] | None = None) -> int:
    """Call ``main(argv)``; a ConfigError becomes one line on standard error and 2, Ctrl-C becomes 130, SIGTERM 143."""
    ours = threading.current_thread() is threading.main_thread() and signal.getsignal(signal.SIGTERM) == signal.SIG_DFL
    if ours:
        signal.signal(signal.SIGTERM, _terminated)
    try:
        return main(sys.argv[1:] if argv is None else argv)
    except ConfigError as error:
        print(f"attnlab: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt as stop:
        print("attnlab: stopped; what was complete stays, and the same command goes on from there", file=sys.stderr)
        return 143 if isinstance(stop, Terminated) else 130
    except BrokenPipeError:  # | head
        sys.stderr.close()
        return 0
    except OSError as cause:
        if cause.errno not in UNWRITABLE:
            raise
        print(f"attnlab: {cause.filename or 'output'}: {cause.strerror}", file=sys.stderr)
        return 2
    finally:
        if ours:
            signal.signal(signal.SIGTERM, signal.SIG_DFL)

"""What every command shares: one line for a user's error, exit codes 0, 1, 2, clean stops, displays that may break."""

from __future__ import annotations

import errno
import os
import shutil
import signal
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path
from types import FrameType
from typing import Any, TextIO

from attnlab.errors import ConfigError

UNWRITABLE = (errno.EACCES, errno.EPERM, errno.EROFS, errno.ENOSPC)


def table_width(otherwise: int = 80) -> int:
    """Columns that a table may have: those of COLUMNS or of the terminal, ``otherwise`` where there is neither."""
    return shutil.get_terminal_size((otherwise, 24)).columns


class Lenient:
    """A standard stream that goes silent when nobody reads it any more, or its disk is full: what a command shows is
    less than what it does."""

    def __init__(self, stream: TextIO):
        self._stream = stream

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    def write(self, text: str) -> int:
        """Show it, if it can be shown."""
        try:
            return self._stream.write(text)
        except UnicodeEncodeError:
            return self._stream.write(text.encode("ascii", "backslashreplace").decode())
        except (OSError, ValueError):
            self._silence()
            return len(text)

    def flush(self) -> None:
        """Show what is waiting, if it can be shown."""
        try:
            self._stream.flush()
        except (OSError, ValueError):
            self._silence()

    def _silence(self) -> None:
        """From here on to nowhere; what waits in its buffer too."""
        with suppress(OSError, ValueError):
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, self._stream.fileno())
            os.close(nowhere)


def lenient_streams() -> None:
    """Make standard output and error go silent instead of breaking. One that was closed is nowhere from the start, so
    that no file of ours gets its number."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # gets the lowest free number: this one
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            stream = Path(os.devnull).open("w")  # noqa: SIM115  for as long as we live
        if not isinstance(stream, Lenient):
            setattr(sys, name, Lenient(stream))


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


@contextmanager
def heard() -> Iterator[None]:
    """Ctrl-C or SIGTERM is heard at the latest when this block ends: C code that calls Python (LLVM's, an import of
    numpy) may lose it."""
    came: list[Callable[[], Any]] = []
    handlers = {number: handler for number in (signal.SIGINT, signal.SIGTERM)
                if callable(handler := signal.getsignal(number))}
    if threading.current_thread() is not threading.main_thread():
        handlers = {}

    def hear(number: int, frame: FrameType | None) -> None:
        came.append(partial(handlers[signal.Signals(number)], number, None))
        handlers[signal.Signals(number)](number, frame)
    hook = sys.unraisablehook
    sys.unraisablehook = lambda lost: None if came else hook(lost)
    for number in handlers:
        signal.signal(number, hear)
    try:
        yield
    except Exception:  # C code may also make another error of it
        if not came:
            raise
    finally:
        sys.unraisablehook = hook
        for number, handler in handlers.items():
            signal.signal(number, handler)
    for again in came:
        again()


def guarded(main: Callable[[Sequence[str]], int], argv: Sequence[str] | None = None) -> int:
    """Call ``main(argv)``; a ConfigError becomes one line on standard error and 2, Ctrl-C becomes 130, SIGTERM 143."""
    ours = threading.current_thread() is threading.main_thread() and signal.getsignal(signal.SIGTERM) == signal.SIG_DFL
    if ours:
        signal.signal(signal.SIGTERM, _terminated)
    streams = sys.stdout, sys.stderr
    lenient_streams()
    try:
        Path.cwd()
        return main(sys.argv[1:] if argv is None else argv)
    except ConfigError as error:
        print(f"attnlab: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt as stop:
        if ours and argv is None:
            signal.signal(signal.SIGINT, signal.SIG_IGN)  # the process ends now; a second Ctrl-C is too late
        print("attnlab: stopped; what was complete stays, and the same command goes on from there", file=sys.stderr)
        return 143 if isinstance(stop, Terminated) else 130
    except OSError as cause:
        if cause.filename is None and cause.errno == errno.ENOENT and not _here():
            print("attnlab: the folder one works in is gone. cd to another one", file=sys.stderr)
            return 2
        if cause.errno not in UNWRITABLE:
            raise
        print(f"attnlab: {cause.filename or 'output'}: {cause.strerror}", file=sys.stderr)
        return 1 if cause.errno == errno.ENOSPC else 2
    finally:
        if argv is not None:  # a call from Python
            sys.stdout, sys.stderr = streams
        if ours:
            signal.signal(signal.SIGTERM, signal.SIG_DFL)


def _here() -> bool:
    """Is there still a folder that one works in?"""
    try:
        return bool(Path.cwd())
    except OSError:
        return False

"""Errors that a user is meant to read, and how they are worded."""

from __future__ import annotations

import inspect
from collections.abc import Iterable
from difflib import get_close_matches
from pathlib import Path
from typing import Any


class ConfigError(Exception):
    """A setting that cannot be: shown as one line (setting, what is wrong, hint) with exit code 2, nothing written."""

    def __init__(self, setting: str, problem: str, hint: str = ""):
        super().__init__(setting, problem, hint)
        self.setting, self.problem, self.hint = setting, problem, hint

    def __str__(self) -> str:
        line = f"{self.setting}: {self.problem}" + (f". {self.hint}" if self.hint else "")
        return " ".join(line.split())


def nearest(name: str, known: Iterable[str]) -> str:
    """A hint with the nearest right name, then all of them."""
    names, name = sorted(known), str(name)
    starts = {known[:len(name)]: known for known in reversed(names)}  # gian: the start of gain_rad_s
    close = get_close_matches(name, names, n=1, cutoff=0.6) or \
        [starts[start] for start in get_close_matches(name, starts, n=1, cutoff=0.6)]
    hint = f"Did you mean '{close[0]}'? " if close and name else ""
    return hint + (f"Known: {', '.join(names)}" if names else "There is none")


def describe(cause: BaseException) -> str:
    """One line: the error's type, message, and for a syntax error its line."""
    line = f" (line {cause.lineno})" if isinstance(cause, SyntaxError) and cause.lineno else ""
    text = cause.msg if isinstance(cause, SyntaxError) else str(cause)
    return f"{type(cause).__name__}: {text}{line}"


class PartError(RuntimeError):
    """A part broke a promise; the message begins with its file."""

    def __init__(self, part: Any, problem: str):
        super().__init__(f"{file_of(part)}: '{getattr(part, 'name', type(part).__name__)}' {problem}")


def file_of(part: Any) -> str:
    """The file of a part's class, as short as it can be said."""
    path = Path(inspect.getsourcefile(type(part)) or type(part).__module__)
    return str(path.relative_to(Path.cwd())) if path.is_relative_to(Path.cwd()) else str(path)

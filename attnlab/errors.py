"""The one error a user is meant to read."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches


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

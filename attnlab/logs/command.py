"""The arguments by which commands open a log."""

from __future__ import annotations

import argparse
from dataclasses import fields
from typing import Any

from attnlab.logs.base import LogSettings
from attnlab.logs.file import READERS, Log
from attnlab.settings import build


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """``--format`` and ``--set name=value`` for what a file leaves unsaid."""
    parser.add_argument("--format", help=f"one of {', '.join(READERS)}; told from the file if left out")
    names = ", ".join(field.name for field in fields(LogSettings))
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", dest="settings",
                        help=f"what the file does not say: {names} (docs/logs.md)")


def log_of(given: argparse.Namespace) -> Log:
    """The log that was asked for. Raises ConfigError."""
    return Log(given.log, settings_of(given.settings), given.format)


def settings_of(pairs: list[str]) -> LogSettings:
    """Settings from ``name=value`` words. Raises ConfigError naming the one at fault."""
    values: dict[str, Any] = {}
    for pair in pairs:
        name, _, value = pair.partition("=")
        try:
            values[name] = float(value)
        except ValueError:
            values[name] = value
    return build(LogSettings, values, "")

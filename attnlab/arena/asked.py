"""What the arena's command line asks for, checked before anything runs."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from attnlab.arena import worlds
from attnlab.arena.drive import Task
from attnlab.arena.ways import BETWEEN, EPOCHS, spec_of, way
from attnlab.errors import ConfigError


@dataclass(frozen=True)
class Number:
    """An option that holds a number from ``low`` to ``high``; ``many``: several, with commas between."""
    option: str
    default: str | None
    low: float
    high: float
    help: str
    whole: bool = False
    many: bool = False

    @property
    def name(self) -> str:
        return self.option.strip("-").replace("-", "_")

    def read(self, text: str | None) -> Any:
        """The value. Raises ConfigError naming the option."""
        if text is None:
            return [] if self.many else None
        kind = int if self.whole else float
        try:
            values = [kind(word) for word in (text.split(",") if self.many else [text])]
        except ValueError:
            what = "a whole number" if self.whole else "numbers, with commas between" if self.many else "a number"
            raise ConfigError(self.option, f"must be {what}, not '{text}'") from None
        for value in values:
            if not self.low <= value <= self.high:
                raise ConfigError(self.option, f"is {value}, must be from {self.low:g} to {self.high:g}")
        return values if self.many else values[0]


NUMBERS = (
    Number("--seeds", "10", 1, 10_000, "of every way", whole=True),
    Number("--price", "0.5", 0.0, 1e6, "of a look: in wrong cycles, or in lost survival"),
    Number("--train-prices", None, 0.0, 1e6, "learn at these prices, too, on logs", many=True),
    Number("--look-cost", None, 0.0, 1e6, "e_nb of eq 10 in worlds, UoE; several are a sweep; the robot's own if left "
           "out", many=True),
    Number("--cap", None, 1e-3, 1e4, "looks a second that a robot's behaviours may not exceed together"),
    Number("--onset", "0.6", 0.05, 1.0, "nearer than this is near, on logs, in m"),
    Number("--epochs", str(EPOCHS), 1, 100_000, "passes over what is learned on, on logs", whole=True))


def parsed(argv: Sequence[str]) -> argparse.Namespace:
    """The arguments."""
    parser = argparse.ArgumentParser(prog="python -m attnlab.arena", description="Compare ways to decide when to look.")
    parser.add_argument("--ways", help="learners, with commas between; all that are here if left out")
    parser.add_argument("--log", type=Path, action="append", default=[], help="a log of a real robot; may be repeated")
    parser.add_argument("--read", type=Path, action="append", default=[], help="a log that is read and told of only")
    parser.add_argument("--set", action="append", default=[], dest="settings", metavar="NAME=VALUE", help="of the logs")
    parser.add_argument("--worlds", help=f"with commas between, or all: {', '.join(worlds.WORLDS)}; these if no log, "
                        "study or board is named")
    parser.add_argument("--study", type=Path, help="a study that is there: learners in worlds")
    parser.add_argument("--name", default="arena_worlds", help="of the study that is made (outputs/arena_worlds)")
    for number in NUMBERS:
        parser.add_argument(number.option, default=number.default, dest=number.name, help=number.help)
    parser.add_argument("--carry", type=Path, action="append", default=[], help="a run whose clock is tried on logs")
    parser.add_argument("--add", type=Path, action="append", default=[], help="a leaderboard of others")
    parser.add_argument("--out", type=Path, default=Path("outputs/arena"), help="folder to write to")
    parser.add_argument("overrides", nargs="*", help="of the study in worlds: train_episodes=100 ...")
    given = parser.parse_intermixed_args(argv)
    for number in NUMBERS:
        setattr(given, number.name, number.read(getattr(given, number.name)))
    return given


def places_of(given: argparse.Namespace) -> list[str]:
    """The worlds to compete in."""
    if given.worlds is None:
        elsewhere = given.log or given.study or given.add or given.read
        return [] if elsewhere else list(worlds.WORLDS)
    names = list(worlds.WORLDS) if given.worlds == "all" else [name for name in given.worlds.split(",") if name]
    if not names:
        raise ConfigError("--worlds", "names no world", f"all, or of {', '.join(worlds.WORLDS)}")
    return names


def checked(given: argparse.Namespace, names: Sequence[str], where: Sequence[str], task: Task) -> None:
    """Raise ConfigError for what cannot be, before anything runs."""
    for name in names:
        if given.log or name == BETWEEN:
            way(name, task)
        else:
            spec_of(name)  # evolution can compete in worlds
    for condition, option, hint in (
            (given.carry and not given.log, "--carry", "--log FILE"),
            (given.train_prices and not given.log, "--train-prices", "--log FILE"),
            (given.look_cost and not where, "--look-cost", "--worlds paper,open"),
            (given.overrides and not where, next(iter(given.overrides), ""), "--worlds paper,open")):
        if condition:
            raise ConfigError(option, "is for logs" if "log" in hint else "is for the study in worlds", hint)
    if where:
        worlds.checked(names, where, given.overrides)

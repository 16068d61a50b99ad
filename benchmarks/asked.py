"""What was asked of the speed, before it was measured, and what came out: each a ratio within one result."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from benchmarks.history import share
from benchmarks.run import LIMIT

Result = dict[str, Any]
FIRST = "2026-11-22-224653.json"  # the last result before there was a compiled engine


class Target(NamedTuple):
    """``value`` of (the result, the first one) must be at least ``bound``, or at most where ``most``."""
    text: str
    value: Callable[[Result, Result], float]
    bound: float
    unit: str = ""
    most: bool = False


def _speed(found: Result, name: str) -> float:
    return float(found["contest"][name]["median"])


def _over(one: str, other: str) -> Callable[[Result, Result], float]:
    return lambda found, first: _speed(found, one) / _speed(found, other)


def _since(name: str) -> Callable[[Result, Result], float]:
    """Its share of the limit over that of the first result."""
    def value(found: Result, first: Result) -> float:
        now, then = share(found, name), share(first, name)
        if now is None or then is None:
            raise KeyError(name)
        return now / then
    return value


TARGETS = (
    Target("compiled, loop alone: at least 1/3 of the fused kernel", _over("compiled, loop alone", LIMIT), 1 / 3),
    Target("compiled, whole run: at least 1/5 of the fused kernel", _over("compiled, whole run", LIMIT), 1 / 5),
    Target("compiled, whole run: at least 5 times the interpreted one",
           _over("compiled, whole run", "python, whole run"), 5),
    Target("interpreted: no slower than it was (its share of the kernel over that before there was a compiled engine)",
           _since("python, whole run"), 0.97),
    Target("pybullet: 1.35 times what it was (the same)", _since("pybullet, whole run"), 1.35),
    Target("study of 40 runs on planar, start to page: under 40 s", lambda f, _: f["study"]["planar"]["wall_s"], 40,
           "s", True),
    Target("the same on pybullet: under 330 s", lambda f, _: f["study"]["pybullet"]["wall_s"], 330, "s", True),
    Target("first compile: at most 15 s of CPU time", lambda f, _: compile_s(f), 15, "s", True),
    Target("warm start of the compiled engine: at most 0.5 s more than the interpreted one",
           lambda f, _: f["starts"]["compiled"]["wall_s"] - f["starts"]["python"]["wall_s"], 0.5, "s", True),
    Target("a run of 30 episodes in a study of many, a process each: under 0.35 s of CPU time",
           lambda f, _: _each(f["runs"]["local"]), 0.35, "s", True),
    Target("the same over threads", lambda f, _: _each(f["runs"]["threads"]), 0.35, "s", True),
    Target("--help: under 1 s", lambda f, _: f["starts"]["help"]["wall_s"], 1, "s", True),
    Target("planar, interpreted: at least 120,000 cycles a CPU-second", lambda f, _: _speed(f, "python, whole run"),
           120_000),
    Target("pybullet: at least 10,000 cycles a CPU-second", lambda f, _: _speed(f, "pybullet, whole run"), 10_000),
    Target("planar, interpreted: at least 300 times ir-sim", _over("python, whole run", "ir-sim"), 300))


def compile_s(found: Result) -> float:
    """CPU seconds that compiling an engine takes, the simulator's kernels among them: a start with an empty cache over
    one that finds all of it."""
    return float(found["starts"]["first compile"]["cpu_s"] - found["starts"]["compiled"]["cpu_s"])


def _each(runs: Result) -> float:
    """CPU seconds of each further run, between a study of one run and the largest."""
    one, most = runs[min(runs, key=int)], runs[max(runs, key=int)]
    return float((most["cpu_s"] - one["cpu_s"]) / (most["runs"] - one["runs"]))


def table(found: Result, first: Result) -> list[str]:
    """A row a target, as Markdown."""
    lines = ["| asked | came out | |", "|---|---:|---|"]
    for target in TARGETS:
        try:
            got = target.value(found, first)
        except KeyError:
            lines.append(f"| {target.text} | not measured in this result | |")
            continue
        shown = f"1/{1 / got:.1f}" if got < 0.5 and not target.unit else f"{got:,.2f}" if got < 100 else f"{got:,.0f}"
        fits = got <= target.bound if target.most else got >= target.bound
        lines.append(f"| {target.text} | {shown} {target.unit}".rstrip() + f" | {'' if fits else '**not reached**'} |")
    return lines

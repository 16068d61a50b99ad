"""A log as a drive: what was near in every cycle, and what a clock that looks now and then knows of it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from attnlab.equations import percept_bin
from attnlab.errors import ConfigError
from attnlab.logs.file import Log
from attnlab.logs.sonars import nearest_ahead

BLOCKS = 8
LEAST = 300  # scans, below which there is nothing to learn from and to judge
Decide = Callable[[int, int], int]  # (index of the period in force, percept from 0) -> index of the next period


@dataclass(frozen=True)
class Drive:
    """``near_m``: the nearest of the frontal sonars in every cycle; ``starts``: cycles at which a stretch without holes
    begins, 0 first; ``cycle_s``: the middle length of a cycle; ``told``: what the log's reader skipped."""
    name: str
    near_m: tuple[float, ...]
    starts: tuple[int, ...]
    cycle_s: float
    told: tuple[str, ...]

    def blocks(self, count: int = BLOCKS) -> list[list[tuple[int, int]]]:
        """``count`` blocks of equal length, each as stretches (from, to) of cycles without holes."""
        n = len(self.near_m)
        edges = [n * i // count for i in range(count + 1)]
        blocks = []
        for low, high in pairwise(edges):
            cuts = [low, *(start for start in self.starts if low < start < high), high]
            blocks.append([(a, b) for a, b in pairwise(cuts) if b > a])
        return blocks


def read_drive(log: Log) -> Drive:
    """The drive of a log. Raises ConfigError if it is too short to judge on."""
    near: list[float] = []
    times: list[float] = []
    starts = [0]
    for scan in log:
        value = nearest_ahead(scan)
        if value is None:
            log.ledger.skip("scan in which no frontal sonar is valid", f"{scan.time_s:.3f} s")
            continue
        if times and scan.time_s - times[-1] > log.settings.hole_s:
            starts.append(len(near))
        near.append(value)
        times.append(scan.time_s)
    if len(near) < LEAST:
        raise ConfigError("--log", f"{log.path.name} has {len(near)} scans that can be used; judging needs {LEAST}",
                          "A short one can be read (--read FILE) or appraised: python -m attnlab.appraise --log FILE")
    gaps = sorted(b - a for a, b in pairwise(times))
    return Drive(Path(log.path.name).name.partition(".")[0], tuple(near), tuple(starts), gaps[len(gaps) // 2],
                 tuple(log.ledger.lines()))


def read_only(log: Log) -> str:
    """What is in a log that nobody competes on, in a line."""
    times, beams, near = list[float](), 0, list[float]()
    for scan in log:
        times.append(scan.time_s)
        beams = len(scan.ranges_m)
        if (value := nearest_ahead(scan)) is not None:
            near.append(value)
    if len(times) < 2:
        raise ConfigError("--read", f"{log.path.name} holds {len(times)} scans")
    gaps = sorted(b - a for a, b in pairwise(times))
    closest = f", the nearest at {min(near):.2f} m" if near else ""
    return (f"{log.path.name} ({log.kind}): {len(times)} scans of {beams} ranges in {times[-1] - times[0]:.0f} s, one "
            f"every {gaps[len(gaps) // 2]:.2f} s{closest}; {'; '.join(log.ledger.lines()) or 'nothing skipped'}")


@dataclass(frozen=True)
class Task:
    """What counts on a drive. An onset: the nearest falls below ``onset_m``. A clock believes what it last saw, near or
    not; a cycle in which that is wrong costs 1 (blind: something is near; needless: nothing is), a look ``price``."""
    onset_m: float = 0.6
    price: float = 0.5
    sigma_max_m: float = 1.0
    bins: int = 6
    periods: tuple[int, ...] = (1, 4, 8, 12)

    def percept(self, near_m: float) -> int:
        """The percept, from 0: equal intervals of [0, sigma_max], as of AVOID."""
        return percept_bin(min(near_m, self.sigma_max_m), 0.0, self.sigma_max_m, self.bins)


@dataclass
class Score:
    """What a clock did on some stretches, in cycles; ``delays`` of the onsets that it saw."""
    cycles: int = 0
    looks: int = 0
    onsets: int = 0
    missed: int = 0
    delays: int = 0
    blind: int = 0
    needless: int = 0

    def cost(self, price: float) -> float:
        """In wrong cycles."""
        return price * self.looks + self.blind + self.needless

    def add(self, other: Score) -> None:
        """Count another's too."""
        for name, value in vars(other).items():
            setattr(self, name, getattr(self, name) + value)


def looks_of(drive: Drive, stretch: tuple[int, int], task: Task, decide: Decide) -> Iterator[tuple[int, int]]:
    """(cycle, period granted) of each look in a stretch; the first one is at its start, with the shortest period in
    force."""
    low, high = stretch
    action = task.periods.index(min(task.periods))
    due = low
    while due < high:
        action = decide(action, task.percept(drive.near_m[due]))
        yield due, task.periods[action]
        due += task.periods[action]


def judge(drive: Drive, stretches: Sequence[tuple[int, int]], task: Task, decide: Decide) -> Score:
    """Replay a clock against always on: it sees only what it looks at, the log knows the rest."""
    score = Score()
    for stretch in stretches:
        score.add(score_looks(drive, stretch, task, [cycle for cycle, _ in looks_of(drive, stretch, task, decide)]))
    return score


def score_looks(drive: Drive, stretch: tuple[int, int], task: Task, looks: Sequence[int]) -> Score:
    """What looking at these cycles of a stretch (its first among them) is worth."""
    low, high = stretch
    near = [value < task.onset_m for value in drive.near_m[low:high]]
    seen = bytearray(high - low)
    for cycle in looks:
        seen[cycle - low] = 1
    score = Score(cycles=high - low, looks=len(looks))
    believed = near[0]
    since: int | None = None  # the onset that was not seen yet
    for i, truly in enumerate(near):
        if i and truly and not near[i - 1]:
            score.onsets += 1
            since = i
        elif not truly and since is not None:
            score.missed += 1
            since = None
        if seen[i]:
            believed = truly
            if truly and since is not None:
                score.delays += i - since
                since = None
        if believed != truly:
            if truly:
                score.blind += 1
            else:
                score.needless += 1
    if since is not None:
        score.missed += 1
    return score


def oracle(drive: Drive, stretches: Sequence[tuple[int, int]], task: Task) -> Score:
    """The least cost that looking at any cycles can have for one who knows the future: a stretch begins with a look,
    and from then on each change of near and not near is looked at or not (dynamic programming over what is
    believed)."""
    total = Score()
    for low, high in stretches:
        near = [value < task.onset_m for value in drive.near_m[low:high]]
        costs, ways = {near[0]: task.price}, {near[0]: [0]}
        runs = [i for i in range(1, len(near)) if near[i] != near[i - 1]]
        for i, end in pairwise([*runs, len(near)]):
            state = near[i]
            keep = {b: costs[b] + (end - i) * (b != state) for b in costs}
            look = min(costs.values()) + task.price
            best = min(costs, key=costs.__getitem__)
            new_costs, new_ways = dict(keep), {b: ways[b] for b in costs}
            if look < new_costs.get(state, float("inf")):
                new_costs[state], new_ways[state] = look, [*ways[best], i]
            costs, ways = new_costs, new_ways
        best = min(costs, key=costs.__getitem__)
        total.add(score_looks(drive, (low, high), task, [low + i for i in ways[best]]))
    return total

"""Drawings of what each way looked at in one episode, side by side."""

from __future__ import annotations

import html
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from attnlab.arena.drive import Decide, Drive, Task, looks_of
from attnlab.arena.worlds import name_of, place_of, settings_of
from attnlab.errors import ConfigError

if TYPE_CHECKING:
    from attnlab.results.load import Study

CYCLES = 300
WIDTH, ROW, LEFT = 900, 14, 150


def strip(drive: Drive, stretch: tuple[int, int], task: Task, deciders: Mapping[str, Decide]) -> str:
    """What each way looked at in the same cycles of a log: a row a way, a tick a look, grey where it was near."""
    low, high = stretch[0], min(stretch[1], stretch[0] + CYCLES)
    near = [drive.near_m[i] < task.onset_m for i in range(low, high)]
    shades = [(a, b, 0, len(deciders)) for a, b in spans(near)]
    rows = {name: [[cycle - low for cycle, _ in looks_of(drive, (low, high), task, decide)]]
            for name, decide in deciders.items()}
    said = (f"Looks of {len(deciders)} ways in {high - low} cycles of {drive.name} ({low} to {high - 1}), learned on "
            f"the even blocks; grey: nearer than {task.onset_m:g} m.")
    return drawing(rows, high - low, shades, said)


def world_strips(study: Study) -> dict[str, str]:
    """By world: the first cycles of the last recorded episode of the first seed, all ways from the same
    start; a tick a look, by behaviour; nothing where no cycles were recorded."""
    settings, seeds = settings_of(study), [study.seed(run) for run in study.complete]
    found: dict[str, dict[str, str]] = {}
    for run in study.complete:
        config = study.config(run)
        name = name_of(config, settings[run])
        if study.seed(run) == min(seeds) and not name.startswith("("):
            found.setdefault(place_of(config, settings[run]), {})[name] = run
    return {place: drawn for place, runs in sorted(found.items()) if (drawn := _world(study, place, runs))}


def _world(study: Study, place: str, runs: Mapping[str, str]) -> str:
    from attnlab.results.one import read_run
    rows: dict[str, list[list[int]]] = {}
    shades, names = [], list[str]()
    for name, run in runs.items():
        try:
            last, _ = read_run(study.path / run)
        except ConfigError:  # no cycles were stored
            continue
        names = [column.removesuffix("_active") for column in last.columns if column.endswith("_active")]
        first = last[last["cycle"] < last["cycle"].min() + CYCLES]
        if len(first) < CYCLES:
            shades.append((len(first), CYCLES, len(rows), len(rows) + 1))
        rows[name] = [[i for i, active in enumerate(first[f"{b}_active"]) if active] for b in names]
    if not rows:
        return ""
    colours = ", ".join(f'<span class="b{i}">{html.escape(name.upper())}</span>' for i, name in enumerate(names))
    return drawing(rows, CYCLES, shades, f"Looks of {len(rows)} ways in the first {CYCLES} cycles of the last "
                   f"recorded episode of one seed, {place}, from the same start; grey: dead.", colours)


def spans(on: Sequence[bool]) -> Iterable[tuple[int, int]]:
    """(from, to) of the stretches that are on."""
    start = None
    for i, now in enumerate([*on, False]):
        if now and start is None:
            start = i
        elif not now and start is not None:
            yield start, i
            start = None


def drawing(rows: Mapping[str, Sequence[Sequence[int]]], cycles: int, shades: Iterable[tuple[int, int, int, int]],
            said: str, key: str = "") -> str:
    """``rows``: by way, of each behaviour, the cycles of its looks; ``shades``: (from, to, first row, row after)."""
    scale = (WIDTH - LEFT - 10) / cycles
    parts = [f'<rect x="{LEFT + a * scale:.1f}" y="{ROW * top}" width="{(b - a) * scale:.1f}" '
             f'height="{ROW * (end - top)}" class="near"/>' for a, b, top, end in shades]
    for row, (name, of) in enumerate(rows.items()):
        parts.append(f'<text x="{LEFT - 6}" y="{ROW * row + ROW - 3}" text-anchor="end">{html.escape(name)}</text>')
        tall = (ROW - 4) / max(1, len(of))
        for i, looks in enumerate(of):
            ticks = "".join(f"M{LEFT + cycle * scale:.1f} {ROW * row + 2 + i * tall:.1f}v{tall:.1f}" for cycle in looks)
            parts.append(f'<path d="{ticks}" class="look b{i}"/>')
    label = html.escape(said)
    return (f'<figure><div class="wide"><svg viewBox="0 0 {WIDTH} {ROW * len(rows)}" role="img" aria-label="{label}">'
            f'{"".join(parts)}</svg></div><figcaption>{label}{f" Behaviours: {key}." if key else ""}</figcaption>'
            '</figure>')

"""The page of a search: the best, how the goal rose, each setting against it, and all trials."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from pathlib import Path
from statistics import median, stdev

from attnlab import __version__
from attnlab.report.page import PROVENANCE, document, nav, notes_block, table

WIDTH, HEIGHT, EDGE = 1000, 300, 20  # of a plot, in its own units: it is as wide as its place
FEW = 10  # trials that say little of a space


@dataclass(frozen=True)
class Seen:
    """A setting that was chosen: among ``words``, or from ``low`` to ``high``, by factors if ``log``."""
    name: str
    words: Sequence[str] = ()
    low: float = 0.0
    high: float = 0.0
    log: bool = False

    def place(self, value: str) -> float:
        """Where a value is along the setting's axis, 0 to 1."""
        if self.words:
            return (self.words.index(value) + 0.5) / len(self.words) if value in self.words else math.nan
        low, high, at = (math.log(x) if self.log else x for x in (self.low, self.high, float(value)))
        return (at - low) / (high - low)


@dataclass(frozen=True)
class Trial:
    """One choice. ``settings``: texts by name; ``value``: mean of ``seeds``, or None, and then ``failed`` says why."""
    number: int
    settings: Mapping[str, str]
    value: float | None
    seeds: Mapping[int, float] = field(default_factory=dict)
    failed: str = ""

    @property
    def spread(self) -> float | None:
        """Standard deviation over seeds."""
        return stdev(self.seeds.values()) if len(self.seeds) > 1 else None


@dataclass(frozen=True)
class Tuned:
    """A search. ``goal``: the measure, as typed; ``commands``: by trial, what runs its settings on fresh seeds."""
    study: str
    goal: str
    unit: str
    minimise: bool
    seeds: str
    asked: int
    axes: Sequence[Seen]
    trials: Sequence[Trial]
    importance: Mapping[str, float]
    command: str
    commands: Mapping[int, str]

    @property
    def title(self) -> str:
        """The goal in words."""
        unit = "" if self.unit == "1" else f" ({self.unit})"
        return f"{'least' if self.minimise else 'most'} {self.goal}{unit}, mean over seeds {self.seeds}"

    def ranked(self) -> list[Trial]:
        """Trials, the best first, those without a value last."""
        sign = 1.0 if self.minimise else -1.0
        return sorted(self.trials, key=lambda t: (t.value is None, sign * (t.value or 0.0), t.number))

    @property
    def best(self) -> Trial | None:
        """The best trial, if any has a value."""
        return next((trial for trial in self.ranked() if trial.value is not None), None)


def shown(value: float | None) -> str:
    """A value of the goal."""
    return "-" if value is None else f"{value:.4g}"


def said(settings: Mapping[str, str]) -> str:
    """Settings on one line."""
    return " ".join(f"{name}={value}" for name, value in settings.items())


def page(found: Tuned) -> str:
    """The whole page; everything that a user named is escaped."""
    good = [trial for trial in found.trials if trial.value is not None]
    links = [("found", "The best"), ("history", "Over trials"), ("settings", "Settings"), ("trials", "All trials"),
             ("provenance", "Provenance")]
    parts = [f'<p class="lead">{escape(_lead(found, len(good)))}</p>', notes_block(_notes(found, len(good))),
             nav(links), _best(found, good)]
    if good:
        parts += [_history(found, good), _settings(found, good)]
    parts += [_table(found), PROVENANCE[0], '<h2 id="provenance">Provenance</h2>'
              f"<pre>{escape(found.command)}</pre><p class=small>attnlab {escape(__version__)}. Typed again it goes on "
              "where it was stopped, and tries again what failed. All numbers are in tune.csv.</p>", PROVENANCE[1]]
    style = (Path(__file__).parent / "tuned.css").read_text()
    return document(f"{found.study}: settings looked for", parts, style=style)


def _lead(found: Tuned, good: int) -> str:
    failed = len(found.trials) - good
    return (f"{found.title[0].upper()}{found.title[1:]}: {len(found.trials)} of {found.asked} trials are done"
            + (f", {failed} of them failed" if failed else "") + ".")


def _notes(found: Tuned, good: int) -> list[str]:
    notes = [f"trial {t.number} failed: {t.failed}" for t in found.trials if t.value is None]
    if 0 < good < FEW:
        notes.append(f"{good} trial{'s say' if good > 1 else ' says'} little about what settings are worth")
    return notes


def _best(found: Tuned, good: Sequence[Trial]) -> str:
    best = found.best
    head = '<h2 id="found">The best</h2>\n'
    if best is None:
        return head + "<p>No trial has a value yet.</p>"
    others = [t.value for t in good if t.value is not None]
    seeds = best.seeds.values()
    text = (f"Trial {best.number} is the best of {len(good)}, with <b>{escape(said(best.settings))}</b>: "
            f"<b>{shown(best.value)}</b>{_unit(found)}, from {shown(min(seeds))} to {shown(max(seeds))} over its "
            f"{len(seeds)} seeds. The middle one of all trials has {shown(median(others))}.")
    return (f"{head}<p>{text}</p><p>It was chosen because these seeds were kind to it, so that fresh ones will say "
            f"less: believe what they say.</p><pre>{escape(found.commands[best.number])}</pre>")


def _unit(found: Tuned) -> str:
    return "" if found.unit == "1" else f" {escape(found.unit)}"


def _scale(values: Sequence[float]) -> tuple[float, float]:
    low, high = min(values), max(values)
    return (low, high) if high > low else (low - 0.5, high + 0.5)


def _history(found: Tuned, good: Sequence[Trial]) -> str:
    """The goal of every trial, and the best until then."""
    low, high = _scale([v for t in good if t.value is not None for v in (t.value, *t.seeds.values())])
    last = max(t.number for t in found.trials)

    def x(number: float) -> float:
        return (number - 0.5) / last
    best, line = math.nan, list[tuple[float, float]]()
    for trial in good:
        value = trial.value or 0.0
        best = value if math.isnan(best) else min(best, value) if found.minimise else max(best, value)
        line += [(x(trial.number), line[-1][1]), (x(trial.number), best)] if line else [(x(trial.number), best)]
    line.append((1.0, best))
    dots = [(x(t.number), v, "seed", f"trial {t.number}, seed {seed}: {shown(v)}") for t in good
            for seed, v in t.seeds.items()]
    dots += [(x(t.number), t.value or 0.0, "mean", f"trial {t.number}: {shown(t.value)}") for t in good]
    return ('<h2 id="history">Over trials</h2>' + _plot(dots, low, high, ["1", f"trial {last}"] if last > 1 else ["1"],
                                                        "tall", line)
            + "<p class=small>Large dots: the mean of a trial; small ones: its seeds; the line: the best so far.</p>")


def _settings(found: Tuned, good: Sequence[Trial]) -> str:
    """Each setting against the goal, those that matter most first."""
    low, high = _scale([t.value for t in good if t.value is not None])
    best = found.best
    cells = []
    for axis in sorted(found.axes, key=lambda a: -found.importance.get(a.name, 0.0)):
        share = found.importance.get(axis.name)
        dots = [(axis.place(t.settings[axis.name]), t.value or 0.0, "best" if t is best else "mean",
                 f"trial {t.number}, {axis.name}={t.settings[axis.name]}: {shown(t.value)}")
                for t in sorted(good, key=lambda t: t is best)]
        ends = list(axis.words) or [f"{axis.low:g}", *(["by factors"] if axis.log else []), f"{axis.high:g}"]
        told = f' <span class=small>importance {100 * share:.0f} %</span>' if share is not None else ""
        cells.append(f"<div><h3>{escape(axis.name)}{told}</h3>{_plot(dots, low, high, ends, 'low', words=axis.words)}"
                     "</div>")
    why = ("Importance: how far what the best trials chose for a setting differs from what all chose (PED-ANOVA); it "
           "says little of few trials. " if found.importance else "")
    return ('<h2 id="settings">Settings</h2><p class=small>Each setting against the goal; a dot is a trial, the large '
            f'one the best. {why}</p><div class=axes>{"".join(cells)}</div>')


def _plot(dots: Sequence[tuple[float, float, str, str]], low: float, high: float, ends: Sequence[str], size: str,
          line: Sequence[tuple[float, float]] = (), words: Sequence[str] = ()) -> str:
    """Dots (place 0 to 1, value, class, what it says) between ``low`` and ``high``; texts are HTML beside the lines, so
    that they have the size of the page's on any screen."""
    def at(place: float, value: float) -> str:
        y = HEIGHT - EDGE - (value - low) / (high - low) * (HEIGHT - 2 * EDGE)
        return f"{EDGE + place * (WIDTH - 2 * EDGE):.1f} {y:.1f}"
    grid = "".join(f'<path class=grid d="M0 {y}H{WIDTH}"/>' for y in (EDGE, HEIGHT // 2, HEIGHT - EDGE))
    body = "".join(f'<path class={kind} d="M{at(place, value)}h0"><title>{escape(text)}</title></path>'
                   for place, value, kind, text in dots if math.isfinite(place))
    steps = f'<path class=line d="M{"L".join(at(*point) for point in line)}"/>' if line else ""
    names = "".join(f"<span>{escape(end)}</span>" for end in ends)
    return (f'<div class="plot {size}"><div class=ys><span>{shown(high)}</span><span>{shown((low + high) / 2)}</span>'
            f'<span>{shown(low)}</span></div><svg viewBox="0 0 {WIDTH} {HEIGHT}" preserveAspectRatio="none" role="img" '
            f'aria-label="{len(dots)} dots, from {shown(low)} to {shown(high)}">{grid}{steps}{body}</svg>'
            f'<div class="xs{" words" if words else ""}">{names}</div></div>')


def _table(found: Tuned) -> str:
    names = [axis.name for axis in found.axes]
    heads = ["trial", "mean", "± sd", *names, "seeds"]
    rows = [[str(t.number), shown(t.value) if t.value is not None else "failed", shown(t.spread),
             *(t.settings[name] for name in names), " ".join(shown(v) for _, v in sorted(t.seeds.items())) or t.failed]
            for t in found.ranked()]
    return ('<h2 id="trials">All trials</h2><p class=small>The best first: mean and standard deviation over seeds '
            f"{escape(found.seeds)}, and the value of each in their order.</p>" + table(heads, rows, (0, 1, 2)))

"""What the paper's ambiguities do to its claims: a study with many readings, judged reading by reading."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from attnlab.claims.findings import Finding
from attnlab.claims.judge import Verdict
from attnlab.claims.roles import Combinations
from attnlab.figures.style import GREY, WIDTH_IN, cut
from attnlab.report.page import Section, table
from attnlab.stats import bootstrap_interval
from attnlab.tables.flat import text

if TYPE_CHECKING:
    from matplotlib.figure import Figure

LEAST_READINGS = 8  # fewer combinations are shown as a plain matrix


class Effect(NamedTuple):
    """Share of readings with this level in which a claim holds, less the share with the default, and its interval."""
    claim: str
    factor: str
    level: str
    default: str
    difference: float
    low: float
    high: float

    @property
    def clear(self) -> bool:
        return self.low > 0 or self.high < 0


@dataclass
class Multiverse:
    """``holds`` (claims, readings): 1, 0, or nan where untestable. ``levels``: factor -> level by reading."""
    ids: list[str]
    titles: list[str]
    names: list[str]
    holds: np.ndarray
    reproduced: np.ndarray
    levels: dict[str, list[str]]
    defaults: dict[str, str]
    effects: list[Effect]

    def share(self, row: int) -> tuple[float, float, float, int]:
        """(share of testable readings in which claim ``row`` holds, low, high, testable readings)."""
        seen = self.holds[row][~np.isnan(self.holds[row])]
        value = bootstrap_interval(seen)
        return value.value, value.low, value.high, len(seen)


def analyse(combinations: Combinations, judged: Mapping[str, Sequence[Verdict]]) -> Multiverse:
    """Shares and main effects. Settings that always change together are one factor."""
    verdicts = list(judged.values())
    first = verdicts[0]
    holds = np.array([[np.nan if of[i].verdict is Finding.UNTESTABLE else float(of[i].holds) for of in verdicts]
                      for i in range(len(first))])
    reproduced = np.array([[of[i].verdict is Finding.REPRODUCED for of in verdicts] for i in range(len(first))])
    levels, defaults = _factors(list(combinations.values()))
    effects = [effect for i, verdict in enumerate(first) for factor, of in levels.items()
               for effect in _effects(verdict.id, factor, np.array(of), defaults[factor], holds[i])]
    return Multiverse([v.id for v in first], [v.claim.title for v in first], list(judged), holds, reproduced, levels,
                      defaults, effects)


def _factors(readings: Sequence[Mapping[str, str]]) -> tuple[dict[str, list[str]], dict[str, str]]:
    import dataclasses

    from attnlab.reading import Reading
    plain = {f"reading.{name}": text(value) for name, value in dataclasses.asdict(Reading()).items()}
    merged: dict[tuple[int, ...], list[str]] = {}
    for name in readings[0]:
        if name == "variant":
            continue  # the name of a combination, not a setting of it
        column = [settings[name] for settings in readings]
        codes = tuple(list(dict.fromkeys(column)).index(value) for value in column)
        if len(set(codes)) > 1:
            merged.setdefault(codes, []).append(name)
    levels, defaults = {}, {}
    for names in merged.values():
        label = " + ".join(name.removeprefix("reading.") for name in names)
        column = [" + ".join(settings[name] for name in names) for settings in readings]
        usual = " + ".join(plain.get(name, "") for name in names)
        levels[label] = column
        defaults[label] = usual if usual in column else column[0]
    return levels, defaults


def _effects(claim: str, factor: str, of: np.ndarray, default: str, holds: np.ndarray) -> list[Effect]:
    """Difference of shares between each level and the default, with a seeded bootstrap over readings."""
    known = ~np.isnan(holds)
    rng = np.random.default_rng(2014)
    base = holds[known & (of == default)]
    found = []
    for level in dict.fromkeys(of.tolist()):
        if level == default:
            continue
        here = holds[known & (of == level)]
        if len(base) < 2 or len(here) < 2:
            found.append(Effect(claim, factor, level, default, np.nan, np.nan, np.nan))
            continue
        drawn = rng.choice(here, (1000, len(here))).mean(axis=1) - rng.choice(base, (1000, len(base))).mean(axis=1)
        low, high = np.quantile(drawn, [0.025, 0.975])
        found.append(Effect(claim, factor, level, default, float(here.mean() - base.mean()), float(low), float(high)))
    return found


def shares(found: Multiverse) -> Figure:
    """For each claim the share of readings in which it holds, with 95 % intervals, and in which it is reproduced."""
    import matplotlib.pyplot as plt
    n = len(found.ids)
    figure, ax = plt.subplots(figsize=(WIDTH_IN, 1.1 + 0.27 * n))
    for row in range(n):
        value, low, high, testable = found.share(row)
        if not testable:
            ax.text(0, row, " untestable in every reading", va="center", color=GREY, fontsize=8.5)
            continue
        ax.barh(row, 100 * value, color="#56b4e9", height=0.68,
                label=None if ax.patches else "claimed direction clear")
        exact = 100 * found.reproduced[row].sum() / testable
        ax.plot(exact, row, "D", color="#00674d", ms=5, label=None if ax.lines else "number met too")
        if np.isfinite(low):
            ax.plot([100 * low, 100 * high], [row, row], color="#333333", lw=1.3)
    ax.set_yticks(range(n), [cut(f"{i}  {t}", 62) for i, t in zip(found.ids, found.titles, strict=True)])
    ax.invert_yaxis()
    ax.set_xlim(0, 103)
    ax.set_xlabel(f"% of the readings that can test the claim ({len(found.names)} at most)")
    ax.grid(axis="y", visible=False)
    if ax.get_legend_handles_labels()[0]:
        figure.legend(loc="outside upper right", ncol=2)
    return figure


def effects_map(found: Multiverse) -> Figure:
    """Main effects: by how many percent points a level moves a claim's share; dots where the interval excludes 0."""
    import matplotlib.pyplot as plt
    import seaborn as sns
    columns = list(dict.fromkeys((e.factor, e.level) for e in found.effects))
    grid = np.full((len(found.ids), len(columns)), np.nan)
    marks = np.full(grid.shape, "", dtype=object)
    for e in found.effects:
        place = found.ids.index(e.claim), columns.index((e.factor, e.level))
        grid[place] = 100 * e.difference
        marks[place] = "•" if e.clear else ""
    figure, ax = plt.subplots(figsize=(WIDTH_IN + 0.8, 2.6 + 0.24 * len(found.ids)))
    sns.heatmap(grid, ax=ax, cmap="vlag", center=0, vmin=-100, vmax=100, annot=marks, fmt="", linewidths=0.4,
                cbar_kws={"label": "percent points", "shrink": 0.6}, annot_kws={"fontsize": 8})
    ax.set_yticks(np.arange(len(found.ids)) + 0.5, found.ids, rotation=0, fontsize=8)
    labels = [cut(f"{f.split(' + ')[0]} = {v.split(' + ')[0]}", 34) for f, v in columns]
    ax.set_xticks(np.arange(len(columns)) + 0.5, labels, rotation=90, fontsize=8)
    return figure


def section(found: Multiverse) -> Section:
    """Shares, strongest readings and best readings as tables."""
    rows = []
    for i, key in enumerate(found.ids):
        value, low, high, testable = found.share(i)
        mine = sorted((e for e in found.effects if e.claim == key and np.isfinite(e.difference)),
                      key=lambda e: -abs(e.difference))
        top = [f"{e.factor.split(' + ')[0]}={e.level.split(' + ')[0]} {100 * e.difference:+.0f} "
               f"[{100 * e.low:.0f}, {100 * e.high:.0f}]" for e in mine if e.clear][:2]
        rows.append([f"{key} {found.titles[i]}", f"{100 * value:.0f} %" if testable else "-",
                     f"{100 * low:.0f} to {100 * high:.0f}" if testable > 1 else "-", str(testable),
                     "; ".join(top) or "none is clear"])
    best = sorted(range(len(found.names)), key=lambda j: (-np.nansum(found.holds[:, j]), j))[:5]
    readings = [[found.names[j], f"{np.nansum(found.holds[:, j]):.0f}", f"{found.reproduced[:, j].sum()}",
                 ", ".join(f"{f.split(' + ')[0]}={of[j].split(' + ')[0]}" for f, of in found.levels.items()
                           if of[j] != found.defaults[f]) or "nothing"] for j in best]
    html = (f"<p>{len(found.names)} readings of the paper's open points were run. A claim holds in a reading if its "
            "verdict is <i>reproduced</i> or one of the two <i>direction</i> ones.</p>"
            + table(("claim", "holds in", "95 % interval", "readings", "moved most by (percent points)"), rows,
                    (1, 2, 3))
            + "<h3>Readings that satisfy most claims</h3>"
            + table(("reading", "claims that hold", "reproduced", "differs from the default in"), readings, (1, 2))
            + f"<p class=small>All {len(found.names)} readings: combinations.csv; all effects: effects.csv. An effect "
            "is the share with a level less the share with the default level; intervals by bootstrap over readings, "
            f"not corrected for their number ({len(found.effects)}): about one in twenty is clear by chance.</p>")
    return Section("multiverse", "The multiverse: claims under every reading", html)


def effects_csv(found: Multiverse) -> bytes:
    sink = io.StringIO()
    writer = csv.writer(sink, lineterminator="\n")
    writer.writerow(["claim", "factor", "level", "default", "difference_of_shares", "low", "high"])
    for e in found.effects:
        writer.writerow([e.claim, e.factor, e.level, e.default, *(f"{v:.4f}" for v in e[4:7])])
    return sink.getvalue().encode()


def combinations_csv(combinations: Combinations, judged: Mapping[str, Sequence[Verdict]]) -> bytes:
    """A row a combination: its settings, and the verdict on every claim."""
    sink = io.StringIO()
    writer = csv.writer(sink, lineterminator="\n")
    first = next(iter(judged.values()), [])
    writer.writerow(["combination", *next(iter(combinations.values()), {}), *(v.id for v in first)])
    for (name, verdicts), settings in zip(judged.items(), combinations.values(), strict=True):
        writer.writerow([name, *settings.values(), *(v.verdict for v in verdicts)])
    return sink.getvalue().encode()

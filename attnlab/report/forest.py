"""The first screen: what was found, in sentences and one ranked plot with the interval of every condition."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from html import escape
from math import ceil, floor
from typing import NamedTuple

import numpy as np

from attnlab.results.load import Study
from attnlab.stats import Interval, mean_interval

MOST = 40
ROW_PX, LEFT_PX, WIDTH_PX, RIGHT_PX = 26, 8, 420, 8


class Row(NamedTuple):
    """A condition: its name, validation survival of each seed (% of the episode), their mean and t interval."""
    name: str
    seeds: Mapping[int, float]
    value: Interval


def rows_of(study: Study) -> list[Row]:
    """Every condition's survival in validation (in training, where there is none), best first."""
    named = study.named()
    if not named:
        return []
    episodes = study.plain("episodes")
    valid = episodes[episodes["phase"] == "validation"]
    shown = valid if len(valid) else episodes
    means = shown.groupby("run", observed=True)["survival"].mean() * 100.0
    found: dict[str, dict[int, float]] = {}
    for run, name in named.items():
        if run in means.index:
            found.setdefault(name, {})[study.seed(run)] = float(means[run])
    rows = [Row(name, seeds, _of_shares(mean_interval(list(seeds.values())))) for name, seeds in found.items()]
    return sorted(rows, key=lambda row: -row.value[0])


def _of_shares(value: Interval) -> Interval:
    """An interval of percentages, cut where a percentage ends; nan stays."""
    return value._replace(low=float(np.clip(value.low, 0.0, 100.0)), high=float(np.clip(value.high, 0.0, 100.0)))


def first_screen(study: Study, marks: Mapping[str, str] | None = None) -> str:
    """HTML: sentences, then the plot. Empty if there is nothing to show. ``marks``: of conditions, by which rows are
    hidden."""
    rows = rows_of(study)
    if not rows:
        return ""
    more = f" The first {MOST} of {len(rows)}; all are in conditions.csv." if len(rows) > MOST else ""
    return ('<h2 id="found">What was found</h2>\n' + "".join(f"<p>{escape(text)}</p>" for text in sentences(rows))
            + picture(rows[:MOST], marks) + "<p class=small>Cycles lived of those there could be, in validation "
            "episodes: mean over seeds with its 95 % t interval, cut at 0 and 100 %, best first; small dots are seeds."
            f"{more}</p>")


def sentences(rows: Sequence[Row]) -> list[str]:
    """Who survives best, and how sure that is: differences are paired by seed."""
    best = rows[0]
    texts = [f"{best.name} survives {_told(best.value)} of an episode{', the most' if len(rows) > 1 else ''}."]
    if len(rows) == 1:
        return texts
    told = []
    for row in rows[1:MOST]:
        seeds = sorted(set(best.seeds) & set(row.seeds))
        difference = mean_interval([best.seeds[seed] - row.seeds[seed] for seed in seeds])
        if len(rows) == 2:
            sure = "clear over seeds" if difference[1] > 0 else "not clear: the interval allows either side"
            texts.append(f"{row.name} survives {_told(row.value)}. Paired by seed ({len(seeds)} of them), the "
                         f"difference is {_told(difference, signed=True)}: {sure}.")
        elif difference[1] > 0:
            told.append(row.name)
    if len(rows) > 2:
        worse = f"{len(told)} of the other {min(len(rows), MOST) - 1} conditions" if told else "None of the others"
        texts.append(f"{worse} {'are' if len(told) != 1 and told else 'is'} clearly below it, paired by seed and not "
                     f"corrected for their number{': ' + ', '.join(told[:12]) if 0 < len(told) <= 12 else ''}.")
    return texts


def _told(value: Interval, signed: bool = False) -> str:
    mean, low, high = value
    form, unit = ("+.1f", " points") if signed else (".1f", " %")
    if np.isnan(low):
        return f"{mean:{form}}{unit} (one seed, no interval)"
    return f"{mean:{form}}{unit} [{low:{form}}, {high:{form}}]"


def picture(rows: Sequence[Row], marks: Mapping[str, str] | None = None) -> str:
    """An inline picture of the rows (``marks``: of conditions): HTML names beside SVG lines, so that both follow the
    page's width and colours."""
    every = [v for row in rows for v in (*row.value, *row.seeds.values()) if not np.isnan(v)]
    low, high = max(0.0, min(every)), min(100.0, max(every))
    low, high = (low - 1.0, high + 1.0) if high - low < 1.0 else (low, high)
    low, high = max(0.0, 5.0 * floor(low / 5)), 5.0 * ceil(high / 5)

    def x(value: float) -> float:
        return round(LEFT_PX + (min(high, max(low, value)) - low) / (high - low) * WIDTH_PX, 1)
    of = marks or {}
    body = "".join(f'<tr{_of(of.get(row.name))}><th scope="row">{escape(row.name)}</th><td>{_line(row, x)}</td>'
                   f"<td class=n>{escape(_told(row.value))}</td></tr>" for row in rows)
    scale = f'<span>{low:.0f} %</span><span>{high:.0f} %</span>'
    return ('<div class="scroll" tabindex="0" role="group" aria-label="Survival of every condition">'
            '<table class=forest><thead><tr><th scope="col">condition</th><th scope="col"><span class=scale>' + scale
            + f'</span></th><th scope="col" class=n>mean [95 %]</th></tr></thead><tbody>{body}</tbody></table></div>')


def _of(mark: str | None) -> str:
    return f' data-of="{mark}"' if mark else ""


def _line(row: Row, x: Callable[[float], float]) -> str:
    mean, low, high = row.value
    middle = ROW_PX / 2
    bar = "" if np.isnan(low) else f'<line class=range x1="{x(low)}" x2="{x(high)}" y1="{middle}" y2="{middle}"/>'
    dots = "".join(f'<circle class=seed cx="{x(v)}" cy="{middle}" r="2"><title>seed {seed}: {v:.1f} %</title></circle>'
                   for seed, v in sorted(row.seeds.items()))
    return (f'<svg viewBox="0 0 {LEFT_PX + WIDTH_PX + RIGHT_PX} {ROW_PX}" aria-hidden="true">{bar}{dots}'
            f'<circle class=mean cx="{x(mean)}" cy="{middle}" r="5"><title>mean {escape(_told(row.value))}</title>'
            "</circle></svg>")

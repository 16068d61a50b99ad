"""What follows when a robot's curiosity level is held."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING

from attnlab.figures.base import Figure
from attnlab.figures.compared import SAFETY, VALID, Asked, asked, difference, looks, outcome, point, values_of
from attnlab.figures.panels import grid
from attnlab.figures.style import OTHERS, VERMILLION, empty
from attnlab.figures.values import UNTOLD
from attnlab.measures.frames import episode_means, of_seeds
from attnlab.measures.needs import units_of
from attnlab.measures.once import once_a_study
from attnlab.registry import register

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawing

    from attnlab.results.conditions import Conditions, Runs

CLAMP, OWN = "validation.clamp_level", "none"
MARKERS = "osD^vPX"
Lines = dict[str, Callable[["Runs"], Mapping[int, float]]]  # what is drawn: name -> by seed


@register("figure", "held_levels")
class HeldLevels(Figure):
    """Looks, survival, safety and needs in validation with the level of curiosity in the state held at each of its
    values, and how much of the table of each level was ever visited in training."""
    title, order = "Curiosity levels that are held", 13
    how = "Means over seeds with t intervals (95 %). All robots of a seed have learned the same; only the level in " \
        "the state differs. Where a level's states were hardly visited, little was learned: all values of such a " \
        "state are still 0, and the shortest period is taken."

    def applies(self, conditions: Conditions) -> bool:
        return len(values_of(conditions, CLAMP)) > 1

    def draw(self, conditions: Conditions) -> Drawing:
        held = asked(conditions)
        figure, axes = grid(5, height_in=2.9, columns=3)
        names = ["its own" if one.settings[CLAMP] == OWN else one.settings[CLAMP] for one in held]
        for ax, (title, (unit, lines)) in zip(axes, _panels(conditions).items(), strict=True):
            for i, (name, of) in enumerate(lines.items()):
                shift = 0.16 * (i - (len(lines) - 1) / 2)
                colour = VERMILLION if len(lines) == 1 else OTHERS[i % len(OTHERS)]
                for k, one in enumerate(held):
                    label = name if k == 0 else UNTOLD + name
                    point(ax, k + shift, of(one.runs), colour, MARKERS[i % len(MARKERS)], label)
            if not ax.lines:
                empty(ax, "not recorded")
                continue
            ax.set_title(title)
            ax.set_ylabel(unit)
            ax.set_xticks(range(len(names)), names)
            ax.set_xlim(-0.5, len(names) - 0.5)
            ax.grid(False, axis="x")
            if len(lines) > 1:
                ax.legend(handletextpad=0.2, fontsize=8)
        return figure

    def say(self, conditions: Conditions) -> str:
        held = {one.settings[CLAMP]: one for one in asked(conditions)}
        own = held.pop(OWN, None)
        parts = [f"held at {level}, {', '.join(said)}" for level, one in held.items()
                 if own is not None and (said := _against(one, own))]
        return f"Beside its own level: {'; '.join(parts)}." if parts else "There is nothing to hold the levels against."


def visited(conditions: Conditions, level: str) -> dict[str, float]:
    """Run -> share (%) of the states with this level, of all behaviours, that were left at least once in training."""
    return {run: 100 * shares[level] for run, shares in _visits(conditions).items() if level in shares}


@once_a_study
def _visits(conditions: Conditions) -> dict[str, dict[str, float]]:
    frame = conditions.frame("policy")
    if not len(frame):
        return {}
    states = frame.groupby(["run", "curiosity_level", "behaviour", "period", "percept"], observed=True)["visits"].sum()
    shares = (states > 0).groupby(level=["run", "curiosity_level"], observed=True).mean().unstack()
    return {str(run): dict(zip(map(str, shares.columns), row, strict=True))
            for run, row in zip(shares.index, shares.to_numpy(float).tolist(), strict=True)}


def _panels(conditions: Conditions) -> dict[str, tuple[str, Lines]]:
    """Title -> (unit, lines)."""
    frame = conditions.frame("behaviours")
    looking: Lines = {name.upper(): partial(looks_in_100, behaviour=name)
                      for name in (frame["behaviour"].unique() if len(frame) else ())}
    units = units_of(conditions)
    needs: Lines = {need: partial(_mean, column=f"{need}_mean") for need in units}

    def seen(runs: Runs) -> dict[int, float]:
        level = str(runs.where.get(CLAMP))
        return of_seeds(runs, visited(conditions, level)) if level != OWN else {}
    return {"Looks": ("activations in 100 cycles", looking),
            "Survival": ("% of the episode", {"": lambda runs: outcome(runs, VALID)}),
            "Safety": ("mean, 0-1", {"": lambda runs: outcome(runs, SAFETY)}),
            "Needs": (f"mean, {next(iter(units.values()), '')}", needs),
            "States visited in training": ("% of those of the level", {"": seen})}


def looks_in_100(runs: Runs, behaviour: str = "all") -> dict[int, float]:
    """Seed -> activations in 100 cycles of validation."""
    return {seed: 100 * value for seed, value in looks(runs, behaviour).items()}


def _mean(runs: Runs, column: str) -> dict[int, float]:
    frame = runs.conditions.frame("episodes")
    return of_seeds(runs, episode_means(runs.conditions, column, "validation", None)) if column in frame else {}


def _against(one: Asked, own: Asked) -> list[str]:
    """How validation differs from that with the robot's own level."""
    steps = ((difference(outcome(one.runs, VALID), outcome(own.runs, VALID)), "survival", 1, " points"),
             (difference(outcome(one.runs, SAFETY), outcome(own.runs, SAFETY)), "safety", 2, ""),
             (difference(looks_in_100(one.runs), looks_in_100(own.runs)), "looks", 0, " in 100 cycles"))
    return [f"{name} {step.said(digits)}{unit}" for step, name, digits, unit in steps if step is not None]

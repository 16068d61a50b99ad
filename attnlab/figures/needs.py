"""Fig 8A: the needs in the last recorded episode of the first seed, a panel a condition."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from attnlab.figures.base import Figure
from attnlab.figures.episode import first_lines, label_of_needs, last_episode, need_lines
from attnlab.figures.found import MOST, sentence
from attnlab.figures.style import WIDTH_IN, empty
from attnlab.measures.needs import OF_THE_PAPER, falls, units_of
from attnlab.registry import register

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.artist import Artist
    from matplotlib.figure import Figure as Drawing

    from attnlab.results.conditions import Conditions


@register("figure", "needs")
class Needs(Figure):
    """Hunger, thirst and any other need within an episode."""
    title, order, place = "needs within an episode", 81, "Fig 8A"
    how = "The last recorded episode of the first seed. A need rises with time and effort and falls with a meal."

    def draw(self, conditions: Conditions) -> Drawing:
        import matplotlib.pyplot as plt
        lines, units = first_lines(conditions, MOST), units_of(conditions)
        rows = max(1, len(lines))
        figure, axes = plt.subplots(rows, 1, figsize=(WIDTH_IN, 0.7 + 1.75 * rows), sharex=True, sharey=True,
                                    squeeze=False)
        for ax, (title, line) in zip(axes.flat, lines, strict=False):
            cycles, seed = last_episode(line)
            if cycles is None or not need_lines(ax, cycles, units):
                empty(ax, "no needs were recorded")
            ax.set_title(title + (f", seed {seed}" if seed is not None else ""), color=line.colour)
            ax.margins(x=0.01)
        if not lines:
            empty(axes[0, 0], "no complete runs")
        axes[-1, 0].set_xlabel("machine cycle")
        figure.supylabel(label_of_needs(conditions), fontsize=9.5)
        names: dict[str, Artist] = {}
        for ax in axes[:, 0]:
            for handle, label in zip(*ax.get_legend_handles_labels(), strict=True):
                names.setdefault(label, handle)
        if names:
            figure.legend(list(names.values()), list(names), loc="outside upper right", ncol=4)
        return figure

    def say(self, conditions: Conditions) -> str:
        parts = []
        for title, line in first_lines(conditions, MOST):
            cycles, seed = last_episode(line)
            words = [] if cycles is None else _meals(cycles, units_of(conditions))
            if cycles is not None and words:
                parts.append(f"{title} (seed {seed}) {', '.join(words)} in {len(cycles)} cycles")
        return sentence(parts, "", conditions)


def _meals(cycles: pd.DataFrame, needs: Iterable[str]) -> list[str]:
    """How often each need that the robot has was satisfied."""
    counts = {need: len(falls(cycles, need)) for need in needs if need in cycles and not cycles[need].isna().any()}
    told = [f"{verb} {counts[need]}" for need, verb in (("hunger", "ate"), ("thirst", "drank")) if need in counts]
    others = [f"{need} fell {count} times" for need, count in counts.items() if need not in OF_THE_PAPER]
    return [*([" and ".join(told) + " times"] if told else []), *others]

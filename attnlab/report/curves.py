"""Figures along episodes: survival (Fig 6), rewards (Fig 7), maximum need (Fig 8B), safety (Fig 9), energy (Fig 10)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from attnlab.conditions import Conditions
from attnlab.report.panels import band, block_of, by_episode, grid, legend, shown, title_of_lines
from attnlab.report.style import cut, empty, seeds_note

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def survival(conditions: Conditions) -> Figure:
    """Fig 6: survival time in % of the episode, means of 50 episodes, training and then validation."""
    drawn, note = shown(conditions)
    figure, axes = grid(max(1, len(drawn)), 3.6, sharex=True, sharey=True)
    block = block_of(conditions, 50)
    for ax, panel in zip(axes, drawn, strict=False):
        for line in panel.lines:
            x, values = by_episode(line.runs, "episodes", "survival", block)
            if len(x):
                band(ax, x, 100 * values, line, marker="o", ms=3.5)
        ax.set_title(cut(panel.title, 110 // min(3, len(drawn))))
        ax.margins(x=0.02)
    if not drawn:
        empty(axes[0], "no complete runs")
    figure.supxlabel(f"training episodes (means of {block})", fontsize=9.5)
    figure.supylabel("survival time, % of the episode", fontsize=9.5)
    legend(figure, axes, title_of_lines(conditions))
    figure.suptitle(f"Survival over training\n{seeds_note(conditions)}" + (f"\n{note}" if note else ""), x=0.01,
                    ha="left", fontsize=10)
    return figure

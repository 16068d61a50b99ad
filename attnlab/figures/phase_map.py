"""A map of worlds: where one robot does better than another, and where they do alike."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from attnlab.figures.base import Figure
from attnlab.figures.compared import BETTER, EARLY, VALID, WORSE, Difference, asked, difference, survival
from attnlab.figures.style import INK, WIDTH_IN
from attnlab.figures.values import Cells, tell
from attnlab.measures.once import once_a_study
from attnlab.registry import register

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Drawing

    from attnlab.results.conditions import Conditions, Runs

ACROSS, UP, BESIDE = "world.source_distance_m", "world.obstacles", "reading.energy_well"
CR, SAME, PLAIN = "litman", "none same_states", "none plain"
SOUND = 90.0  # % of survival in the first half of training, below which a robot without curiosity is not sound (Fig 6)
ROWS = {"CR less NCR, same states: first half of training": (CR, SAME, EARLY),
        "CR less NCR, same states: validation": (CR, SAME, VALID),
        "CR less NCR, plain: validation": (CR, PLAIN, VALID)}
Place = tuple[float, float, float]  # distance (m), obstacles, E_well (UoE)


class Cell(NamedTuple):
    """A world: the runs of each robot in it."""
    runs: dict[str, Runs]

    def step(self, one: str, other: str, which: str) -> Difference | None:
        """How survival differs between two robots; None where one is missing."""
        return difference(*(survival(self.runs[robot], which) if robot in self.runs else {} for robot in (one, other)))

    @property
    def sound(self) -> bool:
        """Does NCR of 2012 (of the same states, where it was not asked) survive while it learns?"""
        found = survival(self.runs.get(PLAIN) or self.runs[SAME], EARLY) if {PLAIN, SAME} & set(self.runs) else {}
        return not found or float(np.mean(list(found.values()))) >= SOUND


@register("figure", "phase_map")
class PhaseMap(Figure):
    """Survival of CR less that of NCR over distance of sources and number of obstacles, a panel for each E_well, with
    the line of no difference and the paper's world."""
    title, order = "Where curiosity pays", 12
    how = "A cell is a world: the mean difference over paired seeds, in points; bold where its t interval (95 %, not " \
        "corrected for the number of cells) leaves out 0. Line: no difference, between the cells' centres. Ring: the " \
        "paper's world. Hatched: NCR (plain) survives less than 90 % in the first half of training."

    def applies(self, conditions: Conditions) -> bool:
        of = cells(conditions)
        return all(len({place[axis] for place in of}) > 1 for axis in (0, 1))

    def draw(self, conditions: Conditions) -> Drawing:
        import matplotlib.pyplot as plt
        from matplotlib.colors import LinearSegmentedColormap
        of = cells(conditions)
        wells = sorted({well for _, _, well in of})
        rows = {title: row for title, row in ROWS.items() if any(_steps(of, row, well) for well in wells)}
        if not rows:
            return plt.figure(figsize=(WIDTH_IN, 1))
        figure, axes = plt.subplots(len(rows), len(wells), figsize=(WIDTH_IN, 0.6 + 2.65 * len(rows)), squeeze=False,
                                    sharex=True, sharey=True)
        shades = LinearSegmentedColormap.from_list("sides", [WORSE, "#ffffff", BETTER])
        maps = [[_steps(of, row, well) for well in wells] for row in rows.values()]
        most = max(abs(step.value) for row in maps for steps in row for step in steps.values())
        drawn = None
        for i, (title, row) in enumerate(zip(rows, maps, strict=True)):
            for ax, well, steps in zip(axes[i], wells, row, strict=True):
                drawn = _panel(ax, of, well, steps, shades, most)
                share = f"E_well/E_max = {well / _energy_max(conditions):.2f}" if i == 0 else ""
                ax.set_title(f"\n{share}", fontsize=9.5, fontweight="normal")  # above it there is room for the row's
            axes[i][0].set_ylabel("obstacles")
            axes[i][0].annotate(title, (0, 1.0), xycoords="axes fraction", xytext=(-26, 18 if i == 0 else 8),
                                textcoords="offset points", fontsize=10, fontweight="bold").set_in_layout(False)
        figure.supxlabel("distance from food to water, m", fontsize=9.5)
        if drawn is not None:
            figure.colorbar(drawn, ax=axes, shrink=0.6, pad=0.01).set_label("difference in survival, points")
        return figure

    def say(self, conditions: Conditions) -> str:
        of = cells(conditions)
        parts = []
        for title, row in ROWS.items():
            found = [step for cell in of.values() if (step := cell.step(*row)) is not None]
            if found:
                clear = [sum(step.side == side for step in found) for side in (1, -1)]
                parts.append(f"{title}, clearly better in {clear[0]} and worse in {clear[1]} of {len(found)} worlds")
        unsound = sum(not cell.sound for cell in of.values())
        return f"{'; '.join(parts)}; NCR is not sound in {unsound}." if parts else "There is nothing to compare."


@once_a_study
def cells(conditions: Conditions) -> dict[Place, Cell]:
    """Every world with the runs in it; none if the study has no such settings."""
    found: dict[Place, Cell] = {}
    for one in asked(conditions):
        s = one.settings
        if not {ACROSS, UP} <= set(s):
            return {}
        robot = s["curiosity"] if s["curiosity"] != "none" else f"none {s.get('reading.non_curious', 'plain')}"
        place = float(s[ACROSS]), float(s[UP]), float(s.get(BESIDE) or one.runs.reading().energy_well)
        found.setdefault(place, Cell({})).runs.setdefault(robot, one.runs)
    return found


def _steps(of: dict[Place, Cell], row: tuple[str, str, str], well: float) -> dict[tuple[float, float], Difference]:
    """(distance, obstacles) -> difference, of one E_well."""
    return {(x, y): step for (x, y, w), cell in of.items() if w == well and (step := cell.step(*row)) is not None}


def _panel(ax: Axes, of: dict[Place, Cell], well: float, steps: dict[tuple[float, float], Difference], shades: Any,
           most: float) -> Any:
    xs, ys = (sorted({place[axis] for place in of}) for axis in (0, 1))
    grid: npt.NDArray[np.float64] = np.full((len(ys), len(xs)), np.nan)
    for (x, y), step in steps.items():
        grid[ys.index(y), xs.index(x)] = step.value
    mesh = ax.pcolormesh(np.arange(len(xs) + 1) - 0.5, np.arange(len(ys) + 1) - 0.5, grid, cmap=shades, vmin=-most,
                         vmax=most, edgecolors="white", linewidth=0.8)
    said = [[f"{steps[x, y].said(1)} points, {steps[x, y].seeds} seeds" if (x, y) in steps else "" for x in xs]
            for y in ys]
    tell(ax, Cells([f"{x:g} m" for x in xs], [f"{y:g} obstacles" for y in ys], np.arange(len(xs) + 1) - 0.5,
                   np.arange(len(ys) + 1) - 0.5, said))
    for (x, y), step in steps.items():
        i, j = xs.index(x), ys.index(y)
        ax.text(i, j, f"{step.value:+.1f}", ha="center", va="center", fontsize=7.5, color=INK,
                fontweight="bold" if step.side else "normal", alpha=1.0 if step.side else 0.75, zorder=4)
        if not of[x, y, well].sound:
            ax.fill_between([i - 0.5, i + 0.5], j - 0.5, j + 0.5, facecolor="none", edgecolor="#999999", hatch="////",
                            lw=0)
    if np.isfinite(grid).all() and grid.min() < 0 < grid.max():
        ax.contour(np.arange(len(xs)), np.arange(len(ys)), grid, levels=[0.0], colors=INK, linewidths=1.3)
    paper = papers()
    if paper in of and paper[2] == well:
        ax.plot(xs.index(paper[0]), ys.index(paper[1]), "o", ms=23, mfc="none", mec=INK, mew=1.6)
    ax.set_xticks(range(len(xs)), [f"{x:g}" for x in xs])
    ax.set_yticks(range(len(ys)), [f"{y:g}" for y in ys])
    ax.grid(False)
    return mesh


def papers() -> Place:
    """The paper's world: where the settings have their defaults."""
    from attnlab.reading import Reading
    from attnlab.worlds.spaced import Spaced
    default = Spaced.Params()
    return default.source_distance_m, float(default.obstacles), Reading().energy_well


def _energy_max(conditions: Conditions) -> float:
    return asked(conditions)[0].runs.reading().energy_max

"""What looks at a study: a column, an observer, a measure and a figure."""

from attnlab.api import Callback, Column, Figure, Measure, Probe, register
from attnlab.figures.curves import one_curve
from attnlab.figures.found import start_and_end


@register("probe", "east")
class East(Probe):
    """How far to the east the robot came, an episode. Draws nothing at random."""
    columns = {"east_m": Column("float64", "m", "largest x of the centre")}

    def measure(self, lived):
        return {"east_m": float(lived.path[:, 0].max())}


@register("callback", "longest")
class Longest(Callback):
    """Writes the longest life to longest.txt in the run's folder."""
    best = 0

    def episode(self, lived):
        self.best = max(self.best, lived.cycles)

    def end(self, status):
        if self.folder is not None:
            (self.folder / "longest.txt").write_text(f"{self.best}\n")


@register("measure", "east")
class MeanEast(Measure):
    """How far to the east the robot came, mean over training episodes."""
    unit = "m"

    def of(self, runs):
        return self.mean_of(runs, "east_m", "train")


@register("figure", "east")
class EastFigure(Figure):
    """How far to the east the robot came along training."""
    title = "how far to the east"

    def applies(self, conditions):
        return "east_m" in conditions.study.episodes.columns

    def draw(self, conditions):
        return one_curve(conditions, "East", "east_m", 1, "largest x of an episode, m")

    def say(self, conditions):
        return start_and_end(conditions, "east_m", " m", block=1)

"""Monitoring functions found by Differential Evolution before the run: offline, in parallel, resumable."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

from attnlab.learners.base import Outcome, Rehearse
from attnlab.learners.monitor import SATISFY, Function, Monitor
from attnlab.registry import register
from attnlab.settings import build, setting
from attnlab.streams import stream

GENES = ("lowest_mc", "highest_mc", "bend_log2")  # of the linear function of each behaviour
BENDS = (-2.0, 2.0)
JOURNAL = "evolution"


@register("learner", "evolution")
class Evolution(Monitor):
    """Burattini et al. 2010, as cited by Di Nocera et al. 2014: the monitoring functions are evolved. Differential
    Evolution (Storn & Price 1997, J. Global Optim. 11:341; scipy's) searches lowest, highest and bend of each
    behaviour's linear function.

    Fitness, ours, is the outcome of episodes in the run's own world: mean survival - look_cost * mean activity, every
    active behaviour of every cycle charged, as eqs 5, 6 and 10 do, over what there would be if all always were. All
    candidates play the same start poses (stream ``start/evolution``). It happens before the first training episode,
    which learn nothing any more. The defaults play (8 + 1) * 18 * 20 = 3240 episodes, many more than the others train;
    ``population=5 generations=4`` plays 500. Every evaluation is kept in the run's folder (``evolution.jsonl``): an
    interrupted run goes on where it was. What was found is in ``evolved.yaml``. Draws from ``evolution`` and numpy's
    generator seeded by it.
    """

    @dataclass
    class Params:
        generations: int = setting(8, "after the first", low=0, high=100_000)
        population: int = setting(18, "candidates in a generation", low=5, high=10_000)
        episodes: int = setting(20, "that each candidate plays", unit="episodes", low=1, high=10_000)
        look_cost: float = setting(0.1, "what it costs that all look in every cycle, in units of survival", low=0)
        workers: int = setting(1, "processes; 0 for one a core", low=0, high=1024)
        default: Function = setting(Function(), "hand-set start, and the function of behaviours not named below")
        behaviours: dict[str, Any] = setting({"eat": dict(SATISFY), "drink": dict(SATISFY)},
                                             "hand-set start by behaviour")

    @classmethod
    def prepare(cls, params: Params, play: Rehearse) -> dict[str, Any]:
        """Evolve; settings that hold what was found."""
        found = evolve(params, play)
        play.keep("evolved.yaml", {"learner": {"name": "monitor", "behaviours": found}})
        return {"behaviours": found}


def functions_of(genome: Iterable[float], behaviours: list[str]) -> dict[str, dict[str, Any]]:
    """A genome as settings of ``monitor`` by behaviour."""
    genes = list(genome)
    return {name: {"kind": "linear", "lowest_mc": genes[3 * i], "highest_mc": genes[3 * i + 1],
                   "bend": 2.0 ** genes[3 * i + 2]} for i, name in enumerate(behaviours)}


def evolve(params: Evolution.Params, play: Rehearse) -> dict[str, dict[str, Any]]:
    """The best functions by behaviour after all generations."""
    from scipy.optimize import differential_evolution
    low, high = float(min(play.periods)), float(max(play.periods))
    bounds = [(low, high), (low, high), BENDS] * len(play.behaviours)
    draw = stream(play.seed, "evolution")
    hand = [getattr(build(Function, params.behaviours.get(name, {}), "learner"), gene)
            if gene != "bend_log2" else 0.0 for name in play.behaviours for gene in GENES]
    first = [[min(b, max(a, x)) for x, (a, b) in zip(hand, bounds, strict=True)]]
    first += [[draw.uniform(a, b) for a, b in bounds] for _ in range(params.population - 1)]

    def costs(_: Callable[..., float], genomes: Iterable[Iterable[float]]) -> list[float]:
        candidates = [candidate(map(float, genome), play.behaviours) for genome in genomes]
        return [cost(outcomes, params.look_cost, len(play.behaviours))
                for outcomes in play(candidates, params.episodes, JOURNAL, params.workers)]
    result = differential_evolution(_unused, bounds, init=first, maxiter=params.generations, tol=0, polish=False,
                                    updating="deferred", workers=costs, seed=draw.getrandbits(32))
    return functions_of(map(float, result.x), play.behaviours)


def candidate(genome: Iterable[float], behaviours: list[str]) -> dict[str, Any]:
    """A genome as the settings of a learner."""
    return {"name": "monitor", "behaviours": functions_of(genome, behaviours)}


def cost(outcomes: list[Outcome], look_cost: float, behaviours: int) -> float:
    """look_cost * share of all possible activity - survival, both means over episodes."""
    total = 0.0
    for lived in outcomes:
        total += look_cost * lived.active / (lived.cycles * behaviours) - lived.cycles / lived.max_cycles
    return total / len(outcomes)


def _unused(_: Iterable[float]) -> float:
    raise AssertionError("the workers evaluate")

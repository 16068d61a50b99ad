"""Monitoring functions found by Differential Evolution before the run: offline, in parallel, resumable."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

from attnlab.learners.monitor import SATISFY, Function, Monitor
from attnlab.registry import plugin_hashes, register
from attnlab.settings import build, setting
from attnlab.streams import stream

GENES = ("lowest_mc", "highest_mc", "bend_log2")  # of the linear function of each behaviour
BENDS = (-2.0, 2.0)
JOURNAL = "evolution.jsonl"


@register("learner", "evolution")
class Evolution(Monitor):
    """Burattini et al. 2010, as cited by Di Nocera et al. 2014: the monitoring functions are evolved. Differential
    Evolution (Storn & Price 1997, J. Global Optim. 11:341; scipy's) searches lowest, highest and bend of each
    behaviour's linear function.

    Fitness, ours, is the outcome of episodes in the run's own world: mean survival - look_cost * mean share of cycles
    with somebody active. All candidates play the same start poses (stream ``start/evolution``). It happens before the
    first training episode, which learn nothing any more. The defaults play (8 + 1) * 18 * 3 = 486 episodes, about what
    the others train. Every evaluation is kept in the run's folder (``evolution.jsonl``): an interrupted run goes on
    where it was. What was found is in ``evolved.yaml``. Draws from ``evolution`` and numpy's generator seeded by it.
    """

    @dataclass
    class Params:
        generations: int = setting(8, "after the first", low=0, high=100_000)
        population: int = setting(18, "candidates in a generation", low=5, high=10_000)
        episodes: int = setting(3, "that each candidate plays", unit="episodes", low=1, high=10_000)
        look_cost: float = setting(0.1, "what looking in every cycle costs, in units of survival", low=0)
        workers: int = setting(1, "processes; 0 for one a core", low=0, high=1024)
        default: Function = setting(Function(), "hand-set start, and the function of behaviours not named below")
        behaviours: dict = setting({"eat": dict(SATISFY), "drink": dict(SATISFY)}, "hand-set start by behaviour")

    @classmethod
    def prepare(cls, experiment, folder: Path | None) -> dict:
        """Evolve; settings that hold what was found."""
        params = build(cls.Params, {k: v for k, v in experiment.settings.learner.items() if k not in ("name", "part")},
                       "learner")
        found = evolve(experiment, params, folder)
        if folder is not None:
            import yaml

            from attnlab.results.files import write_bytes
            text = yaml.safe_dump({"learner": {"name": "monitor", "behaviours": found}}, sort_keys=False)
            write_bytes(folder / "evolved.yaml", text.encode())
        return {"behaviours": found}


def functions_of(genome: Iterable[float], behaviours: list[str]) -> dict[str, dict]:
    """A genome as settings of ``monitor`` by behaviour."""
    genes = list(genome)
    return {name: {"kind": "linear", "lowest_mc": genes[3 * i], "highest_mc": genes[3 * i + 1],
                   "bend": 2.0 ** genes[3 * i + 2]} for i, name in enumerate(behaviours)}


def evolve(experiment, params: Evolution.Params, folder: Path | None) -> dict[str, dict]:
    """The best functions by behaviour after all generations."""
    from scipy.optimize import differential_evolution
    s, behaviours = experiment.settings, list(experiment.settings.behaviours)
    low, high = float(min(s.periods)), float(max(s.periods))
    bounds = [(low, high), (low, high), BENDS] * len(behaviours)
    draw = stream(s.seed, "evolution")
    hand = [getattr(build(Function, params.behaviours.get(name, {}), "learner"), gene)
            if gene != "bend_log2" else 0.0 for name in behaviours for gene in GENES]
    first = [[min(b, max(a, x)) for x, (a, b) in zip(hand, bounds, strict=True)]]
    first += [[draw.uniform(a, b) for a, b in bounds] for _ in range(params.population - 1)]
    with Judge(experiment, params, folder) as judge:
        result = differential_evolution(_unused, bounds, init=first, maxiter=params.generations, tol=0, polish=False,
                                        updating="deferred", workers=judge, seed=draw.getrandbits(32))
    return functions_of(map(float, result.x), behaviours)


def _unused(genome) -> float:
    raise AssertionError("the judge evaluates")


class Judge:
    """Evaluates generations, in processes if asked to, and remembers what it has seen in the journal."""

    def __init__(self, experiment, params: Evolution.Params, folder: Path | None):
        self.config, self.params = dict(experiment.config), params
        self.journal = folder / JOURNAL if folder is not None else None
        self.workers = params.workers or os.cpu_count() or 1
        self.seen: dict[str, float] = {}
        shared = {k: v for k, v in self.config.items() if k not in ("outputs", "study", "cluster", "fresh")}
        learner = {k: v for k, v in self.config["learner"].items() if k in ("episodes", "look_cost")}
        text = json.dumps({**shared, "learner": learner, "plugins": plugin_hashes(self.config)}, sort_keys=True,
                          default=str)
        self.key = hashlib.sha256(text.encode()).hexdigest()[:16]

    def __enter__(self):
        if self.journal is not None and self.journal.exists():
            for line in self.journal.read_text().splitlines():
                try:
                    entry = json.loads(line)
                except ValueError:  # the line that was being written when the run was killed
                    continue
                if entry.get("key") == self.key:
                    self.seen[entry["genome"]] = entry["cost"]
        self._pool = None
        return self

    def __exit__(self, *_):
        if self._pool is not None:
            self._pool.shutdown()
        _close()

    def __call__(self, _: Callable, genomes: Iterable) -> list[float]:
        """The costs of these genomes: minus their fitness."""
        genomes = [[float(x) for x in genome] for genome in genomes]
        new = [g for g in genomes if json.dumps(g) not in self.seen]
        for genome, cost in zip(new, self._costs(new), strict=True):
            self.seen[json.dumps(genome)] = cost
            if self.journal is not None:
                with open(self.journal, "a") as file:
                    file.write(json.dumps({"key": self.key, "genome": json.dumps(genome), "cost": cost}) + "\n")
        return [self.seen[json.dumps(g)] for g in genomes]

    def _costs(self, genomes: list[list[float]]) -> Iterable[float]:
        task = self.config, self.params.episodes, self.params.look_cost
        if self.workers == 1:
            _open(*task)
            return map(cost_of, genomes)
        if self._pool is None:
            from concurrent.futures import ProcessPoolExecutor
            from multiprocessing import get_context
            self._pool = ProcessPoolExecutor(self.workers, get_context("spawn"), _open, task)
        return self._pool.map(cost_of, genomes)


_play: tuple | None = None  # (experiment, simulator, episodes, look_cost) of this process


def _open(config: dict, episodes: int, look_cost: float) -> None:
    global _play
    if _play is not None:
        return
    from attnlab import registry
    from attnlab.experiment import Experiment
    registry.load_all()
    experiment = Experiment({**config, "check_identities": False})
    _play = experiment, experiment.simulator(), episodes, look_cost


def _close() -> None:
    global _play
    if _play is not None:
        _play[1].close()
    _play = None


def cost_of(genome: list[float]) -> float:
    """Play the episodes with these functions; look_cost * active share - survival, both means."""
    from attnlab.run import run_episode
    experiment, simulator, episodes, look_cost = _play
    agent = experiment.agent(simulator)  # a new one: its streams begin anew, so that all candidates share their luck
    functions = functions_of(genome, [a.behaviour.name for a in agent.attentions])
    for attention in agent.attentions:
        attention.learner.set(build(Function, functions[attention.behaviour.name], "learner"))
    exploration, cost = experiment.exploration("train"), 0.0
    for episode in range(episodes):
        history, _, _ = run_episode(agent, exploration, experiment.start_pose("evolution", episode), False)
        cost += look_cost * (len(history) - 1) / agent.simulator.cycle - agent.simulator.cycle / agent.max_cycles
    return cost / episodes

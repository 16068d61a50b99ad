"""The ways that compete, and how one of them learns on a drive."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from random import Random
from typing import Any

from attnlab import registry
from attnlab.arena.drive import Decide, Drive, Score, Task, judge
from attnlab.errors import ConfigError
from attnlab.exploration.base import Exploration
from attnlab.learners.base import Learner, LearnerContext
from attnlab.reading import Reading
from attnlab.streams import stream

BEHAVIOUR = "avoid"
DEFAULT = ("always_on", "fixed_4", "fixed_8", "fixed_12", "random", "monitor", "emotional", "q_learning", "double_q",
           "sarsa", "expected_sarsa", "q_lambda", "tempo_rl", "amrl", "timing", "tacos", "self_triggered", "bandwidth",
           "regulations")
BETWEEN = "tempo_rl(all)"  # the one that asks for the percepts between looks: shown with them and without
EPOCHS = 30  # passes over what it learns on


@dataclass(frozen=True)
class Way:
    """A learner in the arena: its name there, its part, and the settings that are not its defaults."""
    name: str
    node: Mapping[str, Any]

    @property
    def between(self) -> bool:
        """Does it learn from the percepts between looks?"""
        return dict(self.node.get("of", self.node)).get("observe") == "all"


def way(name: str, task: Task, cap: float | None = None) -> Way:
    """The way of this name: a registered learner, or ``tempo_rl(all)``. On a drive the price of a look is in the reward
    of every way; ways that plan by costs of their own are given the same price. ``cap``: looks a machine cycle that it
    may not exceed. Raises ConfigError."""
    part = name.partition("(")[0]
    if part != name and name != BETWEEN:
        raise registry.unknown("learner", name, "--ways")
    node = spec_of(part)
    if name == BETWEEN:
        node["observe"] = "all"
    if "look_cost" in node:
        node["look_cost"] = task.price if part == "self_triggered" else 0.0
    if "below" in node:
        node["below"] = {BEHAVIOUR: task.onset_m / task.sigma_max_m}
    kind: type[Learner] = registry.get("learner", node, "--ways").cls
    if kind.rehearses():
        raise ConfigError("--ways", f"{part} plays whole episodes, which a log has not", "It can compete in worlds")
    if cap is not None:
        node = {**spec_of("capped"), "of": node, "looks_per_s": cap / Reading().dt_s}
    return Way(name, node)


def spec_of(name: str) -> dict[str, Any]:
    """The node of a learner with its defaults."""
    spec = registry.find("learner", name)
    if spec is None:
        raise registry.unknown("learner", name, "--ways")
    return dict(spec.nodes()[name])


def make(chosen: Way, task: Task, seed: int) -> Learner:
    """The learner of a way, untrained."""
    context = LearnerContext(Reading(), BEHAVIOUR, ("none",), task.periods, task.bins,
                             stream(seed, "learner", BEHAVIOUR))
    made: Learner = registry.make("learner", chosen.node, context)
    return made


def learning(name: str, task: Task) -> bool:
    """Does the way learn anything?"""
    return make(way(name, task), task, 0).learns


def decide_by(learner: Learner, exploration: Exploration, draw: Random) -> Decide:
    """What a learner grants, as the arena's clocks are asked."""
    bins = learner.context.bins
    return lambda action, percept: learner.decide(action * bins + percept, exploration, draw)


def train(learner: Learner, drive: Drive, stretches: Sequence[tuple[int, int]], task: Task, seed: int,
          epochs: int = EPOCHS) -> None:
    """Let a learner look at these stretches, ``epochs`` times, exploring by epsilon 0.1.

    The reward of a period p is 1 - (price + wrong cycles in it) / p, a worth a cycle that is 1 when nothing was wrong
    and looks were free. The log knows it; the learner is told no percept that it did not look at, unless it says that
    it needs those (``needs_between``), which then come with a reward a cycle.
    """
    exploration: Exploration = registry.make("exploration", {"name": "epsilon_greedy", "epsilon": 0.1}, None)
    draw = stream(seed, "exploration", BEHAVIOUR)
    bins, periods = task.bins, task.periods
    near = [value < task.onset_m for value in drive.near_m]
    percepts = [task.percept(value) for value in drive.near_m]
    shortest = periods.index(min(periods))
    for epoch in range(epochs):
        exploration.start(epoch)
        for low, high in stretches:
            learner.start()
            state, cycle = shortest * bins + percepts[low], low
            action = learner.decide(state, exploration, draw)
            while cycle + periods[action] < high:
                p, end = periods[action], cycle + periods[action]
                wrong = [near[i] != near[cycle] for i in range(cycle, end)]
                after = action * bins + percepts[end]
                then = learner.decide(after, exploration, draw) if learner.on_policy else -1
                if learner.needs_between:
                    path = [state, *(action * bins + percepts[i] for i in range(cycle + 1, end + 1))]
                    rewards = [1.0 - w - (task.price if k == 0 else 0.0) for k, w in enumerate(wrong)]
                    learner.watched(path, rewards, False)
                elif learner.learns:
                    learner.update(state, action, 1.0 - (task.price + sum(wrong)) / p, after, then, p)
                cycle, state = end, after
                action = then if then >= 0 else learner.decide(state, exploration, draw)


def compete(chosen: Way, drive: Drive, task: Task, seed: int, epochs: int = EPOCHS) -> list[Score]:
    """The score of each block: learned on the blocks of the other parity, never on those it is judged on; judged
    greedily."""
    blocks = drive.blocks()
    scores: list[Score] = [Score()] * len(blocks)
    for parity in (0, 1):
        learner = make(chosen, task, seed)
        if learner.learns:
            train(learner, drive, [s for block in blocks[1 - parity::2] for s in block], task, seed, epochs)
        greedy: Exploration = registry.make("exploration", {"name": "greedy"}, None)
        for i in range(parity, len(blocks), 2):
            learner.start()
            decide = decide_by(learner, greedy, stream(seed, "judged", i))
            scores[i] = judge(drive, blocks[i], task, decide)
    return scores


def _first(_: int, __: int) -> int:
    return 0


def fixed(drive: Drive, task: Task, most: int = 24) -> list[list[Score]]:
    """Scores by block of clocks of every period from 1 to ``most``: what equal looks are worth without any learning."""
    blocks, found = drive.blocks(), []
    for period in range(1, most + 1):
        of_it = Task(task.onset_m, task.price, task.sigma_max_m, task.bins, (period,))
        found.append([judge(drive, block, of_it, _first) for block in blocks])
    return found

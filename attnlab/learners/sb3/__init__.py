"""A clock that a deep network sets: DQN or PPO of Stable-Baselines3, trained before the run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from random import Random
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from attnlab import registry
from attnlab.errors import ConfigError
from attnlab.exploration.base import Exploration
from attnlab.learners.base import Learner, LearnerContext, Look, Rehearse
from attnlab.learners.fixed import NoLearner
from attnlab.learners.observation import observation
from attnlab.registry import register
from attnlab.settings import setting

Layer = tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]  # weights, shape (out, in), and biases, shape (out,)


@register("learner", "sb3", presets={name: {"algorithm": name} for name in ("dqn", "ppo")})
class Sb3(NoLearner):
    """DQN (Mnih et al. 2015, Nature 518:529) or PPO (Schulman et al. 2017, arXiv:1707.06347) of Stable-Baselines3 with
    its own defaults, which nobody tuned, but that a DQN renews its targets a hundred times in its training and not
    every 10,000 steps. A network for each behaviour is trained through ``attnlab/Attention-v0`` in the run's world,
    start poses and model of curiosity, while the other behaviours learn by ``beside``. Then it is frozen: the run's
    training episodes teach it nothing, and in all episodes it takes what it holds for best. It sees what the
    environment shows (percept, period, wanting, liking, energy), not a row of a table.

    What it maximises, ours. Decisions last 1 to 12 cycles, so the discount is gamma^cycles (semi-Markov: Bradtke & Duff
    1995); one a decision would bring the future nearer the rarer one looks. For the same reason eq 4's reward, which
    comes once a period, is taken for the rate throughout it, as ``tempo_rl`` does: it counts (1 - gamma^cycles) /
    (1 - gamma) times, or looking in every cycle would earn more for being paid more often. Targets of -1500 beside
    rewards within [0, 1] make steps that undo all else a network holds. ``death=normalise`` divides all rewards so that
    the penalty becomes -1 / (1 - gamma), which changes no preference between policies; ``clip`` cuts the penalty alone
    there, as much as all that could be earned (at most 1 a cycle): then a rare death costs less than looking does.

    In the table ``policy``, q is the mean of what the network said in that state (DQN: values, PPO: logits). Draws
    nothing in the run. PyTorch is seeded by the stream ``sb3/<behaviour>`` and works on one thread, so that training
    repeats on one machine; another processor or version may give other numbers: these runs are exempt from the same
    bytes. A run that was interrupted does not train again: what was found is in its folder.
    """
    interpreted = "its network asks for what is perceived, not for a row of a table"
    exempt = "PyTorch may give other numbers on another processor or in another version"
    requires, extra = ("stable_baselines3", "gymnasium"), "sb3"

    @dataclass
    class Params:
        algorithm: Literal["dqn", "ppo"] = setting("dqn", "of Stable-Baselines3")
        steps: int = setting(100_000, "decisions of training in all; the behaviours share them equally", low=1,
                             high=10**9)
        gamma: float = setting(0.9, "discount a cycle", low=0, high=0.9999)
        death: Literal["normalise", "clip"] = setting(
            "normalise", "bring a death's penalty to -1 / (1 - gamma) in training: all rewards, or it alone")
        beside: Any = setting("q_learning", "what the others learn by while one is trained: a name, or {name: ..., "
                              "setting: ...}")
        networks: dict[str, Any] = setting({}, "what training found, by behaviour; nothing to be set by hand")

    params: Params

    @classmethod
    def prepare(cls, params: Params, play: Rehearse) -> dict[str, Any]:
        """Train a network for each behaviour; settings that hold them."""
        from attnlab.learners.sb3.training import train
        config = {**play.config, "periods": play.periods, "learner": beside(params), "start_from": None}
        params = replace(params, steps=max(1, params.steps // len(play.behaviours)))
        return {"networks": {name: play.once(f"sb3_{name}", partial(train, config, name, params))
                             for name in play.behaviours}}

    def __init__(self, params: Params, context: LearnerContext):
        super().__init__(params, context)
        beside(params)
        if context.reading.reward_period == "chosen":
            raise ConfigError("algorithm", "reading.reward_period=chosen pays for the action that comes next, which no "
                              "environment can", "reading.reward_period=elapsed")
        self.params = replace(params, networks={})
        self.layers = [(np.array(weights), np.array(biases)) for weights, biases in
                       params.networks.get(context.behaviour, ())]
        self.asked = [0] * context.states
        self.look: Look | None = None

    def meet(self, look: Look) -> None:
        self.look = look

    def decide(self, state: int, exploration: Exploration, draw: Random) -> int:
        if not self.layers:  # a newborn, nobody has trained it
            return int(draw.random() * self.actions)
        said = answer(self.layers, self.seen(state), self.params.algorithm)
        self.asked[state] += 1
        mean = self.q[state]
        for action, value in enumerate(said):
            mean[action] += (value - mean[action]) / self.asked[state]
        return said.index(max(said))

    def seen(self, state: int) -> list[float]:
        """What the environment would show of this look. Without a robot (nothing was met) it is what the state tells:
        the middle of the percept's interval, nothing wanted or liked, full energy."""
        if self.look is not None:
            return self.look()
        bins = self.context.bins
        return observation((state % bins + 0.5) / bins, 0.0, 1.0, state // bins % self.actions, self.actions, 0.0, 0.0,
                           1.0, 1.0)


def beside(params: Sb3.Params) -> dict[str, Any]:
    """The config of the learner of those who are not being trained. Raises ConfigError."""
    of = params.beside
    name = of if isinstance(of, str) else str(dict(of or {}).get("name"))
    spec = registry.find("learner", name)
    if spec is None:
        raise registry.unknown("learner", name, "learner.beside")
    kind: type[Learner] = spec.cls
    if kind.rehearses():
        raise ConfigError("beside", f"{name} plays episodes of its own", "beside=q_learning")
    return {**spec.nodes()[name], **(of if isinstance(of, Mapping) else {})}


def answer(layers: Sequence[Layer], seen: Sequence[float], algorithm: str) -> list[float]:
    """What a network says of each action: values of a DQN (between layers max(0, x)), logits of PPO (tanh x)."""
    x = np.array(seen, np.float32).astype(np.float64)  # as the environment hands it over
    for weights, biases in layers[:-1]:
        x = weights @ x + biases
        x = np.maximum(x, 0.0) if algorithm == "dqn" else np.tanh(x)
    weights, biases = layers[-1]
    found: list[float] = (weights @ x + biases).tolist()
    return found

"""A run whose choices come from outside: it stands still whenever the clock of a behaviour that somebody else decides
for fires, and goes on when it is told the next periods."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from random import Random
from typing import Any, NamedTuple

from attnlab import registry
from attnlab.attention import Attention
from attnlab.cycle import machine_cycle
from attnlab.equations import percept_bin
from attnlab.errors import ConfigError, nearest
from attnlab.exploration.base import Exploration
from attnlab.learners.base import Learner
from attnlab.learners.fixed import NoLearner
from attnlab.robot.plan import RunPlan


class Told(NoLearner):
    """Chooses what it was told; stands in for a learner."""
    name = "told"
    action = 0

    def decide(self, state: int, exploration: Exploration, draw: Random) -> int:
        return self.action


class Look(NamedTuple):
    """What a behaviour perceives when its clock fires, before it chooses. ``percept`` counts from 0, ``state`` is the
    row of a table, ``reward`` what the period that elapsed earned (0.0 if none had)."""
    sigma: float
    percept: int
    wanting: float
    liking: float
    level: int
    state: int
    reward: float


class Play:
    """The episodes of a run's training, in their order. ``deciding``: the behaviours that are decided for; the others
    learn as the config says.

    ``cycle``, ``death`` (None while it lives) and ``over`` tell how the episode stands; ``firing`` are those of
    ``deciding`` whose clock fires now.
    """

    def __init__(self, config: Mapping[str, Any] | RunPlan, deciding: Sequence[str]):
        self.plan = config if isinstance(config, RunPlan) else RunPlan(config)
        if self.plan.reading.reward_period == "chosen":
            raise ConfigError("reading.reward_period", "chosen: a reward would depend on the next action",
                              "reward_period=elapsed")
        self.simulator = self.plan.simulator()
        self.agent = self.plan.agent(self.simulator)
        self.exploration = self.plan.exploration("train")
        by_name = {a.behaviour.name: a for a in self.agent.attentions}
        for name in deciding:
            if name not in by_name:
                raise ConfigError("behaviour", f"the robot has no behaviour '{name}'", nearest(name, by_name))
        self.attentions = {name: by_name[name] for name in deciding}
        others = self.plan.settings.learner
        kind: type[Learner] = registry.get("learner", others, "learner").cls
        if len(self.attentions) < len(by_name) and kind.rehearses():
            raise ConfigError("learner", f"{others['name']} plays episodes before a run, and here is no run",
                              "learner=q_learning is for those who are not decided for")
        self.told: dict[str, Told] = {}
        for name, attention in self.attentions.items():
            attention.learner = self.told[name] = Told(None, attention.learner.context)
        self.episode, self.death, self.over = -1, None, True  # type: tuple[int, str | None, bool]
        self.penalties: dict[str, float] = {}

    @property
    def cycle(self) -> int:
        """Machine cycles lived."""
        return self.simulator.cycle

    @property
    def firing(self) -> list[str]:
        """Of those decided for, whose clock fires now."""
        return [] if self.over else [name for name, a in self.attentions.items() if a.due == self.cycle]

    def start(self) -> None:
        """The next episode."""
        self.episode += 1
        self.exploration.start(self.episode)
        self.agent.start(*self.plan.begin(self.agent, "train", self.episode))
        self.death, self.over = None, False
        self.penalties = dict.fromkeys(self.attentions, 0.0)

    def go(self, actions: Mapping[str, int]) -> bool:
        """Live on until the next of those decided for fires, or the end: is this it? ``actions``: an index of the
        periods for each that fires now."""
        agent = self.agent
        for name in self.firing:
            self.told[name].action = int(actions[name])
        while True:
            _, self.death = machine_cycle(agent, self.exploration, True)
            self.over = self.death is not None or self.cycle >= agent.max_cycles
            if self.over or self.firing:
                break
        agent.body.dead = self.death is not None
        if self.death is not None:
            shares = agent.died(self.death, True)
            self.penalties = {a.behaviour.name: share for a, share in zip(agent.attentions, shares, strict=True)
                              if a.behaviour.name in self.attentions}
        agent.now.cycle = self.cycle
        return self.over

    def look(self, name: str) -> Look:
        """What this behaviour perceives now. Reads its sensors, as its clock fires; changes nothing."""
        return look(self.attentions[name], self.agent.now)

    def words(self) -> str:
        """How things stand, in a line."""
        (x, y, heading), body = self.simulator.pose(), self.agent.body
        needs = ", ".join(f"{need.name} {value:.0f}" for need, value in zip(body.needs, body.values, strict=True))
        return (f"cycle {self.cycle}: ({x:.2f}, {y:.2f}) m, {heading:.2f} rad; {needs}{', ' if needs else ''}energy "
                f"{body.energy:.0f}; {'dead: ' + self.death if self.death else 'firing: ' + ', '.join(self.firing)}")

    def close(self) -> None:
        self.simulator.close()


def look(attention: Attention, now: Any) -> Look:
    """What :meth:`Attention.activate` is about to perceive."""
    behaviour, curiosity = attention.behaviour, attention.curiosity
    sigma = behaviour.percept(now)
    percept = percept_bin(sigma, behaviour.sigma_low, behaviour.sigma_high, attention.bins)
    wanting = curiosity.wanting(attention.memory, now.body.energy)
    liking = curiosity.liking(attention.memory, percept)
    level = curiosity.level(wanting, liking)
    state = (level * len(attention.periods) + attention.action) * attention.bins + percept
    reward = 0.0
    if attention.state >= 0:
        extrinsic = behaviour.reward(sigma, attention._terms[attention.action])
        reward = curiosity.mix(extrinsic, liking, wanting)
    return Look(sigma, percept, wanting, liking, level, state, reward)

"""One attentional behaviour at work: its clock, its percepts, its learner (AIRM, eq 1 and section "Q-learning for
attentional regulation")."""

from __future__ import annotations

from collections.abc import Sequence
from random import Random
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from attnlab.behaviours.base import Behaviour, Senses
from attnlab.curiosity.base import Curiosity
from attnlab.equations import clock_period, percept_bin, period_term
from attnlab.exploration.base import Exploration
from attnlab.learners.base import Learner
from attnlab.reading import Reading

Values = npt.NDArray[np.float64]
Whole = npt.NDArray[np.int64]
WHOLE = ("cycle", "percept", "level", "period")


class Activation(NamedTuple):
    """What happened when a clock fired. ``reward`` and ``extrinsic`` are None at an episode's first activation, when
    no period had elapsed yet."""
    cycle: int
    sigma: float
    percept: int  # from 0
    level: int
    period: int  # newly granted, machine cycles
    wanting: float
    liking: float
    released: bool
    reward: float | None
    extrinsic: float | None


class Looks(NamedTuple):
    """Activations as columns, each of shape (n,); NaN where there was no reward."""
    cycle: Whole
    sigma: Values
    percept: Whole
    level: Whole
    period: Whole
    wanting: Values
    liking: Values
    released: Values
    reward: Values
    extrinsic: Values


class Log(list[Activation]):
    """An episode's activations in the order they came. Compiled code writes them to ``table`` instead, the first
    ``rows`` of it."""
    table: Values | None = None
    rows = 0

    def columns(self) -> Looks:
        """All of them."""
        table = np.array(self, np.float64).reshape(-1, len(Activation._fields)) if self.table is None \
            else self.table[:self.rows].copy()
        return Looks(*(column.astype(np.int64) if name in WHOLE else column
                       for name, column in zip(Looks._fields, table.T, strict=True)))

    def looks(self) -> tuple[Activation, ...]:
        """All of them, one by one."""
        if self.table is None:
            return tuple(self)
        c = self.columns()
        paid = ~np.isnan(c.reward)
        return tuple(Activation._make((*row[:7], bool(row[7]), *(row[8:] if pays else (None, None))))
                     for row, pays in zip(zip(*(column.tolist() for column in c), strict=True), paid, strict=True))


class Attention:
    """The clock of one behaviour and what it learns.

    ``due`` is the cycle of the next activation, ``period`` the one in force (machine cycles), ``command`` the motor
    command held, or None. ``clamp``: index of the curiosity level that the state has where nothing is learned, -1 for
    the level there is.
    """
    command: tuple[float, float] | None

    def __init__(self, behaviour: Behaviour, periods: Sequence[int], curiosity: Curiosity, learner: Learner,
                 reading: Reading, draw: Random, clamp: int = -1):
        self.behaviour, self.curiosity, self.learner, self.reading = behaviour, curiosity, learner, reading
        self.periods, self.draw, self.bins, self.clamp = list(periods), draw, reading.percept_bins, clamp
        self._terms = [period_term(p, min(periods), max(periods)) if max(periods) > min(periods) else 0.0
                       for p in periods]
        self._first = self.periods.index(min(periods))
        self._firing_counts = reading.active == "fired"
        self._chosen_pays = reading.reward_period == "chosen"
        self._choose_first = self._chosen_pays or learner.on_policy
        self._row_levels = [level * len(periods) * self.bins for level in range(len(curiosity.levels))]
        self.memory, self.log = curiosity.memory(), Log()
        self.start()

    def start(self) -> None:
        """Every clock fires in the first cycle of an episode, at the shortest period."""
        self.due = 0
        self.action = self._first
        self.period = self.periods[self._first]
        self.state = -1
        self.command = None
        self.log.clear()
        self.wanting = self.liking = 0.0
        if not self.curiosity.persists:
            self.memory = self.curiosity.memory()
        self.behaviour.start()
        self.learner.start()

    def activate(self, now: Senses, exploration: Exploration, learning: bool) -> int:
        """The clock fires: look, be rewarded for the period that elapsed, learn, choose the next, command. Returns
        1 if that counts as active in eqs 5, 6 and 10, else 0."""
        behaviour, curiosity, learner, memory = self.behaviour, self.curiosity, self.learner, self.memory
        sigma = behaviour.percept(now)
        percept = percept_bin(sigma, behaviour.sigma_low, behaviour.sigma_high, self.bins)
        wanting = self.wanting = curiosity.wanting(memory, now.body.energy)
        liking = self.liking = curiosity.liking(memory, percept)
        level = curiosity.level(wanting, liking) if learning or self.clamp < 0 else self.clamp
        state = self._row_levels[level] + self.action * self.bins + percept
        action = learner.decide(state, exploration, self.draw) if self._choose_first else -1
        reward = extrinsic = None
        if self.state >= 0:
            extrinsic = behaviour.reward(sigma, self._terms[action if self._chosen_pays else self.action])
            reward = curiosity.mix(extrinsic, liking, wanting)
            if learning:
                learner.update(self.state, self.action, reward, state, action, self.period)
        if action < 0:
            action = learner.decide(state, exploration, self.draw)
        curiosity.observe(memory, percept)
        self.state, self.action = state, action
        self.period = clock_period(True, self.periods[action], self.period)
        self.due = now.cycle + self.period
        released = behaviour.released(now, sigma)
        self.command = behaviour.command(now, sigma) if released else None
        self.log.append(Activation(now.cycle, sigma, percept, level, self.period, wanting, liking, released, reward,
                                   extrinsic))
        return 1 if released or self._firing_counts else 0

    def died(self, share: float, learning: bool) -> float:
        """The robot died: the penalty this behaviour gets for its running period, ``share`` of all (0.0 if none)."""
        if self.state < 0 or share == 0.0:
            return 0.0
        penalty = share * self.reading.penalty
        if self.reading.penalty_mix == "inside":
            penalty = self.curiosity.mix(penalty, self.liking, self.wanting)
        if learning:
            self.learner.terminal(self.state, self.action, penalty)
        return penalty

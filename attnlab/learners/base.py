"""What a learner is."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from random import Random
from typing import Any, NamedTuple, Protocol

from attnlab.exploration.base import Exploration
from attnlab.reading import Reading


@dataclass(frozen=True)
class LearnerContext:
    """What a learner is built from: one learner a behaviour.

    A state is ``(level * len(periods) + period) * bins + percept``, all counted from 0; an action is an index into
    ``periods`` (machine cycles). ``shared``: what the learners of one robot's behaviours tell each other.
    """
    reading: Reading
    behaviour: str
    levels: Sequence[str]
    periods: Sequence[int]
    bins: int
    draw: Random
    shared: dict[str, Any] = field(default_factory=dict)

    @property
    def states(self) -> int:
        return len(self.levels) * len(self.periods) * self.bins


class Outcome(NamedTuple):
    """How an episode went: machine cycles lived, how often a behaviour was active in them (each counts, as eqs 5, 6 and
    10 charge them), and the most cycles there could be."""
    cycles: int
    active: int
    max_cycles: int


class Rehearse(Protocol):
    """Episodes that a learner may play before its run; all candidates share world, start poses and luck. ``config``:
    the run's."""
    config: dict[str, Any]
    seed: int
    periods: list[int]
    behaviours: list[str]

    def __call__(self, candidates: Sequence[Mapping[str, Any]], episodes: int, journal: str, workers: int = 1
                 ) -> list[list[Outcome]]:
        """Outcomes of ``episodes`` episodes under each candidate, a learner's settings with its ``name``. They are
        kept in the run's folder under ``journal``, so that an interrupted run goes on where it was."""

    def keep(self, name: str, content: Any) -> None:
        """Write what was found into the run's folder, as YAML."""

    def once(self, name: str, make: Callable[[], Any]) -> Any:
        """What ``make`` gives, plain data, kept in the run's folder under ``name``: an interrupted run has it, unless
        its config or the code has changed, or with ``fresh=true``."""


Look = Callable[[], list[float]]  # what is perceived now, see learners.observation; reads sensors of this cycle


class Learner(ABC):
    """Learns the next period of one behaviour's clock. ``q`` and ``visits`` are lists by state, then action."""
    name: str
    interpreted = ""  # why it runs as Python alone, where it does not compile
    exempt = ""  # why its numbers may be others on another machine, where they may
    learns = True
    on_policy = False  # does update need the next action? Then that is chosen before the update, otherwise after
    needs_between = False  # does it learn by ``watched``, from every cycle between looks? Only a log can give them

    @classmethod
    def prepare(cls, params: Any, play: Rehearse) -> dict[str, Any]:  # noqa: ARG003  for those that need it
        """Called once before a run, with its parameters: settings of this learner that were found offline, by default
        none. ``play`` plays candidates in the run's world."""
        return {}

    def __init__(self, params: Any, context: LearnerContext):
        self.params, self.context = params, context
        self.actions = len(context.periods)
        self.q = [[0.0] * self.actions for _ in range(context.states)]
        self.visits = [[0] * self.actions for _ in range(context.states)]

    def values(self, state: int) -> list[float]:
        """The value of each action in a state. Reads, changes nothing."""
        return self.q[state]

    def decide(self, state: int, exploration: Exploration, draw: Random) -> int:
        """The next action."""
        return exploration.choose(self.values(state), self.visits[state], draw)

    def meet(self, look: Look) -> None:
        """Called once, when the robot is whole, for those who decide by more than the state: ``look`` may be asked
        while they decide."""

    def start(self) -> None:
        """Called before every episode."""

    @abstractmethod
    def update(self, state: int, action: int, reward: float, next_state: int, next_action: int, cycles: int) -> None:
        """Learn from one period that ended: it was chosen in ``state``, lasted ``cycles`` and led to ``next_state``,
        where ``next_action`` was chosen (-1 unless ``on_policy``)."""

    def watched(self, path: Sequence[int], rewards: Sequence[float], ended: bool) -> None:
        """In place of ``update`` and ``terminal``, for those with ``needs_between``: learn from a period of n cycles
        whose n + 1 states and n rewards are known. ``ended``: the last one is an end."""

    @classmethod
    def rehearses(cls) -> bool:
        """Does it play episodes before its run?"""
        return cls.prepare.__func__ is not Learner.prepare.__func__  # type: ignore[attr-defined]

    @abstractmethod
    def terminal(self, state: int, action: int, reward: float) -> None:
        """Learn from the period in which the robot died; nothing comes after it."""

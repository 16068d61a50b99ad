"""Gymnasium environments of one robot. See docs/gym.md."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, SupportsFloat

import gymnasium
import numpy as np
import numpy.typing as npt

from attnlab.gym.play import Look, Play
from attnlab.learners.observation import OF_A_LOOK, observation
from attnlab.robot.plan import RunPlan

Numbers = npt.NDArray[np.float32]
Overrides = Sequence[str] | Mapping[str, Any]
SEEDS = 2**31


def plan_of(overrides: Overrides) -> RunPlan:
    """The run that overrides of the command line ask for, or that a whole config is. Raises ConfigError."""
    from attnlab.cli.calls import composed
    return RunPlan(overrides if isinstance(overrides, Mapping) else composed(list(overrides)))


def seen(play: Play, name: str, look: Look) -> list[float]:
    """:data:`OF_A_LOOK` of a behaviour that looked, with the energy and period of now."""
    attention = play.attentions[name]
    behaviour = attention.behaviour
    return observation(look.sigma, behaviour.sigma_low, behaviour.sigma_high, attention.action,
                       len(attention.periods), look.wanting, look.liking, play.agent.body.energy,
                       play.plan.reading.energy_max)


def paid(shares: Iterable[float], instead: float | None) -> float:
    """The penalties of those who are decided for together, UoR; ``instead``: of each."""
    return sum((share if instead is None else instead for share in shares if share), 0.0)


class _Robot(gymnasium.Env[Numbers, Any]):
    """What both environments share. ``overrides``: of the config, as on the command line, or a whole config.
    ``penalty``: what a death costs instead of ``reading.penalty`` (a network learns little from -1500).

    ``reset(seed=s)`` begins the run with seed s at its first training episode, ``reset()`` goes on with the next
    episode; others' learners learn from one to the next. Start poses and streams are those of ``python -m attnlab``
    with that seed.
    """
    metadata = {"render_modes": ["ansi"], "render_fps": 6}

    def __init__(self, overrides: Overrides = (), penalty: float | None = None, render_mode: str | None = None):
        self.render_mode, self.penalty, self.plan = render_mode, penalty, plan_of(overrides)
        self._play: Play | None = None
        self._looks: dict[str, Look] = {}

    @property
    def deciding(self) -> Sequence[str]:
        """The behaviours that are decided for."""
        raise NotImplementedError

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None
              ) -> tuple[Numbers, dict[str, Any]]:
        super().reset(seed=seed)
        if seed is not None or self._play is None:
            run_seed = seed if seed is not None else int(self.np_random.integers(SEEDS))
            self.close()
            self._play = Play(self.plan.with_seed(run_seed), self.deciding)
        self._play.start()
        self._perceive()
        return self._observation(), self._info()

    def _perceive(self) -> float:
        """Those who fire look; the sum of what their periods that elapsed earned, UoR."""
        assert self._play is not None, "call reset() first"
        earned = 0.0
        for name in self._play.firing:
            self._looks[name] = self._play.look(name)
            earned += self._looks[name].reward
        return earned

    def _live(self, actions: dict[str, int]) -> tuple[Numbers, SupportsFloat, bool, bool, dict[str, Any]]:
        play = self._play
        if play is None or play.over:
            raise gymnasium.error.ResetNeeded("call reset() first")
        over = play.go(actions)
        dead, earned = play.death is not None, self._perceive()
        reward = earned + paid(play.penalties.values(), self.penalty)
        return self._observation(), reward, dead, over and not dead, self._info()

    def _seen(self, name: str) -> list[float]:
        assert self._play is not None, "call reset() first"
        return seen(self._play, name, self._looks[name])

    def _observation(self) -> Numbers:
        raise NotImplementedError

    def _info(self) -> dict[str, Any]:
        play = self._play
        assert play is not None, "call reset() first"
        return {"cycle": play.cycle, "death": play.death or "none", "firing": play.firing,
                "states": {name: look.state for name, look in self._looks.items()}}

    def render(self) -> Any:
        """A line of text with ``render_mode="ansi"``."""
        return self._play.words() if self._play is not None and self.render_mode == "ansi" else None

    def close(self) -> None:
        if self._play is not None:
            self._play.close()
            self._play = None
        self._looks = {}


class AttentionEnv(_Robot):
    """``attnlab/Attention-v0``: the clock of one ``behaviour``; the other behaviours have the config's learner.

    A step is one decision: the next period, an index of ``periods``. It ends when the clock fires again, after as many
    machine cycles, with the reward of the period that elapsed (eq 4). Observation: :data:`OF_A_LOOK`, ``percept`` and
    ``period`` scaled to [0, 1]. ``terminated``: the robot died; ``truncated``: the cycles are over.
    """

    def __init__(self, behaviour: str = "avoid", overrides: Overrides = (), penalty: float | None = None,
                 render_mode: str | None = None):
        super().__init__(overrides, penalty, render_mode)
        self.behaviour = behaviour
        Play(self.plan, [behaviour]).close()  # whether there is such a behaviour is known now, not at reset
        self.action_space = gymnasium.spaces.Discrete(len(self.plan.settings.periods))
        self.observation_space = gymnasium.spaces.Box(0.0, 1.0, (len(OF_A_LOOK),), np.float32)

    @property
    def deciding(self) -> Sequence[str]:
        return [self.behaviour]

    def step(self, action: Any) -> tuple[Numbers, SupportsFloat, bool, bool, dict[str, Any]]:
        return self._live({self.behaviour: int(action)})

    def _observation(self) -> Numbers:
        return np.array(self._seen(self.behaviour), np.float32)


class SurvivalEnv(_Robot):
    """``attnlab/Survival-v0``: one scheduler for all clocks.

    A step is a decision whenever any clock fires: a period for every behaviour, of which those count whose clock
    fires. Observation: for each behaviour whether its clock fires, then :data:`OF_A_LOOK` as it last looked; nobody
    looks in between. Reward: the sum of what ended periods earned.
    """

    def __init__(self, overrides: Overrides = (), penalty: float | None = None, render_mode: str | None = None):
        super().__init__(overrides, penalty, render_mode)
        self.behaviours = list(self.plan.settings.behaviours)
        Play(self.plan, self.behaviours).close()
        shape = ((1 + len(OF_A_LOOK)) * len(self.behaviours),)
        self.action_space = gymnasium.spaces.MultiDiscrete([len(self.plan.settings.periods)] * len(self.behaviours))
        self.observation_space = gymnasium.spaces.Box(0.0, 1.0, shape, np.float32)

    @property
    def deciding(self) -> Sequence[str]:
        return self.behaviours

    def step(self, action: Any) -> tuple[Numbers, SupportsFloat, bool, bool, dict[str, Any]]:
        return self._live({name: int(index) for name, index in zip(self.behaviours, action, strict=True)})

    def _observation(self) -> Numbers:
        assert self._play is not None, "call reset() first"
        fires = self._play.firing
        return np.array([value for name in self.behaviours for value in (float(name in fires), *self._seen(name))],
                        np.float32)

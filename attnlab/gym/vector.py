"""The vector form of ``attnlab/Attention-v0``: all robots of a step in one call of compiled code."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any

import gymnasium
import numpy as np
import numpy.typing as npt
from gymnasium.vector import AutoresetMode, SyncVectorEnv, VectorEnv
from gymnasium.vector.utils import batch_space

from attnlab.errors import ConfigError
from attnlab.gym.envs import SEEDS, AttentionEnv, Numbers
from attnlab.gym.play import Play
from attnlab.robot.engines import never

Seeds = int | Sequence[int | None] | None


def attention(num_envs: int = 1, behaviour: str = "avoid", overrides: Sequence[str] = (), penalty: float | None = None,
              render_mode: str | None = None) -> VectorEnv[Any, Any, Any]:
    """What ``gymnasium.make_vec`` makes: :class:`AttentionVectorEnv`, or where the parts do not compile (or with
    ``engine=python``) Gymnasium's own vector over :class:`AttentionEnv`; ``engine_why`` says why. Raises ConfigError
    with ``engine=compiled`` if that cannot be."""
    one = AttentionEnv(behaviour, overrides, penalty, render_mode)
    asked, why = one._plan.settings.engine, never(one._plan) or ("it renders" if render_mode else "")
    if asked == "python":
        why = "engine=python"
    if not why:
        from attnlab.compiled.engine import Uncompilable
        try:
            return AttentionVectorEnv(one, num_envs)
        except Uncompilable as cause:
            why = str(cause)
    if asked == "compiled":
        raise ConfigError("engine=compiled", f"cannot be: {why}", "engine=auto runs interpreted what does not compile")
    found: Any = SyncVectorEnv([partial(AttentionEnv, behaviour, overrides, penalty, render_mode)
                                for _ in range(num_envs)])
    found.engine_why = why
    return found  # type: ignore[no-any-return]


class AttentionVectorEnv(VectorEnv[Numbers, npt.NDArray[np.int64], npt.NDArray[Any]]):
    """Robots like that of ``one``, each with a seed of its own, every one until its clock fires again. Observations
    (n, 5), rewards, ends and infos are those of :class:`AttentionEnv`; who has ended begins its next episode at the
    next step (``AutoresetMode.NEXT_STEP``). ``reset(seed=s)`` gives robot i the seed s + i."""
    metadata = {"autoreset_mode": AutoresetMode.NEXT_STEP, "render_modes": []}
    engine_why = "compiled"

    def __init__(self, one: AttentionEnv, num_envs: int):
        from attnlab.gym import steps
        from attnlab.gym.robots import Robot
        self._code, self._robot = steps, Robot
        self.num_envs, self.behaviour, self.penalty, self._plan = num_envs, one.behaviour, one.penalty, one._plan
        self.single_observation_space, self.single_action_space = one.observation_space, one.action_space
        self.observation_space = batch_space(one.observation_space, num_envs)
        self.action_space = batch_space(one.action_space, num_envs)
        self._robots: list[Any] = [None] * num_envs
        self._steps: Any = None
        self._at = np.zeros((num_envs, len(steps.AT)), np.int64)
        self._found, self._poses = np.zeros((num_envs, len(steps.FOUND))), np.zeros((num_envs, 3))
        self._ended = np.full(num_envs, steps.OVER)
        self._begin(0, self._plan.settings.seed)  # compiles, or says that it cannot
        self._robots[0] = None

    def reset(self, *, seed: Seeds = None, options: dict[str, Any] | None = None
              ) -> tuple[Numbers, dict[str, Any]]:
        seeds = [None if seed is None else seed + i for i in range(self.num_envs)] if seed is None or \
            isinstance(seed, int) else list(seed)
        if len(seeds) != self.num_envs:
            raise ConfigError("seed", f"there are {len(seeds)} seeds for {self.num_envs} robots")
        super().reset(seed=seed if isinstance(seed, int) else None)
        for i, own in enumerate(seeds):
            if own is not None or self._robots[i] is None:
                self._begin(i, int(self.np_random.integers(SEEDS)) if own is None else own)
        self._live(np.full(self.num_envs, self._code.START))
        return self._observation(), self._info(["none"] * self.num_envs)

    def step(self, actions: npt.NDArray[np.int64]) -> tuple[Numbers, npt.NDArray[Any], npt.NDArray[Any],
                                                            npt.NDArray[Any], dict[str, Any]]:
        if None in self._robots:
            raise gymnasium.error.ResetNeeded("call reset() first")
        chosen = np.array(actions, np.int64)
        if chosen.shape != (self.num_envs,) or not ((chosen >= 0) & (chosen < len(self._plan.settings.periods))).all():
            raise gymnasium.error.InvalidAction(f"{actions!r} is not in {self.action_space}")
        begins = self._ended != self._code.ALIVE
        self._live(np.where(begins, self._code.START, chosen))
        alive, late = self._ended == self._code.ALIVE, self._ended == self._code.OVER
        rewards = np.where(alive & ~begins, self._found[:, 6], 0.0)
        deaths = ["none"] * self.num_envs
        for i in np.flatnonzero(~(alive | late)).tolist():
            deaths[i], paid = self._robots[i].death(int(self._ended[i]))
            rewards[i] = 0.0 if not paid else paid if self.penalty is None else self.penalty
        return self._observation(), rewards, ~(alive | late), late, self._info(deaths)

    def close_extras(self, **_: Any) -> None:
        for robot in self._robots:
            if robot is not None:
                robot.play.close()
        self._robots = [None] * self.num_envs

    def _begin(self, i: int, seed: int) -> None:
        """A robot with this seed, to which nothing has happened."""
        if self._robots[i] is not None:
            self._robots[i].play.close()
        robot = self._robots[i] = self._robot(Play(self._plan.with_seed(seed), [self.behaviour]))
        self._at[i], self._steps = robot.at, robot.steps

    def _live(self, actions: npt.NDArray[np.int64]) -> None:
        for i in np.flatnonzero(actions == self._code.START).tolist():
            self._poses[i] = self._robots[i].start()
        self._steps(self._at, actions, self._poses, self._found, self._ended)

    def _observation(self) -> Numbers:
        attention, found = self._robots[0].play.attentions[self.behaviour], self._found
        low, high = attention.behaviour.sigma_low, attention.behaviour.sigma_high
        seen = np.stack([(found[:, 0] - low) / (high - low), found[:, 9] / max(1, len(attention.periods) - 1),
                         found[:, 2], found[:, 3], found[:, 8] / self._plan.reading.energy_max], axis=1)
        within: Numbers = np.clip(seen, 0.0, 1.0).astype(np.float32)
        return within

    def _info(self, deaths: list[str]) -> dict[str, Any]:
        """As Gymnasium's vectors have it: an array for each name, and which robots have it."""
        everybody = np.ones(self.num_envs, bool)
        firing = np.empty(self.num_envs, object)
        for i, ended in enumerate(self._ended):
            firing[i] = [self.behaviour] if ended == self._code.ALIVE else []
        states = {self.behaviour: self._found[:, 5].astype(np.int64), f"_{self.behaviour}": everybody}
        found = {"cycle": self._found[:, 7].astype(np.int64), "death": np.array(deaths, object), "firing": firing,
                 "states": states}
        return found | {f"_{name}": everybody.copy() for name in found}

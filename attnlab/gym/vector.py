"""The vector forms of ``attnlab/Attention-v0`` and ``attnlab/Survival-v0``: all robots of a step in one call of
compiled code."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import gymnasium
import numpy as np
import numpy.typing as npt
from gymnasium.vector import AutoresetMode, SyncVectorEnv, VectorEnv
from gymnasium.vector.utils import batch_space

from attnlab.errors import ConfigError
from attnlab.gym.envs import SEEDS, AttentionEnv, Numbers, Overrides, SurvivalEnv, paid
from attnlab.gym.play import Play
from attnlab.robot.engines import never

Seeds = int | Sequence[int | None] | None
Single = AttentionEnv | SurvivalEnv
Vector = VectorEnv[Any, Any, Any]


def attention(num_envs: int = 1, behaviour: str = "avoid", overrides: Overrides = (), penalty: float | None = None,
              render_mode: str | None = None) -> Vector:
    """What ``gymnasium.make_vec("attnlab/Attention-v0")`` makes, see :func:`vector`."""
    return vector(partial(AttentionEnv, behaviour, overrides, penalty, render_mode), num_envs)


def survival(num_envs: int = 1, overrides: Overrides = (), penalty: float | None = None,
             render_mode: str | None = None) -> Vector:
    """What ``gymnasium.make_vec("attnlab/Survival-v0")`` makes, see :func:`vector`."""
    return vector(partial(SurvivalEnv, overrides, penalty, render_mode), num_envs)


def vector(single: Callable[[], Single], num_envs: int) -> Vector:
    """:class:`CompiledVectorEnv`, or where the parts do not compile (or with ``engine=python``) Gymnasium's own vector
    over single environments; ``engine_why`` says why. Raises ConfigError with ``engine=compiled`` if that cannot be."""
    one = single()
    asked, why = one.plan.settings.engine, never(one.plan) or ("it renders" if one.render_mode else "")
    if asked == "python":
        why = "engine=python"
    if not why:
        from attnlab.compiled.engine import Uncompilable
        try:
            return CompiledVectorEnv(one, num_envs)
        except Uncompilable as cause:
            why = str(cause)
    if asked == "compiled":
        raise ConfigError("engine=compiled", f"cannot be: {why}", "engine=auto runs interpreted what does not compile")
    found: Any = SyncVectorEnv([single] * num_envs)
    found.engine_why = why
    return found  # type: ignore[no-any-return]


class CompiledVectorEnv(VectorEnv[Numbers, npt.NDArray[np.int64], npt.NDArray[Any]]):
    """Robots like that of ``one``, each with a seed of its own, every one until a clock fires again that is decided
    for. Observations, shape (n, ...), actions, (n,) or (n, k behaviours), rewards, ends and infos are those of ``one``;
    who has ended begins its next episode at the next step (``AutoresetMode.NEXT_STEP``). ``reset(seed=s)`` gives robot
    i the seed s + i."""
    metadata = {"autoreset_mode": AutoresetMode.NEXT_STEP, "render_modes": []}
    engine_why = "compiled"

    def __init__(self, one: Single, num_envs: int):
        from attnlab.gym import steps
        from attnlab.gym.robots import Robot
        self._code, self._robot = steps, Robot
        self.num_envs, self.deciding, self.penalty, self._plan = num_envs, list(one.deciding), one.penalty, one.plan
        self._with_fires = isinstance(one, SurvivalEnv)  # an observation says who fires
        self.single_observation_space, self.single_action_space = one.observation_space, one.action_space
        self.observation_space = batch_space(one.observation_space, num_envs)
        self.action_space = batch_space(one.action_space, num_envs)
        k = len(self.deciding)
        self._robots: list[Any] = [None] * num_envs
        self._steps: Any = None
        self._at, self._poses = np.zeros((num_envs, len(steps.OF_ROBOT)), np.int64), np.zeros((num_envs, 3))
        self._ours = np.zeros((num_envs, k, len(steps.OF_OURS)), np.int64)
        self._found, self._moments = np.zeros((num_envs, k, len(steps.FOUND))), np.zeros((num_envs, 2))
        self._ended = np.full(num_envs, steps.OVER)
        self._begin(0, self._plan.settings.seed)  # compiles, or says that it cannot
        domains = [attention.behaviour for attention in self._robots[0].play.attentions.values()]
        self._low = np.array([behaviour.sigma_low for behaviour in domains])
        self._high = np.array([behaviour.sigma_high for behaviour in domains])
        self._robots[0].play.close()
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
        self._live(np.full((self.num_envs, len(self.deciding)), self._code.START))
        return self._observation(), self._info(["none"] * self.num_envs)

    def step(self, actions: npt.NDArray[np.int64]) -> tuple[Numbers, npt.NDArray[Any], npt.NDArray[Any],
                                                            npt.NDArray[Any], dict[str, Any]]:
        if None in self._robots:
            raise gymnasium.error.ResetNeeded("call reset() first")
        chosen = np.array(actions, np.int64)
        if chosen.shape != self.action_space.shape or not ((chosen >= 0) & (chosen < len(self._plan.settings.periods))
                                                           ).all():
            raise gymnasium.error.InvalidAction(f"{actions!r} is not in {self.action_space}")
        begins = self._ended != self._code.ALIVE
        chosen = chosen.reshape(self.num_envs, -1)
        chosen[begins] = self._code.START
        self._live(chosen)
        alive, late = self._ended == self._code.ALIVE, self._ended == self._code.OVER
        rewards = np.zeros(self.num_envs)
        for j in range(len(self.deciding)):  # one after the other, as a single environment adds
            rewards += np.where((self._found[:, j, 8] > 0.0) & ~begins, self._found[:, j, 6], 0.0)
        deaths = ["none"] * self.num_envs
        for i in np.flatnonzero(~(alive | late)).tolist():
            deaths[i], shares = self._robots[i].death(int(self._ended[i]))
            rewards[i] = paid(shares, self.penalty)
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
        robot = self._robots[i] = self._robot(Play(self._plan.with_seed(seed), self.deciding))
        self._at[i], self._ours[i], self._steps = robot.at, robot.ours, robot.steps

    def _live(self, actions: npt.NDArray[np.int64]) -> None:
        for i in np.flatnonzero(actions[:, 0] == self._code.START).tolist():
            self._poses[i] = self._robots[i].start()
        self._steps(self._at, self._ours, actions, self._poses, self._found, self._moments, self._ended)

    def _observation(self) -> Numbers:
        found, energy = self._found, self._moments[:, 1:] / self._plan.reading.energy_max
        seen = np.stack([(found[..., 0] - self._low) / (self._high - self._low),
                         found[..., 7] / max(1, len(self._plan.settings.periods) - 1), found[..., 2], found[..., 3],
                         np.broadcast_to(energy, found.shape[:2])], axis=2)
        if self._with_fires:
            seen = np.concatenate([found[..., 8:9], seen], axis=2)
        within: Numbers = np.clip(seen, 0.0, 1.0).astype(np.float32).reshape(self.num_envs, -1)
        return within

    def _info(self, deaths: list[str]) -> dict[str, Any]:
        """As Gymnasium's vectors have it: an array for each name, and which robots have it."""
        everybody = np.ones(self.num_envs, bool)
        firing = np.empty(self.num_envs, object)
        for i, fires in enumerate(self._found[..., 8].tolist()):
            firing[i] = [name for name, now in zip(self.deciding, fires, strict=True) if now]
        states: dict[str, Any] = {}
        for j, name in enumerate(self.deciding):
            states |= {name: self._found[:, j, 5].astype(np.int64), f"_{name}": everybody}
        found = {"cycle": self._moments[:, 0].astype(np.int64), "death": np.array(deaths, object), "firing": firing,
                 "states": states}
        return found | {f"_{name}": everybody.copy() for name in found}

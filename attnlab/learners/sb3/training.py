"""A network from Stable-Baselines3. Imports PyTorch: only :meth:`attnlab.learners.sb3.Sb3.prepare` comes here."""

from __future__ import annotations

import random
import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import gymnasium
import numpy as np
import torch
from stable_baselines3 import DQN, PPO
from stable_baselines3.common.buffers import ReplayBuffer, RolloutBuffer

from attnlab.streams import stream

if TYPE_CHECKING:
    from attnlab.learners.sb3 import Sb3

ENVIRONMENT = "attnlab.gym:attnlab/Attention-v0"
RENEWALS = 100  # of a DQN's targets
BATCH = 64  # of PPO: a rollout, 2048 decisions, is some of them where there are fewer


def train(config: Mapping[str, Any], behaviour: str, params: Sb3.Params) -> list[list[Any]]:
    """The layers of the network of one behaviour, each (weights, biases) as lists. ``config``: the run's, with the
    learner of the other behaviours. Global random states are as before."""
    return layers(model(config, behaviour, params))


def model(config: Mapping[str, Any], behaviour: str, params: Sb3.Params) -> DQN | PPO:
    """What Stable-Baselines3 makes of it."""
    env = gymnasium.make(ENVIRONMENT, behaviour=behaviour, overrides=config, disable_env_checker=True)
    penalty = env.get_wrapper_attr("plan").reading.penalty
    more = {"discounts": [params.gamma ** period for period in config["periods"]]}
    given: dict[str, Any] = {"policy": "MlpPolicy", "env": Paid(env, config["seed"], penalty, params),
                             "gamma": params.gamma, "device": "cpu",
                             "seed": stream(config["seed"], "sb3", behaviour).getrandbits(31)}
    with _left_as_it_was():
        try:
            made = DQN(**given, replay_buffer_class=Replay, replay_buffer_kwargs=more,
                       buffer_size=min(params.steps, 1_000_000),
                       target_update_interval=max(1, params.steps // RENEWALS)) if params.algorithm == "dqn" else \
                PPO(**given, rollout_buffer_class=Rollout, rollout_buffer_kwargs=more,
                    n_steps=min(2048, max(1, params.steps // BATCH) * BATCH))
            return made.learn(params.steps)
        finally:
            env.close()


class Paid(gymnasium.Wrapper[Any, Any, Any, Any]):
    """The environment with rewards as rates and a bearable ``penalty`` (UoR), see :class:`Sb3`; it begins with the
    run's seed."""

    def __init__(self, env: gymnasium.Env[Any, Any], seed: int, penalty: float, params: Sb3.Params):
        super().__init__(env)
        self.gamma, self._seed, self._cycle = params.gamma, seed, 0
        self.worst = -1.0 / (1.0 - params.gamma)
        self.scale = min(1.0, self.worst / penalty) if params.death == "normalise" and penalty else 1.0

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        self._cycle = 0
        return super().reset(seed=None if seed is None else self._seed, options=options)

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        seen, reward, died, late, info = super().step(action)
        elapsed, self._cycle = info["cycle"] - self._cycle, info["cycle"]
        reward = self.scale * float(reward)
        reward = max(reward, self.worst) if died else reward * (1.0 - self.gamma ** elapsed) / (1.0 - self.gamma)
        return seen, reward, died, late, info


class Replay(ReplayBuffer):
    """What DQN learns from, with gamma^cycles of each period: ``discounts`` by action."""

    def __init__(self, *given: Any, discounts: Sequence[float], **more: Any):
        super().__init__(*given, **more)
        self.powers = torch.tensor(discounts, dtype=torch.float32)

    def _get_samples(self, batch_inds: Any, env: Any = None) -> Any:
        found = super()._get_samples(batch_inds, env)
        return found._replace(discounts=self.powers[found.actions])


class Rollout(RolloutBuffer):
    """What PPO learns from: generalised advantages (Schulman et al. 2016) with gamma^cycles of each period in place of
    gamma."""

    def __init__(self, *given: Any, discounts: Sequence[float], **more: Any):
        super().__init__(*given, **more)
        self.powers = np.array(discounts, np.float32)

    def compute_returns_and_advantage(self, last_values: torch.Tensor, dones: Any) -> None:
        after, alive = last_values.clone().cpu().numpy().flatten(), 1.0 - dones.astype(np.float32)
        advantage = np.zeros_like(after)
        for step in reversed(range(self.buffer_size)):
            discount = self.powers[self.actions[step].reshape(-1).astype(int)] * alive
            error = self.rewards[step] + discount * after - self.values[step]
            advantage = self.advantages[step] = error + discount * self.gae_lambda * advantage
            after, alive = self.values[step], 1.0 - self.episode_starts[step]
        self.returns = self.advantages + self.values


def layers(trained: DQN | PPO) -> list[list[Any]]:
    """Weights and biases of what chooses the actions."""
    modules = [*trained.policy.mlp_extractor.policy_net, trained.policy.action_net] if isinstance(trained, PPO) else \
        trained.q_net.q_net
    return [[module.weight.detach().double().tolist(), module.bias.detach().double().tolist()]
            for module in modules if isinstance(module, torch.nn.Linear)]


@contextmanager
def _left_as_it_was() -> Iterator[None]:
    """Stable-Baselines3 seeds what all share, and one thread repeats its sums in one order."""
    python, numpy, threads = random.getstate(), np.random.get_state(), torch.get_num_threads()
    torch.set_num_threads(1)
    with warnings.catch_warnings(), torch.random.fork_rng(devices=[]):
        warnings.filterwarnings("ignore", category=UserWarning, module="stable_baselines3")
        try:
            yield
        finally:
            random.setstate(python)
            np.random.set_state(numpy)
            torch.set_num_threads(threads)

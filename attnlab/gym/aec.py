"""PettingZoo's turn-based form: the behaviours are agents, and whose clock fires has the turn."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np

from attnlab.errors import ConfigError
from attnlab.gym.envs import SEEDS, Numbers, Overrides, plan_of, seen
from attnlab.gym.play import Look, Play
from attnlab.learners.observation import OF_A_LOOK

try:
    from pettingzoo import AECEnv
except ImportError:
    raise ConfigError("attnlab.gym.aec", "pettingzoo is not installed", "pip install 'attnlab[gym]'") from None


class BehavioursEnv(AECEnv):  # type: ignore[misc]  # it has no types
    """Every behaviour (``avoid`` is agent ``avoid_0``, as PettingZoo wants it) chooses its own next period when its
    clock fires; seeds, episodes, observations, rewards and
    ``penalty`` as in :class:`attnlab.gym.envs.AttentionEnv`. When the robot dies or its cycles are over, each agent is
    told so in its last turn."""
    metadata = {"name": "attnlab_behaviours_v0", "is_parallelizable": False, "render_modes": ["ansi"]}

    def __init__(self, overrides: Overrides = (), penalty: float | None = None, render_mode: str | None = None):
        super().__init__()
        self._plan, self.penalty, self.render_mode = plan_of(overrides), penalty, render_mode
        self.behaviours = {f"{name}_0": name for name in self._plan.settings.behaviours}
        self.possible_agents = list(self.behaviours)
        self._spaces = {name: (gymnasium.spaces.Box(0.0, 1.0, (len(OF_A_LOOK),), np.float32),
                               gymnasium.spaces.Discrete(len(self._plan.settings.periods)))
                        for name in self.possible_agents}
        self._play: Play | None = None

    def observation_space(self, agent: str) -> gymnasium.spaces.Space[Any]:
        return self._spaces[agent][0]

    def action_space(self, agent: str) -> gymnasium.spaces.Space[Any]:
        return self._spaces[agent][1]

    def reset(self, seed: int | None = None, options: dict[str, Any] | None = None) -> None:
        if seed is not None or self._play is None:
            run_seed = seed if seed is not None else int(np.random.default_rng().integers(SEEDS))
            self.close()
            self._play = Play(self._plan.with_seed(run_seed), list(self.behaviours.values()))
        self._play.start()
        self.agents = list(self.possible_agents)
        self.rewards = dict.fromkeys(self.agents, 0.0)
        self._cumulative_rewards = dict.fromkeys(self.agents, 0.0)
        self.terminations, self.truncations = dict.fromkeys(self.agents, False), dict.fromkeys(self.agents, False)
        self.infos: dict[str, dict[str, Any]] = {agent: {} for agent in self.agents}
        self._looks: dict[str, Look] = {}
        self._chosen: dict[str, int] = {}
        self._next_turns()

    def _next_turns(self) -> None:
        """Those whose clock fires look, and are paid for the period that elapsed; the first of them has the turn."""
        assert self._play is not None, "call reset() first"
        firing = self._play.firing
        self._turns = [agent for agent, name in self.behaviours.items() if name in firing]
        for agent in self._turns:
            look = self._looks[agent] = self._play.look(self.behaviours[agent])
            self.rewards[agent] = look.reward
            self.infos[agent] = {"cycle": self._play.cycle, "state": look.state}
        self._accumulate_rewards()
        self.agent_selection = self._turns[0]

    def observe(self, agent: str) -> Numbers:
        assert self._play is not None, "call reset() first"
        look = self._looks.get(agent)
        if look is None:
            return np.zeros(len(OF_A_LOOK), np.float32)
        return np.array(seen(self._play, self.behaviours[agent], look), np.float32)

    def step(self, action: int | None) -> None:
        agent, play = self.agent_selection, self._play
        if self.terminations[agent] or self.truncations[agent]:
            self._was_dead_step(action)
            return
        assert play is not None and action is not None, "call reset() first"
        self._cumulative_rewards[agent] = 0.0
        self._clear_rewards()
        self._chosen[self.behaviours[agent]] = int(action)
        if agent != self._turns[-1]:
            self.agent_selection = self._turns[self._turns.index(agent) + 1]
            return
        over = play.go(self._chosen)
        self._chosen = {}
        if not over:
            self._next_turns()
            return
        for agent, name in self.behaviours.items():
            share = play.penalties[name]
            self.rewards[agent] = 0.0 if not share else share if self.penalty is None else self.penalty
            self.infos[agent] = {"cycle": play.cycle, "death": play.death or "none"}
            self.terminations[agent], self.truncations[agent] = play.death is not None, play.death is None
        self._accumulate_rewards()
        self.agent_selection = self.agents[0]

    def render(self) -> str | None:
        """A line of text with ``render_mode="ansi"``."""
        return self._play.words() if self._play is not None and self.render_mode == "ansi" else None

    def close(self) -> None:
        if self._play is not None:
            self._play.close()
            self._play = None

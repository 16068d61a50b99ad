"""Attention as an environment: importing this registers ``attnlab/Attention-v0`` and ``attnlab/Survival-v0`` with
Gymnasium; :mod:`attnlab.gym.aec` is the same for PettingZoo. Needs the extra ``gym``.

    import gymnasium, attnlab.gym
    env = gymnasium.make("attnlab/Attention-v0", behaviour="avoid", overrides=["learner=fixed_4"])
"""

from __future__ import annotations

from attnlab.errors import ConfigError

try:
    import gymnasium
except ImportError:
    raise ConfigError("attnlab.gym", "gymnasium is not installed", "pip install 'attnlab[gym]'") from None

gymnasium.register("attnlab/Attention-v0", "attnlab.gym.envs:AttentionEnv",
                   vector_entry_point="attnlab.gym.vector:attention")
gymnasium.register("attnlab/Survival-v0", "attnlab.gym.envs:SurvivalEnv",
                   vector_entry_point="attnlab.gym.vector:survival")

"""A schedule over any exploration."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from random import Random
from typing import Any, Literal

from attnlab import registry
from attnlab.errors import ConfigError
from attnlab.exploration.base import Exploration
from attnlab.registry import register
from attnlab.settings import setting


@register("exploration", "annealed")
class Annealed(Exploration):
    """One setting of another exploration goes from ``first`` to ``last`` over the training episodes and stays there:
    linearly, or by equal factors (``exponential``). Until training starts, and in validation, it is at ``last``. Draws
    what the other draws."""

    @dataclass
    class Params:
        over: Any = setting("softmax", "the exploration: a name, or {name: ..., setting: ...}")
        what: str = setting("tau", "its setting that is annealed")
        first: float = setting(5.0, "value in the first episode")
        last: float = setting(0.1, "value from episode `episodes` on")
        episodes: int = setting(300, "length of the schedule", unit="episodes", low=1)
        shape: Literal["linear", "exponential"] = setting("exponential", "of the schedule")

    params: Params

    def __init__(self, params: Params, context: None = None):
        super().__init__(params, context)
        if params.shape == "exponential" and min(params.first, params.last) <= 0:
            raise ConfigError("exploration.shape", "exponential needs first and last above 0", "Or shape=linear")
        name = params.over if isinstance(params.over, str) else str(dict(params.over or {}).get("name"))
        spec = registry.find("exploration", name)
        if spec is None:
            raise registry.unknown("exploration", name, "exploration.over")
        if spec.cls is Annealed:
            raise ConfigError("exploration.over", "is annealed itself")
        own = params.over if isinstance(params.over, Mapping) else {}
        self._node = {**spec.nodes()[name], **own}
        for value in (params.first, params.last):
            self._at(value)

    def _at(self, value: float) -> None:
        node = {**self._node, self.params.what: value}
        self._inner: Exploration = registry.make("exploration", node, None, "exploration.over")

    def value(self, episode: int) -> float:
        """The setting in this episode."""
        p = self.params
        share = min(1.0, episode / p.episodes)
        if p.shape == "linear":
            return p.first + (p.last - p.first) * share
        factor: float = (p.last / p.first) ** share
        return p.first * factor

    def start(self, episode: int) -> None:
        self._at(self.value(episode))
        self._inner.start(episode)

    def choose(self, values: list[float], visits: list[int], draw: Random) -> int:
        return self._inner.choose(values, visits, draw)

    def probabilities(self, values: list[float], visits: list[int]) -> list[float]:
        return self._inner.probabilities(values, visits)

"""Curiosity put together from others: one's wanting with another's liking is a config and not a class."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from attnlab import registry
from attnlab.curiosity.base import Curiosity, CuriosityContext
from attnlab.errors import ConfigError
from attnlab.registry import register
from attnlab.settings import setting
from attnlab.simulators.base import Surroundings

_DEEPEST = 5  # a model over a model over a model ...


def component(node: Any, context: CuriosityContext, where: str) -> Curiosity:
    """The model that a setting names: ``surprise``, or ``{name: surprise, direction: post_prior}``."""
    named = {"name": node} if isinstance(node, str) else dict(node) if isinstance(node, Mapping) else {}
    spec = registry.find("curiosity", str(named.get("name")))
    if spec is None:
        raise registry.unknown("curiosity", str(named.get("name", node)), where)
    if context.depth >= _DEEPEST:
        raise ConfigError(where, f"models are nested more than {_DEEPEST} deep", "Does one name itself?")
    inner = dataclasses.replace(context, depth=context.depth + 1)
    made: Curiosity = registry.make("curiosity", {**spec.nodes()[named["name"]], **named}, inner, where)
    return made


class Over(Curiosity):
    """A model over another one, ``params.signal``: the memory is that model's, and so is all it does not override."""

    def __init__(self, params: Any, context: CuriosityContext):
        super().__init__(params, context)
        self.signal = component(params.signal, context, "curiosity.signal")
        self.levels, self.persists = self.signal.levels, self.signal.persists

    def attach(self, now: Surroundings) -> None:
        self.signal.attach(now)

    def memory(self) -> Any:
        return self.signal.memory()

    def wanting(self, memory: Any, energy: float) -> float:
        return self.signal.wanting(memory, energy)

    def observe(self, memory: Any, percept: int) -> None:
        self.signal.observe(memory, percept)

    def level(self, wanting: float, liking: float) -> int:
        return self.signal.level(wanting, liking)

    def mix(self, extrinsic: float, liking: float, wanting: float) -> float:
        return self.signal.mix(extrinsic, liking, wanting)


@dataclass
class Both:
    """The memory of the model that wants and that of the one that likes."""
    wants: Any
    likes: Any


@register("curiosity", "composed", presets={"litman_itti": {"liking": "surprise"}})
class Composed(Curiosity):
    """Wanting, liking, level and mixing rule, each from the model named for it (any registered one, with settings of
    its own if given as a mapping). ``litman_itti`` is Litman's wanting with Itti's liking, put together here
    and the same robot as ``surprise``.

    The memory holds one memory for the wanting and one for the liking; they are the same if both are the same model.
    ``persists`` is the liking's. Draws what its models draw.
    """

    @dataclass
    class Params:
        wanting: Any = setting("litman", "model that gives w: a name, or {name: ..., setting: ...}")
        liking: Any = setting("litman", "model that gives R_l")
        level: Any = setting("litman", "model that makes levels of the state from both")
        mix: Any = setting("litman", "model that makes the reward from both and the extrinsic one")

    params: Params

    def __init__(self, params: Params, context: CuriosityContext):
        super().__init__(params, context)
        made: list[tuple[Any, Curiosity]] = []
        for aspect in ("wanting", "liking", "level", "mix"):
            node = getattr(params, aspect)
            model = next((m for n, m in made if n == node), None) or component(node, context, f"curiosity.{aspect}")
            made.append((node, model))
        self._wants, self._likes, self._judges, self._mixes = (model for _, model in made)
        self.levels, self.persists = self._judges.levels, self._likes.persists
        self._one = self._wants is self._likes

    def attach(self, now: Surroundings) -> None:
        for model in (self._wants, self._likes, self._judges, self._mixes):
            model.attach(now)

    def memory(self) -> Both:
        wants = self._wants.memory()
        return Both(wants, wants if self._one else self._likes.memory())

    def wanting(self, memory: Both, energy: float) -> float:
        return self._wants.wanting(memory.wants, energy)

    def liking(self, memory: Both, percept: int) -> float:
        return self._likes.liking(memory.likes, percept)

    def observe(self, memory: Both, percept: int) -> None:
        self._likes.observe(memory.likes, percept)
        if not self._one:
            self._wants.observe(memory.wants, percept)

    def level(self, wanting: float, liking: float) -> int:
        return self._judges.level(wanting, liking)

    def mix(self, extrinsic: float, liking: float, wanting: float) -> float:
        return self._mixes.mix(extrinsic, liking, wanting)

"""Curiosity as a bonus that is added."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from attnlab.curiosity.composed import Over
from attnlab.registry import register
from attnlab.settings import setting


@register("curiosity", "additive")
class Additive(Over):
    """R = R_e + bonus * w * R_l in place of eq (4), with wanting, liking and levels of ``signal``: the rule of most
    bonuses in the literature, where curiosity takes nothing from the extrinsic reward. The reward may exceed 1. Name
    it as the ``mix`` of ``composed`` to combine it with others. Draws nothing at random."""

    @dataclass
    class Params:
        signal: Any = setting("litman", "model of wanting, liking and level: a name, or {name: ..., setting: ...}")
        bonus: float = setting(1.0, "weight of the liking", low=0)

    params: Params

    def liking(self, memory: Any, percept: int) -> float:
        return self.signal.liking(memory, percept)

    def mix(self, extrinsic: float, liking: float, wanting: float) -> float:
        return extrinsic + self.params.bonus * wanting * liking

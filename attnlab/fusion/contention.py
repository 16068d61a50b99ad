"""Contention scheduling: for each motor, the behaviour of the largest emphasis has its way."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from attnlab.fusion.base import Clocked, Fusion
from attnlab.reading import Reading
from attnlab.registry import register
from attnlab.settings import setting


@register("fusion", "contention")
class Contention(Fusion):
    """Caccavale & Finzi (Auton. Robots 2019; Topics Cogn. Sci. 14:327), after Norman & Shallice 1986: behaviours
    compete for each actuator, and the one of the largest emphasis takes it.

    Emphasis is e_b = top_down_b + 1 / p_b, the frequency of its clock being the bottom-up part. Ours: a command that
    asks for full speed does not compete for the speed, one that asks for no turn not for the turn; the first of equals
    wins; without a bid the robot drives at full speed, straight. Draws nothing at random.
    """

    @dataclass
    class Params:
        top_down: dict[str, float] = setting({}, "by behaviour: emphasis that the task gives it, else 0")

    params: Params

    def __init__(self, params: Params, reading: Reading):
        super().__init__(params, reading)
        self._clocks: Sequence[Clocked] = ()

    def attach(self, clocks: Sequence[Clocked]) -> None:
        self._clocks = clocks

    def fuse(self, commands: list[tuple[float, float]]) -> tuple[float, float]:
        if not commands:
            return 0.0, 0.0
        r = self.reading
        holding = [clock for clock in self._clocks if clock.command is not None]
        given = self.params.top_down
        emphasis = [given.get(clock.behaviour.name, 0.0) + 1.0 / clock.period for clock in holding]
        if len(emphasis) != len(commands):  # nobody is attached: the order decides
            emphasis = [0.0] * len(commands)
        speed = max(((e, -i) for i, e in enumerate(emphasis) if commands[i][0] < r.v_max_m_s), default=None)
        turn = max(((e, -i) for i, e in enumerate(emphasis) if commands[i][1] != 0.0), default=None)
        v = r.v_max_m_s if speed is None else commands[-speed[1]][0]
        w = 0.0 if turn is None else commands[-turn[1]][1]
        return max(0.0, v), min(r.w_max_rad_s, max(-r.w_max_rad_s, w))

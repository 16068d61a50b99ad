"""Contention scheduling: for each motor, the behaviour of the largest emphasis has its way."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

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
        self._top_down: list[float] = []

    def attach(self, clocks: Sequence[Clocked]) -> None:
        self._clocks = clocks
        self._top_down = [self.params.top_down.get(clock.behaviour.name, 0.0) for clock in clocks]

    def fuse(self, commands: list[tuple[float, float]]) -> tuple[float, float]:
        if not commands:
            return 0.0, 0.0
        r = self.reading
        emphasis = [self._top_down[i] + 1.0 / clock.period for i, clock in enumerate(self._clocks)
                    if clock.command is not None]
        attached = len(emphasis) == len(commands)  # otherwise the order decides
        v, w, driving, turning = r.v_max_m_s, 0.0, -inf, -inf
        for i, (speed, turn) in enumerate(commands):
            mine = emphasis[i] if attached else 0.0
            if speed < r.v_max_m_s and mine > driving:
                v, driving = speed, mine
            if turn != 0.0 and mine > turning:
                w, turning = turn, mine
        return max(0.0, v), min(r.w_max_rad_s, max(-r.w_max_rad_s, w))

"""What a behaviour is, and what it may look at when its clock fires."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from random import Random
from typing import Any, Protocol

from attnlab.errors import ConfigError, nearest
from attnlab.needs.base import Body, Need
from attnlab.reading import Reading
from attnlab.simulators.base import Blob, Simulator, Surroundings
from attnlab.simulators.robot import FRONT, SONARS

Command = tuple[float, float]  # (v m/s, w rad/s, left positive)


class Senses(Surroundings, Protocol):
    """What a behaviour may ask when its clock fires: the world around the robot, and its body."""
    body: Body

    def need(self, name: str) -> float:
        """The value of a need, UoE."""

    def hand(self) -> tuple[float, float]:
        """(distance m, speed m/s) of a human hand, in a simulator that shows one."""


class RobotSenses:
    """The :class:`Senses` of a robot.

    A sensor is read when it is first asked for, and once a cycle: two behaviours that fire together share the image.
    """
    __slots__ = ("_blobs", "_blobs_at", "_front", "_front_at", "_ring", "_ring_at", "body", "cycle", "simulator")

    def __init__(self, simulator: Simulator, body: Body):
        self.simulator, self.body = simulator, body
        self._front, self._ring = [0.0] * len(FRONT), [0.0] * len(SONARS)
        self.start()

    def start(self) -> None:
        """Forget the last episode's readings."""
        self.cycle = 0
        self._front_at = self._blobs_at = self._ring_at = -1

    def front_distances(self) -> list[float]:
        if self._front_at != self.cycle:
            self._front = self.simulator.echoes(len(FRONT))
            self._front_at = self.cycle
        return self._front

    def ring(self) -> list[float]:
        if self._ring_at != self.cycle:
            self._ring = self.simulator.echoes()
            self._ring_at = self.cycle
        return self._ring

    def blobs(self, kind: str) -> list[Blob]:
        if self._blobs_at != self.cycle:
            self._blobs = self.simulator.blobs()
            self._blobs_at = self.cycle
        larder = self.body.larder
        return [blob for blob in self._blobs if blob.kind == kind and larder.has(blob.solid, self.cycle)]

    def heading(self) -> float:
        return self.simulator.pose()[2]

    def need(self, name: str) -> float:
        body = self.body
        try:
            return body.values[body.index[name]]
        except KeyError:
            raise ConfigError("needs", f"nobody brings a need called '{name}'", nearest(name, body.index)) from None

    def hand(self) -> tuple[float, float]:
        return self.simulator.hand()


@dataclass(frozen=True)
class BehaviourContext:
    """What a behaviour is built from: ``draw`` is its own random stream, the same in every condition."""
    reading: Reading
    draw: Random


class Behaviour(ABC):
    """One attentional behaviour (AIRM): percept, releaser and motor schema.

    ``sigma_low`` and ``sigma_high`` bound the percept sigma; ``charges`` are the causes of death it answers for
    (``crash`` or the name of a need); ``needs`` are needs of its own that it brings along, ``feels`` names those that
    somebody must bring; ``simulators`` are those it can work in, all if empty.
    """
    name: str
    interpreted = ""  # why it runs as Python alone, where it does not compile
    sigma_low: float = 0.0
    sigma_high: float = 1.0
    charges: tuple[str, ...] = ()
    feels: tuple[str, ...] = ()
    simulators: tuple[str, ...] = ()

    def __init__(self, params: Any, context: BehaviourContext):
        self.params, self.reading, self.draw = params, context.reading, context.draw

    def needs(self) -> list[Need]:
        """Needs that exist because of this behaviour; none by default."""
        return []

    def start(self) -> None:
        """Called before every episode: forget what was held."""

    @abstractmethod
    def percept(self, now: Senses) -> float:
        """sigma: what is perceived, within [sigma_low, sigma_high]. Reads, changes nothing."""

    def released(self, now: Senses, sigma: float) -> bool:
        """Is the motor schema on? Reads, changes nothing."""
        return True

    @abstractmethod
    def command(self, now: Senses, sigma: float) -> Command | None:
        """The motor schema, called when released: a command to hold until the next activation, or None."""

    @abstractmethod
    def reward(self, sigma: float, period: float) -> float:
        """Extrinsic reward in [0, 1]; ``period`` is the period term of eqs 7-9 in [0, 1]. Pure."""

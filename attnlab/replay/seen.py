"""What a robot sensed, from where it was: its sensors read again at recorded poses, in its own world."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from attnlab.cycle import Agent
from attnlab.equations import percept_bin
from attnlab.robot.plan import RunPlan
from attnlab.simulators.robot import FRONT

if TYPE_CHECKING:
    import pandas as pd

COLUMNS = ("cycle", "percept", "level", "period", "sigma", "wanting", "liking", "released")


@dataclass
class Sensed:
    """``looks``: by behaviour, a list of rows of :data:`COLUMNS`; ``fans``: the sonar ranges (m, from the ring) by
    cycle, where any were read; ``blobs``: [solid, bearing rad, distance m, height px] by cycle, where the camera was;
    ``wrong``: looks whose recorded percept is not the one found again."""
    looks: dict[str, list[list[Any]]] = field(default_factory=dict)
    fans: dict[int, list[float]] = field(default_factory=dict)
    blobs: dict[int, list[list[float]]] = field(default_factory=dict)
    wrong: int = 0


def sense_again(plan: RunPlan, cycles: pd.DataFrame, start: tuple[float, float, float], phase: str,
                episode: int) -> Sensed:
    """Everything that was looked at in an episode. ``start``: its first pose (m, m, rad).

    A robot with fresh parts is put where the recorded one was whenever a clock fired, with the needs and the energy it
    had, and its behaviours are asked again; a sensor counts as read if one of them asked for it. Liking starts from an
    empty memory, as it does in an episode unless novelty persists.
    """
    with plan.simulator(validation=phase == "validation") as simulator:
        agent = plan.agent(simulator)
        simulator.begin(phase, episode)
        agent.start(*start)
        found = Sensed(looks={a.behaviour.name: [] for a in agent.attentions})
        names = [need.name for need in agent.body.needs]
        poses = [start, *zip(*(cycles[c].tolist() for c in ("x_m", "y_m", "heading_rad")), strict=True)]
        needs = [list(agent.body.values), *map(list, zip(*(cycles[name].tolist() for name in names), strict=True))] \
            if names else [[]] * (len(cycles) + 1)
        energies = [agent.body.energy, *cycles["energy"].tolist()]
        fired = {name: cycles[f"{name}_active"].tolist() for name in found.looks}
        told = {name: {what: cycles[f"{name}_{what}"].tolist() for what in ("percept", "level", "period")}
                for name in found.looks}
        for i in range(len(cycles)):
            if not any(fired[name][i] for name in fired):
                continue
            _stand(agent, i, poses[i], needs[i], energies[i])
            for attention in agent.attentions:
                name = attention.behaviour.name
                if fired[name][i]:
                    row = _look(attention, agent, i, {what: column[i] for what, column in told[name].items()})
                    found.wrong += row[1] != told[name]["percept"][i]
                    found.looks[name].append(row)
            _keep(agent, i, found)
        return found


def _stand(agent: Agent, cycle: int, pose: tuple[float, float, float], needs: list[float], energy: float) -> None:
    simulator = agent.simulator
    simulator.place(*pose)
    simulator.trace[cycle], simulator.cycle, agent.now.cycle = pose, cycle, cycle
    agent.body.values, agent.body.energy = list(needs), energy


def _look(attention: Any, agent: Agent, cycle: int, told: dict[str, Any]) -> list[Any]:
    behaviour, curiosity, now = attention.behaviour, attention.curiosity, agent.now
    sigma = behaviour.percept(now)
    percept = percept_bin(sigma, behaviour.sigma_low, behaviour.sigma_high, attention.bins)
    wanting = curiosity.wanting(attention.memory, agent.body.energy)
    liking = curiosity.liking(attention.memory, percept)
    curiosity.observe(attention.memory, percept)
    released = behaviour.released(now, sigma)
    if released:
        behaviour.command(now, sigma)
    return [cycle, percept + 1, told["level"], told["period"], sigma, wanting, liking, bool(released)]


def _keep(agent: Agent, cycle: int, found: Sensed) -> None:
    """Which sensors were asked for, and what they said."""
    now, simulator = agent.now, agent.simulator
    if now._ring_at == cycle:
        found.fans[cycle] = simulator.sonar()
    elif now._front_at == cycle:
        found.fans[cycle] = simulator.sonar(len(FRONT))
    if now._blobs_at == cycle:
        found.blobs[cycle] = [[b.solid, b.bearing_rad, b.distance_m, b.height_px] for b in now._blobs
                              if agent.body.larder.has(b.solid, cycle)]

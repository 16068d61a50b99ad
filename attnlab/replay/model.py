"""What the page needs in order to live an episode by itself, and which runs it can do that for."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

from attnlab.behaviours.avoid import Avoid
from attnlab.behaviours.forage import Forage
from attnlab.curiosity.litman import Litman
from attnlab.cycle import Agent
from attnlab.exploration.greedy import Greedy
from attnlab.fusion.min_speed_sum_turn import MinSpeedSumTurn
from attnlab.learners.base import Learner
from attnlab.learners.fixed import Fixed
from attnlab.needs.base import Body
from attnlab.robot.plan import RunPlan
from attnlab.simulators.planar import Planar
from attnlab.simulators.robot import BEAMS, CAMERA_HEIGHT_M, RADIUS_M, SONAR_MIN_M, SONARS

OWN = ("_turns", "_active_m", "_blocked_m", "_stop_m")  # what AVOID works out from its settings


def model_of(plan: RunPlan, phase: str, before: Mapping[str, Any] | None, start: tuple[float, float, float]
             ) -> tuple[dict[str, Any] | None, str]:
    """(model, "") or (None, why the page cannot live this episode). ``before``: the robot as it was at its start."""
    with plan.simulator(validation=phase == "validation") as simulator:
        agent = plan.agent(simulator)
        why = _cannot(plan, phase, agent)
        if why or before is None:
            return None, why or "the run was not lived again"
        assert isinstance(simulator, Planar), "checked above"
        camera, body, r = simulator.camera, agent.body, plan.reading
        return {
            "start": list(start), "dt": r.dt_s, "most": r.max_cycles, "reach": simulator.params.sonar_range_m,
            "shortest": SONAR_MIN_M, "radius": RADIUS_M, "safety": simulator.safety_distance_m or 0.0,
            "beams": [list(beam) for beam in BEAMS], "sonars": [list(sonar) for sonar in SONARS],
            "camera": {"columns": camera.columns, "rows": camera.rows, "focal": camera.focal_px,
                       "half": CAMERA_HEIGHT_M},
            "order": list(simulator._solid), "cubes": simulator._cubes, "reading": dataclasses.asdict(r),
            "bins": r.percept_bins, "periods": list(plan.settings.periods),
            "levels": list(agent.attentions[0].curiosity.levels),
            "curious": not getattr(agent.attentions[0].curiosity, "_plain", False),
            "persists": agent.attentions[0].curiosity.persists,
            "body": {"energy": before["energy"] if r.energy_carry_over and not before["dead"] else body.energy_start,
                     "e_u": body.e_u, "e_nb": body.e_nb, "needs": [dataclasses.asdict(need) for need in body.needs],
                     "following": body.larder.following, "empty": body.larder._empty_first},
            "behaviours": [_behaviour(attention, state)
                           for attention, state in zip(agent.attentions, before["behaviours"], strict=True)]}, ""


def _behaviour(attention: Any, state: Mapping[str, Any]) -> dict[str, Any]:
    part, learner = attention.behaviour, attention.learner
    own = {"kind": "avoid", **{name[1:]: getattr(part, name) for name in OWN}} if isinstance(part, Avoid) else \
        {"kind": "forage", "need": part.need, "source": part.source}
    fixed = attention.periods[learner._action] if isinstance(learner, Fixed) else None
    return {"name": part.name, "low": part.sigma_low, "high": part.sigma_high, **own,
            "params": dataclasses.asdict(part.params), "values": state["values"], "fixed": fixed,
            "memory": state["memory"], "stream": state["stream"]}


def why_not(plan: RunPlan, phase: str) -> str:
    """Why the page cannot live an episode of this run, before anything is simulated; empty if it can."""
    with plan.simulator(validation=phase == "validation") as simulator:
        return _cannot(plan, phase, plan.agent(simulator))


def _cannot(plan: RunPlan, phase: str, agent: Agent) -> str:
    """Why the page cannot live this run's episodes; empty if it can. A part counts as known if it changes nothing that
    the page has a copy of."""
    if phase != "validation":
        return "a training episode learns, and the page does not"
    if type(agent.simulator) is not Planar:
        return f"it lives in simulator={agent.simulator.name}, and the page has the planar one alone (a run with " \
               "simulator=planar has a what-if)"
    if not isinstance(plan.exploration("validation"), Greedy):
        return "its choices are drawn at random"
    if type(agent.fusion) is not MinSpeedSumTurn or type(agent.body) is not Body:
        return "its fusion or its body is one that the page does not know"
    for attention in agent.attentions:
        part, learner, curiosity = attention.behaviour, attention.learner, attention.curiosity
        if not (type(part) is Avoid or (isinstance(part, Forage) and not _changed(part, Forage))):
            return f"the page does not know the behaviour {part.name}"
        if not isinstance(curiosity, Litman) or curiosity.__class__.__module__ not in KNOWN_CURIOSITIES:
            return f"the page does not know curiosity={curiosity.name}"
        if isinstance(learner, Fixed):
            if learner._action is None:
                return "its periods are drawn at random"
        elif _changed(learner, Learner, ("decide",)) or not learner.learns:
            return f"the page does not know how learner={learner.name} decides"
    return ""


KNOWN_CURIOSITIES = ("attnlab.curiosity.litman", "attnlab.curiosity.none")


def _changed(part: Any, base: type, names: tuple[str, ...] = ("percept", "released", "command", "_search", "start",
                                                              "needs")) -> bool:
    return any(getattr(type(part), name) is not getattr(base, name) for name in names)


def body_of(plan: RunPlan) -> Body:
    """A body as the run's robot has it at the start of an episode."""
    with plan.simulator() as simulator:
        return plan.agent(simulator).body

"""What a run keeps beside its tables: from time to time where it is, so that a killed one goes on from there, and at
its end the robot that it became."""

from __future__ import annotations

import hashlib
import json
import time
from collections import defaultdict
from collections.abc import Callable, Mapping
from pathlib import Path
from random import Random
from typing import Any

from attnlab.cycle import Agent
from attnlab.exploration.base import Exploration
from attnlab.loading import plugin_hashes
from attnlab.robot.agents import AS_MADE, agent_file
from attnlab.robot.plan import RunPlan
from attnlab.robot.record import Recorder
from attnlab.robot.restore import restore
from attnlab.robot.state import UnkeptError, written
from attnlab.tables.code import package_hash
from attnlab.tables.files import write_bytes
from attnlab.tables.processes import cpu_s

CHECKPOINT, FORMAT = "checkpoint.json", "attnlab checkpoint 1"
Explorations = Mapping[str, Exploration]  # by phase


class Keeping:
    """Keeps a run in its ``folder``: a checkpoint between two episodes, every ``minutes`` (None: never).

    ``agent``: the content of agent.json, once the run has ended; ``done``, ``cycles``, ``wall_s`` and ``cpu_s``: what
    was done, and spent on it, when the run last was interrupted; ``notes``: what run.json says of all this. ``held``:
    is the run still ours to do?
    """

    def __init__(self, plan: RunPlan, folder: Path, key: str, held: Callable[[], bool] = lambda: True):
        self.plan, self.key, self.held = plan, key, held
        self.file = folder / CHECKPOINT
        self.minutes = plan.settings.checkpoint_minutes
        self.agent: bytes | None = None
        self.done = self.cycles = 0
        self.wall_s = self.cpu_s = 0.0
        self.notes: dict[str, Any] = {}
        self._tried = False
        if plan.settings.callback and self.minutes is not None:
            self._never("those who watch a run (callback) see it from its beginning or not at all")
        self._clocks = time.monotonic(), time.perf_counter(), cpu_s()

    def go_on(self, agent: Agent, explorations: Explorations, recorder: Recorder) -> None:
        """If the run was interrupted, make all as it was then. A checkpoint that other code wrote, or that is damaged,
        counts for nothing."""
        found = self._read() if self.minutes is not None else None
        if found is None:
            return
        head, body = found
        try:
            restore(self._things(agent, explorations, recorder), body)
        except UnkeptError:
            self.forget()  # half of it is in place now: the run fails, and begins anew when it is asked for again
            raise
        self.done, self.cycles, self.wall_s, self.cpu_s = head["done"], head["cycles"], head["wall_s"], head["cpu_s"]
        self.notes["went_on_at"] = self.done
        self._tried = True

    def now_and_then(self, done: int, cycles: int, agent: Agent, explorations: Explorations, recorder: Recorder,
                     settle: Callable[[], None]) -> None:
        """Write a checkpoint if it is time. ``settle`` brings all objects up to date."""
        if self.minutes is None or time.monotonic() - self._clocks[0] < 60 * self.minutes or not self.held():
            return
        settle()
        try:
            body = written(self._things(agent, explorations, recorder), AS_MADE)
            if not self._tried:
                self._try(body)
        except UnkeptError as cause:
            self._never(str(cause))
            return
        _, wall, cpu = self._clocks
        text = json.dumps(body, separators=(",", ":"), allow_nan=False).encode()
        head = {**self._mine(), "sha256": hashlib.sha256(text).hexdigest(), "done": done, "cycles": cycles,
                "wall_s": self.wall_s + time.perf_counter() - wall, "cpu_s": self.cpu_s + cpu_s() - cpu}
        write_bytes(self.file, json.dumps(head).encode() + b"\n" + text + b"\n")
        self._clocks = time.monotonic(), wall, cpu

    def end(self, agent: Agent, exploration: Exploration) -> None:
        """The last episode was played: what is to be kept of the robot."""
        plan = self.plan
        try:
            self.agent = agent_file(plan.settings, self.key, agent, exploration, plan.newborn(), plan.unused())
        except UnkeptError as cause:
            self.notes["agent"] = {"why_not": str(cause)}

    def forget(self) -> None:
        """Nothing is to go on from here."""
        self.file.unlink(missing_ok=True)

    def _never(self, why: str) -> None:
        self.minutes = None
        self.notes["checkpoints"] = f"none: {why}"

    def _mine(self) -> dict[str, Any]:
        """What a checkpoint must have in common with a run that goes on from it."""
        return {"format": FORMAT, "key": self.key, "code": package_hash(), "plugins": plugin_hashes(self.plan.config)}

    def _read(self) -> tuple[dict[str, Any], dict[str, Any]] | None:
        try:
            first, text, _ = self.file.read_bytes().split(b"\n")
            head = json.loads(first)
            mine = json.loads(json.dumps(self._mine()))
            if {name: head.get(name) for name in mine} == mine and head["sha256"] == hashlib.sha256(text).hexdigest():
                return head, json.loads(text)
        except (OSError, ValueError, KeyError, AttributeError):
            pass
        return None

    def _things(self, agent: Agent, explorations: Explorations, recorder: Recorder | None) -> dict[str, Any]:
        """All that one episode hands to the next, by name."""
        found = {**explorations, "body": agent.body, "fusion": agent.fusion, "penalty": agent.penalty,
                 **{f"{a.behaviour.name}/clock": a for a in agent.attentions},
                 "stream": getattr(agent.simulator, "draw", Random(0))}
        if recorder is not None:
            found |= {"probes": recorder.probes, "tables": recorder.tables, "visits": recorder._visits}
        return found

    def _try(self, body: Mapping[str, Any]) -> None:
        """Once a run: is a robot that goes on from a checkpoint the same as this one? Raises :class:`UnkeptError`."""
        plan = self.plan
        things = self._things(plan.parts_alone(), {phase: plan.exploration(phase) for phase in ("train", "validation")},
                              None)
        things |= {"probes": plan.probes(), "tables": {name: defaultdict(list) for name in body["tables"]["dict"]}}
        restore(things, body)
        again = written(things, AS_MADE)
        different = [name for name, value in again.items() if value != body[name]]
        if different:
            raise UnkeptError(f"{', '.join(different)}: not the same when read back")
        self._tried = True

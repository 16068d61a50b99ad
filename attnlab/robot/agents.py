"""What a robot has learned, kept in its run's folder as ``agent.json``, and robots that go on from there.

The file holds what living has changed: of each behaviour the learner, the memory of curiosity and the random streams.
What follows from settings is not in it, so that a robot may go on under others.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from attnlab import registry
from attnlab.attention import Attention, Log
from attnlab.behaviours.base import RobotSenses
from attnlab.config import RunSettings
from attnlab.cycle import Agent, History
from attnlab.errors import ConfigError
from attnlab.exploration.base import Exploration
from attnlab.robot.restore import restore
from attnlab.robot.state import UnkeptError, differing, written
from attnlab.simulators.base import Simulator
from attnlab.tables.files import mark_of, read_json
from attnlab.worlds.base import Layout

FILE, FORMAT = "agent.json", "attnlab agent 1"
AS_MADE = (Simulator, Layout, RobotSenses, Log, History)  # made anew, or cleared, when an episode begins
MARK = "#"  # between a run's folder and the hash of its agent
DIGITS = 16  # of that hash
PARTS = ("curiosity", "fusion", "exploration")  # whose state is taken by a robot that has the same part


def things_of(agent: Agent, exploration: Exploration) -> dict[str, Any]:
    """What may change in a robot by living, by name."""
    found: dict[str, Any] = {"exploration": exploration, "curiosity": agent.attentions[0].curiosity,
                             "fusion": agent.fusion}
    for attention in agent.attentions:
        name = attention.behaviour.name
        found |= {f"{name}/behaviour": attention.behaviour, f"{name}/choices": attention.draw,
                  f"{name}/learner": attention.learner, f"{name}/memory": attention.memory}
    return found


def frame_of(settings: RunSettings, attention: Attention) -> dict[str, Any]:
    """What must be the same in a robot that goes on: the states and actions of its tables, and who learns them."""
    return {"behaviours": list(settings.behaviours), "periods": list(attention.periods), "bins": attention.bins,
            "levels": list(attention.curiosity.levels), "learner": _part("learner", settings.learner)}


def agent_file(settings: RunSettings, key: str, agent: Agent, exploration: Exploration, newborn: Agent,
               unused: Exploration) -> bytes:
    """The content of ``agent.json``. ``newborn`` and ``unused``: the same robot and exploration as they are made.
    Raises :class:`UnkeptError`."""
    now = written(things_of(agent, exploration), AS_MADE)
    state = differing(now, written(things_of(newborn, unused), AS_MADE))
    content = {"format": FORMAT, "key": key, "seed": settings.seed, **frame_of(settings, agent.attentions[0]),
               **{group: _part(group, getattr(settings, group)) for group in PARTS}, "state": state}
    data = (json.dumps(content, separators=(",", ":"), allow_nan=False) + "\n").encode()
    _give(newborn, unused, json.loads(data)["state"])
    if written(things_of(newborn, unused), AS_MADE) != now:
        raise UnkeptError("a robot made from what was kept is not the same")
    return data


@dataclass(frozen=True)
class Saved:
    """A robot that was kept. ``mark``: hash of its file."""
    folder: Path
    mark: str
    content: Mapping[str, Any]

    def check(self, settings: RunSettings, attention: Attention) -> None:
        """Raise ConfigError unless a robot with these settings can go on from here."""
        mine, its = frame_of(settings, attention), self.content
        for name, of in (("behaviours", sorted), ("periods", list), ("bins", int), ("levels", list), ("learner", str)):
            if of(mine[name]) != of(its[name]):
                raise ConfigError("start_from", f"the robot of {self.folder} has the {name} {_listed(its[name])}, this "
                                  f"run {_listed(mine[name])}", "They must be the same")

    def give(self, settings: RunSettings, agent: Agent, exploration: Exploration) -> None:
        """Let a robot that is newly made go on from here. Random streams do if its seed is the same: seeds stay
        independent of each other. Raises ConfigError."""
        self.check(settings, agent.attentions[0])
        same = [group for group in PARTS if _part(group, getattr(settings, group)) == self.content[group]]
        state = {name: value for name, value in self.content["state"].items() if name not in PARTS or name in same}
        if "curiosity" not in same:
            state = {name: value for name, value in state.items() if not name.endswith("/memory")}
        try:
            _give(agent, exploration, state, settings.seed == self.content["seed"])
        except (UnkeptError, LookupError, TypeError, ValueError, AttributeError) as cause:
            raise ConfigError("start_from", f"the robot of {self.folder} is another: {cause}",
                              "The parts must be the same") from None

    def give_exploration(self, settings: RunSettings, exploration: Exploration) -> None:
        """What an exploration of the same part has learned."""
        if _part("exploration", settings.exploration) == self.content["exploration"]:
            restore({"exploration": exploration}, self.content["state"])


def _give(agent: Agent, exploration: Exploration, state: Mapping[str, Any], streams: bool = True) -> None:
    found = restore(things_of(agent, exploration), state, streams)
    for attention in agent.attentions:
        attention.memory = found[f"{attention.behaviour.name}/memory"]


def saved(text: str) -> Saved:
    """The robot that ``FOLDER`` or ``FOLDER#HASH`` names. Raises ConfigError if there is none, or if it is another than
    was named."""
    name, _, mark = text.partition(MARK)
    folder = Path(name).expanduser()
    about = read_json(folder / "run.json")
    if about is None or about.get("status") != "complete":
        raise ConfigError("start_from", f"{name} is no complete run", "Name a run: start_from=outputs/STUDY/RUN")
    kept = about.get("agent") or {}
    try:
        data = (folder / FILE).read_bytes()
        content = json.loads(data)
    except (OSError, ValueError):
        why = kept.get("why_not") or "it was made before robots were kept, or the file is damaged"
        raise ConfigError("start_from", f"{folder} has no {FILE} that can be read: {why}",
                          "Run it again with fresh=true") from None
    found = mark_of(data)["sha256"]
    if found != kept.get("sha256") or not isinstance(content, dict) or content.get("format") != FORMAT:
        raise ConfigError("start_from", f"{folder / FILE} is not what its run wrote", "Run it again with fresh=true")
    if mark and mark != found[:DIGITS]:
        raise ConfigError("start_from", f"the robot of {folder} is not the one that was named ({found[:DIGITS]}, not "
                          f"{mark})", "It was made anew by other code; name it again")
    return Saved(folder, found[:DIGITS], content)


def pinned(config: Mapping[str, Any]) -> dict[str, Any]:
    """A config whose ``start_from`` says which robot is meant, whatever becomes of the folder. Raises ConfigError."""
    text = config.get("start_from")
    if not isinstance(text, str) or MARK in text:
        return dict(config)
    return {**config, "start_from": f"{text}{MARK}{saved(text).mark}"}


def _part(group: str, node: Mapping[str, Any]) -> str:
    return registry.get(group, node, group).name


def _listed(value: Any) -> str:
    return ", ".join(map(str, value)) if isinstance(value, Sequence) and not isinstance(value, str) else str(value)

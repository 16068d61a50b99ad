"""A run lived again up to one of its episodes: for cycles that were not recorded, and for the random streams as they
stood when an episode began."""

from __future__ import annotations

import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from attnlab.curiosity.window import Window
from attnlab.cycle import Agent
from attnlab.errors import ConfigError
from attnlab.robot.episode import run_episode
from attnlab.robot.plan import RunPlan
from attnlab.robot.record import Recorder
from attnlab.robot.rehearsal import Rehearsal
from attnlab.tables.scratch import scratch

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class Lived:
    """An episode that was lived again: its cycles as the table has them, what killed the robot (``none``), and the
    robot as it was when the episode began (``before``, see :func:`state_of`)."""
    cycles: pd.DataFrame
    death: str
    before: dict[str, Any]


def live_again(plan: RunPlan, folder: Path, phase: str, episode: int) -> Lived:
    """The run's episodes in their order, until this one has been lived. Nothing is written; ``folder``: of the run,
    for what a learner found offline."""
    import pandas as pd
    s = plan.settings
    recorder = Recorder("again", s.seed, s.curiosity["name"], {}, plan.layout, False, plan.probes())
    with scratch() as copy:
        for journal in folder.glob("*.jsonl"):
            shutil.copy(journal, copy)
        with Rehearsal(plan, Path(copy)) as play:
            plan.prepare(play)
    simulator = plan.simulator()
    try:
        agent = plan.agent(simulator)
        for now, episodes in (("train", s.train_episodes), ("validation", s.validation_episodes)):
            exploration, learning = plan.exploration(now), now == "train"
            if not learning and plan.validation_spec is not None:
                simulator.close()
                agent.simulator = agent.now.simulator = simulator = plan.simulator(validation=True)
            for i in range(episodes):
                if learning:
                    exploration.start(i)
                wanted = (now, i) == (phase, episode)
                before = state_of(agent) if wanted else {}
                outcome = run_episode(agent, exploration, plan.begin(agent, now, i), learning)
                if wanted:
                    recorder.episode(agent, now, i, *outcome, True)
                    return Lived(pd.DataFrame(recorder.tables["cycles"]), outcome[0] or "none", before)
    finally:
        simulator.close()
    raise ConfigError("--episode", f"there is no {phase} episode {episode}", _asked(s.train_episodes,
                                                                                    s.validation_episodes))


def state_of(agent: Agent) -> dict[str, Any]:
    """All of a robot that one episode hands to the next: of each behaviour its random streams, what it remembers and
    the values it learned; and its energy."""
    return {"energy": agent.body.energy, "dead": agent.body.dead, "behaviours": [
        {"stream": list(a.behaviour.draw.getstate()[1]), "choices": list(a.draw.getstate()[1]),
         "memory": a.memory.seen() if isinstance(a.memory, Window) else [],
         "values": [list(a.learner.values(state)) for state in range(len(a.learner.q))]}
        for a in agent.attentions]}


def _asked(train: int, validation: int) -> str:
    return f"The run has train 0 to {train - 1}" + (f", validation 0 to {validation - 1}" if validation else "")

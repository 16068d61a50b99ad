"""One run: training episodes, then validation episodes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from attnlab.errors import PartError
from attnlab.robot.engines import player
from attnlab.robot.guards import diagnose
from attnlab.robot.keeping import Keeping
from attnlab.robot.observers import Observers
from attnlab.robot.plan import RunPlan
from attnlab.robot.record import Recorder, Tables
from attnlab.robot.rehearsal import Rehearsal

Progress = Callable[[int, int], None]  # (episodes done, cycles done)


def play_run(plan: RunPlan, run: str = "run", swept: Mapping[str, Any] | None = None,
             progress: Progress | None = None, folder: Path | None = None,
             observers: Observers | None = None, engine: str = "python", keeping: Keeping | None = None
             ) -> tuple[Tables, int]:
    """All episodes of a run; (tables as lists by column, machine cycles simulated).

    ``folder``: where a learner that works offline keeps its journal; ``engine``: python or compiled, as
    :mod:`attnlab.robot.engines` chose; ``keeping``: where it goes on if it was interrupted, and keeps where it is."""
    s = plan.settings
    recorder = Recorder(run, s.seed, s.curiosity["name"], dict(swept or {}), plan.layout, s.check_identities,
                        plan.probes(), observers or Observers())
    done = cycles = 0
    phases = [("train", s.train_episodes), ("validation", s.validation_episodes)]
    last = max(i for i, (_, episodes) in enumerate(phases) if episodes)
    with Rehearsal(plan, folder) as play:
        plan.prepare(play)
    simulator, agent = plan.simulator(), None
    try:
        agent = plan.agent(simulator)
        explorations = {phase: plan.exploration(phase) for phase, _ in phases}
        if keeping is not None:
            keeping.go_on(agent, explorations, recorder)
            done, cycles = keeping.done, keeping.cycles
        play_episode, quick, finish = player(engine, agent, list(explorations.values()))
        for index, (phase, episodes) in enumerate(phases):
            first = max(0, min(episodes, done - index * s.train_episodes))
            exploration = explorations[phase]
            learning = phase == "train"
            if phase == "validation" and plan.validation_spec is not None:
                simulator.close()
                drawn = simulator.draw.getstate()
                agent.simulator = agent.now.simulator = simulator = plan.simulator(validation=True)
                if first:
                    simulator.draw.setstate(drawn)  # as the checkpoint has it
            for episode in range(first, episodes):
                if learning:
                    exploration.start(episode)
                outcome = play_episode(agent, exploration, plan.begin(agent, phase, episode), learning)
                full = (s.record == "all" or (s.record == "validation" and phase == "validation")
                        or (s.record == "last" and index == last and episode == episodes - 1))
                recorder.episode(agent, phase, episode, *outcome, full, quick)
                done, cycles = done + 1, cycles + simulator.cycle
                if keeping is not None:
                    keeping.now_and_then(done, cycles, agent, explorations, recorder, finish)
                if progress:
                    progress(done, cycles)
        finish()
        if keeping is not None:
            keeping.end(agent, explorations["train"])
        return recorder.finish(agent), cycles
    except PartError:
        raise
    except Exception:
        if agent is not None:
            diagnose(agent)  # raises, and names the part, if one gave what it must not
        raise
    finally:
        simulator.close()

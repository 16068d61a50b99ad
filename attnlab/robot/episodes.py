"""One run: training episodes, then validation episodes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from attnlab.errors import PartError
from attnlab.robot.engines import player
from attnlab.robot.guards import diagnose
from attnlab.robot.observers import Observers
from attnlab.robot.plan import RunPlan
from attnlab.robot.record import Recorder, Tables
from attnlab.robot.rehearsal import Rehearsal

Progress = Callable[[int, int], None]  # (episodes done, cycles done)


def play_run(plan: RunPlan, run: str = "run", swept: Mapping[str, Any] | None = None,
             progress: Progress | None = None, folder: Path | None = None,
             observers: Observers | None = None, engine: str = "python") -> tuple[Tables, int]:
    """All episodes of a run; (tables as lists by column, machine cycles simulated).

    ``folder``: where a learner that works offline keeps its journal; ``engine``: python or compiled, as
    :mod:`attnlab.robot.engines` chose."""
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
        play_episode, quick, finish = player(engine, agent, list(explorations.values()))
        for index, (phase, episodes) in enumerate(phases):
            exploration = explorations[phase]
            learning = phase == "train"
            if phase == "validation" and plan.validation_spec is not None:
                simulator.close()
                agent.simulator = agent.now.simulator = simulator = plan.simulator(validation=True)
            for episode in range(episodes):
                if learning:
                    exploration.start(episode)
                outcome = play_episode(agent, exploration, plan.start_pose(phase, episode), learning)
                full = (s.record == "all" or (s.record == "validation" and phase == "validation")
                        or (s.record == "last" and index == last and episode == episodes - 1))
                recorder.episode(agent, phase, episode, *outcome, full, quick)
                done, cycles = done + 1, cycles + simulator.cycle
                if progress:
                    progress(done, cycles)
        finish()
        return recorder.finish(agent), cycles
    except PartError:
        raise
    except Exception:
        if agent is not None:
            diagnose(agent)  # raises, and names the part, if one gave what it must not
        raise
    finally:
        simulator.close()

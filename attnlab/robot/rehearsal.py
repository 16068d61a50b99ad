"""Episodes before a run, for learners that work offline: played in processes, kept in a journal, never paid twice."""

from __future__ import annotations

import hashlib
import json
import os
import threading
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from attnlab.config import COSMETIC
from attnlab.learners.base import Outcome
from attnlab.loading import load_all, plugin_hashes
from attnlab.robot.episode import run_episode
from attnlab.robot.plan import RunPlan
from attnlab.tables.code import package_hash
from attnlab.tables.files import read_json, write_bytes
from attnlab.tables.processes import end_with_parent

if TYPE_CHECKING:
    from concurrent.futures import ProcessPoolExecutor

    from attnlab.simulators.base import Simulator

Candidate = Mapping[str, Any]  # settings of a learner, with its name


class Rehearsal:
    """Plays candidates in a run's own world: see :class:`attnlab.learners.base.Rehearse`, which this is.

    ``folder`` holds the journal, none if left out. A candidate that the journal has is not played again. Use as a
    context manager.
    """

    def __init__(self, plan: RunPlan, folder: Path | None):
        self.seed, self.periods = plan.settings.seed, plan.settings.periods
        self.behaviours = list(plan.settings.behaviours)
        self.config, self._folder = dict(plan.config), folder
        self._seen: dict[str, list[Outcome]] = {}
        self._pool: ProcessPoolExecutor | None = None

    def __enter__(self) -> Rehearsal:
        return self

    def __exit__(self, *_: object) -> None:
        if self._pool is not None:
            self._pool.shutdown()
        _close()

    def __call__(self, candidates: Sequence[Candidate], episodes: int, journal: str, workers: int = 1
                 ) -> list[list[Outcome]]:
        """Outcomes of the first ``episodes`` episodes under each candidate; ``workers``: processes, 0 for all cores."""
        file = self._folder / f"{journal}.jsonl" if self._folder is not None else None
        key = self._key(episodes)
        if not self._seen and file is not None:
            self._seen = read_journal(file, key)
        texts = [json.dumps(candidate, sort_keys=True) for candidate in candidates]
        new = [text for text in dict.fromkeys(texts) if text not in self._seen]
        for text, outcomes in zip(new, self._play(new, episodes, workers or os.cpu_count() or 1), strict=True):
            self._seen[text] = outcomes
            if file is not None:
                with file.open("a") as lines:
                    lines.write(json.dumps({"key": key, "candidate": text, "outcomes": outcomes}) + "\n")
        return [self._seen[text] for text in texts]

    def keep(self, name: str, content: Any) -> None:
        """Write what was found into the run's folder, as YAML."""
        if self._folder is not None:
            import yaml
            write_bytes(self._folder / name, yaml.safe_dump(content, sort_keys=False).encode())

    def once(self, name: str, make: Callable[[], Any]) -> Any:
        """What ``make`` gives, kept as ``name``.jsonl with what it hangs on: settings, plugins, code."""
        counts = {key: value for key, value in self.config.items() if key not in COSMETIC}
        key = json.loads(json.dumps({**counts, "plugins": plugin_hashes(self.config), "code": package_hash()},
                                    default=str))
        file = self._folder / f"{name}.jsonl" if self._folder is not None else None
        kept = read_json(file) if file is not None and not self.config.get("fresh") else None
        if kept is not None and kept.get("of") == key:
            return kept["found"]
        found = make()
        if file is not None:
            write_bytes(file, (json.dumps({"of": key, "found": found}) + "\n").encode())
        return found

    def _key(self, episodes: int) -> str:
        """Of all that an outcome depends on but the candidate; the learner's other settings are the candidate's."""
        shared = {name: value for name, value in self.config.items() if name not in (*COSMETIC, "learner")}
        text = json.dumps({**shared, "episodes": episodes, "plugins": plugin_hashes(self.config)}, sort_keys=True,
                          default=str)
        return hashlib.sha256(text.encode()).hexdigest()[:16]

    def _play(self, candidates: list[str], episodes: int, workers: int) -> Iterable[list[Outcome]]:
        if workers == 1 or not candidates:
            _open(self.config, episodes)
            return map(play, candidates)
        if self._pool is None:
            from concurrent.futures import ProcessPoolExecutor
            from multiprocessing import get_context
            self._pool = ProcessPoolExecutor(workers, get_context("spawn"), _open, (self.config, episodes))
        return self._pool.map(play, candidates)


def read_journal(file: Path, key: str) -> dict[str, list[Outcome]]:
    """What a journal holds under this key: candidate (as JSON) -> outcomes."""
    found = {}
    for line in file.read_text().splitlines() if file.exists() else []:
        try:
            entry = json.loads(line)
        except ValueError:  # the line that was being written when the run was killed
            continue
        if entry.get("key") == key:
            found[entry["candidate"]] = [Outcome(*outcome) for outcome in entry["outcomes"]]
    return found


class _Stage(threading.local):
    """What was opened on this thread: (plan, simulator, episodes)."""
    opened: tuple[RunPlan, Simulator, int] | None = None


_stage = _Stage()


def _open(config: Mapping[str, Any], episodes: int) -> None:
    if _stage.opened is None:
        end_with_parent()
        load_all()
        plan = RunPlan({**config, "check_identities": False})
        _stage.opened = plan, plan.simulator(), episodes


def _close() -> None:
    if _stage.opened is not None:
        _stage.opened[1].close()
    _stage.opened = None


def play(candidate: str) -> list[Outcome]:
    """Play the episodes with this learner. It starts with streams of its own, so that all candidates share their
    luck."""
    assert _stage.opened is not None, "nothing was opened"
    plan, simulator, episodes = _stage.opened
    agent = plan.agent(simulator, json.loads(candidate))
    exploration, outcomes = plan.exploration("train"), []
    for episode in range(episodes):
        run_episode(agent, exploration, plan.begin(agent, "evolution", episode), False)
        active = int(agent.history.columns()[:, 1].sum())
        outcomes.append(Outcome(agent.simulator.cycle, active, agent.max_cycles))
    return outcomes

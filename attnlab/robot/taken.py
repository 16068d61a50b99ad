"""What a behaviour's clock does in each state, out of a run that is complete."""

from __future__ import annotations

from pathlib import Path
from random import Random
from typing import Any

from attnlab import registry
from attnlab.errors import ConfigError, nearest
from attnlab.learners.base import Learner
from attnlab.loading import load_all
from attnlab.robot.plan import RunPlan
from attnlab.tables.files import read_json


def taken(run: Path | str, behaviour: str) -> dict[str, Any]:
    """Arguments of :class:`attnlab.clock.Clock`. Raises ConfigError."""
    import yaml
    folder = Path(run)
    about = read_json(folder / "run.json")
    if about is None or about.get("status") != "complete":
        raise ConfigError(str(folder), "no complete run", "Name a run: outputs/<study>/<run>")
    load_all()
    config = yaml.safe_load((folder / "config.yaml").read_text())
    found = folder / "evolved.yaml"
    if found.exists():  # what the learner found offline, before the run
        config = {**config, "learner": yaml.safe_load(found.read_text())["learner"]}
        spec = registry.get("learner", config["learner"], "learner")
        config["learner"] = {**spec.nodes()[spec.name], **config["learner"]}
    agent = RunPlan(config).parts_alone()
    known = {attention.behaviour.name: attention for attention in agent.attentions}
    if behaviour not in known:
        raise ConfigError("behaviour", f"the run has none called '{behaviour}'", nearest(behaviour, known))
    attention = known[behaviour]
    table = _table(attention.learner, folder, behaviour)
    periods, bins, levels = attention.periods, attention.bins, attention.curiosity.levels
    rows = [[table[(level * len(periods) + period) * bins:][:bins] for period in range(len(periods))]
            for level in range(len(levels))]
    return {"periods": periods, "levels": levels, "low": attention.behaviour.sigma_low,
            "high": attention.behaviour.sigma_high, "bins": bins, "table": rows,
            "about": {"behaviour": behaviour, "run": about["run"], "key": about["key"], "seed": about["seed"],
                      "learner": config["learner"]["name"], "curiosity": about["curiosity"],
                      "code": (about.get("code") or {}).get("hash"), "dt_s": agent.body.reading.dt_s}}


def _table(learner: Learner, folder: Path, behaviour: str) -> list[int]:
    """The index of the next period in each state: the best of what was learned, or what a learner that does not learn
    decides."""
    states = range(learner.context.states)
    if learner.learns:
        import pyarrow.parquet as pq
        rows = pq.read_table(folder / "policy.parquet", columns=["behaviour", "q"]).to_pylist()
        q = [row["q"] for row in rows if row["behaviour"] == behaviour]
        n = learner.actions
        if len(q) != n * len(states):
            raise ConfigError(str(folder), "its policy has other states than its config", "Run it again")
        return [max(range(n), key=lambda action: q[state * n + action]) for state in states]
    greedy = registry.make("exploration", {"name": "greedy"}, None)
    asked = []
    for order, seed in ((states, 0), (reversed(states), 1), (states, 2)):
        learner.start()
        draw, answers = Random(seed), {}
        for state in order:
            answers[state] = learner.decide(state, greedy, draw)
        asked.append([answers[state] for state in states])
    if asked[0] != asked[1] or asked[0] != asked[2]:
        raise ConfigError("learner", f"'{learner.name}' decides by more than the state: it cannot be taken away as a "
                          "table")
    return asked[0]

"""Probes and callbacks: columns of one's own, and onlookers that can do no harm."""

from __future__ import annotations

import json
from random import Random

import numpy as np
import pyarrow.parquet as pq
import pytest
from hypothesis import given
from hypothesis import strategies as st

from attnlab.callbacks.base import Callback
from attnlab.config import run_key
from attnlab.errors import ConfigError, PartError
from attnlab.probes.base import Lived, Probe
from attnlab.registry import parts, register
from attnlab.results import load
from attnlab.robot.episodes import play_run
from attnlab.robot.plan import RunPlan
from attnlab.simulators.planar import Planar
from attnlab.tables.schema import Column
from attnlab.testing import config, make, run
from attnlab.testing.build import node
from attnlab.worlds.geometry import Solid, clearance, clearances

SHORT = ("simulator=planar", "train_episodes=2", "validation_episodes=1", "max_cycles=60", "picture=false",
         "report=false")
NUMBER = st.floats(-6, 6)
SOLIDS = st.builds(Solid, st.just("obstacle"), NUMBER, NUMBER, st.floats(0.1, 3), st.floats(0.1, 3), NUMBER)


@given(st.lists(SOLIDS, max_size=4), st.lists(st.tuples(NUMBER, NUMBER), min_size=1, max_size=5))
def test_clearances_are_those_of_each_point(solids, points):
    found = clearances(np.array(points), tuple(solids))
    assert found.tolist() == pytest.approx([clearance(x, y, tuple(solids)) for x, y in points], abs=1e-12)


def lived(path, **more):
    n = len(path) - 1
    zeros = np.zeros(n)
    return Lived("train", 0, n, n, None, np.array(path, float), zeros, zeros, None, None, {}, more)


def test_clearance_by_hand():
    """The obstacle of the paper's world nearest to (1.2, 2.0) begins at y = 2.55: 0.55 m, less 0.25 m of body."""
    probe = make("probe", "clearance")
    found = probe.measure(lived([(0, 0, 0), (1.2, 2.0, 0), (1.2, 2.2, 0)]))
    assert found["clearance_min_m"] == pytest.approx(0.1)
    assert found["clearance_mean_m"] == pytest.approx(0.2)


def test_a_probe_is_a_column_with_its_unit_everywhere(attnlab, tmp_path):
    done = attnlab("-m", "probe=[clearance],[]", *SHORT)
    assert done.returncode == 0, done.stderr
    study = load(tmp_path / "outputs" / "main")
    with_it = study.episodes["clearance_min_m"].notna()
    assert with_it.sum() == 3 and len(study.episodes) == 6
    schemas = [pq.read_schema(file) for file in tmp_path.glob("outputs/main/*/episodes.parquet")]
    schema = next(schema for schema in schemas if "clearance_min_m" in schema.names)
    about = schema.field("clearance_min_m").metadata
    assert about[b"unit"] == b"m" and b"nearest surface" in about[b"meaning"]
    assert schema.field("energy_mean").metadata[b"unit"] == b"UoE"


def test_an_empty_group_is_in_no_key():
    plain = config()
    assert run_key({**plain, "probe": {}, "callback": {}}) == run_key({k: v for k, v in plain.items() if k != "probe"})
    assert run_key({**plain, "callback": {"jsonl": {"name": "jsonl"}}}) == run_key(plain)
    assert run_key({**plain, "probe": {"clearance": node("probe", "clearance")}}) != run_key(plain)


@pytest.fixture(autouse=True)
def forget():
    before = dict(parts)
    yield
    parts.clear()
    parts.update(before)


def probe(name="odd", table="episodes", columns=None, measure=lambda self, lived: {"odd": 1.0}):
    columns = {"odd": Column("float64", "1", "odd")} if columns is None else columns
    return register("probe", name)(type("Odd", (Probe,), {"table": table, "columns": columns, "measure": measure,
                                                          "__module__": __name__}))


@pytest.mark.parametrize(("columns", "says"), [
    ({}, "declares no columns"), ({"odd": "float64"}, "must be a Column of type"),
    ({"odd": Column("complex", "1", "x")}, "must be a Column of type"),
    ({"survival": Column("float64", "1", "x")}, "survival is a column of episodes already")])
def test_what_is_declared_is_checked_at_the_door(columns, says):
    with pytest.raises(TypeError, match=says):
        probe(columns=columns)


@pytest.mark.parametrize(("table", "measured", "says"), [
    ("episodes", {"even": 1.0}, "measured even; it declares odd"),
    ("cycles", {"odd": [1.0, 2.0]}, "gave 2 values of odd for"),
    ("behaviours", {"odd": {"avoid": 1.0}}, "gave odd for avoid; the robot has avoid, eat, drink")])
def test_what_was_measured_is_checked_after_the_episode(table, measured, says):
    probe(table=table, measure=lambda self, lived: measured)
    with pytest.raises(PartError, match=says):
        play_run(RunPlan(config(probe=("odd",))))


def test_columns_of_cycles_and_behaviours():
    probe("late", "cycles", {"odd": Column("int32", "mc", "x")}, lambda self, lived: {"odd": np.arange(lived.cycles)})
    probe("busy", "behaviours", {"looks": Column("int32", "1", "x")},
          lambda self, lived: {"looks": {name: len(of) for name, of in lived.looks.items()}})
    tables = run(probe=("late", "busy"))
    assert tables["cycles"]["odd"] == tables["cycles"]["cycle"]
    assert tables["behaviours"]["looks"] == tables["behaviours"]["activations"]


def test_two_probes_of_one_column():
    probe("one")
    probe("two")
    with pytest.raises(ConfigError, match="probe.two: brings the column odd to episodes, and so does probe.one"):
        RunPlan(config(probe=("one", "two")))


def test_who_watches_cannot_write():
    seen = []

    class Greedy(Callback):
        """Tries to change what it sees."""

        def episode(self, lived):
            seen.append(lived)
            lived.path[0] = 9.0
    register("callback", "greedy")(Greedy)
    from attnlab.robot.observers import Observers
    plan = RunPlan({**config(), "callback": {"greedy": {"name": "greedy"}}})
    observers = Observers(plan.callbacks())
    tables, _ = play_run(plan, observers=observers)
    assert repr(tables) == repr(run()) and len(seen) == 1  # not called again
    assert "read-only" in observers.errors["greedy"]


ONLOOKERS = """
from attnlab.api import Callback, register

@register("callback", "tally")
class Tally(Callback):
    '''Counts episodes.'''
    def start(self, config):
        self.seen = []
    def episode(self, lived):
        self.seen.append(lived.episode)
    def end(self, status):
        (self.folder / "tally.txt").write_text(f"{status} {len(self.seen)}")

@register("callback", "clumsy")
class Clumsy(Callback):
    '''Falls over.'''
    def episode(self, lived):
        raise RuntimeError("fell over")
"""


def test_callbacks_of_a_plugin(attnlab, here, tmp_path):
    assert here(*SHORT, "study=alone").returncode == 0
    (tmp_path / "plugins").mkdir()
    (tmp_path / "plugins" / "onlookers.py").write_text(ONLOOKERS)
    done = attnlab(*SHORT, "callback=[tally,clumsy,jsonl]", "study=watched")
    assert done.returncode == 0, done.stderr
    assert done.stderr.count("callback=clumsy is left out from here on: plugins/onlookers.py:18: RuntimeError") == 1
    alone, watched = (next(tmp_path.glob(f"outputs/{study}/*/run.json")).parent for study in ("alone", "watched"))
    for table in alone.glob("*.parquet"):
        assert table.read_bytes() == (watched / table.name).read_bytes()
    about = json.loads((watched / "run.json").read_text())
    assert about["status"] == "complete" and list(about["callbacks"]) == ["clumsy"]
    assert (watched / "tally.txt").read_text() == "complete 3"
    lines = [json.loads(line) for line in (watched / "episodes.jsonl").read_text().splitlines()]
    assert [line["survival"] for line in lines] == load(tmp_path / "outputs/watched").episodes["survival"].tolist()


def test_a_simulator_has_a_stream_of_its_own():
    @register("simulator", "noisy")
    class Noisy(Planar):
        """Sonars with noise."""

        def sonar(self, count=16):
            return [max(0.0, d + self.draw.gauss(0, 0.01)) for d in super().sonar(count)]
    first, second = (run(simulator="noisy", seed=seed) for seed in (0, 0))
    assert repr(first) == repr(second) and repr(first) != repr(run(simulator="planar"))
    assert make("simulator", "noisy", seed=1).draw.random() != make("simulator", "noisy").draw.random()
    assert isinstance(make("simulator", "planar").draw, Random)

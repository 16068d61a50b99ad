"""A clock taken out of a run decides as the run did; its one file stands alone."""

import json
import shutil
import subprocess
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import pandas as pd
import pytest

import attnlab
from attnlab.clock import Clock
from attnlab.equations import percept_bin
from attnlab.errors import ConfigError
from attnlab.logs.file import Log
from attnlab.logs.sonars import nearest_ahead
from attnlab.robot.folder import run_to_folder
from attnlab.testing import config
from benchmarks import clock as bench

SHORT = {"train_episodes": 12, "validation_episodes": 1, "max_cycles": 600, "record": "validation"}


def kept(folder, **settings):
    chosen = config(**{**SHORT, **settings})
    assert run_to_folder(chosen, folder, {"run": "run", "key": "k", "overrides": [], "swept": {}})
    return folder


@pytest.fixture(scope="module")
def curious(tmp_path_factory):
    return kept(tmp_path_factory.mktemp("curious"))


def decides_as_recorded(folder, behaviour, **how):
    clock = attnlab.Clock.from_run(str(folder), behaviour)
    cycles = pd.read_parquet(folder / "cycles.parquet")
    looks = cycles[cycles[f"{behaviour}_active"]]
    given = [clock.next(int(row[f"{behaviour}_percept"]), row[f"{behaviour}_level"]) for _, row in looks.iterrows()]
    assert given == looks[f"{behaviour}_period"].tolist() and len(given) > 20
    return clock, given


@pytest.mark.parametrize("behaviour", ["avoid", "eat", "drink"])
def test_it_grants_what_validation_granted(curious, behaviour):
    decides_as_recorded(curious, behaviour)


@pytest.mark.parametrize("learner", ["double_q", "fixed_8", "monitor"])
def test_of_every_learner_that_is_a_table(tmp_path, learner):
    _, given = decides_as_recorded(kept(tmp_path, learner=learner, curiosity="none"), "avoid")
    assert (set(given) == {8}) == (learner == "fixed_8")


@pytest.mark.parametrize("learner", ["random", {"name": "monitor", "behaviours": {"avoid": {"kind": "derivative"}}}])
def test_what_is_no_table_is_refused(tmp_path, learner):
    with pytest.raises(ConfigError, match="decides by more than the state"):
        Clock.from_run(str(kept(tmp_path, learner=learner, curiosity="none")), "avoid")


def test_what_is_not_there_is_named(curious, tmp_path):
    with pytest.raises(ConfigError, match="no complete run"):
        Clock.from_run(str(tmp_path), "avoid")
    with pytest.raises(ConfigError, match="none called 'aviod'. Did you mean 'avoid'"):
        Clock.from_run(str(curious), "aviod")


def test_it_goes_to_a_file_and_back(curious, tmp_path):
    clock = Clock.from_run(str(curious), "avoid")
    clock.save(str(tmp_path / "a.json"))
    again = Clock.load(str(tmp_path / "a.json"))
    assert again.to_json() == clock.to_json() and again.table == clock.table
    assert again.about["behaviour"] == "avoid" and again.about["learner"] == "q_learning" and again.about["key"] == "k"
    for text in ("", "[]", "{}", '{"format": "other"}', clock.to_json().replace('"bins": 6', '"bins": 5')):
        with pytest.raises(ValueError, match="this is no attnlab clock 1|cannot have a table"):
            Clock.from_json(text)


def small():
    """Two levels, periods 4 and 1, two percepts: the second level always grants 4."""
    return Clock([4, 1], ["low", "HH"], 0.0, 1.0, 2, [[[0, 1], [1, 0]], [[0, 0], [0, 0]]])


def test_by_hand():
    clock = small()
    assert [clock.percept(x) for x in (-1.0, 0.0, 0.49, 0.5, 1.0, 9.0)] == [1, 1, 1, 2, 2, 2]
    assert [clock.next(p) for p in (1, 2, 1, 2)] == [1, 4, 4, 1]  # from the shortest: stays, 4, stays, back to 1
    assert clock.next(1, "HH") == 4
    clock.start()
    assert clock.next(1, "low") == 1


@pytest.mark.parametrize(("call", "problem"), [
    (lambda c: c.next(0), "percept 0 is not one of 1 to 2"), (lambda c: c.next(3), "percept 3 is not one"),
    (lambda c: c.next(1, "LH"), "no level is called 'LH'; known: low, HH"),
    (lambda c: c.percept(float("nan")), "sigma is no number"),
    (lambda c: Clock([1], ["a"], 0, 1, 1, [[[1]]]), "names a period that is not there"),
    (lambda c: Clock([1], ["a"], 1, 1, 1, [[[0]]]), "cannot have a table")])
def test_what_cannot_be(call, problem):
    with pytest.raises(ValueError, match=problem):
        call(small())


def test_percepts_are_those_of_the_run(curious):
    clock = Clock.from_run(str(curious), "avoid")
    for i in range(-5, 1100):
        sigma = i / 1000
        assert clock.percept(sigma) - 1 == percept_bin(max(0.0, min(1.0, sigma)), clock.low, clock.high, clock.bins)


def test_the_loop_of_the_page_over_a_log(tmp_path):
    """As the ROS 2 timer does: hold what comes, look when the time has come. Nearest 0.8, then 0.2 from cycle 12 on:
    periods 4 when far, 1 when near; the look at cycle 12 finds it."""
    rows = [f"{i * 0.1},{0.8 if i < 12 else 0.2}" for i in range(24)]
    (tmp_path / "log.csv").write_text("t_s,r10\n" + "\n".join(rows) + "\n")
    clock = Clock([1, 4], ["none"], 0.0, 1.0, 2, [[[0, 1], [0, 1]]])
    due, looks = 0, []
    for cycle, scan in enumerate(Log(tmp_path / "log.csv")):
        if cycle == due:
            looks.append(cycle)
            due += clock.next(clock.percept(nearest_ahead(scan)))
    assert looks == [0, 4, 8, *range(12, 24)]


def test_the_file_stands_alone_and_is_fast(curious, tmp_path):
    """Copied to an empty folder, without attnlab to be found; five microseconds a look or less."""
    Clock.from_run(str(curious), "avoid").save(str(tmp_path / "avoid.json"))
    shutil.copy(Path(attnlab.__file__).parent / "clock.py", tmp_path)
    text = ("import sys; from clock import Clock; c = Clock.load('avoid.json'); c.start()\n"
            "print(c.next(c.percept(0.3)), [m for m in sys.modules if m.startswith('attnlab')])")
    done = subprocess.run([sys.executable, "-I", "-c", f"import sys; sys.path.insert(0, '.'); {text}"], cwd=tmp_path,
                          capture_output=True, text=True, check=True)
    assert done.stdout.split()[0] in {"1", "4", "8", "12"} and done.stdout.strip().endswith("[]")
    clock, best = Clock.load(str(tmp_path / "avoid.json")), 1.0
    for _ in range(5):
        began = time.process_time()
        for i in range(2000):
            clock.next(clock.percept(i / 2000), "HH")
        best = min(best, (time.process_time() - began) / 2000)
    assert best < 5e-6


def test_the_page_has_what_was_measured():
    """If not: python benchmarks/clock.py --page."""
    found = json.loads(bench.RESULT.read_text())
    text = bench.PAGE.read_text()
    assert bench.filled(text, found) == text and len(bench.PLACE.findall(text)) == 2
    assert 0 < found["next"] < 5 and 0 < found["percept"] < 5


def test_the_node_of_the_page(monkeypatch, tmp_path):
    """On stand-ins for ROS: a timer that is set anew after each look, with the cycles that the clock grants. Near (0.2)
    at every look but the second (0.8, and its NaN-like beams are out of range)."""
    timers, heard = [], []

    class Node:
        def __init__(self, name): heard.append(name)
        def create_subscription(self, kind, topic, keep, qos): heard.append((topic, keep))
        def destroy_timer(self, timer): timers.remove(timer)

        def create_timer(self, after_s, call):
            timers.append((after_s, call))
            return timers[-1]
    spun = []
    modules = {"rclpy": {"init": lambda: None, "spin": spun.append}, "rclpy.node": {"Node": Node},
               "rclpy.qos": {"qos_profile_sensor_data": None}, "sensor_msgs": {},
               "sensor_msgs.msg": {"LaserScan": None}}
    for name, content in modules.items():
        monkeypatch.setitem(sys.modules, name, SimpleNamespace(**content))
    monkeypatch.setitem(sys.modules, "clock", SimpleNamespace(Clock=Clock))
    monkeypatch.chdir(tmp_path)
    Clock([1, 4], ["none"], 0.0, 1.0, 2, [[[0, 1], [0, 1]]], {"dt_s": 0.5}).save("avoid.json")
    text = bench.PAGE.read_text()
    exec(text[text.index("import math"):].partition("```")[0], {})
    [node] = spun
    granted = []
    for ranges in (None, (0.2, 9.0), (0.8, 9.0, 0.001), (0.2,), ()):
        if ranges is not None:
            heard[1][1](SimpleNamespace(ranges=ranges, range_min=0.05, range_max=5.0))
        [(after_s, look)] = timers
        granted.append(after_s)
        look()
    assert granted == [0.5, 0.5, 0.5, 2.0, 0.5] and timers[0][0] == 2.0 and node.timer is timers[0]

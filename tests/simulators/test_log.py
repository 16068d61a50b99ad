"""simulator=log: each cycle shows what the log has there, to those who only look."""

import errno
import json
import tracemalloc
from math import hypot, isnan
from pathlib import Path

import pytest

from attnlab.arena.drive import read_drive
from attnlab.callbacks.scalars import scalars
from attnlab.config import run_key
from attnlab.errors import ConfigError
from attnlab.logs.base import LogSettings
from attnlab.logs.file import Log
from attnlab.logs.rows import ROW, Rows
from attnlab.logs.sonars import sectors
from attnlab.replay.__main__ import main as replay
from attnlab.replay.again import live_again
from attnlab.replay.seen import sense_again
from attnlab.replay.track import agrees, open_run
from attnlab.replay.track import choose as choose_episode
from attnlab.robot.engines import choose
from attnlab.robot.folder import run_to_folder
from attnlab.robot.plan import RunPlan
from attnlab.simulators.log import Logged
from attnlab.testing import config, make, run
from tests.logs import made

NEAR = [round(0.3 + (i * 7 % 23) / 20, 3) for i in range(80)]  # m ahead, in each scan


def written(tmp_path, near=NEAR, times=None, poses=True, name="log.csv"):
    """A log of two sonars, 0.1 s a scan: ahead ``near``, to the left 2 m; the robot drives 0.25 m a scan along y."""
    rows = ["t_s,x_m,y_m,heading_rad,r10,r90" if poses else "t_s,r10,r90"]
    for i, value in enumerate(near):
        pose = f"7,{i / 4 - 100},0.5," if poses else ""
        rows.append(f"{times[i] if times else round(i / 10, 3)},{pose}{value},2")
    path = tmp_path / name
    path.write_text("\n".join(rows) + "\n")
    return str(path)


def on(file, **settings):
    """A run's config on a log: WATCH alone, 40 cycles a block."""
    more = {name: settings.pop(name) for name in list(settings) if name in Logged.Params.__dataclass_fields__}
    return config(simulator={"name": "log", "file": file, "blocks": 2, **more}, behaviours=("watch",), **settings)


def test_each_cycle_shows_its_scan(tmp_path):
    """Block 0 is trained on, block 1 validated; odd,even exchanges them."""
    with RunPlan(on(written(tmp_path))).simulator() as simulator:
        for phase, first in (("train", 0), ("validation", 40), ("train", 0)):
            assert simulator.begin(phase, 5)[0] == 40
            simulator.place(0.0, 0.0, 0.0)
            for cycle in range(40):
                ring = simulator.sonar()
                assert (ring[3], ring[0], ring[7]) == (NEAR[first + cycle], 2.0, 5.0)  # to the right none listens
                assert simulator.echoes(8) == ring[:8] and simulator.cycle == cycle
                assert simulator.advance(0.4, 1.0, 1) == (1, False)
            assert simulator.gaps().tolist() == [*NEAR[first + 1:first + 40], NEAR[first + 39]]
    with RunPlan(on(written(tmp_path), held_out="even")).simulator() as simulator:
        simulator.begin("train", 0)
        assert simulator.sonar()[3] == NEAR[40]


def test_the_run_is_the_log(tmp_path):
    """What WATCH perceived, where the robot was, and eq 13 from what was there, by hand: period 4, bins of 1/6 m."""
    file = written(tmp_path)
    tables = run(simulator={"name": "log", "file": file, "blocks": 2}, behaviours=("watch",), learner="fixed_4",
                 periods=[1, 4, 8, 12], curiosity="none")
    cycles = {name: values[-40:] for name, values in tables["cycles"].items()}  # of validation: scans 40 to 79
    looks = [i for i in range(40) if cycles["watch_active"][i]]
    assert looks == list(range(0, 40, 4)) and set(tables["episodes"]["survival"]) == {1.0}
    assert [cycles["watch_percept"][i] for i in looks] == [min(6, int(min(1.0, NEAR[40 + i]) * 6) + 1) for i in looks]
    after = [NEAR[min(79, 41 + i)] for i in range(40)]
    assert cycles["safety"] == pytest.approx([min(1.0, d) * (12 - 4) / 11 for d in after])
    assert cycles["y_m"] == pytest.approx([1.0 + min(79, 41 + i) / 4 for i in range(40)])  # the path begins at (1, 1)
    assert set(cycles["x_m"]) == {1.0} and cycles["v_m_s"][0] == pytest.approx(2.5)
    assert tables["episodes"]["path_m"][-1] == pytest.approx(39 / 4) and tables["episodes"]["death"][-1] == "none"
    assert {(x, y) for x, y in zip(tables["coverage"]["x_cell"], tables["coverage"]["y_cell"], strict=True)} <= \
        {(x, y) for x in (10,) for y in range(10, 210)}


def test_a_log_without_poses_says_nowhere_where_the_robot_was(tmp_path, monkeypatch):
    tables = run(simulator={"name": "log", "file": written(tmp_path, poses=False), "blocks": 2}, behaviours=("watch",))
    assert set(tables["cycles"]["x_m"]) == set(tables["cycles"]["v_m_s"]) == set(tables["episodes"]["path_m"]) == {None}
    assert tables["coverage"] == {} and None not in tables["cycles"]["safety"]
    watched = []
    monkeypatch.setattr("attnlab.robot.observers.Observers.episode", lambda self, lived: watched.append(scalars(lived)))
    monkeypatch.setattr("attnlab.robot.observers.Observers.__bool__", lambda self: True)
    posed = run(simulator={"name": "log", "file": written(tmp_path), "blocks": 2, "poses": False},
                behaviours=("watch",))
    assert posed["cycles"] == tables["cycles"]
    assert watched and not any(isnan(value) for told in watched for value in told.values())


def test_a_sensor_is_read_when_the_clock_fires(tmp_path, monkeypatch):
    asked, sonar = [], Logged.sonar
    monkeypatch.setattr(Logged, "sonar", lambda self, count=16: asked.append(self.cycle) or sonar(self, count))
    tables = run(simulator={"name": "log", "file": written(tmp_path), "blocks": 2}, behaviours=("watch",),
                 train_episodes=1)
    assert asked == [cycle for cycle, active in zip(tables["cycles"]["cycle"], tables["cycles"]["watch_active"],
                                                    strict=True) if active]


def test_blocks_and_holes_are_those_of_the_arena(tmp_path):
    """Two holes; a stretch of less than 20 cycles is no episode."""
    near = [NEAR[i % 80] for i in range(300)]
    times = [i / 10 + 5 * (i >= 70) + 5 * (i >= 80) for i in range(300)]
    log = Log(written(tmp_path, near, times))
    drive, rows = read_drive(log), Rows(Log(log.path), 5.0)
    assert rows.starts == list(drive.starts) == [0, 70, 80] and rows.cycle_s == drive.cycle_s
    assert rows.read(0, 300)[:, 3:11].min(axis=1).tolist() == [min(d, 2.0) for d in drive.near_m]
    assert rows.stretches(4) == [[(a, b) for a, b in block if b - a >= 20] for block in drive.blocks(4)]
    assert rows.stretches(4) == [[(0, 70)], [(80, 150)], [(150, 225)], [(225, 300)]]
    assert rows.told == ("2 x hole of more than 1 s (first: line 72)",)


def test_time_shows_the_last_scan_and_stops_at_a_hole(tmp_path):
    """Scans at 0, 0.1, 0.35, 0.4, then after a hole at 2 and 2.1: every 0.2 s one sees 0.1's at 0.2, none in the
    hole."""
    file = written(tmp_path, [1.0, 1.1, 1.2, 1.3, 1.4, 1.5], [0.0, 0.1, 0.35, 0.4, 2.0, 2.1])
    rows = Rows(Log(file), 5.0, "cones", 0.2)
    assert rows.read(0, rows.count)[:, 6].tolist() == [1.0, 1.1, 1.3, 1.4]
    assert (rows.count, rows.starts, rows.cycle_s) == (4, [0, 3], 0.2)
    fast = Rows(Log(file), 5.0, "cones", 0.05)
    assert fast.read(0, fast.count)[:, 6].tolist() == [1.0, 1.0, 1.1, 1.1, 1.1, 1.1, 1.1, 1.2, 1.3, 1.4, 1.4, 1.5]


def test_a_path_that_begins_later_begins_there(tmp_path):
    """An MCAP whose odometry comes after two scans."""
    messages = [("/scan", "sensor_msgs/msg/LaserScan", "cdr", made.laser(t / 4, (1.0, 2.0, t / 8)))
                for t in range(1, 7)]
    messages.insert(2, ("/odom", "nav_msgs/msg/Odometry", "cdr", made.odometry(1, 3.0, 4.0, 0.0, 1.0)))
    rows = Rows(Log(made.mcap(tmp_path / "a.mcap", messages)), 5.0)
    assert rows.count == 4 and rows.posed and rows.starts == [0]
    assert rows.read(0, 4)[:, :4].tolist() == [[1.0, 1.0, 0.0, t / 8] for t in range(3, 7)]
    assert rows.told == ("2 x cycle before the first pose (first: the first)",)


def test_every_beam_is_heard_by_one_sonar():
    """24 beams of 15 degrees: that at 75 is nearer to 90 than to 50; cones would leave out some."""
    from math import pi
    found = sectors(tuple(i * pi / 12 for i in range(24)))
    assert sorted(i for beams in found for i in beams) == list(range(24))
    assert found[0] == (5, 6, 7) and found[3] == (0, 1) and found[1] == (3, 4)


def test_another_file_of_the_same_name_is_another_run(tmp_path):
    file = written(tmp_path)
    one = RunPlan(on(file))
    assert one.config["simulator"]["sha256"] and run_key(RunPlan(one.config).config) == run_key(one.config)
    written(tmp_path, [2.0 + value for value in NEAR])
    other = RunPlan(on(file))
    assert run_key(other.config) != run_key(one.config)
    with pytest.raises(ConfigError, match="simulator.file: .* is not the file that was named"):
        RunPlan(one.config)
    assert one.reading.dt_s == pytest.approx(0.1) and one.config["world"]["name"] == "floor"


def test_it_is_interpreted_and_says_why(tmp_path):
    long = on(written(tmp_path), train_episodes=50_000)
    assert choose(RunPlan(long)) == ("python", "simulator=log runs as Python: what it shows is read from a file")
    with pytest.raises(ConfigError, match="engine=compiled: cannot be: simulator=log runs as Python"):
        choose(RunPlan({**long, "engine": "compiled"}))


@pytest.mark.parametrize(("settings", "says"), [
    ({"file": ""}, "simulator.file: names no log"), ({"file": "nowhere"}, "simulator.file: there is no file nowhere"),
    ({"blocks": 5}, "simulator.blocks: 5 blocks of the 80 cycles of log.csv leave training or validation without"),
    ({"max_cycles": 30}, "simulator.blocks: an episode would have 40 cycles, and max_cycles is 30. max_cycles=40, or "
                         "simulator.blocks=3"),
    ({"format": "mcap"}, "simulator.file: log.csv is no mcap file. It looks like csv"),
    ({"topic": "/a", "hole_s": 0}, "simulator.hole_s: is 0.0 s, must be more than 0"),
    ({"how": {"dt_s": 0.2}}, "reading.dt_s: is 0.2 s, and a cycle is a scan of the log, 0.1 s"),
    ({"how": {"need_max": 340}}, "needs: hunger may kill within 120 cycles, and in simulator=log nobody can do"),
    ({"world": {"name": "random"}}, "world=random: a log has no other world than its own"),
    ({"probe": ("clearance",)}, "probe.clearance: this world has no surface to be near to"),
    ({"validation": {"simulator": "planar"}}, "validation.simulator: what was recorded is trained and validated"),
    ({"learner": {"name": "tempo_rl", "observe": "all"}}, "asks for the percepts between looks")])
def test_what_cannot_be(tmp_path, settings, says):
    with pytest.raises(ConfigError) as error:
        RunPlan(on(**{"file": written(tmp_path), **settings}))
    assert says in str(error.value)


@pytest.mark.parametrize("behaviours", [("avoid",), ("watch", "eat"), ("give",)])
def test_who_acts_is_refused(tmp_path, behaviours):
    chosen = {**on(written(tmp_path)), "behaviours": config(behaviours=behaviours)["behaviours"]}
    with pytest.raises(ConfigError, match=rf"behaviours.{behaviours[-1]}: acts, and in simulator=log .*=\[watch\]"):
        RunPlan(chosen)
    with pytest.raises(ConfigError, match="validation.simulator: what was recorded"):
        RunPlan(config(validation={"simulator": "log"}))


def test_what_is_no_log_of_every_cycle_is_refused(tmp_path):
    with pytest.raises(ConfigError, match="has a scan every 3 s: it was thinned"):
        RunPlan(on(written(tmp_path, times=[3.0 * i for i in range(80)]), hole_s=10))
    with pytest.raises(ConfigError, match="simulator.file: log.csv holds no scan that can be used"):
        RunPlan(on(written(tmp_path, [-1.0, -1.0], poses=False), range_min_m=3))
    far = Path(written(tmp_path, name="far.csv"))
    far.write_text(far.read_text() + "9,1000,0,0,1,1\n")
    with pytest.raises(ConfigError, match="simulator.poses: the path of far.csv spans 995 m"):
        RunPlan(on(str(far)))
    assert RunPlan(on(str(far), poses=False)).recorded


def test_a_disk_with_no_room_left(tmp_path, monkeypatch):
    def full(**_):
        raise OSError(errno.ENOSPC, "No space left on device")
    monkeypatch.setattr("attnlab.logs.rows.tempfile.TemporaryFile", full)
    with pytest.raises(ConfigError, match=r"simulator.file: .*log.csv cannot be read, or .*No space left"):
        RunPlan(on(written(tmp_path, [value + 0.01 for value in NEAR])))


def test_a_long_log_takes_no_memory(tmp_path):
    """Thrice as long takes no more, but for the gaps of which the middle one is a cycle's length."""
    peaks = []
    for scans in (2_000, 6_000):
        file = written(tmp_path, [NEAR[i % 80] for i in range(scans)], name=f"{scans}.csv")
        list(Log(file))
        tracemalloc.start()
        rows = Rows(Log(file), 5.0)
        assert rows.count == scans and not isnan(rows.read(scans - 1, 1)[0, 0])
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[1] < peaks[0] + 150_000
    assert f"({ROW.size} bytes each)" in (Path(__file__).parents[2] / "docs" / "logs.md").read_text()


def test_a_run_is_kept_made_again_and_replayed(tmp_path):
    """The same bytes twice; every percept is found again in the log; without poses there is nothing to draw."""
    chosen, info = on(written(tmp_path)), {"run": "run", "key": "k", "overrides": [], "swept": {}}
    folders = [tmp_path / name for name in ("one", "two")]
    for folder in folders:
        assert run_to_folder(chosen, folder, info)
    assert all((folders[0] / name).read_bytes() == (folders[1] / name).read_bytes() for name in
               ("episodes.parquet", "behaviours.parquet", "cycles.parquet", "coverage.parquet", "agent.json"))
    run = open_run(folders[0])
    phase, episode, cycles = choose_episode(run, "train", 1)
    lived = live_again(run.plan, run.folder, phase, episode)
    assert agrees(cycles, lived.cycles)
    assert sense_again(run.plan, cycles, run.plan.start_pose(phase, episode), phase, episode).wrong == 0
    assert replay([str(folders[0])]) == 0
    assert run_to_folder(on(written(tmp_path, poses=False)), folders[1], info)
    with pytest.raises(ConfigError, match="its log says nowhere where the robot was"):
        replay([str(folders[1])])


def test_settings_of_a_reader_are_settings_of_the_simulator(tmp_path):
    bare = tmp_path / "bare.csv"
    bare.write_text("\n".join(f"{value},2.0,3.0,4.0" for value in NEAR) + "\n")
    plan = RunPlan(on(str(bare), rate_hz=20.0, step_deg=10.0, first_deg=10.0))
    with plan.simulator() as simulator:
        assert simulator.dt_s == pytest.approx(0.05) and simulator.sonar()[:4] == [5.0, 4.0, 3.0, NEAR[0]]
        assert simulator.told() == ["bare.csv: no header: taken as 4 ranges, the first at 10 degrees, the next +10 "
                                    "degrees from it, 20 rows a second"]
    assert set(LogSettings.__dataclass_fields__) <= set(Logged.Params.__dataclass_fields__)
    assert hypot(*plan.start_pose("train", 0)[:2]) != hypot(3, 4)  # nowhere


@pytest.mark.parametrize(("sigma", "period", "reward"), [
    (1.0, 1.0, 1.0), (1.0, 0.0, 0.0), (0.4, 0.0, 1.0), (0.2, 1.0, 0.0), (0.7, 0.3, 0.5), (0.55, 1.0, 0.25)])
def test_watch_earns_by_hand(sigma, period, reward):
    """u = (sigma - 0.4) / 0.6."""
    watch = make("behaviours", "watch")
    assert watch.reward(sigma, period) == pytest.approx(reward) and watch.sigma_high == 1.0


def test_what_is_typed(complain, tmp_path):
    """Refused in a line, with nothing written; or a study, which says what of the log was skipped."""
    file = written(tmp_path, times=[i / 10 + 2 * (i >= 40) for i in range(80)])
    log = ["simulator=log", f"simulator.file={file}", "simulator.blocks=2"]
    code, err, there = complain(*log)
    assert (code, there) == (2, ["log.csv"]) and len(err.splitlines()) == 1
    assert "behaviours.avoid: acts, and in simulator=log all goes as it was recorded" in err
    code, err, there = complain(*log, "behaviours=[watch]", "engine=compiled")
    assert (code, there) == (2, ["log.csv"]) and "engine=compiled: cannot be: simulator=log runs as Python" in err
    code, err, there = complain(*log, "behaviours=[watch]", "simulator.held_out=odd,even", "train_episodes=2",
                                "validation_episodes=1", "cluster=serial", "picture=false", "report=false")
    assert code == 0 and "attnlab: log.csv: 1 x hole of more than 1 s (first: line 42)" in err
    about = [json.loads((tmp_path / name).read_text()) for name in there if name.endswith("run.json")]
    assert {one["status"] for one in about} == {"complete"} and {one["engine"] for one in about} == {"python"}
    assert [one["skipped"] for one in about] == [["log.csv: 1 x hole of more than 1 s (first: line 42)"]] * 2

"""planar and pybullet are the same robot, whichever way they are told; what was learned in one lives in the other."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections import Counter
from pathlib import Path
from random import Random

import pytest

from attnlab.certify import certificate
from attnlab.certify.__main__ import main
from attnlab.certify.episodes import divergence, survival, total_variation
from attnlab.certify.poses import compare_drives, compare_poses
from attnlab.certify.verdict import TOLERANCES, judge
from attnlab.errors import ConfigError
from attnlab.loading import load_all
from attnlab.robot.episodes import play_run
from attnlab.robot.plan import RunPlan
from attnlab.simulators.robot import Camera
from attnlab.testing.build import config, make
from attnlab.testing.world import drive

ROOT = Path(__file__).resolve().parents[2]
KINDS = {"planar": ("planar", {}), "pybullet": ("pybullet", {}), "rays": ("pybullet", {"camera": "rays"}),
         "wheels": ("pybullet", {"drive": "wheels"})}


@pytest.mark.parametrize("camera", ["segmentation", "rays"])
@pytest.mark.parametrize("columns", [32, 47])
def test_the_same_senses_at_the_same_poses(camera, columns):
    size = {"camera_columns": columns, "camera_rows": columns // 2}
    with make("simulator", "planar", **size) as planar, make("simulator", "pybullet", camera=camera, **size) as bullet:
        found = compare_poses(planar, bullet, 150, Random(1), lambda: None)
        found |= compare_drives(planar, bullet, 2, Random(2), lambda: None)
    assert found["poses_sensed"] > 60 and found["blobs"] > 30
    assert all(row["passes"] for row in judge({"paper": found}))
    assert found["sonar_m_max"] < 1e-9 and found["drive_gap_max_m"] < 1e-9


def test_another_robot_is_told_apart():
    with make("simulator", "planar") as one, make("simulator", "planar", camera_fov_deg=70.0, sonar_range_m=2.0) as two:
        failing = {row["measure"] for row in judge({"paper": compare_poses(one, two, 100, Random(1), lambda: None)})
                   if not row["passes"]}
    assert {"sonar_m_max", "bearing_px_median", "blob_miss_share"} <= failing


def test_every_tolerance_can_fail():
    for tolerance in TOLERANCES:
        (row,) = judge({"a": {tolerance.measure: 0.0}, "b": {tolerance.measure: -1.01 * tolerance.limit}})
        assert not row["passes"] and row["world"] == "b"


@pytest.mark.parametrize("kind", KINDS)
def test_the_tenth_start_is_the_first_and_senses_change_nothing(kind):
    name, settings = KINDS[kind]
    with make("simulator", name, **settings) as simulator:
        drives = []
        for i in range(10):
            simulator.place(2.0, 2.0, 0.5)
            if i % 2:
                simulator.sonar(), simulator.blobs(), simulator.pose()
                assert (simulator.sonar(), simulator.blobs()) == (simulator.sonar(), simulator.blobs())
            drives.append(drive(simulator, 12))
        assert all(other == drives[0] for other in drives)


PROGRAM = """
import json, sys
from attnlab.testing.build import make
from attnlab.testing.world import drive
from attnlab.loading import load_all
name, settings = json.loads(sys.argv[1])
simulator = make("simulator", name, **settings)
simulator.place(2.0, 2.0, 0.5)
print(repr(drive(simulator, 12)))
"""


def test_another_process_drives_the_same_whatever_ran_before():
    for name, settings in KINDS.values():
        with make("simulator", name, **settings) as simulator:
            simulator.place(2.0, 2.0, 0.5)
            here = repr(drive(simulator, 12))
        there = subprocess.run([sys.executable, "-c", PROGRAM, json.dumps([name, settings])], text=True, check=True,
                               capture_output=True, env={**os.environ, "PYTHONPATH": str(ROOT)}, timeout=60)
        assert there.stdout.strip() == here


@pytest.mark.parametrize(("rows", "half", "count"), [(24, 6.93, 14), (24, 0.49, 0), (24, 0.5, 2), (24, 99, 24),
                                                     (11, 0.2, 1), (11, 1.0, 3), (11, 5.6, 11)])
def test_rows_within(rows, half, count):
    assert Camera(32, rows, 1.0).rows_within(half) == count
    middle = [row + 0.5 - rows / 2 for row in range(rows)]
    assert sum(abs(m) <= half for m in middle) == count


def test_distances_between_runs():
    assert total_variation(Counter("aaab"), Counter("ab")) == pytest.approx(0.25)
    assert total_variation(Counter("aa"), Counter("b")) == 1.0 and total_variation(Counter("a"), Counter("aa")) == 0.0
    tables = play_run(RunPlan(config(train_episodes=2)))[0]
    other = play_run(RunPlan(config(train_episodes=2, seed=1)))[0]
    same = divergence(tables, tables)
    assert same["identical"] == same["first"] == same["episodes"] == 3 and max(same["gaps_m"]) == 0.0
    assert divergence(tables, other)["first"] == 0 and max(divergence(tables, other)["gaps_m"]) > 0.1


def test_closed_loop_and_transfer():
    run = {"train_episodes": 4, "validation_episodes": 2, "max_cycles": 300, "how": {"max_cycles": 300}}
    stayed = play_run(RunPlan(config(simulator="planar", **run)))[0]
    bullet = play_run(RunPlan(config(simulator="pybullet", **run)))[0]
    assert divergence(stayed, bullet)["first"] >= 1
    moved = play_run(RunPlan(config(simulator="planar", validation={"simulator": "pybullet"}, **run)))[0]
    wheels = play_run(RunPlan(config(simulator="planar", validation={"simulator": "pybullet",
                                                                              "drive": "wheels"}, **run)))[0]
    for other in (moved, wheels):
        assert survival(other, "train") == survival(stayed, "train")
        assert other["policy"] == stayed["policy"]  # nothing is learned in validation
        assert len(survival(other)) == 2
    on = [row for row, phase in enumerate(stayed["cycles"]["phase"]) if phase == "validation"]
    assert [wheels["cycles"]["x_m"][i] for i in on[:50]] != [stayed["cycles"]["x_m"][i] for i in on[:50]]


@pytest.mark.parametrize("validation", [{"simulator": "planar", "drive": "wheels"}, {"drive": "wheels"},
                                        {"simulator": "stage"}])
def test_transfer_to_what_is_not_there(validation):
    with pytest.raises(ConfigError, match="validation.simulator"):
        RunPlan(config(simulator="planar", validation=validation))


def test_the_command_and_its_complaints(tmp_path, capsys):
    out = tmp_path / "here"
    assert main(["--poses", "60", "--episodes", "0", "--worlds", "open", "--seeds", "1", "--first-seed", "100",
                 "--no-wheels", "--out", str(out)]) == 0
    stored = json.loads((out / "certificate.json").read_text())
    assert stored["passes"] and stored["worlds"]["open"]["poses"] == 60 and "paper" not in stored["worlds"]
    assert "sonar_m_max" in (out / "certificate.md").read_text()
    capsys.readouterr()
    for arguments in (["--worlds", "mars"], ["--worlds", ""], ["--poses", "0"], ["reading.v_max=1"]):
        assert main([*arguments, "--out", str(tmp_path / "none")]) == 2
        lines = capsys.readouterr().err.strip().splitlines()
        assert len(lines) == 1 and lines[0].startswith("attnlab: "), lines
    assert not (tmp_path / "none").exists()


@pytest.mark.long
def test_a_certificate_with_closed_loops():
    load_all()
    found = certificate.certify(certificate.WORLDS, 1000, 10, 1, [])
    assert found["passes"], [row for row in found["verdict"] if not row["passes"]]

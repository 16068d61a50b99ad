"""Every engine makes the bytes that one process a run makes here. Long: pytest -m long tests/clusters."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import time
from importlib.util import find_spec
from pathlib import Path

import pytest

from attnlab.clusters.slurm import Slurm

ROOT = Path(__file__).resolve().parents[2]
SWEEP = ("curiosity=litman,none", "seed=0-2", "simulator=planar", "train_episodes=3", "validation_episodes=2",
         "max_cycles=120", "picture=false", "report=false")
LIMIT_S = 300  # for an engine to do it all
HERE = ["-W", "ignore", "-m", "attnlab"]


def command(tmp_path, *arguments):
    return subprocess.run([sys.executable, *HERE, *SWEEP, *arguments], cwd=tmp_path, capture_output=True, text=True,
                          timeout=LIMIT_S, env={**os.environ, "PYTHONPATH": str(ROOT)})


def tables(study: Path) -> dict[str, bytes]:
    return {f"{file.parent.name}/{file.name}": file.read_bytes() for file in study.glob("*/*.parquet")}


def check_same(tmp_path, study):
    assert command(tmp_path, "study=here").returncode == 0
    here, there = tables(tmp_path / "outputs" / "here"), tables(tmp_path / "outputs" / study)
    assert len(here) == 30 and here == there


@pytest.mark.long
@pytest.mark.parametrize(("engine", "package"), [("ray", "ray"), ("dask", "distributed")])
def test_tasks(tmp_path, engine, package):
    if find_spec(package) is None:
        pytest.skip(f"pip install -e '.[{engine}]'")
    done = command(tmp_path, f"cluster={engine}", f"study={engine}", "cluster.runs_per_job=2")
    assert done.returncode == 0, done.stderr
    assert "Traceback" not in done.stderr
    check_same(tmp_path, engine)


@pytest.fixture
def one_node(tmp_path):
    """A SLURM of this machine alone."""
    if not all(map(shutil.which, ("slurmctld", "slurmd", "munged", "sbatch"))) or os.geteuid():
        pytest.skip("apt-get install -y slurmctld slurmd slurm-client munge, as root")
    script = ROOT / "tests" / "clusters" / "slurm-local.sh"
    folder = tmp_path / "slurm"
    subprocess.run(["bash", str(script), "start", str(folder)], check=True, timeout=120, capture_output=True)
    yield
    subprocess.run(["bash", str(script), "stop", str(folder)], check=False, timeout=60, capture_output=True)


@pytest.mark.long
def test_slurm(tmp_path, one_node):
    done = command(tmp_path, "cluster=slurm", "cluster.runs_per_job=3", "cluster.minutes=5", "cluster.memory_gb=1",
                   "study=slurm")
    assert done.returncode == 0, done.stderr
    assert "submitted as job" in done.stdout and "--share $SLURM_ARRAY_TASK_ID/2" in done.stdout
    study, until = tmp_path / "outputs" / "slurm", time.monotonic() + LIMIT_S
    while len(tables(study)) < 30 or not all(json.loads(file.read_text())["status"] == "complete"
                                             for file in study.glob("*/run.json")):
        assert time.monotonic() < until, [file.read_text() for file in study.glob("*.log")]
        time.sleep(0.5)
    check_same(tmp_path, "slurm")


def test_the_script_asks_for_what_is_set(tmp_path):
    params = Slurm.Params(partition="long", account="lab", minutes=90, memory_gb=1.5, cpus=4, setup=["module load x"])
    lines = Slurm(params).script(tmp_path / "a study", 7).splitlines()
    assert lines[0] == "#!/bin/bash"
    for option in ("array=1-7", "time=90", "mem=1536M", "cpus-per-task=4", "partition=long", "account=lab", "requeue",
                   "signal=B:TERM@60"):
        assert f"#SBATCH --{option}" in lines
    assert lines[-2] == "module load x"
    assert lines[-1].startswith("exec ") and lines[-1].endswith(
        f"attnlab.work '{tmp_path}/a study' --share $SLURM_ARRAY_TASK_ID/7 --jobs 4 --minutes 89")
    assert subprocess.run(["bash", "-n"], input="\n".join(lines), text=True).returncode == 0


def test_without_slurm_nothing_is_written(complain, monkeypatch):
    monkeypatch.setattr("shutil.which", lambda name: None)
    code, err, written = complain("cluster=slurm", "simulator=planar")
    assert code == 2 and "there is no sbatch" in err and written == []

"""An offline evolution that is killed goes on where it was when the same command is typed again."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from attnlab.tables.schema import TABLES

COMMAND = ("learner=evolution", "learner.generations=4", "learner.population=6", "learner.episodes=4",
           "simulator=planar", "curiosity=none", "seed=0", "train_episodes=2", "validation_episodes=2",
           "picture=false", "report=false")


def genomes(folder: Path) -> list[str]:
    """What was evaluated so far; a line that is being written does not count."""
    journal = next(folder.glob("*/evolution.jsonl"), None)
    lines = journal.read_text().split("\n")[:-1] if journal else []
    return [json.loads(line)["candidate"] for line in lines]


@pytest.mark.long
def test_killed_and_typed_again(attnlab, tmp_path):
    root = Path(__file__).resolve().parents[2]
    process = subprocess.Popen([sys.executable, "-m", "attnlab", *COMMAND, "study=killed"], cwd=tmp_path,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True,
                               env={**os.environ, "PYTHONPATH": str(root)})
    killed, deadline = tmp_path / "outputs" / "killed", time.monotonic() + 120
    while time.monotonic() < deadline and len(genomes(killed)) < 8:
        time.sleep(0.02)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    before = genomes(killed)
    assert 8 <= len(before) < 30
    again = attnlab(*COMMAND, "study=killed")
    assert again.returncode == 0, again.stderr
    straight = attnlab(*COMMAND, "study=straight")
    assert straight.returncode == 0, straight.stderr
    assert genomes(killed)[:len(before)] == before
    assert genomes(killed) == genomes(tmp_path / "outputs" / "straight")  # none twice, none left out
    for one in (tmp_path / "outputs" / "straight").glob("*/*.parquet"):
        assert one.read_bytes() == (killed / one.parent.name / one.name).read_bytes(), one.name
    assert len(list(killed.glob("*/*.parquet"))) == len(TABLES)

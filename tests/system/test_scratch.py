"""What a killed process leaves in the temporary folder goes with the next command; what is not its own stays."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import pytest

from attnlab.tables.scratch import OWNER, scratch, sweep_scratch

SERVER = """
from attnlab.clusters.child import context_for
from attnlab.tables.scratch import scratch
mine = scratch()
context_for([])
print("there", flush=True)
input()
"""


@pytest.fixture
def home(tmp_path, monkeypatch):
    """The temporary folder of this test, in this process and its children; short, for it is to hold a socket."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    return tmp_path


def test_a_killed_one_is_swept(monkeypatch):
    with tempfile.TemporaryDirectory(prefix="t") as short, subprocess.Popen(
            [sys.executable, "-c", SERVER], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            env={**os.environ, "TMPDIR": short}) as process:
        assert process.stdout.readline() == b"there\n"
        monkeypatch.setattr(tempfile, "tempdir", short)
        left = Path(short)
        assert sorted(path.name.split("-")[0] for path in left.iterdir()) == ["attnlab", "pymp"]
        sweep_scratch()
        assert len(list(left.iterdir())) == 2  # it lives
        process.send_signal(signal.SIGKILL)
        process.wait()
        until = time.monotonic() + 10
        while any(left.iterdir()) and time.monotonic() < until:
            sweep_scratch()
            time.sleep(0.1)
        assert not any(left.iterdir())


def test_only_signed_ones_of_this_machine(home):
    mine = scratch()
    owner = json.loads((home / mine.name / OWNER).read_text())
    gone = {**owner, "pid_birth": -1}
    for name, said in (("attnlab-elsewhere", {**gone, "place": "another"}), ("attnlab-odd", ["x"]), ("other-x", gone),
                       ("attnlab-gone", gone)):
        (home / name).mkdir()
        (home / name / OWNER).write_text(json.dumps(said))
    (home / "attnlab-unsigned").mkdir()
    sweep_scratch()
    left = sorted(path.name for path in home.iterdir() if path != Path(mine.name))
    assert left == ["attnlab-elsewhere", "attnlab-odd", "attnlab-unsigned", "other-x"]
    mine.cleanup()


def test_a_folder_goes_with_its_user(home):
    with scratch() as name:
        assert [path.name for path in Path(name).iterdir()] == [OWNER]
    assert list(home.iterdir()) == []

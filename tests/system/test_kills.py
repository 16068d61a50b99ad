"""The short form of the campaign of kills: a sweep that several commands share, killed six times at random."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest

from benchmarks import kills


@pytest.mark.long
def test_killed_at_random(tmp_path):
    done = subprocess.run([sys.executable, kills.__file__, "--kills", "6", "--home", str(tmp_path)],
                          capture_output=True, text=True, timeout=1200)
    assert done.returncode == 0, done.stdout + done.stderr
    found = kills.sums([json.loads(line) for line in (tmp_path / "journal.jsonl").read_text().splitlines()])
    assert found["kills"] >= 6 and found["tables"] >= 80
    assert found["differing_tables"] == found["completed_twice"] == found["unfinished_sweeps"] == 0

"""Plugin files written for one test, run by the real command in a process of its own."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SHORT = ["simulator=planar", "train_episodes=2", "validation_episodes=1", "max_cycles=60", "picture=false",
         "report=false", "cluster=serial"]


class Place:
    """A folder to work in, with a plugins/ folder of its own."""

    def __init__(self, path: Path):
        self.path = path
        (path / "plugins").mkdir()

    def plugin(self, name: str, text: str) -> None:
        (self.path / "plugins" / f"{name}.py").write_text(text)

    def python(self, *arguments: str, **environment: str) -> subprocess.CompletedProcess:
        return subprocess.run([sys.executable, *arguments], cwd=self.path, capture_output=True, text=True, timeout=300,
                              env={**os.environ, "PYTHONPATH": str(ROOT), "COLUMNS": "200", **environment})

    def attnlab(self, *overrides: str) -> subprocess.CompletedProcess:
        typed = {override.partition("=")[0] for override in overrides}
        short = [override for override in SHORT if override.partition("=")[0] not in typed]
        return self.python("-m", "attnlab", *short, *overrides)

    def runs(self) -> dict[str, dict]:
        """run.json of every run by its condition."""
        found = [json.loads(path.read_text()) for path in self.path.glob("outputs/*/*/run.json")]
        return {about["condition"]: about for about in found}


@pytest.fixture
def place(tmp_path):
    return Place(tmp_path)

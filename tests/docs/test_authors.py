"""docs/authors.md: every command in it, in its order, in an empty folder."""

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "authors.md").read_text()


def commands() -> list[list[str]]:
    """The indented lines that start with python, continued lines joined, as arguments."""
    prose = re.sub(r"```.*?```", "", PAGE, flags=re.DOTALL).replace("\\\n", " ")
    lines = [line.strip() for line in prose.splitlines() if line.startswith("    python ")]
    return [shlex.split(line)[1:] for line in lines]


def run(arguments: list[str], folder: Path) -> str:
    """What one command printed; the test fails if it failed."""
    found = {a: sorted(str(f.relative_to(folder)) for f in folder.glob(a)) for a in arguments if "*" in a}
    expanded = [path for a in arguments for path in found.get(a, [a])]
    done = subprocess.run([sys.executable, *expanded], cwd=folder, capture_output=True, text=True, timeout=600,
                          env={**os.environ, "PYTHONPATH": str(ROOT)})
    assert done.returncode == 0, f"{' '.join(arguments)}\n{done.stdout}\n{done.stderr}"
    return done.stdout


def test_the_page_has_its_commands():
    assert len(commands()) == 10
    assert {c[1] for c in commands()} == {"attnlab.new", "attnlab.parts", "pytest", "attnlab", "attnlab.report",
                                          "attnlab.appraise"}


def test_new_parts_work_as_they_are_written(tmp_path):
    """Steps 1 to 3: seconds."""
    for arguments in commands()[:5]:
        printed = run(arguments, tmp_path)
    assert " passed" in printed and (tmp_path / "plugins" / "fade.py").exists()
    assert len((tmp_path / "plugins" / "nap.py").read_text().splitlines()) <= 40
    assert len((tmp_path / "plugins" / "fade.py").read_text().splitlines()) <= 30
    shown = re.search(r"```python\n(.*?)```", PAGE, flags=re.DOTALL)[1]
    written = (tmp_path / "plugins" / "fade.py").read_text()
    for line in shown.splitlines():
        assert line in written or line.strip().startswith('"""'), f"the page shows {line!r}, the file does not have it"


@pytest.mark.long
def test_every_command_of_the_page(tmp_path):
    for arguments in commands():
        run(arguments, tmp_path)
    assert (tmp_path / "outputs" / "mine" / "survival.png").exists()
    assert list(tmp_path.glob("outputs/mine/litman-seed0-*/appraisal.png"))
    assert len(list(tmp_path.glob("outputs/mine/*/policy.parquet"))) == 9

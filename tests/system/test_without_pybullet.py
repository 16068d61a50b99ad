"""Where pybullet is not installed, everything else works."""

from __future__ import annotations

import subprocess
import sys

import pytest

from attnlab.cli.main import main
from attnlab.paths import PACKAGE
from attnlab.results import load

SHORT = ("train_episodes=2", "validation_episodes=1", "max_cycles=60", "picture=false", "report=false",
         "cluster=serial")


@pytest.fixture
def no_pybullet(monkeypatch):
    monkeypatch.setitem(sys.modules, "pybullet", None)


@pytest.mark.usefixtures("no_pybullet")
@pytest.mark.parametrize("typed", ["simulator=pybullet", "validation.simulator=pybullet",
                                   "+experiment=cr_vs_ncr"])
def test_what_needs_it_says_so_before_anything_runs(complain, typed):
    code, err, written = complain(*SHORT, *(["simulator=planar"] if typed.startswith("valid") else []), typed)
    assert code == 2 and written == []
    lines = err.strip().splitlines()
    assert len(lines) == 1
    assert "needs the package pybullet, which is not installed here. pip install pybullet, or choose" in lines[0]


@pytest.mark.usefixtures("no_pybullet")
def test_planar_does_not(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main([*SHORT, "simulator=planar"]) == 0
    assert len(load("main").complete) == 1


@pytest.mark.parametrize("module", ["attnlab", "attnlab.replay"])
def test_a_python_without_packages_says_what_to_type(module):
    """The other terminal, in which nobody typed source .venv/bin/activate."""
    done = subprocess.run([sys.executable, "-S", "-m", module], cwd=PACKAGE.parent, capture_output=True, text=True,
                          check=False)
    assert done.returncode == 2 and done.stdout == "" and len(done.stderr.splitlines()) == 1
    assert "has no numpy. Type: source .venv/bin/activate" in done.stderr

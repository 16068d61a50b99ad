"""Shared by all tests: nothing is ever written into the checkout."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from attnlab.loading import load_all

ROOT = Path(__file__).resolve().parent.parent


@pytest.fixture(scope="session", autouse=True)
def parts_loaded():
    """Register every part once."""
    load_all()


@pytest.fixture
def attnlab(tmp_path, monkeypatch):
    """Run a real command in an empty folder: ``attnlab("+experiment=smoke")`` -> CompletedProcess."""
    def call(*arguments: str, module: str = "attnlab", timeout: float = 240, env: dict | None = None):
        return subprocess.run([sys.executable, "-m", module, *arguments], cwd=tmp_path, capture_output=True, text=True,
                              timeout=timeout, env={**os.environ, "PYTHONPATH": str(ROOT), **(env or {})})
    return call


@pytest.fixture
def complain(tmp_path, monkeypatch, capsys):
    """Run the command line in this process, in an empty folder: (exit code, standard error, files written)."""
    from attnlab.cli.main import main

    def call(*arguments: str) -> tuple[int, str, list[str]]:
        monkeypatch.chdir(tmp_path)
        code = main(list(arguments))
        return code, capsys.readouterr().err, sorted(str(p.relative_to(tmp_path)) for p in tmp_path.rglob("*"))
    return call

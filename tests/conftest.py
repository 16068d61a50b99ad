"""Shared by all tests: nothing is ever written into the checkout."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

from attnlab.loading import load_all

ROOT = Path(__file__).resolve().parent.parent
CHROMIUM = next((found for name in ("chromium", "chromium-browser", "google-chrome") if (found := shutil.which(name))),
                None)
FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-extensions",
         "--disable-background-networking", "--disable-component-update", "--disable-sync", "--hide-scrollbars"]

for name in ("COLUMNS", "LINES"):  # pytest-xdist says 80; a command that is asked without them has no terminal
    os.environ.pop(name, None)
settings.register_profile("any machine", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("any machine")  # a busy one is slow, and that is no failure


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
def here(tmp_path, monkeypatch, capsys):
    """The same in this process, its runs one after the other: seconds sooner, for all that is no matter of processes,
    of streams, or of plugins, which are loaded once a process."""
    def call(*arguments: str, module: str = "attnlab") -> subprocess.CompletedProcess:
        from importlib import import_module

        from attnlab.console import guarded
        monkeypatch.chdir(tmp_path)
        if module == "attnlab":
            from attnlab.cli.main import main
            code = main([*arguments, *["cluster=serial"][:not any(a.startswith("cluster") for a in arguments)]])
        else:
            home = import_module(module)
            home = home if hasattr(home, "main") else import_module(f"{module}.__main__")
            code = guarded(home.main, list(arguments))
        return subprocess.CompletedProcess(arguments, code, *capsys.readouterr())
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


@pytest.fixture(scope="session")
def browser(tmp_path_factory):
    """A function that runs Chromium on arguments and returns (standard output, standard error)."""
    if CHROMIUM is None:
        assert os.environ.get("CI") != "true", "CI must install chromium"
        pytest.skip("chromium is not installed (Debian: apt-get install chromium)")
    home = tmp_path_factory.mktemp("chromium")

    def run(*arguments: str) -> tuple[str, str]:
        done = subprocess.run([CHROMIUM, *FLAGS, f"--user-data-dir={home}", *arguments], capture_output=True, text=True,
                              timeout=120, check=True)
        return done.stdout, done.stderr
    return run

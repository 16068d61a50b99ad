"""The same bytes on every Python and every processor that numba knows: golden digests, made anew with
``python tests/system/short_runs.py --write`` by a change that is meant to change numbers."""

from __future__ import annotations

import ast
import json
import os
import shutil
import subprocess
import tomllib
from pathlib import Path

import pytest

from tests.system import short_runs

ROOT = Path(__file__).resolve().parents[2]
VERSIONS = ("3.11", "3.12", "3.13")
GOLDEN = json.loads(short_runs.GOLDEN.read_text())
RUN_BY = ("arithmetic", "equations", "streams", "worlds", "needs", "exploration", "fusion", "simulators", "learners",
          "behaviours", "curiosity", "penalty", "attention", "cycle", "probes", "robot", "kernels", "logs", "pioneer")
MOVED = {"hypot", "dist", "lgamma", "fsum", "sumprod"}  # their bits depend on the Python, or differ when compiled


def test_this_python():
    assert short_runs.digests() == GOLDEN


def asks_for(node: ast.AST) -> str | None:
    """What a call, or an import, uses whose bits may differ; counting by ``sum`` is exact."""
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "sum":
        counted = node.args[0].elt if isinstance(node.args[0], ast.GeneratorExp) else None
        return None if isinstance(counted, (ast.Compare, ast.Constant)) else "sum"
    if isinstance(node, ast.ImportFrom) and node.module == "math":
        return next((name.name for name in node.names if name.name in MOVED), None)
    return node.attr if isinstance(node, ast.Attribute) and node.attr in MOVED else None


def test_nothing_that_runs_a_robot_uses_what_differs():
    files = [file for room in RUN_BY for file in
             ([ROOT / "attnlab" / f"{room}.py"] if (ROOT / "attnlab" / f"{room}.py").exists()
              else sorted((ROOT / "attnlab" / room).rglob("*.py")))]
    found = [f"{file.relative_to(ROOT)}:{node.lineno} {what}" for file in files
             for node in ast.walk(ast.parse(file.read_text())) if (what := asks_for(node))]
    assert files and not found


def digests(python: str, *arguments: str, **variables: str) -> dict[str, str]:
    done = subprocess.run([python, short_runs.__file__, *arguments], capture_output=True, text=True,
                          env={**os.environ, "PYTHONPATH": str(ROOT), **variables}, timeout=600)
    assert done.returncode == 0, done.stderr[-2000:]
    found: dict[str, str] = json.loads(done.stdout)
    return found


def table(python: str, cache: Path) -> dict[str, str]:
    """Engine and processor -> "the same", or the runs that differ from the golden ones."""
    found = {}
    for engine, golden in (("python", GOLDEN), ("compiled", {name: GOLDEN[name] for name in short_runs.COMPILED})):
        for processor in ("native", "generic"):
            chosen = {} if processor == "native" else {"NUMBA_CPU_NAME": processor}
            arguments = ["--compiled"] if engine == "compiled" else []
            got = digests(python, *arguments, NUMBA_CACHE_DIR=str(cache), **chosen)
            differ = sorted(name for name in golden.keys() | got.keys() if golden.get(name) != got.get(name))
            found[f"{engine}, {processor}"] = ", ".join(differ) or "the same"
    return found


def interpreter(version: str) -> str | None:
    """A Python of this version on this machine, from the path, pyenv or uv."""
    asked = [shutil.which(f"python{version}"), *map(str, Path.home().glob(f".pyenv/versions/{version}.*/bin/python"))]
    if shutil.which("uv"):
        asked.append(subprocess.run(["uv", "python", "find", version], capture_output=True, text=True).stdout.strip())
    for python in filter(None, asked):
        if subprocess.run([python, "--version"], capture_output=True).returncode == 0:  # no empty shim of pyenv's
            return python
    return None


def installed(python: str, folder: Path) -> str:
    """A Python with all that attnlab needs but pybullet, which takes minutes to compile where it is not ready-made."""
    needed = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["dependencies"]
    subprocess.run([python, "-m", "venv", str(folder / "env")], check=True)
    mine = str(folder / "env/bin/python")
    subprocess.run([mine, "-m", "pip", "install", "-q", "-c", str(ROOT / "constraints.txt"),
                    *(name for name in needed if not name.startswith("pybullet"))], check=True)
    return mine


@pytest.mark.long
@pytest.mark.parametrize("version", VERSIONS)
def test_engines_on_every_python_and_processor(tmp_path, version):
    python = interpreter(version)
    if python is None:
        pytest.skip(f"no Python {version} on this machine")
    assert set(table(installed(python, tmp_path), tmp_path / "cache").values()) == {"the same"}

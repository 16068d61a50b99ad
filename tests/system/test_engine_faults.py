"""The compiler's bad days: no cache, another's cache, two at once, Ctrl-C, a part that breaks when it is compiled."""

from __future__ import annotations

import json
import os
import pickle
import signal
import subprocess
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import pytest

from attnlab.console import heard
from attnlab.errors import ConfigError
from attnlab.launch import engines
from attnlab.robot.engines import PAYS_CYCLES, Choice, choose
from attnlab.robot.plan import RunPlan
from attnlab.testing import config

ROOT = Path(__file__).resolve().parents[2]
TINY = {"behaviours": ("wander",), "needs": "energy_only", "curiosity": "count", "learner": "always_on",
        "exploration": "greedy"}  # compiles soonest
TYPED = ("behaviours=[wander]", "needs=energy_only", "curiosity=count", "learner=always_on", "exploration=greedy",
         "simulator=planar", "train_episodes=2", "validation_episodes=1", "max_cycles=100", "report=false",
         "picture=false", "study=s")
PROGRAM = f"""
from attnlab.robot.engines import choose
from attnlab.robot.episodes import play_run
from attnlab.robot.plan import RunPlan
from attnlab.testing import config
from attnlab.testing.digest import digest
plan = RunPlan(config(**{TINY!r}, engine="compiled"))
print(*choose(plan), digest(play_run(plan, engine="compiled")[0]), sep="; ")
"""


def start(cache: Path, *command: str, cwd: Path = ROOT) -> subprocess.Popen:
    return subprocess.Popen([sys.executable, *command], cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                            text=True, env={**os.environ, "PYTHONPATH": str(ROOT), "NUMBA_CACHE_DIR": str(cache)})


def finished(process: subprocess.Popen) -> str:
    out, err = process.communicate(timeout=600)
    assert process.returncode == 0, err
    return out.strip()


def test_without_numba(monkeypatch):
    monkeypatch.setitem(sys.modules, "attnlab.compiled.engine", None)
    engine, why = choose(RunPlan(config()), PAYS_CYCLES)
    assert engine == "python" and why.startswith("numba is missing or too old (") and "\n" not in why
    with pytest.raises(ConfigError, match="engine=compiled: cannot be: numba is missing or too old"):
        choose(RunPlan(config(engine="compiled")))


def test_without_a_cache_folder(monkeypatch):
    """Compiled code that is not kept pays for no run."""
    monkeypatch.setattr("attnlab.kernels.compile.keeps", lambda: False)
    assert choose(RunPlan(config()), PAYS_CYCLES) == (
        "python", "numba's cache folder cannot be written: each run would compile for itself")


def test_it_is_said_once_that_it_compiles_and_why_it_did_not(monkeypatch, capsys):
    """Two conditions of one composition, one of another, and one that was compiled before."""
    settings = SimpleNamespace(max_cycles=10, **{group: {"name": "a"} for group in engines.PARTS})
    jobs = [SimpleNamespace(of=SimpleNamespace(key=key), settings=settings, episodes=1, plan=key) for key in "aabcd"]

    def chosen(plan, cycles, announce):
        if plan != "d":
            announce()
        return Choice("compiled", "") if plan == "d" else Choice("python", "slips.py:3: no")
    monkeypatch.setattr(engines, "choose", chosen)
    monkeypatch.setattr(engines, "SAID", set())
    engines.prepare(jobs)
    assert capsys.readouterr().err.splitlines() == ["compiling, about 10 s for each composition of parts, once",
                                                    "runs interpreted: slips.py:3: no"]
    assert [job.engine.name for job in jobs] == ["python"] * 4 + ["compiled"]
    engines.prepare(jobs)  # of a multiverse the next block of pilots, and the study
    assert capsys.readouterr().err == ""


@pytest.fixture
def interruptible():
    """Ctrl-C is heard, also where the tests were started in the background of a shell, which ignores it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_ctrl_c_that_c_code_loses_is_heard_in_the_end(capsys, interruptible):
    """A callback from C cannot raise: Python prints the exception and forgets it."""
    import ctypes

    def interrupt():
        os.kill(os.getpid(), signal.SIGINT)
        return 0
    called, went_on = ctypes.CFUNCTYPE(ctypes.c_int)(interrupt), []

    def lose():
        with heard():
            called()
            went_on.append(1)
    with pytest.raises(KeyboardInterrupt):
        lose()
    assert went_on and capsys.readouterr().err == ""
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_ctrl_c_that_became_another_error_is_ctrl_c(interruptible):
    """numpy's C code turns one that comes while it is imported into an ImportError."""
    def turn(interrupted):
        with heard():
            try:
                if interrupted:
                    os.kill(os.getpid(), signal.SIGINT)
            finally:
                raise ImportError("could not import datetime")
    with pytest.raises(KeyboardInterrupt):
        turn(True)
    with pytest.raises(ImportError):
        turn(False)
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


@pytest.mark.long
def test_two_at_once_and_a_cache_of_another_version(tmp_path):
    """Both compile, or one finds what the other wrote; code of another numba is not used, nor is what is no code."""
    one, other = [finished(process) for process in [start(tmp_path, "-c", PROGRAM) for _ in range(2)]]
    digest = one.split("; ")[-1]
    assert one.startswith("compiled") and other.endswith(digest)
    again = finished(start(tmp_path, "-c", PROGRAM))
    assert again == f"compiled; engine=compiled, and it was compiled before; {digest}"
    indices = list(tmp_path.rglob("*.nbi"))
    for index in indices:
        index.write_bytes(pickle.dumps("0.1") + index.read_bytes())
    assert finished(start(tmp_path, "-c", PROGRAM)) == f"compiled; engine=compiled; {digest}"
    for code in tmp_path.rglob("*.nbc"):
        code.write_bytes(b"no code")
    assert finished(start(tmp_path, "-c", PROGRAM)) == f"compiled; engine=compiled; {digest}"


@pytest.mark.long
def test_interrupted_while_it_compiles(tmp_path):
    command = start(tmp_path / "cache", "-m", "attnlab", *TYPED, "engine=compiled", cwd=tmp_path)
    for line in command.stderr:
        if line.startswith("compiling"):
            break
    time.sleep(1)
    command.send_signal(signal.SIGINT)
    _, said = command.communicate(timeout=120)
    assert command.returncode == 130, said
    assert "Traceback" not in said and not list(tmp_path.glob("outputs/*/*/run.json"))
    finished(start(tmp_path / "cache", "-m", "attnlab", *TYPED, "engine=compiled", cwd=tmp_path))
    (about,) = tmp_path.glob("outputs/s/*/run.json")
    assert json.loads(about.read_text())["engine"] == "compiled"


BREAKS = '''
from attnlab.api import Learner, register


@register("learner", "breaks")
class Breaks(Learner):
    """Divides by nothing in its seventh episode."""

    def __init__(self, params, context):
        super().__init__(params, context)
        self.left = 8

    def start(self):
        self.left -= 1

    def update(self, state, action, reward, next_state, next_action, cycles):
        self.visits[state][action] += 1
        self.q[state][action] += 1 // self.left

    def terminal(self, state, action, reward):
        self.visits[state][action] += 1
'''


@pytest.mark.long
def test_what_breaks_compiled_is_played_again_and_named(tmp_path):
    """It passes the first three episodes; the run then fails as Python does, with the plugin's line."""
    (tmp_path / "plugins").mkdir()
    (tmp_path / "plugins" / "breaks.py").write_text(BREAKS)
    typed = [word for word in TYPED if not word.startswith(("learner", "train", "exploration"))]
    command = start(tmp_path / "cache", "-m", "attnlab", *typed, "learner=breaks", "train_episodes=9",
                    "engine=compiled", cwd=tmp_path)
    _, said = command.communicate(timeout=600)
    assert command.returncode == 1, said
    about = json.loads(next(tmp_path.glob("outputs/s/*/run.json")).read_text())
    assert (about["status"], about["engine"]) == ("failed", "python")
    assert about["engine_why"].startswith("compiled, it raised ZeroDivisionError")
    line = BREAKS.splitlines().index("        self.q[state][action] += 1 // self.left") + 1
    assert about["error"].strip().splitlines()[-1].startswith(f"plugins/breaks.py:{line}: ZeroDivision")

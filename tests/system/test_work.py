"""A study's file is all that is needed to do its runs: by several at once, again, within a time, and no longer."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

SHORT = ("simulator=planar", "train_episodes=3", "validation_episodes=2", "max_cycles=120", "picture=false",
         "report=false")
ENV = {**os.environ, "PYTHONPATH": str(Path(__file__).resolve().parents[2])}


def runs_of(folder: Path) -> dict[str, dict]:
    return {file.parent.name: json.loads(file.read_text()) for file in sorted(folder.glob("*/run.json"))}


def begun(tmp_path, *arguments, module="attnlab.work"):
    return subprocess.Popen([sys.executable, "-m", module, *arguments], cwd=tmp_path, env=ENV, text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE)


@pytest.fixture
def asked(complain, monkeypatch, tmp_path):
    """Only ask for a study: asked("seed=0-3") -> its folder."""
    def call(*arguments, study="asked"):
        with monkeypatch.context() as patch:
            patch.setattr("attnlab.launch.drive._run", lambda todo, folder: [])
            assert complain(*arguments, f"study={study}")[0] == 0
        return tmp_path / "outputs" / study
    return call


def test_two_shares_do_a_study_and_the_bytes_are_those_of_one_command(asked, here, tmp_path):
    sweep = ("curiosity=litman,none", "learner.alpha=0.3,0.5", "labels={litman: CR}", "callback=[jsonl]", *SHORT)
    folder = asked(*sweep)
    both = [begun(tmp_path, "outputs/asked", "--share", f"{i}/2", "--jobs", "1") for i in (1, 2)]
    said = [process.communicate(timeout=240) for process in both]
    assert [process.returncode for process in both] == [0, 0], said
    runs = runs_of(folder)
    assert len(runs) == 4 and {about["status"] for about in runs.values()} == {"complete"}
    assert not list((folder / ".claims").iterdir())
    assert here(*sweep, "study=straight").returncode == 0
    straight = tmp_path / "outputs" / "straight"
    for name, about in runs_of(straight).items():
        assert {key: about[key] for key in ("swept", "condition", "key", "claims")} == \
            {key: runs[name][key] for key in ("swept", "condition", "key", "claims")}
        assert [file.name for file in (folder / name).iterdir()] != []
        assert {file.name for file in (folder / name).iterdir()} == {file.name for file in (straight / name).iterdir()}
        for file in (straight / name).glob("*.parquet"):
            assert file.read_bytes() == (folder / name / file.name).read_bytes()
    again = here("asked", module="attnlab.work")
    assert again.returncode == 0 and "nothing to do, 4 complete of 4 runs" in again.stdout
    table = next(folder.glob("*/episodes.parquet"))
    whole = table.read_bytes()
    table.write_bytes(whole[:900] + bytes([whole[900] ^ 1]) + whole[901:])
    assert "1 of 4 runs to be done" in here("asked", module="attnlab.retry").stdout
    assert table.read_bytes() == whole


def test_sigterm_gives_back_within_ten_seconds(asked, tmp_path):
    folder = asked("seed=0-2", "simulator=planar", "engine=python", "train_episodes=100000", "picture=false",
                   "report=false")
    process = begun(tmp_path, "asked", "--jobs", "2")
    until = time.monotonic() + 120
    while time.monotonic() < until and sum(r["status"] == "running" for r in runs_of(folder).values()) < 2:
        time.sleep(0.05)
    process.send_signal(signal.SIGTERM)
    begin = time.monotonic()
    _, err = process.communicate(timeout=60)
    assert time.monotonic() - begin < 10 and process.returncode == 143 and "Traceback" not in err
    assert not list((folder / ".claims").iterdir())
    assert [about["interrupted"] for about in runs_of(folder).values()] == [True, True]


def test_it_leaves_in_time(asked, attnlab):
    asked("seed=0-2", "simulator=planar", "engine=python", "train_episodes=100000", "picture=false", "report=false")
    begin = time.monotonic()
    done = attnlab("asked", "--minutes", "0.2", module="attnlab.work")
    assert time.monotonic() - begin < 30 and done.returncode == 0, done.stderr
    assert "2 interrupted, 1 missing of 3 runs" in done.stdout


@pytest.mark.parametrize(("arguments", "says"), [
    (["nowhere"], "there is no such study"), (["asked", "--share", "3/2"], "'3/2' is no share"),
    (["asked", "--minutes", "0"], "must be more than 0"), (["asked", "--jobs", "0"], "at least 1")])
def test_wrong_words_are_one_line(asked, arguments, says, capsys):
    from attnlab.console import guarded
    from attnlab.work import main
    asked("seed=0", *SHORT)
    assert guarded(main, arguments) == 2
    err = capsys.readouterr().err
    assert says in err and len(err.splitlines()) == 1


RAISES = """
from attnlab.api import Curiosity, register
from attnlab.curiosity.none import NoCuriosity
@register("curiosity", "{name}")
class Part(NoCuriosity):
    def wanting(self, memory, energy):
        {does}
"""


@pytest.fixture
def plugin(tmp_path):
    def write(name, does):
        (tmp_path / "plugins").mkdir(exist_ok=True)
        (tmp_path / "plugins" / f"{name}.py").write_text(RAISES.format(name=name, does=does))
    return write


def test_runs_that_fail_alike_stop_the_sweep(plugin, attnlab, tmp_path):
    plugin("failing", "raise ValueError('x [/bold] ' + 'long ' * 300_000)")
    done = attnlab("curiosity=failing", "seed=0-5", "cluster.stop_after=2", "cluster.jobs=1", *SHORT)
    assert done.returncode == 1 and "stopped: 2 runs failed alike, and 4 were not begun" in done.stderr
    assert len(done.stderr) < 5000 and "[/bold]" in done.stderr
    runs = runs_of(tmp_path / "outputs" / "main")
    assert len(runs) == 2 and all(len(about["error"]) < 50_000 for about in runs.values())


ENDS = {"os._exit(0)": "the process ended with exit code 0 before the run was complete", "sys.exit(3)": "SystemExit: 3",
        "raise BaseException('my own')": "BaseException: my own",
        "time.sleep(999)": "was not done within 0.1 minutes (cluster.minutes_a_run): it was in"}


def test_a_part_that_ends_or_never_does(plugin, attnlab, tmp_path):
    """Whatever it does, its run is failed with the reason, and the others are done."""
    for i, does in enumerate(ENDS):
        plugin(f"odd{i}", f"import os, sys, time; {does}")
    plugin("wanders", "import os; os.chdir('/'); return 0.5")
    names = [f"odd{i}" for i in range(len(ENDS))]
    done = attnlab(f"curiosity={','.join(names)},wanders", "cluster.minutes_a_run=0.1", *SHORT)
    assert done.returncode == 1
    runs = {about["curiosity"]: about for about in runs_of(tmp_path / "outputs" / "main").values()}
    for name, says in zip(names, ENDS.values(), strict=True):
        assert runs[name]["status"] == "failed" and says in runs[name]["error"], runs[name]
    assert "plugins/odd3.py:7 (wanting)" in runs["odd3"]["error"]
    assert runs["wanders"]["status"] == "complete"
    assert not list((tmp_path / "outputs" / "main").glob("*/.where"))

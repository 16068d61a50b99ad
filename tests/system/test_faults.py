"""What a terminal, a system, a disk or a stranger's file does to a sweep: one line, and what can go on goes on."""

from __future__ import annotations

import io
import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import pytest

from attnlab.clusters.child import context_for
from attnlab.launch.progress import Display

ROOT = Path(__file__).resolve().parents[2]
PLAIN = ("simulator=planar", "engine=python", "validation_episodes=1", "picture=false", "report=false")
SHORT = (*PLAIN, "train_episodes=2", "max_cycles=60")


def shell(tmp_path, text, **env):
    """A line of bash in an empty folder; PY stands for the command."""
    return subprocess.run(["bash", "-c", text.replace("PY", f"{sys.executable} -m attnlab {' '.join(SHORT)}")],
                          cwd=tmp_path, capture_output=True, text=True, timeout=240,
                          env={**os.environ, "PYTHONPATH": str(ROOT), **env})


def statuses(folder: Path) -> list[str]:
    return [json.loads(file.read_text())["status"] for file in sorted(folder.glob("*/run.json"))]


@pytest.mark.parametrize("line", ["PY cluster=serial >&- 2>&-; echo $?",
                                  "PY 2>/dev/full | true; echo ${PIPESTATUS[0]}"])
def test_nobody_listens(tmp_path, line):
    done = shell(tmp_path, line)
    assert done.stdout == "0\n", done.stderr
    assert statuses(tmp_path / "outputs" / "main") == ["complete"]


def test_a_terminal_shows_what_it_is_given(monkeypatch):
    """An error text that rich would take for markup."""
    screen = io.StringIO()
    screen.isatty = lambda: True
    monkeypatch.setattr(sys, "stderr", screen)
    job = SimpleNamespace(run="[red]run[/x]")
    with Display(1, 1) as display:
        display.run_done(job, {"status": "failed", "error": "Traceback\n[/bold] [link=x] it broke"})
    assert "failed: [red]run[/x]: [/bold] [link=x] it broke" in screen.getvalue()


def test_processes_of_a_run_and_no_room_for_a_socket(tmp_path):
    """Evolution's own processes; TMPDIR too long for the fork server."""
    long = tmp_path / ("t" * 100)
    long.mkdir()
    done = shell(tmp_path, "PY learner=evolution learner.workers=2 learner.generations=0 learner.population=5 "
                           "learner.episodes=1", TMPDIR=str(long))
    assert done.returncode == 0, done.stderr
    assert statuses(tmp_path / "outputs" / "main") == ["complete"]


def children(pid: int) -> dict[int, str]:
    """Processes below a process: number -> command line."""
    found, queue = {}, [pid]
    while queue:
        parent = queue.pop()
        for task in Path(f"/proc/{parent}/task").glob("*/children"):
            for child in map(int, task.read_text().split()):
                found[child] = Path(f"/proc/{child}/cmdline").read_text()
                queue.append(child)
    return found


def begun(tmp_path, *arguments):
    return subprocess.Popen([sys.executable, "-m", "attnlab", *arguments], cwd=tmp_path, text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True,
                            env={**os.environ, "PYTHONPATH": str(ROOT)})


def wait_for(what, seconds=60.0):
    until = time.monotonic() + seconds
    while not (found := what()):
        assert time.monotonic() < until
        time.sleep(0.02)
    return found


def test_a_killed_fork_server_and_a_killed_parent(tmp_path):
    """The first costs its runs a new beginning; the second ends all that it began."""
    study = tmp_path / "outputs" / "main"
    process = begun(tmp_path, *PLAIN, "seed=0-1", "train_episodes=150", "cluster.jobs=2")
    wait_for(lambda: statuses(study).count("running") == 2 if study.exists() else False)
    server = next(pid for pid, line in children(process.pid).items() if "forkserver" in line
                  and children(pid))
    os.kill(server, signal.SIGKILL)
    out, err = process.communicate(timeout=240)
    assert process.returncode == 0, err
    assert statuses(study) == ["complete"] * 2 and "failed" not in out + err

    process = begun(tmp_path, *PLAIN, "seed=0-1", "train_episodes=100000", "study=killed", "cluster.jobs=2")
    study = tmp_path / "outputs" / "killed"
    wait_for(lambda: statuses(study).count("running") == 2 if study.exists() else False)
    workers = list(children(process.pid))
    process.kill()
    process.communicate(timeout=60)
    wait_for(lambda: not any(Path(f"/proc/{pid}").exists() for pid in workers), 20)


def test_ctrl_c_twice_and_at_once(tmp_path):
    process = begun(tmp_path, *PLAIN, "seed=0-1", "train_episodes=100000")
    study = tmp_path / "outputs" / "main"
    wait_for(lambda: statuses(study).count("running") if study.exists() else False)
    process.send_signal(signal.SIGINT)
    time.sleep(0.02)
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=60)
    assert process.returncode == 130 and "Traceback" not in err, err
    for _ in range(5):
        early = begun(tmp_path, *SHORT)
        time.sleep(0.1)
        early.send_signal(signal.SIGINT)
        _, err = early.communicate(timeout=60)
        if "Could not import runpy" not in err:  # else Python itself had not begun by then: once more
            break
    assert early.returncode in (130, -signal.SIGINT) and "attnlab" not in err.replace("attnlab: stopped", ""), err


@pytest.mark.parametrize(("line", "says"), [
    ("mkdir gone; cd gone; rmdir ../gone; PY", "the folder one works in is gone"),
    ("LC_ALL=C PY study=é", "cannot be read"),
    ("LC_ALL=C PY \'study=\"ключ/\"\'", "cannot be the name of a folder")])
def test_one_line_wherever_one_is(tmp_path, line, says):
    done = shell(tmp_path, line)
    assert done.returncode == 2 and says in done.stderr and "Traceback" not in done.stderr, done.stderr
    assert len([text for text in done.stderr.splitlines() if "getcwd" not in text]) == 1


BOMB = "a0: &a0 [1,1,1,1,1,1,1,1,1,1]\n" + "".join(
    f"a{i}: &a{i} [{','.join([f'*a{i - 1}'] * 10)}]\n" for i in range(1, 9))
FILES = {
    "callbacks": ("experiment", "# @package _global_\nhydra: {callbacks: {x: {a: 1}}}\n", "callbacks names code"),
    "target": ("experiment", "# @package _global_\nhydra: {sweeper: {_target_: os.getcwd}}\n", "_target_ names code"),
    "nested": ("experiment", "# @package _global_\nlearner: {x: [{_target_: os.system}]}\n", "_target_ names code"),
    "logging": ("experiment", "# @package _global_\nhydra: {job_logging: {x: {(): os.getcwd}}}\n", "() names"),
    "bomb": ("world", f"part: layout\n{BOMB}", "anchors stand for more than"),
    "itself": ("world", "part: layout\nboxes: &a [*a]\n", "anchors stand for more than")}


@pytest.mark.parametrize("name", FILES)
def test_a_config_file_runs_no_code(complain, tmp_path, name):
    group, text, says = FILES[name]
    (tmp_path / "plugins" / group).mkdir(parents=True)
    (tmp_path / "plugins" / group / f"{name}.yaml").write_text(text)
    code, err, _ = complain(f"{group}={name}", "simulator=planar")
    assert code == 2 and f"plugins/{group}/{name}.yaml" in err and says in err, err
    assert not (tmp_path / "outputs").exists()


@pytest.mark.parametrize("name", ["callbacks", "target", "logging"])
def test_code_through_another_file(complain, tmp_path, name):
    """What was chosen names a file that names the code."""
    (tmp_path / "plugins" / "experiment").mkdir(parents=True)
    (tmp_path / "plugins" / "experiment" / "sly.yaml").write_text("# @package _global_\ndefaults: [other]\n")
    (tmp_path / "plugins" / "experiment" / "other.yaml").write_text(FILES[name][1])
    code, err, _ = complain("experiment=sly", "simulator=planar")
    assert code == 2 and "plugins/experiment/other.yaml" in err and FILES[name][2] in err, err
    assert not (tmp_path / "outputs").exists()


@pytest.mark.parametrize("typed", ["hydra.searchpath=['file://{}']", "+hydra.searchpath=['{}']", "--config-dir={}"])
def test_a_folder_that_was_typed_is_looked_at_too(complain, tmp_path, typed):
    """Its files set values like those of plugins/, and run no code."""
    folder = tmp_path / "it's mine"
    for group, name, text in (("experiment", "sly", FILES["callbacks"][1]),
                              ("world", "small", "part: layout\nwidth_m: 0\n")):
        (folder / group).mkdir(parents=True)
        (folder / group / f"{name}.yaml").write_text(text)
    named = typed.format(str(folder).replace("'", "\\'") if "'" in typed else folder)
    code, err, _ = complain(named, "experiment=sly", "simulator=planar")
    assert code == 2 and "experiment/sly.yaml: callbacks names code" in err, err
    code, err, _ = complain(named, "world=small", "simulator=planar")
    assert code == 2 and "world.width_m: is 0" in err, err


@pytest.mark.parametrize(("typed", "says"), [("hydra.searchpath=[pkg://os]", "pkg://os is no folder"),
                                             ("--config-dir=nowhere", "there is no folder nowhere")])
def test_what_is_no_folder(complain, typed, says):
    code, err, written = complain(typed, "simulator=planar")
    assert code == 2 and says in err and not written, err


def test_a_swept_file_is_looked_at_too(complain, tmp_path):
    (tmp_path / "plugins" / "world").mkdir(parents=True)
    (tmp_path / "plugins" / "world" / "bomb.yaml").write_text(FILES["bomb"][1])
    code, err, _ = complain("world=paper,bomb", "simulator=planar")
    assert code == 2 and "plugins/world/bomb.yaml: its anchors stand for more" in err, err


def test_a_disk_with_no_room_left_is_told_in_a_unit_that_shows_it(complain, monkeypatch):
    monkeypatch.setattr("shutil.disk_usage", lambda _: SimpleNamespace(free=1))
    code, err, written = complain("simulator=planar", "train_episodes=20")
    assert code == 2 and not written and re.search(r"about [1-9]\d* kB of disk, free are 1 B", err), err


def test_little_memory(monkeypatch, tmp_path):
    """Too little to live in is said before anything is written; a little more makes no fork server."""
    done = shell(tmp_path, "ulimit -v 900000; PY")
    assert done.returncode == 2 and done.stderr.startswith("attnlab: ulimit -v: allows a process 922 MB"), done.stderr
    assert not (tmp_path / "outputs").exists()
    monkeypatch.setattr("attnlab.clusters.child.address_space", lambda: 2e9)
    assert context_for([]).get_start_method() == "spawn"


def test_a_claims_file_is_not_printed(complain, tmp_path):
    (tmp_path / "secret.yaml").write_text("password: hunter2\n  indented: [wrong\n")
    code, err, written = complain(f"claims_file={tmp_path / 'secret.yaml'}", "simulator=planar")
    assert code == 2 and "secret.yaml:2: is no readable YAML" in err and "hunter2" not in err
    assert written == ["secret.yaml"]

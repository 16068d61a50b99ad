"""Real commands from start to tables: what is written, resumed, lost and kept."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from attnlab.cli.main import main
from attnlab.results import load
from attnlab.tables.schema import SCHEMA, TABLES

ROOT = Path(__file__).resolve().parents[2]
SHORT = ("simulator=planar", "train_episodes=3", "validation_episodes=2", "max_cycles=120", "picture=false",
         "report=false")


def runs_of(folder: Path) -> list[dict]:
    return [json.loads(file.read_text()) for file in sorted(folder.glob("*/run.json"))]


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """The study of the paper's command, made once by a real one: (folder to work in, what the command said)."""
    place = tmp_path_factory.mktemp("made")
    done = subprocess.run([sys.executable, "-m", "attnlab", "+experiment=cr_vs_ncr", "-m", "seed=0-1", *SHORT],
                          cwd=place, capture_output=True, text=True, timeout=240,
                          env={**os.environ, "PYTHONPATH": str(ROOT)})
    assert done.returncode == 0, done.stderr
    return place, done


@pytest.fixture
def study(made, tmp_path):
    """A copy of it to do harm to: (folder of the study, what the command said)."""
    place, done = made
    shutil.copytree(place / "outputs", tmp_path / "outputs")
    return tmp_path / "outputs" / "cr_vs_ncr", done


def test_the_papers_command_makes_the_contracts_tables(study):
    folder, done = study
    about = runs_of(folder)
    assert [r["status"] for r in about] == ["complete"] * 4
    assert sorted((r["curiosity"], r["seed"]) for r in about) == [(c, s) for c in ("litman", "none") for s in (0, 1)]
    assert {"key", "overrides", "versions", "wall_s", "cycles", "error", "claims"} <= set(about[0])
    result = load(folder)
    for table in TABLES:
        frame = getattr(result, table)
        assert len(frame), table
        assert set(SCHEMA[table]) <= set(frame.columns), table
    assert len(result.runs) == 4
    assert len(result.episodes) == 4 * 5
    assert len(result.behaviours) == 4 * 5 * 3
    assert set(result.policy["curiosity_level"]) == {"none", "low", "LH", "HH"}
    assert len(result.policy) == 2 * 3 * 24 * 4 + 2 * 3 * 72 * 4
    assert set(result.policy["percept"]) == set(range(1, 7))
    last = result.episodes.query("phase == 'validation' and episode == 1").set_index("run")["cycles"]
    assert result.cycles.groupby("run").size().to_dict() == last.to_dict()
    visits = result.coverage.groupby("run")["visits"].sum()
    assert visits.to_dict() == result.episodes.groupby("run")["cycles"].sum().to_dict()
    assert "python -m attnlab.report" in done.stdout
    assert "CR" in done.stdout and "NCR" in done.stdout


def test_conditions_are_paired(study):
    """Same seed: same start poses, whatever the condition."""
    from attnlab.robot.plan import RunPlan
    poses = {}
    for run in sorted(study[0].iterdir()):
        if (run / "config.yaml").exists():
            import yaml
            experiment = RunPlan(yaml.safe_load((run / "config.yaml").read_text()))
            poses.setdefault(experiment.settings.seed, []).append(
                [experiment.start_pose(phase, i) for phase in ("train", "validation") for i in range(3)])
    assert all(a == b for a, b in poses.values())
    assert poses[0][0] != poses[1][0]


def test_asking_again_runs_only_what_is_missing(study, here):
    folder, _ = study
    before = {p: p.stat().st_mtime_ns for p in folder.glob("*/*.parquet")}
    again = here("+experiment=cr_vs_ncr", "-m", "seed=0-1", *SHORT)
    assert again.returncode == 0
    assert "4 of 4 runs are complete already; nothing to run" in again.stdout
    assert {p: p.stat().st_mtime_ns for p in folder.glob("*/*.parquet")} == before
    runs = sorted(folder.glob("*/run.json"))
    (runs[0].parent / "episodes.parquet").write_bytes(b"PAR1 half of a file")
    runs[1].unlink()
    runs[2].write_text(json.dumps({**json.loads(runs[2].read_text()), "status": "running"}))
    mended = here("+experiment=cr_vs_ncr", "-m", "seed=0-2", *SHORT)
    assert mended.returncode == 0, mended.stderr
    assert "1 of 6 runs are complete already; running the other 5" in mended.stdout
    assert all(word in mended.stdout for word in ("1 damaged", "1 incomplete", "1 running", "2 missing"))
    assert len(load(folder).complete) == 6


def test_two_at_once_share_the_work(here, tmp_path):
    """Each run is done by one of them, both end well, and the bytes are those of one command."""
    env = {**os.environ, "PYTHONPATH": str(Path(__file__).resolve().parents[2])}
    command = [sys.executable, "-m", "attnlab", "seed=0-1", *SHORT, "cluster.jobs=1"]
    both = [subprocess.Popen([*command, "study=shared", f"curiosity={order}"], cwd=tmp_path, text=True, env=env,
                             stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            for order in ("litman,none", "none,litman")]
    said = [process.communicate(timeout=240) for process in both]
    assert [process.returncode for process in both] == [0, 0], said
    shared = tmp_path / "outputs" / "shared"
    runs = runs_of(shared)
    assert [about["status"] for about in runs] == ["complete"] * 4
    assert not list((shared / ".claims").iterdir())
    assert len({about["key"] for about in runs}) == 4
    assert here("seed=0-1", *SHORT, "curiosity=litman,none", "study=alone").returncode == 0
    for one in (tmp_path / "outputs" / "alone").glob("*/*.parquet"):
        assert one.read_bytes() == (shared / one.parent.name / one.name).read_bytes(), one


def test_fresh_starts_over_and_makes_the_same_bytes(study, here):
    folder, _ = study
    before = {p: p.read_bytes() for p in folder.glob("*/*.parquet")}
    for path in before:
        path.write_bytes(b"")
    again = here("+experiment=cr_vs_ncr", "-m", "seed=0-1", "fresh=true", *SHORT)
    assert again.returncode == 0
    assert {p: p.read_bytes() for p in folder.glob("*/*.parquet")} == before


def test_another_config_never_overwrites(study, here):
    folder, _ = study
    before = {p: p.read_bytes() for p in folder.glob("*/*.parquet")}
    other = here("+experiment=cr_vs_ncr", "-m", "seed=0-1", *SHORT, "learner.alpha=0.5")
    assert other.returncode == 0
    assert {p: p.read_bytes() for p in before} == before
    assert len(load(folder).complete) == 8


def test_damage_is_named_and_the_rest_is_shown(study):
    folder, _ = study
    runs = sorted(p.parent for p in folder.glob("*/run.json"))
    (runs[0] / "cycles.parquet").write_bytes((runs[0] / "cycles.parquet").read_bytes()[:-20])
    (runs[1] / "run.json").unlink()
    result = load(folder)
    state = result.runs.set_index("run")
    assert state.loc[runs[0].name, "status"] == "damaged"
    assert "cycles.parquet" in state.loc[runs[0].name, "why"]
    assert "no run.json" in state.loc[runs[1].name, "why"]
    assert set(result.episodes["run"]) == {run.name for run in runs[2:]}


def test_a_swept_setting_is_a_column(here, tmp_path):
    done = here("-m", "reading.novelty_window=5,10", "learner=q_learning,fixed_4", "seed=3", *SHORT)
    assert done.returncode == 0, done.stderr
    episodes = load(tmp_path / "outputs" / "main").episodes
    assert set(episodes["reading.novelty_window"]) == {5, 10}
    assert set(episodes["learner"]) == {"q_learning", "fixed_4"}
    assert episodes["run"].nunique() == 4


PLUGINS = {
    "broken.py": "def half(:\n",
    "killer.py": '''
import os, signal
from attnlab.behaviours.avoid import Avoid
from attnlab.registry import register

@register("behaviours", "killer")
class Killer(Avoid):
    """Kills its own process, as a fault in a C library would."""
    def percept(self, now):
        if now.cycle > 20:
            os.kill(os.getpid(), signal.SIGSEGV)
        return super().percept(now)
''',
    "raiser.py": '''
from attnlab.behaviours.avoid import Avoid
from attnlab.registry import register

@register("behaviours", "raiser")
class Raiser(Avoid):
    """Raises in the middle of a run."""
    def percept(self, now):
        if now.cycle > 20:
            raise RuntimeError("the sensor fell off")
        return super().percept(now)
''',
}


@pytest.fixture
def with_plugins(tmp_path):
    (tmp_path / "plugins").mkdir()
    for name, text in PLUGINS.items():
        (tmp_path / "plugins" / name).write_text(text)
    return tmp_path


def test_a_broken_plugin_and_a_crash_take_nobody_down(with_plugins, attnlab):
    done = attnlab("-m", "behaviours=[avoid,eat,drink],[killer,eat,drink],[raiser,eat,drink]", "curiosity=none", *SHORT)
    assert done.returncode == 1
    assert "broken.py did not load" in done.stderr and "SyntaxError" in done.stderr
    state = load(with_plugins / "outputs" / "main").runs
    by = {next(o for o in row["overrides"] if o.startswith("behaviours")): row for _, row in state.iterrows()}
    assert by["behaviours=[avoid,eat,drink]"]["status"] == "complete"
    assert "SIGSEGV" in by["behaviours=[killer,eat,drink]"]["error"]
    assert "the sensor fell off" in by["behaviours=[raiser,eat,drink]"]["error"]
    assert "raiser.py" in by["behaviours=[raiser,eat,drink]"]["error"]  # the traceback names the file
    assert "2 of 3 runs failed" in done.stderr


def test_a_broken_plugin_is_named_when_asked_for(with_plugins, attnlab):
    done = attnlab("+behaviours=broken", *SHORT)
    assert done.returncode == 2
    assert "broken.py did not load" in done.stderr.splitlines()[-1]
    assert not (with_plugins / "outputs").exists()


def test_rest_is_used_by_naming_it(here, tmp_path):
    done = here("+behaviours=rest", "behaviours.rest.threshold=310", *SHORT)
    assert done.returncode == 0, done.stderr
    result = load(tmp_path / "outputs" / "main")
    assert set(result.behaviours["behaviour"]) == {"avoid", "eat", "drink", "rest"}
    assert result.behaviours.query("behaviour == 'rest'")["releases"].sum() > 0
    assert result.episodes["fatigue_mean"].notna().all()
    assert "rest_active" in result.cycles


def test_ctrl_c_stops_cleanly_and_keeps_what_was_complete(tmp_path):
    env = {**os.environ, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-m", "attnlab", "-m", "seed=0-5", "cluster.jobs=1", "simulator=planar",
               "train_episodes=250", "validation_episodes=1", "picture=false", "report=false"]
    process = subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                               env=env, start_new_session=True)
    folder = tmp_path / "outputs" / "main"
    deadline = time.monotonic() + 120
    while time.monotonic() < deadline:
        states = [about["status"] for about in runs_of(folder)] if folder.exists() else []
        if "complete" in states and "running" in states:
            break
        time.sleep(0.05)
    os.killpg(process.pid, signal.SIGINT)
    _, err = process.communicate(timeout=30)
    assert process.returncode == 130, err
    assert "Traceback" not in err
    states = [about["status"] for about in runs_of(folder)]
    assert "complete" in states
    assert "running" not in states
    result = load(folder)
    assert set(result.episodes["run"]) == set(result.complete)


def test_a_changed_plugin_runs_again(attnlab, tmp_path):
    assert attnlab("curiosity", "mine", module="attnlab.new").returncode == 0
    typed = ("curiosity=mine", "cluster=serial", *SHORT)
    assert attnlab(*typed).returncode == 0
    plugin = tmp_path / "plugins" / "mine.py"
    plugin.write_text(plugin.read_text() + "\n# another thought\n")
    again = attnlab(*typed)
    assert "1 made before its plugin was changed" in again.stdout and "nothing to run" not in again.stdout
    assert "nothing to run" in attnlab(*typed).stdout


def test_conditions_keep_the_names_of_this_command(here, tmp_path):
    """A run that an earlier command made, under another name, is counted where it belongs."""
    assert here("learner.alpha=0.1", *SHORT).returncode == 0
    done = here("learner.alpha=0.1,0.5", "seed=0-1", *SHORT)
    rows = [line.split()[:2] for line in done.stdout.splitlines() if line.strip().startswith(("alpha", "litman"))]
    assert rows[:2] == [["alpha=0.1", "2"], ["alpha=0.5", "2"]]  # what does not fit beside them is below
    more = here("learner.alpha=0.9", *SHORT)
    assert "holds 4 more runs of other settings" in more.stdout


def test_labels_and_lists_may_be_typed(here, tmp_path):
    done = here("labels={litman:CR,none:NCR}", "curiosity=litman,none", "behaviours=[avoid,eat]", "+behaviours=rest",
                   *SHORT)
    assert done.returncode == 0, done.stderr
    assert " CR " in done.stdout and " NCR " in done.stdout
    assert set(load(tmp_path / "outputs" / "main").behaviours["behaviour"]) == {"avoid", "eat", "rest"}


WORLDS = {"cut": ("boxes: [{kind: food", "cut.yaml:", "is no YAML"),
          "bare": ("width_m: 4.0", "world:", "does not say which part it sets. Write 'part: "),
          "typo": ("part: layout\nboxes:\n  - {kind: foods, x_m: 1.0, y_m: 1.0}", "boxes[0].kind",
                   "Did you mean 'food'")}


@pytest.mark.parametrize("name", WORLDS)
def test_a_wrong_world_file_is_one_line(here, tmp_path, name):
    text, where, what = WORLDS[name]
    (tmp_path / "plugins" / "world").mkdir(parents=True)
    (tmp_path / "plugins" / "world" / f"{name}.yaml").write_text(f"defaults: [layout, _self_]\n{text}\n"
                                                                 if name != "bare" else text)
    done = here(f"world={name}", *SHORT)
    assert done.returncode == 2 and not (tmp_path / "outputs").exists()
    line = done.stderr.strip().splitlines()[-1]
    assert where in line and what in line, done.stderr


def test_a_report_of_no_study_writes_nothing(here, tmp_path):
    (tmp_path / "empty").mkdir()
    done = here("empty", module="attnlab.report")
    assert done.returncode == 2 and "no runs in it" in done.stderr and not list((tmp_path / "empty").iterdir())


def test_other_behaviours_in_one_study_keep_their_columns(here):
    done = here("behaviours=[avoid,eat,drink],[avoid,drink]", *SHORT)
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    head = next(line for line in lines if "condition" in line and "avoid" in line)
    names = head.split()[-3:]
    assert sorted(names) == ["avoid", "drink", "eat"]
    two = next(line for line in lines[lines.index(head):] if "[avoid,drink]" in line)
    assert two.split()[-3:][names.index("eat")] == "-"


def test_what_was_stopped_did_not_fail(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    typed = [*SHORT, "cluster=serial"]
    assert main(typed) == 0
    file = next(Path("outputs/main").glob("*/run.json"))
    file.write_text(json.dumps({**json.loads(file.read_text()), "status": "failed", "interrupted": True}))
    assert main(typed) == 0
    assert "no run is complete (1 interrupted)" in capsys.readouterr().out

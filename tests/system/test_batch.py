"""Many robots in one call: over any number of threads the same bytes as one by one, each in its folder."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

import attnlab.batch
from attnlab.errors import ConfigError
from attnlab.robot.folder import run_to_folder
from attnlab.testing import config
from attnlab.testing.digest import digest
from benchmarks import batch as figures

ROOT = Path(__file__).resolve().parents[2]
SHORT = {"train_episodes": 3, "validation_episodes": 1, "max_cycles": 300}
TIMES = {"wall_s", "cpu_s", "pid_birth"}


def robots() -> list[dict]:
    """Seeds, a reading and a setting: one composition."""
    return [config(**SHORT, seed=seed, how=how, learner={"name": "q_learning", "alpha": alpha})
            for seed in (0, 1) for how in ({}, {"need_start": 900}) for alpha in (0.1, 0.5)]


@pytest.fixture(scope="module")
def one_by_one():
    return [attnlab.api.simulate({**settings, "engine": "python"}) for settings in robots()]


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_any_number_of_threads_gives_what_one_by_one_gives(threads, one_by_one):
    found = attnlab.batch.simulate(robots(), threads)
    assert [same(tables) for tables in found] == [same(tables) for tables in one_by_one]
    assert len({same(tables) for tables in found}) == len(found)


def same(tables) -> str:
    return digest({name: frame.astype(object).to_dict("list") for name, frame in tables._asdict().items()})


def test_each_has_its_folder_as_ever(tmp_path):
    folders = attnlab.batch.run(robots(), tmp_path / "batch", threads=3)
    assert len(set(folders)) == 8
    for folder, settings in zip(folders, robots(), strict=True):
        mine = json.loads((folder / "run.json").read_text())
        assert (mine["status"], mine["engine"], mine["run"]) == ("complete", "compiled", folder.name)
        info = {name: mine[name] for name in ("run", "key", "overrides", "swept", "condition", "code", "claims")}
        alone = tmp_path / "alone" / folder.name
        assert run_to_folder({**settings, "engine": "compiled"}, alone, {**info, "engine": ("compiled",
                                                                                           mine["engine_why"])})
        assert {file.name for file in alone.iterdir()} == {file.name for file in folder.iterdir()}
        its = json.loads((alone / "run.json").read_text())
        assert {name for name in mine if mine[name] != its[name]} <= TIMES
        for file in (*alone.glob("*.parquet"), alone / "config.yaml", alone / "agent.json"):
            assert file.read_bytes() == (folder / file.name).read_bytes()
    assert set(mine["swept"]) == {"learner.alpha", "reading.need_start"} and mine["key"] == folder.name[-10:]


@pytest.mark.parametrize(("configs", "said"), [
    ([], "configs: there are none"),
    ([config(), config(curiosity="none")], r"configs\[1\]: has curiosity=none, and configs\[0\] curiosity=litman"),
    ([config(), config(behaviours=("avoid", "eat"))], r"configs\[1\]: has behaviours=\[avoid,eat\], and"),
    ([config(simulator="scripted", behaviours=("give",), needs="energy_only")], "simulator=scripted runs as Python"),
    ([config(), config()], "asks twice for the run"),
    ([config(), config(max_cycles=0)], "max_cycles: is 0 mc, must be at least 1")])
def test_what_cannot_be_is_one_line_and_nothing_is_written(configs, said, tmp_path):
    with pytest.raises(ConfigError, match=said) as raised:
        attnlab.batch.run(configs, tmp_path / "batch")
    assert "\n" not in str(raised.value) and not (tmp_path / "batch").exists()


def test_no_threads_are_too_few():
    with pytest.raises(ConfigError, match="threads: is 0"):
        attnlab.batch.simulate(robots(), threads=0)


def test_a_run_that_fails_is_data(tmp_path, monkeypatch):
    def breaks(plan, *_, **__):
        if plan.settings.seed == 1:
            raise OSError("no disk, say")
        return play(plan, *_, **__)
    play = attnlab.robot.folder.play_run
    monkeypatch.setattr("attnlab.robot.folder.play_run", breaks)
    found = [json.loads((folder / "run.json").read_text())["status"]
             for folder in attnlab.batch.run([config(**SHORT, seed=seed) for seed in range(3)], tmp_path, threads=2)]
    assert found == ["complete", "failed", "complete"]


def test_a_study_over_threads_is_the_study(here, tmp_path):
    how = ("curiosity=litman,none", "seed=0-2", "simulator=planar", "train_episodes=3", "validation_episodes=1",
           "max_cycles=200", "engine=python", "report=false", "picture=false")
    for cluster in ("serial", "threads"):
        assert here(*how, f"cluster={cluster}", f"outputs={cluster}").returncode == 0
    files = sorted(file.relative_to(tmp_path / "serial") for file in (tmp_path / "serial").rglob("*.parquet"))
    assert len(files) == 6 * 5
    for file in files:
        assert (tmp_path / "serial" / file).read_bytes() == (tmp_path / "threads" / file).read_bytes()
    again = here(*how, "cluster=threads", "outputs=threads")
    assert "6 of 6 runs are complete already" in again.stdout


def test_a_stop_gives_back(here, tmp_path, monkeypatch):
    def stopped(self, display):
        raise KeyboardInterrupt
    with monkeypatch.context() as patch:
        patch.setattr("attnlab.clusters.threads._Run.tell", stopped)
        how = ("seed=0-3", "simulator=planar", "engine=python", "train_episodes=60", "report=false", "picture=false",
               "cluster=threads", "cluster.jobs=2")
        assert here(*how).returncode != 0
    runs = [json.loads(file.read_text()) for file in (tmp_path / "outputs" / "main").glob("*/run.json")]
    assert runs and all(run["interrupted"] for run in runs if run["status"] == "failed")
    assert not list((tmp_path / "outputs" / "main" / ".claims").glob("[!.]*"))


def test_the_pages_say_what_was_stored():
    stored = json.loads(figures.RESULT.read_text())
    for page in (ROOT / "docs" / "engine.md", ROOT / "docs" / "gym.md"):
        text = page.read_text()
        assert text == figures.said(text, stored) and "python benchmarks/batch.py" in text


@pytest.mark.long
def test_the_example_of_the_page_runs(capsys):
    [block] = re.findall(r"```python\n(.*?)```", (ROOT / "docs" / "engine.md").read_text(), re.S)
    exec(compile(block, "docs/engine.md", "exec"), {})
    assert re.fullmatch(r"\d\.\d\d( \d\.\d\d){3}\n", capsys.readouterr().out)

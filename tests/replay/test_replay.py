"""A replay shows what the run's tables say, and says so when it cannot."""

import json
import re
import shutil

import numpy as np
import pandas as pd
import pytest

from attnlab.console import guarded
from attnlab.replay.__main__ import main
from attnlab.robot.folder import run_to_folder
from attnlab.testing import config


def live(folder, **settings):
    """A run in ``folder``."""
    chosen = config(**{"train_episodes": 3, "validation_episodes": 2, "max_cycles": 400, "record": "last", **settings})
    assert run_to_folder(chosen, folder, {"run": folder.name, "key": "k", "overrides": [], "swept": {}})
    return folder


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    return live(tmp_path_factory.mktemp("study") / "curious")


def data_of(page):
    return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', page.read_text())[1])


def test_the_page_holds_what_was_recorded(run, tmp_path, capsys):
    out = tmp_path / "there" / "page.html"
    assert main([str(run), "--out", str(out)]) == 0
    assert capsys.readouterr().out.strip() == str(out)
    (track,), cycles = data_of(out)["tracks"], pd.read_parquet(run / "cycles.parquet")
    assert (track["phase"], track["episode"], track["n"]) == ("validation", 1, len(cycles))
    assert np.allclose(track["x"], cycles["x_m"], atol=1e-11) and np.allclose(track["energy"], cycles["energy"])
    for name in ("avoid", "eat", "drink"):
        felt = cycles[cycles[f"{name}_active"]]
        looks = track["looks"][name]
        assert [look[0] for look in looks] == felt["cycle"].tolist()
        assert [look[1] for look in looks] == felt[f"{name}_percept"].tolist()
        assert [look[3] for look in looks] == felt[f"{name}_period"].tolist()
    heard = cycles.loc[cycles["avoid_active"], "cycle"].tolist()
    assert sorted(map(int, track["fans"])) == heard  # sonars are shown when AVOID read them, and never otherwise
    policy = pd.read_parquet(run / "policy.parquet").set_index(["behaviour", "curiosity_level", "period", "percept"])
    assert track["tables"]["eat"]["LH|4|2"] == pytest.approx(policy.loc[("eat", "LH", 4, 2), "q"].tolist(), abs=1e-3)
    assert track["model"] and not track["why"] and data_of(out)["world"][0]["width"] == 4.0
    assert "role=\"note\"" not in out.read_text()


def test_a_meal_is_where_a_need_fell(tmp_path):
    run = live(tmp_path / "hungry", how={"need_start": 900.0, "releaser_threshold": 0.0}, max_cycles=1150, seed=2)
    main([str(run), "--quick"])
    (track,) = data_of(run / "replay.html")["tracks"]
    cycles, row = pd.read_parquet(run / "cycles.parquet"), pd.read_parquet(run / "episodes.parquet").iloc[-1]
    assert sum(need == "hunger" for _, need in track["meals"]) == row["meals"]
    assert sum(need == "thirst" for _, need in track["meals"]) == row["drinks"] and track["meals"]
    for cycle, need in track["meals"]:
        assert cycles[need].iat[cycle] < ([900.0, *cycles[need]])[cycle]


def test_cycles_that_were_not_recorded_are_lived_again(run, tmp_path, capsys):
    """An episode lived again is the recorded one, and the page says where it comes from."""
    everything = live(tmp_path / "all", record="all")
    for phase, episode in (("train", 2), ("validation", 0)):
        out = tmp_path / f"{phase}.html"
        assert main([str(run), "--phase", phase, "--episode", str(episode), "--out", str(out)]) == 0
        assert "because its cycles were not recorded" in capsys.readouterr().err
        found, cycles = data_of(out)["tracks"][0], pd.read_parquet(everything / "cycles.parquet")
        cycles = cycles[(cycles["phase"] == phase) & (cycles["episode"] == episode)]
        assert np.allclose(found["x"], cycles["x_m"], atol=1e-11)
        assert "simulating that run again" in re.search(r'role="note">(.*?)</div>', out.read_text())[1]
        assert bool(found["model"]) == (phase == "validation")
    assert found["n"] == len(cycles)


def test_two_runs_side_by_side(run, tmp_path):
    other = live(tmp_path / "other", curiosity="none", world={"name": "layout", "boxes": []})
    main([str(run), "--with", str(other), "--quick", "--out", str(tmp_path / "two.html")])
    data = data_of(tmp_path / "two.html")
    assert [track["label"] for track in data["tracks"]] == ["curiosity=litman", "curiosity=none"]
    assert [len(world["solids"]) for world in data["world"]] == [8, 4]
    assert data["tracks"][0]["start"][0] != data["tracks"][1]["start"][0]  # other worlds, other starts
    assert data["tracks"][1]["looks"]["avoid"][0][2] == "none"


@pytest.mark.parametrize(("settings", "why"), [
    ({"simulator": "pybullet"}, "simulator=pybullet"), ({"curiosity": "habituation"}, "curiosity=habituation"),
    ({"behaviours": ("avoid", "eat", "drink", "wander")}, "behaviour wander"),
    ({"learner": "random"}, "learner=random"),
    ({"how": {"validation_exploration": "softmax"}}, "at random"), ({"fusion": "mean"}, "fusion")])
def test_what_the_page_cannot_live_it_shows(tmp_path, settings, why):
    run = live(tmp_path / "run", max_cycles=60, train_episodes=1, **settings)
    assert main([str(run)]) == 0
    (track,) = data_of(run / "replay.html")["tracks"]
    assert track["model"] is None and why in track["why"] and track["looks"]["avoid"]


def test_a_run_of_changed_code_has_no_what_if(tmp_path):
    """Poses that this version does not arrive at: the record is shown, and the page says so."""
    run = live(tmp_path / "run")
    cycles = pd.read_parquet(run / "cycles.parquet")
    cycles["x_m"] += 0.25
    cycles.to_parquet(run / "cycles.parquet")
    assert main([str(run)]) == 0
    (track,), text = data_of(run / "replay.html")["tracks"], (run / "replay.html").read_text()
    assert track["model"] is None and "no longer lives this episode" in text and "percepts are not those" in text


def test_bad_input_is_one_line(run, tmp_path, capsys):
    study = live(tmp_path / "study" / "run")

    def broken(name, **files):
        copy = shutil.copytree(study, tmp_path / name)
        for file, text in files.items():
            (copy / file.replace("_", ".")).write_text(text)
        return copy
    gone = (study / "config.yaml").read_text().replace("name: litman", "name: vanished")
    about = json.loads((study / "run.json").read_text())
    cases = {
        (str(tmp_path / "nowhere"),): "there is no such run", (str(study.parent),): "no complete run",
        (str(study), "--episode", "7"): "there is no validation episode 7. They go from 0 to 1",
        (str(study), "--phase", "train", "--episode", "-1"): "there is no train episode -1",
        (str(study), "--out", str(tmp_path)): "is a folder",
        (str(broken("a", cycles_parquet="PAR1 not PAR1")),): "cycles.parquet cannot be read",
        (str(broken("b", episodes_parquet="")),): "episodes.parquet is missing or cut off",
        (str(broken("c", config_yaml=gone)),): "no curiosity is called 'vanished'",
        (str(broken("f", config_yaml=gone, run_json=json.dumps({**about, "plugins": {"plugins/shy.py": "1f"}}))),):
            "called 'vanished'. The run was made with plugins/shy.py, not here any more",
        (str(broken("d", run_json=json.dumps({**about, "schema": 99}))),): "tables of schema 99",
        (str(broken("e", run_json=json.dumps({**about, "status": "failed"}))),): "no complete run (failed",
        (str(study), "--with", str(tmp_path / "nowhere")): "there is no such run"}
    before = sorted(tmp_path.rglob("*"))
    for arguments, said in cases.items():
        assert guarded(main, list(arguments)) == 2
        err = capsys.readouterr().err
        assert said in err and err.count("\n") == 1, err
    assert sorted(tmp_path.rglob("*")) == before


def test_a_run_of_the_older_schema(run, tmp_path):
    """Schema 1 knew no true safety: the strip is empty, everything else is there."""
    old = live(tmp_path / "old")
    about = json.loads((old / "run.json").read_text())
    (old / "run.json").write_text(json.dumps({**about, "schema": 1}))
    for table in ("cycles", "episodes"):
        frame = pd.read_parquet(old / f"{table}.parquet")
        frame.drop(columns=[c for c in frame if c.startswith("safety_held")]).to_parquet(old / f"{table}.parquet")
    assert main([str(old), "--quick"]) == 0
    (track,) = data_of(old / "replay.html")["tracks"]
    assert set(track["safety"]) == {None} and max(track["held"]) > 0


def test_other_needs_and_tasks(tmp_path):
    """A behaviour of plugins/ with a need of its own, and the hand of Fig 1."""
    rest = live(tmp_path / "rest", behaviours=("avoid", "eat", "drink", "rest"))
    assert main([str(rest)]) == 0
    (track,) = data_of(rest / "replay.html")["tracks"]
    assert "rest" in track["why"] and len(track["needs"]) == 3
    give = live(tmp_path / "give", simulator="scripted", behaviours=("give",), needs="energy_only")
    assert main([str(give)]) == 0
    assert data_of(give / "replay.html")["tracks"][0]["needs"] == []


def test_hostile_names_are_text(tmp_path):
    evil = "</script><script>document.title='owned'</script>"
    run = live(tmp_path / "run", labels={"litman": evil})
    main([str(run), "--quick"])
    text = (run / "replay.html").read_text()
    assert evil not in text and data_of(run / "replay.html")["tracks"][0]["label"] == evil


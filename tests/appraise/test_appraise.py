"""A recorded run seen through every model: what is replayed is what the robot saw, and the probes tell models apart."""

import pandas as pd
import pytest

from attnlab.appraise.__main__ import main
from attnlab.appraise.views import appraise, chosen, probes
from attnlab.errors import ConfigError
from attnlab.robot.folder import run_to_folder
from attnlab.testing import config
from attnlab.testing.build import reading
from tests.logs import made


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A short run of the curious robot with its last episode recorded."""
    path = tmp_path_factory.mktemp("run")
    chosen = config(train_episodes=3, validation_episodes=1, max_cycles=400, record="last", seed=4)
    assert run_to_folder(chosen, path, {"run": "run", "key": "k", "overrides": [], "swept": {}})
    return path


def test_litman_replayed_is_what_the_robot_felt(folder, tmp_path):
    assert main([str(folder), "--curiosity", "litman", "--out", str(tmp_path)]) == 0
    table = pd.read_csv(tmp_path / "appraisal.csv")
    cycles = pd.read_parquet(folder / "cycles.parquet")
    for behaviour in ("avoid", "eat", "drink"):
        mine = table[table["behaviour"] == behaviour]
        felt = cycles[cycles[f"{behaviour}_active"]]
        assert mine["cycle"].tolist() == felt["cycle"].tolist()
        assert mine["level"].tolist() == felt[f"{behaviour}_level"].tolist()
        if behaviour == "avoid":
            assert mine["wanting"].tolist() == pytest.approx(felt["wanting"].tolist())
    assert table["level"].nunique() > 1


def test_models_in_one_table_and_figure(folder, tmp_path):
    names = ["litman", "habituation", "surprise", "optimal_arousal"]
    assert set(names) < set(chosen("all"))
    assert main([str(folder), "--curiosity", ",".join(names), "--out", str(tmp_path)]) == 0
    table = pd.read_csv(tmp_path / "appraisal.csv")
    assert set(table["curiosity"]) == set(names)
    assert table.groupby("curiosity").size().nunique() == 1
    assert table["liking"].between(0, 1).all() and table["wanting"].between(0, 1).all()
    habituation = table[(table["curiosity"] == "habituation") & (table["behaviour"] == "avoid")]
    assert habituation["liking"].nunique() > 2  # its sonars were read again in the run's world
    assert (tmp_path / "appraisal.png").read_bytes()[:4] == b"\x89PNG"
    assert "| optimal_arousal |" in (tmp_path / "appraisal.md").read_text()


def test_the_probes_tell_theories_apart():
    names = chosen("all")
    shown = {probe: appraise(views, names, reading()) for probe, views in probes(6, 4600.0).items()}

    def liking(probe, name):
        frame = shown[probe]
        return frame.loc[frame["curiosity"] == name, "liking"].to_numpy()
    for name in names:
        assert liking("boredom", name)[80:100].mean() < 0.15, f"{name} is never bored"
    for name in ("litman", "count", "surprise", "prediction_error", "habituation", "salience", "novelty_decay"):
        assert liking("a new object", name)[100] > 0.9
    assert liking("a new object", "optimal_arousal")[100] < 0.1 < 0.9 < liking("a new object", "optimal_arousal").max()
    assert liking("a new object", "learning_progress")[100] == 0.0 < liking("a new object", "learning_progress")[125]
    noise = {name: liking("a noisy sonar", name)[100:].mean() for name in names}
    assert noise["prediction_error"] > 0.7 > 0.25 > noise["learning_progress"]
    assert liking("a cycle", "prediction_error")[-1] < 0.2  # the order is learned; a window of views never does
    assert liking("a cycle", "litman")[-1] > 0.8


def test_mistakes_are_one_line(folder, tmp_path):
    with pytest.raises(ConfigError, match="no curiosity is called 'litmann'. Did you mean 'litman'"):
        main([str(folder), "--curiosity", "litmann"])
    with pytest.raises(ConfigError, match="no complete run"):
        main([str(tmp_path)])


def test_a_log_is_appraised_as_it_was_recorded(tmp_path, monkeypatch, capsys):
    """Three looks of AVOID: 0.5 m, 0.7 m, 0.25 m are percepts 4, 5, 2 of six; the first views are the newest."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "drive.csv").write_bytes(made.csv())
    assert main(["--log", "drive.csv", "--curiosity", "litman,habituation"]) == 0
    table = pd.read_csv(tmp_path / "outputs" / "appraisal-drive" / "appraisal.csv")
    assert table.loc[table["curiosity"] == "litman", "percept"].tolist() == [4, 5, 2]
    assert table["liking"].between(0, 1).all() and (table["wanting"] == 1.0).all()
    assert "over drive.csv, looked at in every cycle" in (
        tmp_path / "outputs" / "appraisal-drive" / "appraisal.md").read_text()


@pytest.mark.parametrize(("arguments", "problem"), [
    ([], "name a run's folder, or a log by --log FILE"), (["run", "--log", "a"], "a run and a log were given"),
    (["run", "--set", "hole_s=1"], "--set: is for a log"), (["--log", "none.csv"], "there is no file none.csv"),
    (["--log", "empty.csv"], "holds no scan that can be used. 1 x scan without a valid beam")])
def test_what_is_shown_must_be_one_thing_and_there(arguments, problem, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "empty.csv").write_text("t_s,r0\n1,nan\n")
    with pytest.raises(ConfigError, match=problem):
        main(arguments)
    assert not (tmp_path / "outputs").exists()

"""An episode as an MCAP log and as a Rerun recording, opened by the real tools."""

import json
import subprocess
import sys
from pathlib import Path

import pandas as pd
import pytest

import attnlab
from attnlab.errors import ConfigError
from attnlab.export.__main__ import main

SHORT = ("train_episodes=3", "validation_episodes=1", "max_cycles=80", "simulator=planar", "seed=1", "engine=python",
         "cluster=serial", "report=false", "picture=false")


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    study = attnlab.sweep([*SHORT, f"outputs={tmp_path_factory.mktemp('exported')}", "study=one"])
    return study.path / study.complete[0]


@pytest.fixture(scope="module")
def cycles(run):
    return pd.read_parquet(run / "cycles.parquet")


def test_mcap_is_the_episode(run, cycles, capsys):
    reader = pytest.importorskip("mcap.reader")
    assert main([str(run), "--mcap"]) == 0
    file = run / "episode.mcap"
    assert capsys.readouterr().out.strip() == str(file)
    with file.open("rb") as stream:
        opened = reader.make_reader(stream, validate_crcs=True)
        found: dict[str, list] = {}
        for schema, channel, message in opened.iter_messages():
            found.setdefault(channel.topic, []).append((message.log_time, json.loads(message.data)))
            assert channel.message_encoding == "json" and json.loads(schema.data)["type"] == "object"
    poses = [content["pose"]["position"] for _, content in found["/pose"]][1:]
    assert [place["x"] for place in poses] == pytest.approx(list(cycles["x_m"]), abs=1e-9)
    assert [content["energy"] for _, content in found["/body"]] == pytest.approx(list(cycles["energy"]), abs=0.01)
    for behaviour in ("avoid", "eat", "drink"):
        assert [content["cycle"] for _, content in found[f"/attention/{behaviour}"]] == \
            list(cycles.index[cycles[f"{behaviour}_active"]])
    (_, scene), = found["/world"]
    assert len(scene["entities"][0]["cubes"]) > 5
    again = file.read_bytes()
    main([str(run), "--mcap", "--out", str(run / "again.mcap")])
    assert (run / "again.mcap").read_bytes() == again


def test_rerun_opens_it(run, cycles):
    pytest.importorskip("rerun")
    assert main([str(run), "--rerun"]) == 0
    tool = Path(sys.executable).with_name("rerun")
    for command in ("verify", "stats"):
        done = subprocess.run([tool, "rrd", command, run / "episode.rrd"], capture_output=True, text=True, timeout=120)
        assert done.returncode == 0, done.stderr
    printed = subprocess.run([tool, "rrd", "print", run / "episode.rrd"], capture_output=True, text=True, timeout=120)
    for entity in ("/world/robot", "/body/energy", "/attention/avoid/period"):
        assert entity in printed.stdout + printed.stderr


@pytest.mark.parametrize(("words", "told"), [
    (["--mcap", "--rerun"], None), ([], "names no format"), (["--mcap", "--out", "x.txt"], "does not end in .mcap"),
    (["--csv", "--episode", "0"], "belongs to --mcap"),
    (["--mcap", "--episode", "7"], "there is no validation episode 7")])
def test_bad_input_is_one_line(run, words, told):
    if told is None:
        with pytest.raises(SystemExit):
            main([str(run), *words])
        return
    with pytest.raises(ConfigError, match=told):
        main([str(run), *words])


def test_a_missing_extra_is_named(run, monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(ConfigError, match=r"needs the package rerun.*attnlab\[rerun\]"):
        main([str(run), "--rerun"])

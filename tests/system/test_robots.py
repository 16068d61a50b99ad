"""The main study runs on pybullet, the big ones on planar; what a study says of the other robot."""

from __future__ import annotations

import json

import pytest
import yaml

from attnlab.cli.main import main
from attnlab.launch import robots
from attnlab.paths import certificate_file, conf_dir
from attnlab.results import load

SHORT = ("train_episodes=1", "validation_episodes=1", "max_cycles=40", "picture=false", "report=false",
         "cluster=serial", "seed=0")


@pytest.mark.parametrize(("study", "robot"), [("cr_vs_ncr", "pybullet"), ("controls", "planar"),
                                              ("baselines", "planar"), ("generations", "planar"),
                                              ("curiosities", "planar"), ("multiverse", "planar")])
def test_the_robot_of_each_study(study, robot):
    node = yaml.safe_load((conf_dir() / "experiment" / f"{study}.yaml").read_text())
    assert {"override /simulator": robot} in node["defaults"]


def test_on_pybullet_it_says_at_start_and_end_what_planar_is(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["+experiment=cr_vs_ncr", *SHORT]) == 0
    start, end = capsys.readouterr().out.split("means over seeds")
    for said in (start, end):
        assert "several times faster" in said and "they pass 10 of 10 rules" in said
    assert f"+experiment=cr_vs_ncr {' '.join(SHORT)} simulator=planar study=cr_vs_ncr_planar\n" in end
    assert {load("cr_vs_ncr").config(run)["simulator"]["name"] for run in load("cr_vs_ncr").complete} == {"pybullet"}


def test_on_planar_it_says_how_to_use_pybullet_and_no_more(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["+experiment=controls", *SHORT]) == 0
    said = capsys.readouterr().out
    assert "simulator=pybullet study=controls_pybullet" in said and "faster" not in said
    study = load("controls")
    assert [c.name for c in study.file.conditions] == ["CR", "NCR, same states", "NCR, plain"]
    # cr, plain, same_states
    assert study.policy.groupby("run").size().to_list() == [72 * 4 * 3, 24 * 4 * 3, 72 * 4 * 3]
    kinds = {run: (study.config(run)["curiosity"]["name"], study.config(run)["reading"]["non_curious"])
             for run in study.complete}
    assert sorted(kinds.values()) == [("litman", "plain"), ("none", "plain"), ("none", "same_states")]


def test_what_the_certificate_says_follows_it(tmp_path, monkeypatch):
    found = json.loads(certificate_file().read_text())
    file = tmp_path / "certificate.json"
    monkeypatch.setattr(robots, "certificate_file", lambda: file)
    found["verdict"][0] |= {"passes": False}
    next(row for row in found["verdict"] if row["measure"].startswith("transfer_"))["worst"] = -7.25
    file.write_text(json.dumps(found))
    assert "pass 9 of 10" in robots.certificate() and "within 7.2 points; not in: largest sonar" in robots.certificate()
    monkeypatch.setattr(robots, "certificate_file", lambda: None)
    assert robots.certificate() == ""

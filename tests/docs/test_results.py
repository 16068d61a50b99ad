"""docs/results: every number of its page, and of what the README says of it, is from the tables; words follow signs."""

from __future__ import annotations

import csv
import importlib
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

sys.path.insert(0, str(Path(__file__).parents[1] / "report"))
from attnlab.claims import DEFAULT, claims_hash
from attnlab.claims.files import load_claims
from attnlab.results import load
from attnlab.tables.readings import Decided, Tried, write_decided
from tests.report.small_study import write_study

ROOT = Path(__file__).resolve().parents[2]
RESULTS = ROOT / "docs" / "results"
README = (ROOT / "README.md").read_text()


@pytest.fixture
def script(monkeypatch):
    """A module of the folder by name."""
    monkeypatch.syspath_prepend(str(RESULTS))
    return importlib.import_module


def test_the_page_is_what_its_tables_say(script):
    """If not: python docs/results/make.py --page."""
    assert (RESULTS / "README.md").read_text() == script("page").page(RESULTS)


def test_so_is_the_projects_readme(script):
    assert script("page").readme(README, RESULTS) == README
    assert "<!-- found:" in README and "<!-- minutes: cr_vs_ncr -->" in README


def test_the_other_numbers_of_the_readme():
    assert f"a verdict for each of {len(load_claims(DEFAULT).claims)} claims" in README
    readings = yaml.safe_load((ROOT / "conf/experiment/multiverse.yaml").read_text())["variants"]["size"]
    assert f"under {readings} readings" in README and "40 runs" in README
    equations = {int(n) for n in re.findall(r"\((\d+)\)", (ROOT / "attnlab" / "equations.py").read_text())}
    assert f"the paper's {max(equations)} equations" in README


def test_what_is_not_in_the_page_any_more():
    text = (RESULTS / "README.md").read_text()
    assert not [words for words in ("tuned for:", "slower in every reading", "survives better in validation")
                if words in text]


def planted(folder, study, *rows):
    """contrasts.csv with (quantity, unit, treatment, control, difference, low, high), as if made today."""
    (folder / study).mkdir(parents=True, exist_ok=True)
    with (folder / study / "contrasts.csv").open("w", newline="") as sink:
        writer = csv.writer(sink)
        writer.writerow(["quantity", "unit", "treatment", "control", "seeds", "treatment_mean", "control_mean",
                         "difference", "low", "high"])
        writer.writerows([*row[:4], 20, 90 + row[4], 90, *row[4:]] for row in rows)
    made = {"claims_sha256": claims_hash(DEFAULT), "seeds": 20, "runs": 40, "asked_for": 40, "cpu_s_of_runs": 600,
            "code": {"hash": "abc"}}
    (folder / study / "made.json").write_text(json.dumps(made))


@pytest.mark.parametrize(("ends", "word", "costs", "safer"), [
    ((2.0, 1.0, 3.0), "more", "gains", "safer than"), ((-2.0, -3.0, -1.0), "less", "costs", "less safe than"),
    ((2.0, -1.0, 5.0), "neither clearly more nor clearly less", "neither clearly costs", "neither clearly safer")])
def test_words_follow_signs(script, tmp_path, ends, word, costs, safer):
    found, studies = script("found"), script("studies")
    planted(tmp_path, "cr_vs_ncr", *((q, "%", "CR", "NCR", *ends) for q in (found.EARLY, found.LATE, found.VALID)))
    pairs = ((studies.CR, studies.SAME), (studies.SAME, studies.PLAIN), (studies.CR, studies.PLAIN))
    planted(tmp_path, "controls", *((q, unit, *pair, *ends) for pair in pairs
                                    for q, unit in ((found.EARLY, "%"), ("safety", "1"))))
    _, second, third, fourth, _ = found.sentences(tmp_path)
    assert second.startswith(f"Against NCR, plain, CR survives {word} in the first half of training (")
    assert f"({90 + ends[0]:.1f} against 90.0 %, {ends[0]:+.1f} [{ends[1]:+.1f}, {ends[2]:+.1f}] points)" in second
    assert f"(NCR, same states), CR survives {word} in" in third and f"{costs}" in third and f"CR is {safer}" in third
    assert fourth == "This is not known yet: generations has not been made under today's rules."


def test_the_simulators_are_compared_by_verdicts(script, tmp_path):
    found = script("found")
    for study, words in (("cr_vs_ncr", ("reproduced", "untestable", "direction only")),
                         ("cr_vs_ncr_planar", ("reproduced", "not reproduced", "contradicted"))):
        planted(tmp_path, study)
        lines = [f"C{i},{word}" for i, word in enumerate(words, 1)]
        (tmp_path / study / "verdicts.csv").write_text("claim,verdict\n" + "\n".join(lines))
    first, *_, fifth = found.sentences(tmp_path)
    assert first.startswith("Of the paper's 3 claims, 1 reproduced,")
    assert "1 untestable: " in first and "20 seeds" in first
    assert fifth == ("On planar, 1 of 3 verdicts are the same, and claims that hold in one and are contradicted in the "
                     "other: C3.")


def test_what_was_made_under_other_rules_says_so(script, tmp_path):
    found, page = script("found"), script("page")
    planted(tmp_path, "controls", (found.EARLY, "%", "CR", "NCR, plain", 1.0, 0.5, 1.5))
    assert page.OLD not in page.page(tmp_path)
    (tmp_path / "controls" / "made.json").write_text(json.dumps({"claims_sha256": "0" * 64}))
    assert page.OLD in page.page(tmp_path) and found.sentences(tmp_path)[2].startswith("This is not known yet")


def test_contrasts_are_paired_by_seed(script, tmp_path):
    study = write_study(tmp_path / "small", seeds=3, safety=0.3, labels={"litman": "CR", "none": "NCR"})
    rows = {row["quantity"]: row for row in script("contrasts").rows(load(study), [("CR", "NCR"), ("CR", "nobody")])}
    safety = rows["safety"]
    assert safety["seeds"] == 3 and 0.28 < safety["low"] < safety["difference"] < safety["high"] < 0.32
    assert safety["treatment_mean"] - safety["control_mean"] == pytest.approx(safety["difference"])
    assert rows["extrinsic reward of AVOID, survived"]["treatment_mean"] == 51.0


def test_every_study_of_the_page_can_be_asked_for(script):
    """Each command is one that the command line takes, and names the folder that its results are kept in."""
    import attnlab
    for study in script("studies").STUDIES:
        words = [word for word in study.typed if not word.startswith(("-m", "seed="))]
        assert attnlab.compose(*words)["study"] == study.name


JOINT = ("measure,claim,role,against,claimed,readings,with_value,seeds,median_d,as_claimed,clear_as_claimed,"
         "clear_opposite,p_joint,p_median,p_clear,p_family,patterns,statement,side,readings_on_side,hangs_on,"
         "as_claimed_by_level,moved_most_by,its_share")


def joint(folder, *rows):
    """joint.csv of a multiverse of 10 readings, as if made today: (measure, against, d, as claimed, clear as claimed,
    clear opposite, p, statement, side, hangs on, levels), each claimed to be lower."""
    (folder / "multiverse").mkdir(parents=True)
    lines = [f"{m},C{i},CR,{whom},lower,10,10,6,{d},{on},{clear},{no},0.1,0.1,0.1,{p},64,{kind},{side},"
             f"{max(on, 10 - on)},{hangs},{levels},crash,0.2"
             for i, (m, whom, d, on, clear, no, p, kind, side, hangs, levels) in enumerate(rows)]
    (folder / "multiverse" / "joint.csv").write_text("\n".join([JOINT, *lines]))
    made = {"command": "typed", "claims_sha256": claims_hash("multiverse"), "seeds": 6, "runs": 180, "asked_for": 180,
            "cpu_s_of_runs": 600, "cycles": 300_000_000, "code": {"hash": "abc"}, "page_cpu_s": 90.0,
            "pilots": {"readings": "12 were tried.", "balance": "All is even.", "runs": 24, "cpu_s": 120}}
    (folder / "multiverse" / "made.json").write_text(json.dumps(made))


def test_the_multiverse_says_what_its_joint_test_says(script, tmp_path):
    universe = script("universe")
    assert universe.section(tmp_path) == ["## The multiverse", "This is not known yet: multiverse has not been made "
                                          "under today's rules."]
    other = "NCR, same"
    joint(tmp_path, ("thirst", "NCR", 0.8, 10, 6, 0, 0.01, "robust", "lower", "", ""),
          ("thirst", f'"{other}"', 0.7, 9, 5, 0, 0.02, "robust", "lower", "", ""),
          ("hunger", "NCR", -0.9, 0, 0, 7, 0.0001, "robust", "higher", "", ""),
          ("safety", "NCR", 0.3, 6, 3, 1, 0.3, "hangs on a factor", "lower", "crash + x; need_k",
           "contact: 5 of 5; distance: 1 of 5"),
          ("path", "NCR", 0.2, 7, 1, 0, 0.04, "mixed", "lower", "", ""),
          *(("meals", whom, 0.0, 5, 0, 0, 0.9, "noise", "lower", "", "") for whom in ("NCR", f'"{other}"')))
    _, what, pilots, counts, listed, _, *tables = universe.section(tmp_path)
    assert "10 readings of what" in what and "180 runs. They took 10 processor minutes (0.50 million cycles" in what
    assert "the 24 pilots 2, the page 1.5" in what and "corrected for all 7 comparisons" in what
    assert pilots.startswith("12 were tried. All is even.")
    assert counts == ("7 comparisons of 5 measures: robust 3, hangs on a factor 1, mixed 1, noise 2. What they hang on "
                      "first: crash 1.")
    robust, hangs, mixed, noise = listed.splitlines()
    assert "; 3): higher hunger [C2] than NCR in 10 of 10 (d -0.90), the opposite; lower thirst [C0] than NCR in 10 " \
           "of 10 (d +0.80) and than NCR, same in 9 of 10 (d +0.70), as claimed." in robust
    assert hangs == "- **hang on crash** (1): safety [C3] against NCR (as claimed with contact in 5 of 5, distance " \
                    "in 1 of 5)."
    assert mixed.endswith("; 1): path against NCR.") and noise.endswith("; 2): meals.")
    assert tables[0] == "**CR less NCR**" and tables[2] == f"**CR less {other}**" and len(tables) == 4
    assert "| hunger [C2], claimed lower | robust, the opposite | 0 of 10 | 0 % | 70 % | -0.90 | <0.001 |" in tables[1]
    assert "| hangs on crash, need_k | 6 of 10 | 30 % | 10 % | +0.30 | 0.3 |" in tables[1]
    (tmp_path / "multiverse" / "made.json").write_text(json.dumps({"claims_sha256": "0" * 64}))
    assert universe.section(tmp_path)[1].startswith("This is not known yet")


def test_what_the_pilots_decided_goes_into_what_it_was_made_with(script, tmp_path):
    universe = script("universe")
    study = tmp_path / "mine"
    assert universe.pilots(study, load) == {}
    tried = [Tried(f"r{i}", {"a": "x"}, 95.0 - 10 * i, 1, 1, "survives 85.00 %" * i, not i) for i in (0, 1)]
    write_decided(study, Decided("mark", "plain survives more than 90 %", 4, tried, {}, ("a", "a", 0.0), 0.5))
    write_study(tmp_path / "mine_pilots", seeds=2)
    found = universe.pilots(study, load)["pilots"]
    assert found["readings"].startswith("2 of 4 readings were tried") and "too little: 1" in found["readings"]
    assert found["runs"] == 4 and found["balance"].startswith("Levels of two factors meet")


@pytest.mark.long
def test_all_of_it_in_a_short_form(tmp_path):
    subprocess.run([sys.executable, str(RESULTS / "make.py"), "--short", "--outputs", "made", "--to", "kept"],
                   cwd=tmp_path, check=True, env={**os.environ, "PYTHONPATH": str(ROOT)})
    text = (tmp_path / "kept" / "README.md").read_text()
    assert "not known yet" not in text and "Made under older rules" not in text
    assert (tmp_path / "kept" / "generations" / "report.html").exists()

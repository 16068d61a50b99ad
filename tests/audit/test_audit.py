"""The auditor finds what cannot be, by arithmetic that was done by hand here too."""

import pytest

from attnlab.audit.__main__ import main
from attnlab.audit.checks import FITS, IMPOSSIBLE, STRAINED, audit
from attnlab.audit.table import load_table
from attnlab.console import guarded
from attnlab.errors import ConfigError


def outcome(findings, check, condition, n=None, cells=""):
    found = [f for f in findings if (f.check, f.condition, f.cycles) == (check, condition, n) and cells in f.cells]
    assert len(found) == 1, found
    return found[0]


@pytest.fixture(scope="module")
def paper():
    return audit(load_table())


def test_safety_bound_of_table_5(paper):
    # (12 - 1150/204) / 11 = 0.5785 < 0.61; with NCR's 156 activations 0.4207 > 0.38
    bad = outcome(paper, "safety and activations", "CR", 1150)
    assert bad.outcome == IMPOSSIBLE and "0.580" in bad.arithmetic  # 204.5 activations, for 204 is rounded
    assert outcome(paper, "safety and activations", "NCR", 1150).outcome == FITS
    assert outcome(paper, "safety and activations", "NCR", 1500).outcome == IMPOSSIBLE


def test_1500_cycles_are_out_of_reach_of_103_activations(paper):
    found = outcome(paper, "reach of the clocks", "NCR", 1500, "activations.eat")
    assert found.outcome == IMPOSSIBLE and "1236" in found.arithmetic
    assert outcome(paper, "reach of the clocks", "NCR", 1150, "activations.eat").outcome == FITS


def test_what_fits(paper):
    assert outcome(paper, "sum of rewards", "NCR").outcome == FITS  # 234 against 235: rounding
    assert outcome(paper, "sum of rewards", "CR").outcome == FITS
    assert "28.6%" in outcome(paper, "union of activations", "NCR").arithmetic
    # (1150 - 103) / 22 + 103 (1 - 420/1500) / 2 = 47.6 + 37.1 = 84.7 against 83 +- 6
    assert "84.7" in outcome(paper, "reward and mean need", "NCR", 1150, "reward.eat").arithmetic


def test_energy(paper):
    # 4525 - 2683 = 1842 > 1150 + 364 = 1514, but meals may raise it
    assert outcome(paper, "range of energy", "NCR", 1150).outcome == STRAINED
    assert outcome(paper, "range of energy", "NCR", 1500).outcome == FITS
    balance = outcome(paper, "energy and needs", "NCR, CR", 1150)
    # 3809 + 420 + 363 + 1151/2 - 364/2 = 4985.5; 3720 + 328 + 311 + 575.5 - 221.5 = 4713
    assert balance.outcome == STRAINED and "NCR 4986" in balance.arithmetic and "CR 4713" in balance.arithmetic
    assert {f.condition for f in paper if f.check == "always above E_well"} == {"CR"}


TABLE = """
title: mine
cycles: {100: made up}
conditions: [A]
extrinsic_only: [A]
cells:
  safety_max: {A: [0.90, 0.01]}
  safety_mean: {A: [%s, 0.01]}
  reward.eat: {A: [5.0, 1]}
  reward.global: {A: [%s, 1]}
  activations.eat: {A: [50, 1]}
"""


def write(tmp_path, text):
    path = tmp_path / "table.yaml"
    path.write_text(text)
    return str(path)


def test_own_table(tmp_path):
    fine = audit(load_table(write(tmp_path, TABLE % ("0.50", "5.0"))))
    assert {f.outcome for f in fine} == {FITS}
    wrong = audit(load_table(write(tmp_path, TABLE % ("0.95", "7.0"))))
    assert {f.check for f in wrong if f.outcome == IMPOSSIBLE} == {"order", "sum of rewards"}


def test_printed_digits_set_the_rounding(tmp_path):
    table = load_table(write(tmp_path, TABLE % ("0.50", "5.0")))
    assert table.cells["safety_mean"]["A"].rounding == 0.005
    assert table.cells["activations.eat"]["A"].rounding == 0.5


@pytest.mark.parametrize(("text", "words"), [
    ("- 1", "expected settings by name"), ("a: [", "no readable YAML"), ("title: x", "conditions"),
    (TABLE.replace("safety_max", "safty_max") % ("0.5", "5.0"), "safty_max"),
    (TABLE.replace("{A: [0.90, 0.01]}", "{B: [0.9, 0.1]}") % ("0.5", "5.0"), "no such condition"),
    (TABLE % ("many", "5.0"), "is no number"), (TABLE % (".nan", "5.0"), "is no number"),
    (TABLE.replace("[5.0, 1]", "[5.0, -1]") % ("0.5", "5.0"), "cannot be"),
    (TABLE.replace("{100: made up}", "{}") % ("0.5", "5.0"), "cycles"),
    (TABLE.replace("title: mine", "titel: mine") % ("0.5", "5.0"), "titel"),
])
def test_bad_files(tmp_path, text, words, capsys):
    path = write(tmp_path, text)
    with pytest.raises(ConfigError, match=words):
        load_table(path)
    assert guarded(main, [path]) == 2
    assert len(capsys.readouterr().err.strip().splitlines()) == 1


def test_command(capsys):
    assert main([]) == 0
    said = capsys.readouterr().out
    assert "0.61 <= (12 - 1150/204) / 11" in said and "N = 1150" in said
    assert main(["--all"]) == 0
    everything = capsys.readouterr().out
    assert " fits " in everything and " fits " not in said
    assert guarded(main, ["no_such_table"]) == 2

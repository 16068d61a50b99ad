"""The calibration finds what is known: rates of error, power, seeds that are needed; and says what it cannot do."""

import copy

import numpy as np
import pytest
import yaml

from attnlab.calibrate.__main__ import MARKS, main, sound
from attnlab.calibrate.plant import noise, studies
from attnlab.calibrate.table import calibrate, rate
from attnlab.claims.files import load_claims
from attnlab.claims.parts import Part
from attnlab.console import guarded

ONE = {"roles": {"treatment": {"where": {"curiosity": "litman"}}, "control": {"where": {"curiosity": "none"}}},
       "claims": {"X": {"title": "t", "where": "w", "says": "s", "parts": [
           {"measure": "survival", "test": "paired", "direction": "higher", "number": 1, "tolerance": 0.5,
            "unit": "%"}]}}}
HEADS = "settings,claim,part,measure,test,unit,seed,value"
UNIT = dict(enumerate((np.linspace(-1, 1, 21) / np.linspace(-1, 1, 21).std(ddof=1)).tolist()))


def claims_of(tmp_path, content):
    file = tmp_path / "mine.yaml"
    file.write_text(yaml.safe_dump(content))
    return load_claims(str(file))


def test_no_rule_of_the_paper_is_wrong_too_often():
    rows = calibrate(load_claims("dinocera2014"), {}, planted=2000, seeds=20)
    assert len(rows) == 27 and sound(rows)
    assert all(row.to_hold is None and not row.known for row in rows if row.id not in ("C2", "C3", "C4"))


def test_the_power_of_a_t_test(tmp_path):
    """An effect of one standard deviation: 80 % power with 10 pairs, 68 % with 8 (noncentral t)."""
    from scipy.stats import nct, t
    row, = calibrate(claims_of(tmp_path, ONE), {("X", 0): UNIT}, planted=4000, seeds=8)
    bound = t.ppf(0.975, 7)
    assert row.power_holds == pytest.approx(nct.sf(bound, 7, 8 ** 0.5), abs=0.03)
    assert row.to_hold == 10 and row.known
    # the whole interval within 1 +- 0.5: 74 % of normal samples of 40, 93 % of 60
    assert row.to_reproduce == 60 and row.power_reproduced < 0.05
    assert row.false_contradicted[0] == pytest.approx(0.025, abs=0.01) and row.false_reproduced[0] < 0.01


def test_comparisons_of_a_claim_hang_together_as_in_the_tables():
    parts = [Part(measure="survival", unit="%", direction="higher")] * 2
    values = {seed: float(x) for seed, x in enumerate(np.random.default_rng(0).normal(size=30))}
    of = noise(parts, [values, {seed: -2 * x for seed, x in values.items()}])
    one, two = studies(parts, of, "paper", 20, 500, np.random.default_rng(1))
    # rows of one seed stay together (correlation -1), each with its own kernel of 0.3: 1 / (1 + 0.3^2)
    assert np.corrcoef(one.ravel(), two.ravel())[0, 1] == pytest.approx(-1 / 1.09, abs=0.02)
    assert two.std() == pytest.approx(2 * np.std(list(values.values()), ddof=1), rel=0.05)


def test_a_rate_with_its_upper_bound():
    """3 of 100: the exact upper end solves P(at most 3) = 0.05."""
    from scipy.stats import binom
    share, high = rate(np.arange(100) < 3)
    assert share == 0.03 and binom.cdf(3, 100, high) == pytest.approx(0.05)
    assert rate(np.ones(5, bool)) == (1.0, 1.0)


def test_the_command_writes_table_and_page(tmp_path, capsys):
    (tmp_path / "mine.yaml").write_text(yaml.safe_dump(ONE))
    rows = "".join(f",X,0,survival,paired,%,{seed},{value}\n" for seed, value in UNIT.items())
    (tmp_path / "seeds.csv").write_text(f"{HEADS}\n{rows}")
    (tmp_path / "page.md").write_text(f"before\n{MARKS[0]}\nformer\n{MARKS[1]}\nafter\n")
    code = main([str(tmp_path / "seeds.csv"), "--claims", str(tmp_path / "mine.yaml"), "--planted", "500", "--out",
                 str(tmp_path / "deep" / "out"), "--docs", str(tmp_path / "page.md")])
    assert code == 0 and "every rule is wrong in 5 % of the studies or fewer" in capsys.readouterr().out
    assert (tmp_path / "deep" / "out" / "calibration.csv").read_text().startswith("claim,title,planted,seeds")
    page = (tmp_path / "page.md").read_text()
    assert "former" not in page and page.startswith("before") and page.endswith("after\n") and "| X t |" in page


@pytest.mark.parametrize(("words", "problem"), [
    (["--seeds", "1"], "--seeds: is 1, and under 6 seeds there is no verdict"),
    (["--planted", "9"], "--planted: is 9, must be at least 100"),
    (["--docs", "mine.yaml"], "has no place for the table"),
    (["--claims", "dinocera"], "dinocera2014"),
    (None, "has no seeds.csv. Make the report first"),
])
def test_bad_input_is_one_line_and_nothing_is_written(tmp_path, monkeypatch, capsys, words, problem):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.yaml").write_text(yaml.safe_dump(ONE))
    (tmp_path / "seeds.csv").write_text(f"{HEADS}\n,X,0,survival,paired,%,0,1\n")
    given = ["nothing.csv"] if words is None else ["seeds.csv", "--planted", "100", "--claims", "mine.yaml", *words]
    assert guarded(main, given) == 2
    error = capsys.readouterr().err
    assert problem in error and error.count("\n") == 1 and not (tmp_path / "outputs").exists()


@pytest.mark.parametrize("text", ["", "a,b\n1,2\n", f"{HEADS}\n,X,0,s,p,%,0,x\n"])
def test_a_table_that_is_none(tmp_path, capsys, text):
    (tmp_path / "seeds.csv").write_text(text)
    assert guarded(main, [str(tmp_path / "seeds.csv"), "--out", str(tmp_path / "out")]) == 2
    assert capsys.readouterr().err.count("\n") == 1 and not (tmp_path / "out").exists()


def test_no_part_of_a_claim_is_left_out(tmp_path):
    content = copy.deepcopy(ONE)
    content["claims"]["X"]["parts"].append({"measure": "survival_convergence", "test": "order", "direction": "lower",
                                            "unit": "episodes"})
    row, = calibrate(claims_of(tmp_path, content), {("X", 0): UNIT}, planted=1000, seeds=20)
    alone, = calibrate(claims_of(tmp_path, ONE), {("X", 0): UNIT}, planted=1000, seeds=20)
    assert row.power_holds < alone.power_holds  # both must hold

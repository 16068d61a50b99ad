"""Pairs of claims: what excludes each other is proved, what does not has a witness that the rules themselves judge."""

import csv

import pytest

from attnlab.audit import pairs as proving
from attnlab.audit.bookkeeping import constructed, necessary, quantity
from attnlab.audit.certificate import as_csv, as_rows, holding, matrix, words
from attnlab.audit.pairs import ALL, IMPOSSIBLE, POSSIBLE, UNDECIDED, Pair, holds, pairs
from attnlab.claims.files import load_claims
from attnlab.reading import Reading

HEAD = """title: planted
roles:
  treatment: {label: CR, where: {curiosity: litman}}
  control: {label: NCR, where: {curiosity: none}}
claims:
"""


BESIDE = "{measure: {name: overlap}, test: paired, direction: lower, unit: '%', counts: false}"


@pytest.fixture
def planted(tmp_path):
    """Claims by name, each a list of comparisons as yaml."""
    def write(**claims):
        text = HEAD + "".join(f"  {key}: {{title: t, where: w, says: s, parts: [{', '.join([*parts, BESIDE])}]}}\n"
                              for key, parts in claims.items())
        (tmp_path / "planted.yaml").write_text(text)
        return load_claims(str(tmp_path / "planted.yaml"))
    return write


def acts(who, direction, unit="activations"):
    return f"{{measure: {{name: activations, behaviour: {who}}}, test: paired, direction: {direction}, unit: {unit}}}"


def column(name, test, unit="UoE"):
    return f"{{measure: {{name: episode, column: {name}}}, {test}, unit: {unit}}}"


def test_the_same_measure_cannot_be_higher_and_lower(planted):
    found, _ = pairs(planted(up=[acts("avoid", "higher")], down=[acts("avoid", "lower")]))
    assert found.outcome == IMPOSSIBLE
    assert "up: activations avoid of CR less that of NCR >= 0" in found.reason and "down: " in found.reason


def test_sums_are_used(planted):
    """More by each, fewer in all: no row alone says so."""
    found, every = pairs(planted(each=[acts(who, "higher") for who in ("avoid", "eat", "drink")],
                                 all=[acts("all", "lower")]))
    assert found.outcome == IMPOSSIBLE and "activations add up" in found.reason
    assert every[:3] == (ALL, "", IMPOSSIBLE)
    assert pairs(planted(two=[acts(who, "higher") for who in ("avoid", "eat")], all=[acts("all", "lower")])
                 )[0].outcome == POSSIBLE


def test_order_of_least_and_mean_is_used(planted):
    low = column("safety_mean", "test: level, direction: lower, reference: 0.3", "'1'")
    high = column("safety_min", "test: level, direction: higher, reference: 0.4", "'1'")
    found, _ = pairs(planted(low=[low], high=[high]))
    assert found.outcome == IMPOSSIBLE and "safety_min <= safety_mean" in found.reason


def test_what_the_reading_cannot_do_is_not_called_impossible(planted):
    """Mean safety of 0.9 with 100 looks: (12 - 1150/100) / 11 = 0.05, but in lives of 100 cycles who knows."""
    few = "{measure: {name: activations, behaviour: avoid}, test: level, direction: lower, reference: 100, " \
          "unit: activations}"
    safe = column("safety_mean", "test: level, direction: higher, reference: 0.9", "'1'")
    assert pairs(planted(few=[few], safe=[safe]))[0].outcome == UNDECIDED


def test_a_study_in_which_both_hold_is_a_witness(planted):
    few = column("safety_min", "test: level, direction: higher, reference: 0.4", "'1'")
    more = column("safety_mean", "test: level, direction: higher, reference: 0.5", "'1'")
    claims = planted(a=[few], b=[more])
    assert pairs(claims, {"mine": ["a", "b"]})[0] == Pair("a", "b", POSSIBLE, "hold in mine")
    assert pairs(claims, {"mine": ["a"]})[0].reason.startswith("constructed: ")


def test_a_witness_keeps_to_the_books():
    """C18, C20 and all that is said of them, by hand: E + H + T, the safety bound, the sums."""
    claims = load_claims("dinocera2014")
    rows = [row for key in ("C13", "C18", "C20", "C22") for row in proving.claimed(claims, key)]
    books = [row for role in claims.roles for row in (*necessary(role), *constructed(role, 443))]
    assert proving._room(rows, books) is None  # as many looks as the other robot, and more
    books = [row for role in claims.roles
             for row in (*necessary(role), *constructed(role, 443 if role == "treatment" else 364))]
    found = proving._room(rows, books)
    assert found is not None
    for role, total in (("treatment", 443), ("control", 364)):
        mean = {name: found[f"{name} of {role}"] for name in (
            "safety_mean", "activations avoid", "activations eat", "activations drink", "active_cycles", "energy_mean",
            "hunger_mean", "thirst_mean")}
        assert mean["activations avoid"] + mean["activations eat"] + mean["activations drink"] == pytest.approx(total)
        assert mean["safety_mean"] <= (12 - 1150 / mean["activations avoid"]) / 11 + 1e-6
        start = Reading().energy_start + 2 * Reading().need_start - 1151 / 2
        together = mean["energy_mean"] + mean["hunger_mean"] + mean["thirst_mean"]
        assert start - 1e-6 <= together <= start + total + 1e-6
    assert all(holds(claims, key, found) for key in ("C13", "C18", "C20", "C22"))
    assert not holds(claims, "C18", {**found, "safety_mean of treatment": found["safety_mean of control"]})


def test_quantities_have_one_name():
    claims = load_claims("dinocera2014").claims
    assert quantity(claims["C20"].parts[2]) == "activations avoid minus eat"
    assert quantity(claims["C6"].parts[2]) == "reward eat+drink survived"
    assert quantity(claims["C16"].parts[0]) == "hunger_max train"


def test_the_certificate_in_words(tmp_path):
    found = [Pair("a", "b", IMPOSSIBLE, "why"), Pair("a", "c", POSSIBLE, "hold in x"),
             Pair("b", "c", POSSIBLE, "constructed: 1"), Pair(ALL, "", IMPOSSIBLE, "why")]
    assert words(as_rows(found)).startswith("Of 3 pairs of claims, 1 cannot hold together (a and b), 2 can (1 do in a "
                                            "study, 1 in numbers")
    assert "all claims at once are impossible" in words(as_rows(found))
    assert list(csv.DictReader(as_csv(found).splitlines())) == as_rows(found)
    assert matrix(found, ["a", "b", "c"]).splitlines()[:3] == ["a ", "b x", "c s o"]
    (tmp_path / "verdicts.csv").write_text("settings,claim,verdict\n,C1,direction only\n,C2,contradicted\n")
    assert holding(tmp_path / "verdicts.csv") == {tmp_path.name: ["C1"]}


@pytest.mark.parametrize(("typed", "said"), [
    (["--out", "x.csv"], "--out: is for claims"), (["--claims", "nobody"], "no claims file is called 'nobody'"),
    (["--claims", "--seen", "nowhere.csv"], "--seen: nowhere.csv cannot be read")])
def test_bad_input_is_one_line(here, tmp_path, typed, said):
    done = here(*typed, module="attnlab.audit")
    assert done.returncode == 2 and said in done.stderr and done.stderr.count("\n") == 1
    assert not list(tmp_path.iterdir())

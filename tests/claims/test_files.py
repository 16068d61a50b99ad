"""Claims files are checked: one clear line for every mistake."""

import copy
import hashlib

import pytest
import yaml

from attnlab.claims import claims_path
from attnlab.claims.files import load_claims
from attnlab.claims.parts import Part
from attnlab.errors import ConfigError

GOOD = {
    "title": "t", "source": "s",
    "roles": {"treatment": {"label": "A", "where": {"curiosity": "litman"}},
              "control": {"label": "B", "where": {"curiosity": "none"}}},
    "claims": {"X1": {"title": "t", "where": "w", "says": "s", "parts": [
        {"measure": {"name": "survival", "phase": "train"}, "test": "paired", "direction": "higher", "unit": "%"}]}}}


def write(tmp_path, content) -> str:
    path = tmp_path / "mine.yaml"
    path.write_text(content if isinstance(content, str) else yaml.safe_dump(content))
    return str(path)


@pytest.mark.parametrize(("name", "ids"), [("temporl", ["T1", "T2"]), ("amrl", ["A1", "A2"]), ("timing", ["M1"]),
                                           ("tacos", ["S1", "S2"])])
def test_claims_of_other_ways_to_decide_when_to_look(name, ids):
    claims = load_claims(name)
    assert list(claims.claims) == ids and claims.rules.least_seeds == 6
    assert set(claims.roles["treatment"].where) == set(claims.roles["control"].where) == {"learner"}


def test_shipped_claims_are_c1_to_c27():
    claims = load_claims("dinocera2014")
    assert list(claims.claims) == [f"C{i}" for i in range(1, 28)]
    assert claims.labels == {"litman": "CR", "none": "NCR"}
    assert claims.path == claims_path("dinocera2014")


def test_good_file(tmp_path):
    claims = load_claims(write(tmp_path, GOOD))
    assert claims.rules.least_seeds == 6 and claims.measures["X1"][0].unit == "%"


PART = ("claims", "X1", "parts", 0)


@pytest.mark.parametrize(("where", "value", "words"), [
    ((*PART, "measure", "name"), "surviving", "Did you mean 'survival'"),
    ((*PART, "measure", "phase"), "training", "phase.*not one of its values"),
    ((*PART, "measure", "fase"), "train", "no such setting"),
    ((*PART, "measure"), None, "measure: is missing"),
    ((*PART, "unit"), "UoE", r"unit: is 'UoE', but the measure 'survival' is in '%'"),
    ((*PART, "unit"), None, "unit: is missing"),
    ((*PART, "direction"), "up", "not one of its values"),
    ((*PART, "direction"), "about", "direction: is missing"),
    ((*PART, "tolerance"), 3, "number: is missing"),
    ((*PART, "deviations"), [3], "number: is missing"),
    ((*PART, "against"), "treatment", "compares 'treatment' with itself"),
    ((*PART, "forms"), {"by another name": 3}, "expected settings of the measure"),
    ((*PART, "forms"), {"early": {"fase": "train"}}, r"forms.early.measure.fase: no such setting"),
    ((*PART, "measure"), {"name": "episode", "column": "survivl"}, "no number column.*Did you mean 'survival'"),
    ((*PART, "test"), "not_lower", "margin: is missing"),
    ((*PART, "test"), "permutation", "no permutation test"),
    ((*PART, "test"), "t-test", "not one of its values"),
    ((*PART, "counts"), False, "no comparison that counts"),
    ((*PART, "reference"), "many", "expected a number"),
    (("claims", "X1", "says"), "", "says: is missing"),
    (("claims", "X1", "parts"), [], "no comparison that counts"),
    (("claims",), {}, "there are none"),
    (("roles", "treatment", "where"), {}, "where: is missing"),
    (("roles", "treatment", "where"), {"curiosity": "litmann"}, "no curiosity is called 'litmann'.*'litman'"),
    (("roles", "treatment", "where"), {"curiosty": "litman"}, "Did you mean 'curiosity'"),
    (("roles", "bystander"), {"where": {"curiosity": "count"}}, "bystander: is played by nobody"),
    (("roles",), {}, "names none"),
    (("about",), {"wrld": "paper"}, r"about.wrld.*Did you mean 'world'"),
    (("rules",), {"least_seeds": 1}, "at least 3"),
    (("rules",), {"seeds": 1}, "no such setting"),
])
def test_mistakes(tmp_path, where, value, words):
    content = copy.deepcopy(GOOD)
    node = content
    for key in where[:-1]:
        node = node[key]
    node[where[-1]] = value
    with pytest.raises(ConfigError, match=words) as caught:
        load_claims(write(tmp_path, content))
    assert "\n" not in str(caught.value) and "mine.yaml" in str(caught.value)


LEVEL = {"measure": {"name": "survival"}, "test": "level", "unit": "%"}


@pytest.mark.parametrize(("part", "words"), [
    ({**LEVEL, "direction": "higher", "reference": 0}, "reference: cannot fail: 'survival' is between 0 and 100"),
    ({**LEVEL, "direction": "at_most", "reference": 100}, "cannot fail"),
    ({**LEVEL, "direction": "higher", "reference": 100}, "cannot hold"),
    ({**LEVEL, "direction": "at_least", "reference": 101}, "cannot hold"),
    ({**LEVEL, "direction": "lower", "reference": 0}, "cannot hold"),
    ({**LEVEL, "number": 50, "tolerance": 50}, "tolerance: cannot fail"),
    ({**LEVEL, "direction": "higher", "reference": 50, "number": 120, "tolerance": 10}, "number: cannot hold"),
    ({**LEVEL, "number": 50, "tolerance": -1}, "tolerance: is -1.0, must be at least 0"),
    ({**LEVEL, "number": 50}, "direction: is missing.*with its tolerance"),
    ({"measure": "survival", "test": "not_lower", "margin": 100, "unit": "%"}, "margin: cannot fail"),
    ({"measure": "survival_convergence", "test": "level", "direction": "lower", "reference": 500, "unit": "episodes"},
     "'survival_convergence' is never for some seeds, which has no mean. Use order or median"),
    ({"measure": "survival_convergence", "test": "median", "direction": "at_least", "reference": 0, "unit": "episodes"},
     "cannot fail"),
    ({"measure": "overlap", "test": "order", "direction": "lower", "reference": -100, "unit": "%"}, "cannot hold"),
])
def test_a_rule_must_be_able_to_fail_and_to_hold(tmp_path, part, words):
    content = copy.deepcopy(GOOD)
    content["claims"]["X1"]["parts"].append(part)
    with pytest.raises(ConfigError, match=words) as caught:
        load_claims(write(tmp_path, content))
    assert "X1.parts[1]" in str(caught.value) and "\n" not in str(caught.value)


def test_a_tolerance_is_half_of_the_effect_with_its_standard_error():
    """100 +- 9 against 66 +- 2 over 100 episodes: half of 34, and sqrt(85) / 10."""
    part = Part(measure="reward", unit="UoR", direction="higher", number=34, deviations=[9, 2])
    assert part.known == pytest.approx((17 ** 2 + 85 / 100) ** 0.5)
    assert Part(measure="reward", unit="UoR", direction="higher", number=34).known is None
    assert Part(measure="reward", unit="UoR", number=34, tolerance=0).known == 0


def test_the_old_rules_are_kept_under_their_hash():
    kept = sorted((claims_path("dinocera2014").parent / "kept").glob("*.yaml"))
    assert kept
    for file in kept:
        assert file.stem.rpartition("-")[2] == hashlib.sha256(file.read_bytes()).hexdigest()[:12]


def test_a_role_nobody_named(tmp_path):
    content = copy.deepcopy(GOOD)
    del content["roles"]["control"]
    with pytest.raises(ConfigError, match="compares the role 'control'"):
        load_claims(write(tmp_path, content))


@pytest.mark.parametrize("text", ["a: [", "- 1", "7", "\x00"])
def test_no_yaml(tmp_path, text):
    with pytest.raises(ConfigError):
        load_claims(write(tmp_path, text))


def test_command_says_it_in_one_line(tmp_path, capsys):
    from attnlab.console import guarded
    from attnlab.report.__main__ import main
    (tmp_path / "study" / "run").mkdir(parents=True)
    (tmp_path / "study" / "run" / "run.json").write_text('{"status": "failed"}')
    assert guarded(main, [str(tmp_path / "study"), "--claims", "dinocera"]) == 2
    assert guarded(main, [str(tmp_path / "no_study")]) == 2
    lines = capsys.readouterr().err.strip().splitlines()
    assert len(lines) == 2 and "dinocera2014" in lines[0] and "no such study" in lines[1]

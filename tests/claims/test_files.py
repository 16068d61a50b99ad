"""Claims files are checked: one clear line for every mistake."""

import copy

import pytest
import yaml

from attnlab.claims import claims_path
from attnlab.claims.files import load_claims
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


def test_shipped_claims_are_c1_to_c27():
    claims = load_claims("dinocera2014")
    assert list(claims.claims) == [f"C{i}" for i in range(1, 28)]
    assert claims.labels == {"litman": "CR", "none": "NCR"}
    assert claims.path == claims_path("dinocera2014")


def test_good_file(tmp_path):
    claims = load_claims(write(tmp_path, GOOD))
    assert claims.rules.least_seeds == 3 and claims.measures["X1"][0].unit == "%"


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
    ((*PART, "number"), 3, "tolerance: is missing"),
    ((*PART, "tolerance"), 3, "number: is missing"),
    ((*PART, "test"), "not_lower", "margin: is missing"),
    ((*PART, "test"), "permutation", "no permutation test"),
    ((*PART, "test"), "t-test", "not one of its values"),
    ((*PART, "counts"), False, "no comparison that counts"),
    ((*PART, "reference"), "many", "expected a number"),
    (("claims", "X1", "says"), "", "says: is missing"),
    (("claims", "X1", "parts"), [], "no comparison that counts"),
    (("claims",), {}, "there are none"),
    (("roles", "treatment", "where"), {}, "where: is missing"),
    (("roles", "treatmant"), {"where": {"a": 1}}, "Did you mean 'treatment'"),
    (("rules",), {"least_seeds": 1}, "at least 2"),
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

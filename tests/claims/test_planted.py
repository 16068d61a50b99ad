"""Every rule is shown studies with a known truth, and must say what is so: it can fail, and it can hold."""

import pytest
from planted_tables import write

from attnlab.claims.files import load_claims
from attnlab.claims.findings import Finding
from attnlab.claims.judge import judge
from attnlab.results import load
from attnlab.results.conditions import Conditions

EVERY = {f"C{i}" for i in range(1, 28)}
NO_NUMBER = {"C1", "C3", "C4", "C16", "C17", "C24", "C25", "C27"}  # the paper gives a direction and no precision


@pytest.fixture
def found(tmp_path):
    def of(kind: str):
        study = write(tmp_path / kind, kind)
        return {v.id: v for v in judge(load_claims("dinocera2014"), Conditions(load(study)))}
    return of


def those(verdicts, *findings):
    return {key for key, v in verdicts.items() if v.verdict in findings}


def test_what_the_paper_says_is_reproduced(found):
    verdicts = found("paper")
    assert those(verdicts, Finding.REPRODUCED) == EVERY - NO_NUMBER
    assert those(verdicts, Finding.DIRECTION) == NO_NUMBER


def test_the_reverse_is_contradicted(found):
    """CR and NCR have changed places. C4 speaks of both alike. What is said of one robot alone is not so of the
    other."""
    verdicts = found("swapped")
    assert those(verdicts, Finding.REPRODUCED, Finding.COMPATIBLE, Finding.DIRECTION) == {"C4"}
    compared = {f"C{i}" for i in (1, 3, 6, 7, 8, 13, 14, 15, 16, 17, 18, 19, 20, 22, 23, 24, 25, 26)}
    assert those(verdicts, Finding.CONTRADICTED) >= compared


@pytest.mark.parametrize(("kind", "true"), [
    # nobody is curious: what the two have in common, or NCR alone does, is so
    ("same_states", {"C4", "C9", "C26"}),
    ("none", {"C26"}),       # not less safe, and covers no less: true where nothing differs
    ("constant", {"C26"}),
])
def test_where_nothing_is_nothing_is_found(found, kind, true):
    verdicts = found(kind)
    assert those(verdicts, Finding.REPRODUCED, Finding.COMPATIBLE, Finding.DIRECTION) == true
    assert not those(verdicts, Finding.UNTESTABLE)

"""The check that a part compiles, and gives the same: what it says of one that does not."""

import pytest

from attnlab.testing import compiles
from attnlab.testing.compiled import first_difference

TABLES = {"episodes": {"death": [None, "crash"], "energy": [1.0, 2.0]}, "cycles": {"v": [0.1, 0.1 + 0.2]}}


def test_the_first_field_that_differs_is_named():
    other = {**TABLES, "cycles": {"v": [0.1, 0.3]}}
    assert first_difference(TABLES, TABLES) == ""
    assert first_difference(TABLES, other) == "cycles.v, row 1: 0.30000000000000004 interpreted, 0.3 compiled"
    fewer, more = {"cycles": {"v": [0.1]}}, {"cycles": {"v": [0.1, 0.3]}}
    assert first_difference(more, fewer) == "cycles.v, row 1: 0.3 interpreted, nothing compiled"
    assert first_difference(fewer, more) == "cycles.v: 1 rows interpreted, 2 compiled"


@pytest.fixture
def compiled_anyhow(monkeypatch):
    """Nothing is compiled; the compiled engine gives what is asked for."""
    def gives(tables):
        monkeypatch.setattr("attnlab.robot.engines.build", lambda plan: True)
        monkeypatch.setattr("attnlab.robot.episodes.play_run",
                            lambda plan, engine: (TABLES if engine == "python" else tables, 0))
    return gives


def test_a_part_that_compiles_to_something_else_fails(compiled_anyhow):
    compiled_anyhow(TABLES)
    compiles("learner", "q_learning")()
    compiled_anyhow({**TABLES, "episodes": {"death": [None, None], "energy": [1.0, 2.0]}})
    with pytest.raises(AssertionError, match="q_learning compiles to something else: episodes.death, row 1: 'crash'"):
        compiles("learner", "q_learning")()


def test_a_part_that_says_why_it_is_interpreted_is_told_so():
    with pytest.raises(AssertionError, match="scripted runs as Python alone: its hand is looked up in a table"):
        compiles("simulator", "scripted")()


def test_a_part_that_does_not_compile_fails_with_the_line(monkeypatch):
    from attnlab.compiled.engine import Uncompilable

    def refuse(plan):
        raise Uncompilable("mine.py:7: no")
    monkeypatch.setattr("attnlab.robot.engines.build", refuse)
    with pytest.raises(AssertionError, match="q_learning does not compile: mine.py:7: no"):
        compiles("learner", "q_learning")()


test_a_part_for_certain = pytest.mark.long(compiles("exploration", "ucb1"))

"""The table at the end of a study, on terminals of any width."""

import pytest

from attnlab.results.load import Study
from attnlab.results.summary import parts_of, print_summary
from attnlab.robot.folder import run_to_folder
from attnlab.testing import config

LONG = "curiosity=litman, learner.alpha=0.25, world=cluttered, reading=table4"


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    path = tmp_path_factory.mktemp("study")
    for curiosity in ("litman", "none"):
        chosen = config(curiosity=curiosity, max_cycles=30)
        about = {"run": curiosity, "key": curiosity, "overrides": [], "swept": {}}
        assert run_to_folder(chosen, path / curiosity, about)
    return Study(path)


@pytest.mark.parametrize("width", [110, 80, 60, 50])
def test_every_number_and_condition_is_there(study, width, capsys):
    print_summary(study, {"litman": LONG, "none": "NCR"}, {}, {}, width)
    out = capsys.readouterr().out
    table = out.partition("results ")[0].splitlines()
    assert max(map(len, table)) <= width
    words = "".join("".join(line.split()) for line in table)
    for head in ("survival", "early", "late", "valid.", "crashed", "hunger", "thirst", "energy", "safety",
                 "activations", "avoideatdrink", "NCR"):
        assert head in words, head
    assert "…" not in out
    left = "".join(line[:width // 2].strip() + " " for line in table)
    for word in LONG.split(", "):
        assert word in left, word  # the condition goes on in the next line and is never cut


def test_many_conditions_are_counted(study, capsys):
    named = {f"r{i}": f"condition {i % 50}" for i in range(1000)}
    print_summary(study, named, {"report": study.path / "index.html"}, {"found": "3 robust, of 4 comparisons"})
    out = capsys.readouterr().out.splitlines()
    assert out[0].endswith(": 1,000 runs of 50 conditions, whose means over seeds are in conditions.csv of the report")
    assert [line.split()[0] for line in out[1:]] == ["results", "report", "found"]


def test_columns_go_where_there_is_room():
    columns = [["condition", "CR"], ["one", "1"], ["two", "2"], ["three", "3"]]
    assert parts_of(columns, 80) == [columns]
    assert parts_of(columns, 23) == [columns[:3], [columns[0], columns[3]]]
    assert parts_of(columns, 5) == [[columns[0], column] for column in columns[1:]]


def test_where_there_is_no_terminal(study, monkeypatch, capsys):
    """80 columns, or what COLUMNS says."""
    for given, width in ((None, 80), ("60", 60)):
        monkeypatch.delenv("COLUMNS", raising=False)
        if given:
            monkeypatch.setenv("COLUMNS", given)
        print_summary(study, {"litman": LONG, "none": "NCR"}, {}, {})
        longest = max(map(len, capsys.readouterr().out.partition("results ")[0].splitlines()))
        assert width - 20 < longest <= width

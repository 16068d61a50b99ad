"""Two studies side by side: known differences, paired or not, settings named, verdicts; bad input is one line."""

import csv

import pytest

from attnlab.errors import ConfigError
from attnlab.report import compare
from attnlab.report.__main__ import main
from attnlab.report.against import face
from attnlab.results.load import Study
from attnlab.stats import mean_interval
from attnlab.stats.intervals import difference_interval
from tests.report.small_study import write_study

SMALL = {"train": 6, "cycles": 20}


@pytest.fixture(scope="module")
def pair(tmp_path_factory):
    """The same seeds in another world (and CR safer by 0.3), and fewer seeds of other length in a third study."""
    home = tmp_path_factory.mktemp("pair")
    one = write_study(home / "one", 6, safety=0.3, **SMALL)
    other = write_study(home / "other", 6, simulator={"name": "pybullet"}, **SMALL)
    third = write_study(home / "third", 4, train=8, cycles=30)
    return Study(one), Study(other), Study(third)


def of(facing, condition, measure):
    return next(of for of in facing.compared if (of.condition, of.measure) == (condition, measure))


def test_one_setting_and_shared_seeds_are_paired(pair):
    facing = face(*pair[:2])
    assert facing.everywhere == {"simulator.name": ("planar", "pybullet")}
    curious = next(name for name in facing.differs if "litman" in name or name == "CR")
    safer = of(facing, curious, "safety")
    assert safer.paired and safer.seeds == tuple(range(6)) and safer.clear
    assert safer.difference == mean_interval([safer.one[seed] - safer.other[seed] for seed in range(6)])
    assert safer.difference.value == pytest.approx(0.3, abs=1e-6)  # the same draws, shifted
    plain = next(name for name in facing.differs if name != curious)
    assert not of(facing, plain, "safety").clear


def test_more_settings_are_independent_samples(pair):
    facing = face(pair[0], pair[2])
    assert set(facing.everywhere) == {"train_episodes", "max_cycles"}
    for one in facing.compared:
        assert not one.paired
        assert one.difference == difference_interval(list(one.one.values()), list(one.other.values()))
    assert all(len(one.other) == 4 for one in facing.compared)


def test_the_page_and_its_numbers(pair, tmp_path, capsys):
    assert main([str(pair[0].path), "--against", str(pair[1].path), "--out", str(tmp_path)]) == 0
    page = (tmp_path / "against-other.html").read_text()
    assert capsys.readouterr().out.strip() == str(tmp_path / "against-other.html")
    assert "simulator.name" in page and "paired, 6<" in page and "Verdicts side by side" in page
    rows = list(csv.DictReader((tmp_path / "against-other.csv").read_text().splitlines()))
    assert len(rows) == len(face(*pair[:2]).compared)
    assert {row["paired"] for row in rows} == {"yes"}
    assert page.count("<script>") == 1 and "27 verdicts on" in page


def test_bad_input_is_one_line(pair, tmp_path):
    with pytest.raises(ConfigError, match="is the study itself"):
        compare(pair[0].path, pair[0].path)
    odd = write_study(tmp_path / "odd", 2, ("brave",), **SMALL)
    with pytest.raises(ConfigError, match="no condition in common"):
        compare(pair[0].path, odd, tmp_path / "out")
    with pytest.raises(ConfigError, match="there is no such study"):
        compare(pair[0].path, tmp_path / "nothing")
    with pytest.raises(ConfigError, match="belongs to a report"):
        main([str(pair[0].path), "--against", str(pair[1].path), "--baselines", str(odd)])
    assert not (tmp_path / "out").exists()

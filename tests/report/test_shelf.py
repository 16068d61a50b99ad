"""The index of a folder of studies: a card each, whatever is in the folder; bad input is one line."""

import re
import shutil

import pytest

from attnlab.errors import ConfigError
from attnlab.index import main
from attnlab.report.forest import rows_of as from_tables
from attnlab.report.shelf import build, rows_of
from attnlab.results.load import Study
from tests.report.small_study import write_study


@pytest.fixture
def outputs(study, tmp_path):
    home = tmp_path / "outputs"
    shutil.copytree(study, home / "small")
    (home / "small" / "none-seed1" / "replay.html").write_text("x")
    (home / "small" / "report").mkdir()
    (home / "small" / "report" / "index.html").write_text("x")
    hostile = write_study(home / "<b>odd", 1, ("none",), train=4, cycles=10, labels={"none": "<script>1</script>"})
    (hostile / "none-seed0" / "episodes.parquet").write_bytes(b"no table")
    (home / "notes").mkdir()
    return home


def test_a_card_for_every_study(outputs, capsys):
    assert main([str(outputs)]) == 0
    page = (outputs / "index.html").read_text()
    assert capsys.readouterr().out.strip() == str(outputs / "index.html")
    assert re.findall(r'<section class=card><h2 id="(.*?)"', page) == ["&lt;b&gt;odd", "small"]
    assert "2 conditions: " in page and "Runs: 12 complete" in page
    assert page.count("<script>") == 1 and "<b>odd" not in page
    links = [link for link in re.findall(r'href="([^"#]*)"', page) if not link.startswith("data:")]
    assert links == ["small/report/index.html", "small/none-seed1/replay.html"]
    assert all((outputs / link).is_file() for link in links)
    assert "no run is complete" in page  # the damaged one


def test_its_first_sentence_is_that_of_the_report(study):
    found = Study(study)
    short, long = rows_of(found), from_tables(found)
    assert [row.name for row in short] == [row.name for row in long]
    for one, other in zip(short, long, strict=True):
        assert one.value == pytest.approx(other.value)


def test_bad_input_is_one_line(tmp_path, study):
    empty = tmp_path / "empty"
    empty.mkdir()
    for path, words in ((tmp_path / "none", "there is no such folder"), (empty, "there is no study in it"),
                        (study, "is a study, not a folder of them")):
        with pytest.raises(ConfigError, match=words):
            build(path, None)
    with pytest.raises(ConfigError, match="is a folder"):
        build(study.parent, tmp_path)
    assert not list(empty.iterdir())

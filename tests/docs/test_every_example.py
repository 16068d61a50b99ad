"""Whatever a page shows as code works: Python runs, a yaml file is read, by the tests named here or in this file."""

import importlib
import re
import tomllib

import pytest

import attnlab
from attnlab import registry
from attnlab.claims.files import load_claims
from attnlab.robot.folder import run_to_folder
from attnlab.testing import config
from tests.docs.test_every_command import is_there
from tests.docs.typed import BLOCK, PAGES, ROOT, blocks

RUN_BY = {  # (page, kind) -> tests that run every block of this kind there
    ("README.md", "python"): ["tests/docs/test_every_example.py::test_the_readme"],
    ("docs/authors.md", "python"): ["tests/docs/test_authors.py::test_new_parts_work_as_they_are_written"],
    ("docs/authors.md", "toml"): ["tests/docs/test_every_example.py::test_the_entry_point"],
    ("docs/claims.md", "python"): ["tests/docs/test_every_example.py::test_a_measure_and_claims"],
    ("docs/claims.md", "yaml"): ["tests/docs/test_every_example.py::test_a_measure_and_claims",
                                 "tests/system/test_pilots.py::test_what_is_declared_is_what_the_docs_say"],
    ("docs/clock.md", "python"): ["tests/docs/test_every_example.py::test_the_clock"],
    ("docs/engine.md", "python"): ["tests/system/test_batch.py::test_the_example_of_the_page_runs"],
    ("docs/gym.md", "python"): ["tests/gym/test_gym.py::test_the_page_of_the_docs_runs",
                                "tests/gym/test_gym.py::test_so_do_its_vectors",
                                "tests/gym/test_gym.py::test_stable_baselines3_learns_as_the_page_says"],
    ("docs/index.md", "python"): ["tests/docs/test_every_example.py::test_the_first_page"],
    ("docs/logs.md", "python"): ["tests/docs/test_every_example.py::test_a_log"],
    ("docs/worlds.md", "yaml"): ["tests/docs/test_reference.py::test_the_world_of_the_page_stands"],
}
SKETCHES = {  # what needs what nobody can install here: it is compiled, and the page says that it is a sketch or whose
    ("docs/clock.md", "import rclpy"), ("docs/clusters.md", "from dask_jobqueue import")}
SHORT = {"train_episodes": 2, "validation_episodes": 1, "max_cycles": 120, "simulator": "planar"}

KINDS = ("python", "yaml", "toml")
SHOWN = ("console", "sh", "text")  # commands, which have a test of their own, and a drawing


def of(page, kind, within=""):
    """The one block of a kind in a page that has these words."""
    [found] = [text for where, _, text in blocks(kind) if where == page and within in text]
    return found


def shorter(text):
    """A program whose runs are short."""
    few = ", ".join(f'"{name}={value}"' for name, value in SHORT.items())
    return re.sub(r'("seed=[^"]*")', rf'\1, {few}, "picture=false", "report=false", "cluster=serial"', text)


@pytest.fixture
def reader(tmp_path, monkeypatch):
    """An empty folder in which a run of first_look is."""
    monkeypatch.chdir(tmp_path)
    assert run_to_folder(config(**SHORT), tmp_path / "outputs" / "first_look" / "RUN", {
        "run": "RUN", "key": "k", "overrides": [], "swept": {}, "condition": "litman"})
    return tmp_path


def run(text, page):
    space = {}
    exec(compile(text, page, "exec"), space)
    return space


def test_every_block_is_run():
    for kind, page, text in [(k, page, text) for k in KINDS for page, _, text in blocks(k)]:
        if any(where == page and words in text for where, words in SKETCHES):
            compile(text, page, "exec")
            assert re.search("sketch|dask-jobqueue", (ROOT / page).read_text())
            continue
        assert (page, kind) in RUN_BY, f"no test runs the {kind} of {page}"
    tests = [test for some in RUN_BY.values() for test in some]
    assert all(map(is_there, tests)), [test for test in tests if not is_there(test)]
    assert {kind for page in PAGES for kind, _ in BLOCK.findall(page.read_text())} == {*KINDS, *SHOWN}


def test_files_and_tests_that_pages_name_are_there():
    for page in PAGES:
        spans = re.findall(r"`([^`\n]+)`", page.read_text())
        named = {found for span in spans for found in re.findall(
            r"\b(?:attnlab|tests|conf|docs|benchmarks)/[\w/-]+\.(?:py|yaml|md|json|css|js)(?:::\w+)?", span)}
        for name in (name for name in named if "NAME" not in name):
            assert (ROOT / name.partition("::")[0]).is_file(), f"{page.name}: {name}"
            assert "::" not in name or is_there(name), f"{page.name}: {name}"


def test_the_readme(reader):
    made = run(shorter(of("README.md", "python")), "README.md")
    assert len(made["study"].episodes) == 3 and made["config"]["seed"] == 3
    assert len(attnlab.load("outputs/main").runs) == 10


def test_the_first_page(reader, capsys):
    run(of("docs/index.md", "python"), "docs/index.md")
    assert "validation" in capsys.readouterr().out


def test_the_clock(reader, monkeypatch):
    run(of("docs/clock.md", "python", "from_run"), "docs/clock.md")
    monkeypatch.syspath_prepend(ROOT / "attnlab")  # where clock.py is copied from
    robots = of("docs/clock.md", "python", "nearest_m")
    assert run(f"nearest_m = 0.7\n{robots}", "docs/clock.md")["cycles"] in (1, 4, 8, 12)


def test_a_log(reader, capsys):
    (reader / "log.csv").write_text("t_s,r-90,r0,r90\n" + "".join(f"{i / 5},1.0,{2 - i / 10},3.0\n" for i in range(9)))
    run(of("docs/logs.md", "python").replace("freiburg-079.carmen.log.gz", "log.csv"), "docs/logs.md")
    assert capsys.readouterr().out.startswith("0.0 1.0\n")


def test_a_measure_and_claims(reader, monkeypatch):
    monkeypatch.setattr(registry, "parts", dict(registry.parts))
    (reader / "meals_of_the_page.py").write_text(of("docs/claims.md", "python"))
    monkeypatch.syspath_prepend(reader)
    importlib.import_module("meals_of_the_page")
    assert ("measure", "meals") in {(spec.group, spec.name) for spec in registry.parts.values()}
    (reader / "mine.yaml").write_text(of("docs/claims.md", "yaml", "Fixed clocks"))
    claims = load_claims("mine.yaml")
    assert [*claims.claims] == ["slow_crashes"] and len(claims.claims["slow_crashes"].parts) == 3


def test_the_entry_point():
    shipped = (ROOT / "tests" / "thirdparty_plugin" / "pyproject.toml").read_text()
    told = tomllib.loads(of("docs/authors.md", "toml"))["project"]["entry-points"]
    assert tomllib.loads(shipped)["project"]["entry-points"] == told

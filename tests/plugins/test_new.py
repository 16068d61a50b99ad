"""``attnlab.new`` in every group: what it writes works, passes its own tests, and is never written over."""

from __future__ import annotations

import tomllib
from pathlib import Path

from attnlab.cli.listing import find
from attnlab.groups import GROUPS
from attnlab.new import groups

ROOT = Path(__file__).resolve().parents[2]


def test_every_group_starts_with_a_part_that_passes_its_tests(attnlab, here, tmp_path):
    assert set(GROUPS) - set(groups()) <= {"cluster"}  # the one group whose parts are written by few
    for group in groups():
        done = here(group, f"my_{group}", module="attnlab.new")
        assert done.returncode == 0, done.stderr
        assert (tmp_path / "plugins" / f"my_{group}.py").is_file()
    tested = attnlab("-q", "-p", "no:cacheprovider", "tests", module="pytest")
    assert tested.returncode == 0, tested.stdout
    again = here("fusion", "my_fusion", module="attnlab.new")
    assert again.returncode == 2 and "exists already" in again.stderr


def test_an_experiment_claims_and_a_world_of_ones_own(here, tmp_path):
    """What is written runs as it is, together: the experiment in the world, judged by the claims."""
    for kind, name in (("experiment", "mine"), ("claims", "hopes"), ("yaml_world", "room")):
        done = here(kind, name, module="attnlab.new")
        assert done.returncode == 0, done.stderr
    done = here("+experiment=mine", "seed=0-5", "world=room", "claims_file=hopes", "train_episodes=2",
                   "picture=false", "validation_episodes=1", "max_cycles=60", "simulator=planar")
    assert done.returncode == 0 and "NCR" in done.stdout, done.stderr
    verdicts = next((tmp_path / "outputs" / "mine").rglob("verdicts.csv")).read_text()
    assert "hopes_1" in verdicts and "untestable" not in verdicts
    again = here("claims", "hopes", module="attnlab.new")
    assert again.returncode == 2 and "exists already" in again.stderr and again.stderr.count("\n") == 1
    unknown = here("experimint", "x", module="attnlab.new")
    assert unknown.returncode == 2 and "Did you mean 'experiment'" in unknown.stderr


def test_a_package_of_ones_own(attnlab, tmp_path):
    """Imported, it registers its part; its tests pass; its metadata names the entry point."""
    assert attnlab("package", "siesta", module="attnlab.new").returncode == 0
    tested = attnlab("-q", "-p", "no:cacheprovider", "siesta/tests", module="pytest",
                     env={"PYTHONPATH": f"{tmp_path / 'siesta' / 'src'}:{ROOT}", "PYTEST_PLUGINS": "siesta"})
    assert tested.returncode == 0, tested.stdout
    project = tomllib.loads((tmp_path / "siesta" / "pyproject.toml").read_text())["project"]
    assert project["entry-points"]["attnlab.plugins"] == {"siesta": "siesta"}


def test_a_part_is_explained_within_the_terminal(monkeypatch):
    monkeypatch.setenv("COLUMNS", "60")
    for part in ("behaviours/avoid", "behaviours/drink", "exploration/softmax", "world/random"):
        text = find(part)
        assert max(len(line) for line in text.splitlines()[1:] if " = " not in line) <= 60, part
        assert ":class:" not in text
    assert "(set with behaviours.drink.<name>=<value>)" in find("behaviours/drink")
    assert "(set with world.<name>=<value>)" in find("world/random")

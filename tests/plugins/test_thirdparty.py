"""A package somebody else wrote: found by its entry point, with its own conf, in worker processes too."""

import json
import os
import shutil
import sys
import sysconfig
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parents[1] / "thirdparty_plugin"
ROOT = PACKAGE.parents[1]
IN_A_POOL = """
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from attnlab.testing import run

def survival(seed):
    return run(seed=seed, curiosity="weekly", behaviours=("avoid", "patrol"))["episodes"]["survival"]

if __name__ == "__main__":
    with ProcessPoolExecutor(2, get_context("spawn")) as pool:
        assert list(pool.map(survival, range(2))) == [survival(0), survival(1)]
    print("same in workers")
"""


def installed_by_hand(site: Path) -> str:
    """The package and what pip would write of its entry point, in a folder for PYTHONPATH."""
    shutil.copytree(PACKAGE / "src", site, dirs_exist_ok=True)
    info = site / "attnlab_example-0.1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: attnlab-example\nVersion: 0.1.0\n")
    (info / "entry_points.txt").write_text("[attnlab.plugins]\nexample = attnlab_example\n")
    return f"{ROOT}:{site}"


def check(python, place, *sweep):
    """The parts are listed, a sweep over them in worker processes is complete, a pool of processes finds them."""
    whole = not sweep
    listed = python("-m", "attnlab.parts")
    rows = {line.split()[0]: line for line in listed.stdout.splitlines() if line.startswith("  ")}
    assert "package" in rows["weekly"] and "package" in rows["patrol"], listed.stdout + listed.stderr
    done = python("-m", "attnlab", "+experiment=island", "-m", *(sweep or ["seed=0-1"]), "simulator=planar",
                  "train_episodes=2", "validation_episodes=1", "max_cycles=60", "picture=false", "report=false")
    assert done.returncode == 0, done.stdout + done.stderr
    runs = place.runs()
    assert set(runs) == ({"weekly", "litman", "none"} if whole else {"weekly"})
    assert len(list(place.path.glob("outputs/island/*/policy.parquet"))) == (6 if whole else 1)
    for run in place.path.glob("outputs/island/*/run.json"):
        assert (run.parent / "longest.txt").read_text() == "60\n"  # its callback
        assert not json.loads(run.read_text()).get("callbacks")
    of = next(place.path.glob("outputs/island/*weekly*/run.json"))
    assert json.loads(of.read_text())["versions"]["attnlab-example"] == "0.1.0"
    study = json.loads((place.path / "outputs" / "island" / "study.json").read_text())
    assert study["code"]["packages"] == {"attnlab-example": "0.1.0"}
    assert "attnlab_example/weekly.py" in study["code"]["plugins"]
    (place.path / "pool.py").write_text(IN_A_POOL)
    pooled = python("pool.py")
    assert "same in workers" in pooled.stdout, pooled.stderr


def test_a_package_is_found_by_its_entry_point(place, tmp_path):
    path = installed_by_hand(tmp_path / "site")
    check(lambda *arguments: place.python(*arguments, PYTHONPATH=path), place, "curiosity=weekly")
    unknown = place.python("-m", "attnlab", "world=iland", PYTHONPATH=path)
    assert unknown.returncode == 2 and "island" in unknown.stderr


@pytest.mark.long
def test_a_package_brings_files_measures_and_figures(place, tmp_path):
    """Claims, tables and open points of its conf are found by name; its column is measured, judged and drawn."""
    def python(*arguments):
        done = place.python(*arguments, PYTHONPATH=path)
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout
    path = installed_by_hand(tmp_path / "site")
    python("-m", "attnlab", "+experiment=island", "curiosity=weekly", "seed=0-2", "simulator=planar",
           "train_episodes=4", "validation_episodes=1", "max_cycles=100", "picture=false", "cluster=serial")
    page = (place.path / "outputs" / "island" / "report" / "index.html").read_text()
    assert "how far to the east" in page and "The weekly robot gets east" in page
    known = "from attnlab.api import load; print(load('outputs/island').episodes['east_m'].min() > 0)"
    assert python("-c", known) == "True\n"
    assert "A table of the island" in python("-m", "attnlab.audit", "island")
    python("-m", "attnlab", "variants={design: multiverse, size: 2, factors: island}", "simulator=planar", "study=two",
           "train_episodes=1", "validation_episodes=1", "max_cycles=60", "picture=false", "report=false",
           "cluster=serial")
    assert len(list(place.path.glob("outputs/two/*/run.json"))) == 2


def test_a_package_that_does_not_load_is_named_with_its_entry_point(place, tmp_path):
    path = installed_by_hand(tmp_path / "site")
    (tmp_path / "site" / "attnlab_example" / "weekly.py").write_text("import nothing_there\n")
    listed = place.python("-m", "attnlab.parts", PYTHONPATH=path)
    line = listed.stdout.partition("failed to load")[2]
    assert "entry point example (attnlab_example): ModuleNotFoundError: No module named 'nothing_there'" in line
    assert "patrol" not in listed.stdout  # nothing of a package that failed halfway


@pytest.mark.long
def test_pip_installs_it_into_a_fresh_environment(place, tmp_path):
    import subprocess
    home = tmp_path / "fresh"
    subprocess.run([sys.executable, "-m", "venv", str(home)], check=True)
    python = home / "bin" / "python"
    site = next(home.glob("lib/python*/site-packages"))
    (site / "shared.pth").write_text(sysconfig.get_paths()["purelib"] + "\n")  # spares it numba and pybullet again
    subprocess.run([str(python), "-m", "pip", "install", "-q", str(ROOT), str(PACKAGE)], check=True, cwd=tmp_path)

    def run(*arguments):
        clean = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}  # the installed one
        return subprocess.run([str(python), *arguments], cwd=place.path, capture_output=True, text=True, timeout=600,
                              env=clean)
    check(run, place)
    assert run("-m", "attnlab.new", "learner", "mine").returncode == 0  # its templates are in the wheel
    where = run("-c", "import attnlab, attnlab_example; print(attnlab.__file__, attnlab_example.__file__)")
    assert where.stdout.count(str(home)) == 2

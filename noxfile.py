#!/usr/bin/env python3
# /// script
# dependencies = ["nox>=2025.5.1"]
# ///
"""Every check of the project, each in an environment of its own: ``nox -l`` lists them, ``nox -s types`` runs one.

In the environment that the README's install command makes, ``pytest``, ``mypy`` and ``ruff check`` do the same at once.
``PIP_CONSTRAINT=constraints.txt nox`` takes the tested versions instead of the newest.
"""

from __future__ import annotations

import shutil
import tarfile
from pathlib import Path

import nox

nox.needs_version = ">=2025.5.1"
nox.options.default_venv_backend = "uv|virtualenv"

PYTHONS = ["3.11", "3.12", "3.13"]


@nox.session(python=PYTHONS)
def tests(session: nox.Session) -> None:
    """The default tests, minutes: nox -s tests-3.11 -- tests/equations -x."""
    session.install("-e", ".[all]")
    session.run("python", "-m", "pytest", "-q", "-n", "2", *session.posargs)


@nox.session(default=False)
def long(session: nox.Session) -> None:
    """The long tests: soundness over thousands of episodes."""
    session.install("-e", ".[all]")
    session.run("python", "-m", "pytest", "-q", "-m", "long", *session.posargs)


@nox.session(default=False)
def extras(session: nox.Session) -> None:
    """What is in no other environment, PyTorch among it: learner=sb3, the checkers, the callbacks."""
    session.install("-e", ".[test,sb3,tensorboard,mlflow,wandb]")
    session.run("python", "-m", "pytest", "-q", "-m", "long or not long", "tests/learners/test_sb3.py", "tests/gym",
                "tests/robot/test_dashboards.py", "tests/docs/test_deep_results.py", *session.posargs)
    session.run("python", "-m", "pytest", "-q", "tests/conformance/test_every_part.py", "-k",
                "sb3 or dqn or ppo or tensorboard or mlflow or wandb")


@nox.session
def lint(session: nox.Session) -> None:
    """Code, spelling, pages."""
    session.install("-e", ".[lint]")
    session.run("ruff", "check", ".")
    session.run("codespell")
    session.run("rumdl", "check", ".")


@nox.session
def types(session: nox.Session) -> None:
    """The package and the plugins under mypy, strict."""
    session.install("-e", ".[types,gym,logs]")
    session.run("mypy", *session.posargs)


@nox.session(default=False)
def docs(session: nox.Session) -> None:
    """What the pages say: their commands, also the slow ones, columns, worlds, links."""
    session.install("-e", ".[all]")
    session.run("python", "-m", "pytest", "-q", "-m", "", "tests/docs", *session.posargs)


@nox.session(default=False)
def site(session: nox.Session) -> None:
    """The site into site/; warnings are errors, and so is a notebook that no longer gives what it shows."""
    session.install("-e", ".[docs]")
    session.run("python", "docs/notebooks/make.py", "--check")
    session.run("mkdocs", "build", "--strict", *session.posargs)


@nox.session(default=False)
def build(session: nox.Session) -> None:
    """Archive and wheel: the archive's own tests pass in it, the wheel runs in an empty folder."""
    session.install("build")
    folder = Path(session.create_tmp()).resolve()
    dist = folder / "dist"
    shutil.rmtree(dist, ignore_errors=True)
    session.run("python", "-m", "build", "--outdir", str(dist))
    archive, wheel = next(dist.glob("*.tar.gz")), next(dist.glob("*.whl"))

    session.install(f"attnlab[all] @ {wheel.as_uri()}")
    empty = folder / "empty"
    empty.mkdir(exist_ok=True)
    with session.chdir(empty):
        session.run("python", "-m", "attnlab", "+experiment=smoke", "fresh=true")

    with tarfile.open(archive) as packed:
        packed.extractall(folder, filter="data")
    with session.chdir(folder / archive.name.removesuffix(".tar.gz")):
        session.run("python", "-m", "pytest", "-q", *(session.posargs or ["-n", "2"]))


@nox.session(default=False)
def review(session: nox.Session) -> None:
    """The habits of scientific Python projects, by sp-repo-review."""
    session.install("sp-repo-review[cli]")
    session.run("repo-review", ".")


if __name__ == "__main__":
    nox.main()

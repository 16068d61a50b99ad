"""Whatever a page tells to type can be typed: a command of ours is read by its own parser, a study is composed and all
its runs are planned, the rest names what there is. What a page promises beyond that is run by the test of its subject;
options are looked for there."""

import argparse
import importlib
import importlib.util
import re
import shlex
import sys
import tomllib
from functools import cache, partial
from pathlib import Path
from types import SimpleNamespace

import pytest

from attnlab.cli.store import store_options
from attnlab.errors import ConfigError
from attnlab.launch.compose import Composer
from attnlab.paths import conf_dir
from attnlab.testing import config
from attnlab.testing.log import lines
from tests.docs.typed import ROOT, commands

OTHERS = {"ros2", "pre-commit"}  # programs of others, named in passing
WORDS = {"GROUP": "curiosity", "NAME": "avoid"}  # what stands for a word of the reader's
FLAG = re.compile(r"--[a-z][a-z-]*")


def words(line: str) -> list[str]:
    """Arguments of a command; what a page says beside it is set apart by spaces or a #."""
    return [WORDS.get(word, word) for word in shlex.split(re.split(r" {2,}", line)[0], comments=True)]


COMMANDS = commands()
OURS = [c for c in COMMANDS if re.match(r"python3? -m attnlab(\.\w+)?( |$)", c.line)]
STUDIES = [c for c in OURS if words(c.line)[2] == "attnlab"]
READERS = [c for c in OURS if c not in STUDIES]
SCRIPTS = [c for c in COMMANDS if re.match(r"python3? (?!-)", c.line)]
REST = [c for c in COMMANDS if c not in OURS and c not in SCRIPTS]
ELSEWHERE = {  # what needs more than is here -> the test that types it where that is
    "hydra/sweeper=optuna": "tests/system/test_foreign_sweeper.py::test_it_is_told_the_mean_over_seeds",
    "curiosity=litman,none,fade": "tests/docs/test_authors.py::test_every_command_of_the_page",
    "curiosity.liking=fade": "tests/docs/test_authors.py::test_every_command_of_the_page",
    "behaviours=[avoid,eat,drink,nap]": "tests/docs/test_authors.py::test_every_command_of_the_page"}


class ReadError(Exception):
    """Raised once a command's arguments are understood."""


def is_there(test: str) -> bool:
    """Is there a test of this name?"""
    file, _, name = test.partition("::")
    return f"\ndef {name}(" in (ROOT / file).read_text()


@pytest.fixture
def only_read(monkeypatch):
    """Parsers stop when all is understood."""
    def stopping(parse):
        def read(*arguments, **more):
            raise ReadError(parse(*arguments, **more))
        return read
    for name in ("parse_args", "parse_intermixed_args"):
        monkeypatch.setattr(argparse.ArgumentParser, name, stopping(getattr(argparse.ArgumentParser, name)))


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """A folder in which outputs/STUDY/RUN is a run, and FILE a log."""
    from attnlab.robot.folder import run_to_folder
    folder = tmp_path_factory.mktemp("reader")
    (folder / "FILE").write_text("\n".join(lines()) + "\n")
    assert run_to_folder(config(train_episodes=1, validation_episodes=1, max_cycles=60, simulator="planar"),
                         folder / "outputs" / "STUDY" / "RUN", {"run": "RUN", "key": "k", "overrides": [], "swept": {}})
    return folder


def test_the_pages_are_searched():
    assert len(COMMANDS) > 110 and len(STUDIES) > 30 and len(READERS) > 50 and len(SCRIPTS) > 7


@pytest.fixture
def planned(study, monkeypatch):
    """Arguments -> a run they ask for, made up to its start: that of the last value of whatever is swept, and of the
    seeds; names and settings are looked up for all. Composed as by Hydra's main, but what commands share is kept."""
    from hydra import compose, initialize_config_dir
    from hydra.core.global_hydra import GlobalHydra

    from attnlab.cli.argv import normalise
    from attnlab.launch import expand, sweeper
    monkeypatch.chdir(study)
    store_options()
    sweeper.register_with_hydra()
    with initialize_config_dir(str(conf_dir()), version_base="1.3"):
        loader = GlobalHydra.instance().config_loader()
        master = cache(lambda *chosen: compose("config", [*chosen], return_hydra_config=True))
        composers, whole, every = {}, expand.choices, sweeper.read_variants
        monkeypatch.setattr(sweeper, "Composer", lambda loader, of: composers.setdefault(id(of), Composer(loader, of)))
        monkeypatch.setattr(expand, "choices", lambda o: whole(o)[-1:])
        monkeypatch.setattr(sweeper, "read_variants", lambda node: dict(list(every(node).items())[-1:]))
        monkeypatch.setattr(sweeper, "sound", lambda design, *_: [*design.levels][:1])  # no pilots
        options = cache(partial(loader.get_group_options, overrides=[]))
        monkeypatch.setattr(loader, "get_group_options", lambda group, kind, overrides: options(group, kind))

        def plan(arguments):
            _, overrides = normalise(arguments)
            asked = sweeper.StudySweeper()
            asked.setup(hydra_context=SimpleNamespace(config_loader=loader), task_function=None, config=master(
                *(o for o in overrides if o.startswith(("+experiment=", "tune.")))))
            asked.params = asked.master.hydra.sweeper.params
            if asked.master.tune.goal is None:
                return asked.jobs(overrides)
            search = asked._expansion(overrides)  # one choice of it
            return search.trial({name: whole(o)[0].partition("=")[2] if o.is_discrete_sweep() else str(o.value().start)
                                 for name, o in search.sweeps().items()})
        yield plan


def test_every_study_can_be_planned(planned):
    for typed in STUDIES:
        arguments = [word.replace("seed=s", "seed=3") for word in words(typed.line)[3:]]
        if "--help" in arguments:
            continue
        elsewhere = next((test for word, test in ELSEWHERE.items() if word in arguments), None)
        if elsewhere is not None:
            assert is_there(elsewhere)
            continue
        try:
            runs = planned(arguments)
        except ConfigError as cause:
            if not re.search(r"pip install 'attnlab\[(ray|dask|sb3)\]'", str(cause)):  # extras that are not here
                pytest.fail(f"{typed}: {cause}")
        else:
            assert runs, typed


@pytest.mark.parametrize("typed", READERS, ids=lambda c: c.line)
def test_a_command_is_understood(typed, only_read, capsys):
    arguments = words(typed.line)[2:]
    home = importlib.import_module(arguments[0])
    home = home if hasattr(home, "main") else importlib.import_module(f"{arguments[0]}.__main__")
    with pytest.raises(ReadError) as read:
        home.main(arguments[1:])
    assert read.value.args[0] is not None


@pytest.mark.parametrize("typed", SCRIPTS, ids=lambda c: c.line)
def test_a_script_is_there_and_understands(typed, only_read, monkeypatch):
    script, *arguments = words(typed.line)[1:]
    source = (ROOT / script).read_text()
    if "ArgumentParser" not in source:  # one of few words
        assert '__name__ == "__main__"' in source and (not arguments or "sys.argv" in source)
        return
    assert 'if __name__ == "__main__"' in source
    spec = importlib.util.spec_from_file_location("script", ROOT / script)
    monkeypatch.setattr(sys, "path", [str((ROOT / script).parent), *sys.path])
    monkeypatch.setattr(sys, "argv", [script, *arguments])
    spec.loader.exec_module(module := importlib.util.module_from_spec(spec))
    with pytest.raises(ReadError):
        module.main()


def test_the_rest_names_what_there_is():
    extras = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["optional-dependencies"]
    sessions = set(re.findall(r"^def (\w+)\(session", (ROOT / "noxfile.py").read_text(), re.MULTILINE))
    for typed in REST:
        program, *arguments = words(typed.line)
        if program in ("python", "python3") and arguments:
            program, arguments = arguments[1], arguments[2:]
        if program == "pytest":
            paths = [word for word in arguments if "/" in word]
            assert all((ROOT / path).exists() for path in paths), typed
        elif program == "nox":
            assert set(arguments) - {"-s"} <= sessions, typed
        elif program == "pip":
            for word in arguments:
                named = re.fullmatch(r"(?:\.|attnlab)\[(\w+)\]", word)
                assert named is None or named[1] in extras, typed
            assert "-c" not in arguments or (ROOT / "constraints.txt").is_file()
        else:
            assert program in {"python", "venv", "mypy", "ruff", *OTHERS}, typed


def test_each_option_is_used_by_a_test():
    """Of the tests that start that command, one gives it each option that the pages name, or types what a page has."""
    tests = [file.read_text() for file in (ROOT / "tests").rglob("test_*.py") if file != Path(__file__)]
    unused = set()
    for typed in READERS:
        module, *arguments = words(typed.line)[2:]
        name = module.rpartition(".")[2]
        starting = [text for text in tests if re.search(rf"attnlab(\.| import .*\b){name}\b", text)]
        page = f'"{Path(typed.page).name}"'
        unused |= {f"{module} {flag}" for flag in filter(FLAG.fullmatch, arguments)
                   if not any(f'"{flag}' in text or page in text for text in starting)}
        assert starting, f"no test starts {module}"
    assert not unused


ALONE = {  # what takes minutes, or a log -> the test that types it with less
    "attnlab.search": "tests/search/test_search.py", "attnlab.certify": "tests/simulators/test_agreement.py",
    "attnlab.calibrate": "tests/claims/test_calibrate.py", "attnlab.arena": "tests/arena/test_arena.py",
    "attnlab.logs": "tests/logs/test_formats.py", "attnlab.fig1": "tests/worlds/test_give.py",
    "attnlab.new": "tests/plugins/test_new.py", "attnlab.toys": "tests/toys/test_toys_command.py"}


@pytest.mark.long
def test_what_the_readme_tells_to_type(attnlab, tmp_path):
    """Its commands on a study and a run, on two studies of two runs of a few short episodes."""
    few = ("seed=0-1", "simulator=planar", "train_episodes=2", "validation_episodes=2", "max_cycles=80",
           "picture=false", "report=false")
    for study in ("STUDY", "STUDY2"):
        assert attnlab("+experiment=cr_vs_ncr", *few, f"study={study}").returncode == 0
    run = next((tmp_path / "outputs" / "STUDY").glob("*/run.json")).parent.name
    typed = [words(c.line)[2:] for c in READERS if c.page == "README.md"]
    assert len(typed) > 20 and {module for module, *_ in typed} > set(ALONE)
    for module, *arguments in typed:
        if module in ALONE:
            assert (ROOT / ALONE[module]).is_file()
            continue
        named = [re.sub("(STUDY|first_look)/RUN", f"STUDY/{run}", a).replace("cr_vs_ncr", "STUDY") for a in arguments]
        named = ["film.gif" if word.endswith(".mp4") else word for word in named]  # .mp4 is an extra
        done = attnlab(*named, module=module, timeout=600)
        assert done.returncode == 0, f"{module} {named}: {done.stdout[-300:]}{done.stderr[-800:]}"
    assert (tmp_path / "outputs" / "index.html").is_file() and (tmp_path / "film.gif").is_file()

"""Whatever a plugin does wrong is one clear line with its file; the other runs go on."""

import pytest

from attnlab.registry import parts, register
from attnlab.robot import guards
from attnlab.robot.episodes import play_run
from attnlab.robot.folder import run_to_folder
from attnlab.robot.plan import RunPlan
from attnlab.testing import checks, config

HEAD = """
from dataclasses import dataclass
from attnlab.curiosity.litman import Litman
from attnlab.behaviours.wander import Wander
from attnlab.learners.fixed import RandomPeriod
from attnlab.registry import register
from attnlab.settings import setting
"""

AT_IMPORT = {
    "raises": ("raise RuntimeError('no such sensor')", "RuntimeError: no such sensor"),
    "syntax": ("def broken(:\n    pass", "SyntaxError: invalid syntax (line 8)"),
    "missing": ("import a_module_nobody_has", "No module named 'a_module_nobody_has'"),
    "exits": ("raise SystemExit(3)", "SystemExit: 3"),
    "taken": ("@register('curiosity', 'litman')\nclass Mine(Litman): pass",
              "curiosity 'litman' is already registered by"),
    "twice": ("@register('curiosity', 'one')\nclass Mine(Litman): pass\n"
              "@register('curiosity', 'one')\nclass Mine(Litman): pass", "curiosity 'one' is already registered by"),
    "group": ("@register('curiosties', 'one')\nclass Mine(Litman): pass",
              "there is no group 'curiosties'. Did you mean 'curiosity'"),
    "untyped": ("@register('curiosity', 'one')\nclass Mine(Litman):\n    @dataclass\n    class Params:\n        a = 3",
                "parameter 'a' of Mine has no type"),
    "untyped_setting": ("@register('curiosity', 'one')\nclass Mine(Litman):\n    @dataclass\n    class Params:\n"
                        "        a = setting(3, 'x')", "'a' is a field but has no type annotation"),
    "no_dataclass": ("@register('curiosity', 'one')\nclass Mine(Litman):\n    class Params:\n        a: int = 3",
                     "Params must be a dataclass with typed fields"),
    "no_default": ("@register('curiosity', 'one')\nclass Mine(Litman):\n    @dataclass\n"
                   "    class Params:\n        a: int",
                   "parameter 'a' of Mine has no default"),
    "unfinished": ("from attnlab.curiosity.base import Curiosity\n@register('curiosity', 'one')\n"
                   "class Mine(Curiosity):\n    def memory(self): return 0", "Mine lacks liking, observe"),
    "wrong_default": ("@register('curiosity', 'one')\nclass Mine(Litman):\n    @dataclass\n    class Params:\n"
                      "        a: int = setting(3, 'x', high=2)", "do not accept their own defaults: curiosity.a"),
}


def test_every_failure_at_import_is_a_line_and_the_others_load(place):
    for name, (text, _) in AT_IMPORT.items():
        place.plugin(f"bad_{name}", HEAD + text)
    place.plugin("fine", HEAD + "@register('curiosity', 'fine')\nclass Fine(Litman): pass")
    done = place.python("-m", "attnlab.parts")
    assert done.returncode == 0 and "\n  fine " in done.stdout
    failed = done.stdout.partition("failed to load")[2].splitlines()
    for name, (_, message) in AT_IMPORT.items():
        line = [line for line in failed if f"plugins/bad_{name}.py: " in line]
        assert len(line) == 1 and message in line[0], (name, line)
    assert "litman               built in" in done.stdout  # the built-in one is still itself
    both = next(line for line in failed if "bad_taken" in line)
    assert both.count(".py") >= 2 and "litman.py" in both  # names both
    for name, (_, message) in AT_IMPORT.items():
        if name in ("raises", "untyped"):
            one = place.python("-m", "attnlab.parts", f"bad_{name}")
            assert f"plugins/bad_{name}.py failed to load" in one.stdout and message in one.stdout


def test_a_plugin_that_did_not_load_is_explained_when_it_is_asked_for(place):
    place.plugin("wise", "raise RuntimeError('no such sensor')")
    done = place.attnlab("curiosity=wise")
    assert done.returncode == 2 and not (place.path / "outputs").exists()
    line = done.stderr.strip().splitlines()[-1]
    assert "wise" in line and "did not load" in line and "no such sensor" in line


IN_A_RUN = {
    "loses": ("    def observe(self, memory, percept):\n        raise KeyError('lost')", ":11: KeyError: 'lost'"),
    "dreams": ("    def liking(self, memory, percept):\n        return float('nan')", ": 'dreams' gave wanting"),
}


def test_plugins_that_go_wrong_in_a_run_and_the_run_after_them(place):
    for name, (text, _) in IN_A_RUN.items():
        place.plugin(name, HEAD + f"@register('curiosity', '{name}')\nclass Bad(Litman):\n" + text)
    done = place.attnlab("curiosity=loses,dreams,litman", "-m")
    assert done.returncode == 1
    runs = place.runs()
    assert runs["litman"]["status"] == "complete"
    for name, (_, message) in IN_A_RUN.items():
        assert runs[name]["status"] == "failed"
        assert runs[name]["error"].strip().splitlines()[-1].startswith(f"plugins/{name}.py{message}")
        assert [line for line in (done.stdout + done.stderr).splitlines() if f"plugins/{name}.py{message}" in line]


def broken(group, base, name="broken_part", **members):
    """A part registered for one test; the file blamed is this one."""
    cls = type("Broken", (base,), {"__module__": __name__, **members})
    register(group, name)(cls)
    return cls


@pytest.fixture(autouse=True)
def forget():
    before = dict(parts)
    yield
    parts.clear()
    parts.update(before)


def error_of(**settings):
    """What a run of :func:`config` ends with."""
    with pytest.raises(Exception) as caught:
        play_run(RunPlan(config(max_cycles=60, **settings)))
    return guards.verdict(caught.value)


@pytest.mark.parametrize(("member", "value", "message"), [
    ("percept", lambda self, now: 99.0, "perceived 99.0, outside"),
    ("percept", lambda self, now: float("nan"), "perceived nan, outside"),
    ("percept", lambda self, now: None, "perceived None, outside"),
    ("reward", lambda self, sigma, period: float("nan"), "gave reward nan"),
    ("command", lambda self, now, sigma: (float("nan"), 0.0), "commanded (nan, 0.0)"),
    ("command", lambda self, now, sigma: (0.1, 0.2, 0.3), "commanded (0.1, 0.2, 0.3)"),
    ("command", lambda self, now, sigma: 3.0, "commanded 3.0"),
    ("command", lambda self, now, sigma: [][0], "IndexError: list index out of range"),
])
def test_a_behaviour_that_goes_wrong(member, value, message):
    from attnlab.behaviours.wander import Wander
    broken("behaviours", Wander, **{member: value})
    line = error_of(behaviours=("avoid", "broken_part"))
    assert message in line and "test_bad_plugins.py" in line and "\n" not in line


@pytest.mark.parametrize(("member", "value", "message"), [
    ("liking", lambda self, memory, percept: 1.5, "gave wanting"),
    ("wanting", lambda self, memory, energy: float("nan"), "gave wanting nan"),
    ("level", lambda self, wanting, liking: 7, "gave level 7, no index of ('low', 'LH', 'HH')"),
    ("level", lambda self, wanting, liking: -1, "gave level -1, no index"),
    ("level", lambda self, wanting, liking: "LH", "gave level 'LH', no index"),
    ("mix", lambda self, extrinsic, liking, wanting: float("inf"), "mixed a reward of inf"),
])
def test_a_curiosity_that_goes_wrong(member, value, message):
    from attnlab.curiosity.litman import Litman
    broken("curiosity", Litman, **{member: value})
    line = error_of(curiosity="broken_part")
    assert message in line and "test_bad_plugins.py" in line


@pytest.mark.parametrize(("value", "message"), [
    (lambda self, state, exploration, draw: 4, "chose 4, no index of the periods [1, 4, 8, 12]"),
    (lambda self, state, exploration, draw: -1, "chose -1, no index"),
    (lambda self, state, exploration, draw: 1.0, "chose 1.0, no index"),
])
def test_a_learner_that_grants_a_period_outside_its_set(value, message):
    from attnlab.learners.fixed import RandomPeriod
    broken("learner", RandomPeriod, decide=value)
    line = error_of(learner="broken_part")
    assert message in line and "test_bad_plugins.py" in line


def test_a_part_that_raises_at_construction_is_a_config_error_with_its_file(place):
    place.plugin("bad", HEAD + "@register('behaviours', 'bad')\nclass Bad(Wander):\n"
                 "    def __init__(self, params, context):\n        raise RuntimeError('no arm')")
    done = place.attnlab("behaviours=[avoid,bad]")
    assert done.returncode == 2 and not (place.path / "outputs").exists()
    line = done.stderr.strip().splitlines()[-1]
    assert "plugins/bad.py:11" in line and "RuntimeError: no arm" in line


def caught(group, name, check):
    """The suite's complaint."""
    with pytest.raises(AssertionError) as error:
        checks(group)[check](name)
    return str(error.value)


def test_the_suite_catches_unseeded_randomness():
    import random

    import numpy as np

    from attnlab.behaviours.wander import Wander
    from attnlab.curiosity.litman import Litman
    from attnlab.learners.fixed import RandomPeriod
    broken("curiosity", Litman, liking=lambda self, memory, percept: random.random())
    assert "no_hidden_randomness" in checks("curiosity")
    assert "global random" in caught("curiosity", "broken_part", "no_hidden_randomness")
    assert "asked twice" in caught("curiosity", "broken_part", "pure_reads")
    broken("learner", RandomPeriod, decide=lambda self, state, exploration, draw: int(np.random.randint(4)))
    assert "global random" in caught("learner", "broken_part", "no_hidden_randomness")
    broken("behaviours", Wander, command=lambda self, now, sigma: (0.1, random.Random().uniform(-1, 1)))
    assert "other numbers" in caught("behaviours", "broken_part", "runs")


def test_the_suite_catches_impure_reads_and_shared_memories():
    from attnlab.curiosity.count import Count

    def counting(self, memory, percept):
        memory[percept] += 1
        return 0.5
    broken("curiosity", Count, liking=counting)
    assert "a read changed the memory" in caught("curiosity", "broken_part", "pure_reads")
    shared = [0] * 6
    broken("curiosity", Count, "shared_part", memory=lambda self: shared)
    assert "share a memory" in caught("curiosity", "shared_part", "memories_apart")
    broken("curiosity", Count, "bold_part", liking=lambda self, memory, percept: 2.0)
    assert "outside [0, 1]" in caught("curiosity", "bold_part", "bounds")


def test_the_suite_catches_missing_docs():
    from dataclasses import dataclass

    from attnlab.curiosity.litman import Litman

    @dataclass
    class Params:
        length: int = 3
    broken("curiosity", Litman, Params=Params, __doc__="Something.")
    assert "parameter length has no doc" in caught("curiosity", "broken_part", "documented")


def test_good_runs_are_not_touched_by_a_failed_one(tmp_path):
    """A failed run has a status and a traceback, and no tables that could be taken for results."""
    from attnlab.curiosity.litman import Litman
    broken("curiosity", Litman, liking=lambda self, memory, percept: float("nan"))
    info = {"run": "run", "key": "k", "overrides": [], "swept": {}}
    assert not run_to_folder(config(curiosity="broken_part"), tmp_path / "a", info)
    assert run_to_folder(config(), tmp_path / "b", info)
    assert not list((tmp_path / "a").glob("*.parquet")) and len(list((tmp_path / "b").glob("*.parquet"))) == 5

"""Random settings, readings, worlds and seeds of every part that compiles: both engines give the same bytes.

    python tests/system/test_engines_agree.py 0 500

plays the runs 0 to 499 and prints each that differs, and how many agreed. A run's number says all of it. Those of one
composition of parts follow each other, 20 at a time, because a composition is compiled once, whatever its settings.
"""

from __future__ import annotations

import dataclasses
import sys
import typing
from random import Random
from typing import Any

import pytest

from attnlab import registry
from attnlab.errors import ConfigError
from attnlab.reading import Reading
from attnlab.robot.engines import build
from attnlab.robot.episodes import play_run
from attnlab.robot.plan import RunPlan
from attnlab.settings import choices_of
from attnlab.testing import config
from attnlab.testing.build import node
from attnlab.testing.compiled import first_difference

TOGETHER = 20  # runs of a composition that follow each other
GROUPS = ("behaviours", "needs", "fusion", "curiosity", "learner", "exploration")
COMPOSITIONS: tuple[dict[str, Any], ...] = (
    {},
    {"curiosity": "none", "learner": "sarsa", "exploration": "greedy"},
    {"curiosity": "composed", "learner": "monitor", "exploration": "epsilon_greedy"},
    {"curiosity": "litman_gap", "learner": "double_q", "exploration": "ucb1"},
    {"curiosity": "information_gap", "learner": "q_lambda", "behaviours": ("avoid", "eat", "drink", "wander")},
    {"curiosity": "learning_progress", "learner": "tempo_rl", "exploration": "annealed"},
    {"curiosity": "habituation", "learner": "amrl", "exploration": "epsilon_greedy"},
    {"curiosity": "surprise", "learner": "regulations", "fusion": "contention"},
    {"curiosity": "litman_itti", "learner": "emotional", "fusion": "mean"},
    {"curiosity": "surprise_poisson", "learner": "timing"},
    {"curiosity": "salience", "learner": "self_triggered", "exploration": "annealed"},
    {"curiosity": "prediction_error", "learner": "bandwidth", "exploration": "ucb1"},
    {"curiosity": "optimal_arousal", "learner": "capped", "exploration": "epsilon_greedy"},
    {"curiosity": "shuffled_liking", "learner": "expected_sarsa"},
    {"curiosity": "random_wanting", "learner": "tacos", "fusion": "contention"},
    {"curiosity": "count", "learner": "fixed", "behaviours": ("avoid", "wander"), "needs": "energy_only"},
    {"curiosity": "additive", "learner": "random", "behaviours": ("avoid", "rest")},
    {"curiosity": "novelty_decay", "learner": "always_on", "how": {"need_death": False}},
    {"curiosity": "novelty_window", "learner": "evolution", "how": {"crash": "safety_distance"}},
    {"curiosity": "surprise_reverse", "learner": "steady", "exploration": "ucb1", "fusion": "mean"},
)
SMALL = {"evolution": {"generations": 0, "population": 5, "episodes": 1, "workers": 1}}
OTHERS = {"need_death", "crash", "validation_exploration"}  # of the reading: they are compiled for
FIXED = OTHERS | {"max_cycles", "start_pose", "penalised"}  # the world has no pose, and a part is its own group


def other(draw: Random, field: dataclasses.Field[Any], kind: Any, value: Any) -> Any:
    """Another value of a setting, within its bounds; the same of what is no number, word or yes and no."""
    choices = (True, False) if kind is bool else choices_of(kind)
    if choices:
        return draw.choice(choices)
    if kind not in (int, float) or not value:
        return value
    meta, found = field.metadata, value * draw.uniform(0.4, 2.0)
    low, high = meta.get("low"), meta.get("high")
    if low is not None or meta.get("above") is not None:
        found = max(found, low if low is not None else meta["above"] + 1e-3 * abs(value))
    return kind(min(found, high) if high is not None else found)


def changed(draw: Random, cls: Any, values: dict[str, Any], share: float) -> dict[str, Any]:
    """Settings of a dataclass, some of them others."""
    hints = typing.get_type_hints(cls)
    return {**values, **{field.name: other(draw, field, hints[field.name], values[field.name])
                         for field in dataclasses.fields(cls) if field.name in values and draw.random() < share}}


def part(draw: Random, group: str, name: str) -> dict[str, Any]:
    """A part with other settings."""
    found = node(group, name, **SMALL.get(name, {}))
    return found if name in SMALL else changed(draw, registry.get(group, found, group).params, found, 0.5)


def world(draw: Random) -> dict[str, Any]:
    """One of the worlds that are there, or boxes anywhere."""
    name = draw.choice(("paper", "cluttered", "open", "wandering", "random", "random"))
    if name != "random":
        return node("world", name)
    return node("world", name, obstacles=draw.randint(0, 6), food=draw.randint(1, 3), water=draw.randint(1, 3))


def drawn(number: int) -> dict[str, Any]:
    """The config of a run."""
    draw = Random(number)
    chosen = COMPOSITIONS[number // TOGETHER % len(COMPOSITIONS)]
    plain = {field.name: field.default for field in dataclasses.fields(Reading) if field.name not in FIXED}
    while True:
        how = {name: value for name, value in changed(draw, Reading, plain, 0.1).items() if value != plain[name]}
        parts: dict[str, Any] = {group: part(draw, group, chosen[group]) for group in GROUPS[1:] if group in chosen}
        made = config(**parts, behaviours=chosen.get("behaviours", ("avoid", "eat", "drink")), world=world(draw),
                      how={**how, "penalised": draw.choice(("all", "responsible")), **chosen.get("how", {})},
                      seed=draw.randrange(1000), train_episodes=draw.randint(1, 4),
                      max_cycles=draw.choice((30, 200, 600)))
        made["behaviours"] = {name: part(draw, "behaviours", name) for name in made["behaviours"]}
        try:
            RunPlan(made)
            return made
        except ConfigError:
            continue


def differs(number: int) -> str:
    """What is not the same in a run when each engine plays it; empty if all is."""
    from attnlab.compiled.engine import Uncompilable
    made = drawn(number)
    try:
        one, compiled = (play_run(RunPlan(made), engine=engine)[0] for engine in ("python", "compiled"))
    except Uncompilable as cause:
        return f"does not compile: {cause}"
    return first_difference(one, compiled)


@pytest.mark.long
@pytest.mark.parametrize("composition", range(len(COMPOSITIONS)))
def test_engines_agree(composition):
    first = composition * TOGETHER
    assert not {number: what for number in range(first, first + TOGETHER) if (what := differs(number))}


def test_every_part_that_compiles_is_played():
    """Or says why it does not, which six do."""
    played = {(group, option) for chosen in COMPOSITIONS for group, names in {**config(), **chosen}.items()
              if group in GROUPS for option in ([names] if isinstance(names, str) else
                                                [names["name"]] if "name" in names else names)}
    played.add(("simulator", "planar"))
    known = {(spec.group, spec.name): spec.cls.interpreted for spec in registry.parts.values()
             if spec.group in (*GROUPS, "simulator") and spec.cls.__module__.startswith(f"attnlab.{spec.group}"[:-1])}
    assert {key for key, why in known.items() if not why} <= played
    assert {key for key, why in known.items() if why} == {
        ("behaviours", "give"), ("behaviours", "watch"), ("simulator", "scripted"), ("simulator", "pybullet"),
        ("simulator", "log"), ("learner", "sb3")}


@pytest.mark.long
@pytest.mark.parametrize("simulator", ["scripted", "pybullet", "log"])
def test_who_says_that_it_does_not_compile_still_does_not(simulator):
    """GIVE compiles but for its hand, which is in the first alone, WATCH but for its log."""
    pytest.importorskip("pybullet" if simulator == "pybullet" else "numba")
    from attnlab.compiled.engine import Uncompilable
    alone = {"scripted": "give", "log": "watch"}.get(simulator)
    more: dict[str, Any] = {"behaviours": (alone,), "needs": "energy_only"} if alone else {}
    assert not alone or registry.parts["behaviours", alone].cls.simulators == (simulator,)
    with pytest.raises((AttributeError, KeyError, Uncompilable)):
        build(RunPlan(config(simulator=simulator, **more)))


if __name__ == "__main__":
    first, last = map(int, sys.argv[1:3])
    found = {}
    for number in range(first, last):
        what = differs(number)
        if what:
            found[number] = what
            print(f"run {number} of {COMPOSITIONS[number // TOGETHER % len(COMPOSITIONS)]}: {what}", flush=True)
    print(f"{last - first - len(found)} of {last - first} runs agree")
    sys.exit(bool(found))

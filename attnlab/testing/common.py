"""Checks for parts of every group: documented and typed parameters, no hidden randomness, a whole run."""

from __future__ import annotations

import contextlib
import dataclasses
import inspect
import math
import random
import typing
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from attnlab import registry
from attnlab.settings import build, defaults_of
from attnlab.tables.scratch import scratch
from attnlab.testing.build import config, node, part_of

if TYPE_CHECKING:
    from attnlab.robot.plan import RunPlan

IN_A_RUN = ("simulator", "behaviours", "needs", "fusion", "curiosity", "learner", "exploration")


def checks(group: str) -> list[Callable[..., None]]:
    """Checks of :data:`group` that need nothing special."""
    def documented(name: str, **_: Any) -> None:
        """The class says what it is; every parameter says what it means."""
        spec = part_of(group, name)
        assert (inspect.getdoc(spec.cls) or "").strip(), f"{spec.origin}: {spec.cls.__name__} has no docstring"
        for field in dataclasses.fields(spec.params):
            assert field.metadata.get("doc"), f"{spec.origin}: parameter {field.name} has no doc: use setting(...)"

    def typed(name: str, **settings: Any) -> None:
        """Parameters have types that a config can be checked against, and their defaults pass."""
        spec = part_of(group, name)
        hints = typing.get_type_hints(spec.params)
        assert {field.name for field in dataclasses.fields(spec.params)} <= set(hints), spec.origin
        defaults = defaults_of(spec.params)
        assert defaults_of(type(build(spec.params, defaults, group))) == defaults
        assert plain(defaults), f"{spec.origin}: a default is no number, word, list or mapping: {defaults}"
        registry.build_params(group, node(group, name, **settings), group)

    def runs(name: str, **settings: Any) -> None:
        """A short run with it is complete, finite, and the same when it is run again."""
        first = whole_run(group, name, settings)
        for table, columns in first.items():
            for column, values in columns.items():
                bad = [v for v in values if isinstance(v, float) and not math.isfinite(v)]
                assert not bad, f"{name}: {table}.{column} holds {bad[0]}"
        assert repr(first) == repr(whole_run(group, name, settings)), f"{name}: a second run gave other numbers"

    def no_hidden_randomness(name: str, **settings: Any) -> None:
        """Nothing is drawn from ``random`` or ``numpy.random``, neither read nor moved: draw from context.draw."""
        import numpy as np
        saved = random.getstate(), np.random.get_state()
        try:
            results = []
            for seed in (1, 2):
                random.seed(seed)
                np.random.seed(seed)
                before = random.getstate(), repr(np.random.get_state())
                results.append(repr(whole_run(group, name, settings)))
                after = random.getstate(), repr(np.random.get_state())
                assert before == after, f"{name}: moves the global random state; draw from context.draw"
            assert results[0] == results[1], f"{name}: its numbers depend on the global random state"
        finally:
            random.setstate(saved[0])
            np.random.set_state(saved[1])

    def goes_on(name: str, **settings: Any) -> None:
        """A run that was interrupted is the same in the end; what a part of ours holds can all be kept."""
        tables, notes = interrupted(group, name, settings)
        assert repr(tables) == repr(whole_run(group, name, settings)), f"{name}: an interrupted run goes on otherwise"
        ours = part_of(group, name).cls.__module__.startswith("attnlab.")
        assert not ours or set(notes) <= {"went_on_at"}, f"{name}: {notes}"

    alone = [documented, typed]
    return [*alone, runs, goes_on, no_hidden_randomness] if group in IN_A_RUN else alone


def plain(value: Any) -> bool:
    """Is this what a config file can hold?"""
    if isinstance(value, dict):
        return all(isinstance(key, str) and plain(item) for key, item in value.items())
    if isinstance(value, (list, tuple)):
        return all(map(plain, value))
    return value is None or isinstance(value, (bool, int, float, str))


def whole_run(group: str, name: str, settings: dict[str, Any]) -> dict[str, dict[str, list[Any]]]:
    """The tables of a short run that uses the part."""
    from attnlab.robot.episodes import play_run
    return play_run(plan_of(group, name, settings))[0]


class _Interrupted(BaseException):
    """Stands for a kill."""


def interrupted(group: str, name: str, settings: dict[str, Any]) -> tuple[dict[str, dict[str, list[Any]]],
                                                                          dict[str, Any]]:
    """The tables of the same run, killed after its first episode and begun again, and what run.json would say of it."""
    from attnlab.robot.episodes import play_run
    from attnlab.robot.keeping import Keeping

    def kill(*_: int) -> None:
        raise _Interrupted
    with scratch() as home:
        plan = plan_of(group, name, settings, checkpoint_minutes=0)
        with contextlib.suppress(_Interrupted):
            play_run(plan.with_seed(plan.settings.seed), folder=Path(home), progress=kill,
                     keeping=Keeping(plan, Path(home), "key"))
        keeping = Keeping(plan, Path(home), "key")
        return play_run(plan, folder=Path(home), keeping=keeping)[0], keeping.notes


def plan_of(group: str, name: str, settings: dict[str, Any], **top: Any) -> RunPlan:
    """A short run that uses the part."""
    from attnlab.robot.plan import RunPlan
    if group == "behaviours":
        works_in: tuple[str, ...] = getattr(part_of(group, name).cls, "simulators", ())
        others = () if "log" in works_in else ("avoid",)
        chosen = config(behaviours=tuple(dict.fromkeys((*others, name))), simulator=(works_in or ("planar",))[0],
                        **top)
        chosen["behaviours"][name].update(settings)
    elif group == "needs":
        chosen = config(needs={"name": name, **settings}, behaviours=("avoid",), **top)
    else:
        asked: dict[str, Any] = {group: {"name": name, **settings}}
        if (group, name) == ("simulator", "log"):
            asked["behaviours"] = ("watch",)
        chosen = config(**asked, **top)
    return RunPlan(chosen)

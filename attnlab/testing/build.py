"""Parts and whole runs for tests, built without a command line."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from attnlab import registry
from attnlab.behaviours.base import BehaviourContext
from attnlab.curiosity.base import CuriosityContext
from attnlab.figures.base import FigureContext
from attnlab.learners.base import LearnerContext
from attnlab.loading import load_all
from attnlab.reading import Reading
from attnlab.robot.plan import RunPlan
from attnlab.settings import build
from attnlab.simulators.base import SimulatorContext
from attnlab.streams import stream
from attnlab.worlds.base import Layout

PERIODS = [1, 4, 8, 12]
BOXES = [{"kind": kind, "x_m": x, "y_m": y} for kind, x, y in
         (("obstacle", 1.2, 2.8), ("obstacle", 2.8, 1.2), ("food", 0.25, 1.0), ("water", 3.75, 3.0))]


def node(group: str, name: str, **settings: Any) -> dict:
    """The config of a part with its defaults and ``settings``."""
    load_all()
    spec = registry.find(group, name)
    if spec is None:
        raise registry.unknown(group, name, group)
    return {**spec.nodes()[name], **settings}


def reading(**settings: Any) -> Reading:
    """The default reading but for ``settings``."""
    return build(Reading, settings, "reading")


def layout(seed: int = 0, name: str = "layout", **settings: Any) -> Layout:
    """The world of the paper, or another."""
    boxes = {"boxes": BOXES} if name == "layout" else {}
    return registry.make("world", node("world", name, **{**boxes, **settings}), None).build(seed)


def make(group: str, name: str, *, seed: int = 0, how: Mapping[str, Any] | None = None, world: Layout | None = None,
         behaviour: str | None = None, levels: Sequence[str] | None = None, **settings: Any) -> Any:
    """The part ``group=name`` with ``settings``, under the reading ``how``; streams from ``seed``. ``behaviour`` and
    ``levels`` are a learner's context (AVOID with all three if left out), or settings of a measure."""
    if group == "measure":
        settings |= {name: value for name, value in (("behaviour", behaviour), ("levels", levels)) if value is not None}
    r, levels = reading(**(how or {})), tuple(levels or ("low", "LH", "HH"))
    contexts = {
        "curiosity": lambda: CuriosityContext(r, r.percept_bins, stream(seed, "curiosity")),
        "behaviours": lambda: BehaviourContext(r, stream(seed, "behaviour", name)),
        "learner": lambda: LearnerContext(r, behaviour or "avoid", levels, PERIODS, r.percept_bins,
                                          stream(seed, "learner")),
        "simulator": lambda: SimulatorContext(world or layout(), r.dt_s, r.max_cycles),
        "needs": lambda: r, "fusion": lambda: r, "penalty": lambda: r,
        "exploration": lambda: None, "world": lambda: None, "measure": lambda: None, "figure": FigureContext,
    }
    return registry.make(group, node(group, name, **settings), contexts[group]())


def config(*, simulator: str = "planar", behaviours: tuple[str, ...] = ("avoid", "eat", "drink"),
           world: Mapping[str, Any] | None = None, how: Mapping[str, Any] | None = None, curiosity: Any = "litman",
           learner: Any = "q_learning", exploration: Any = "softmax", needs: Any = "survival",
           fusion: Any = "min_speed_sum_turn", **top: Any) -> dict:
    """A run's config; a part is a name or {name: ..., setting: ...}. Short unless ``top`` says otherwise."""
    def part(group: str, chosen: Any) -> dict:
        return node(group, chosen) if isinstance(chosen, str) else node(group, **chosen)
    return {"seed": 0, "train_episodes": 2, "validation_episodes": 1, "max_cycles": 120, "record": "all",
            "reading": {"name": "inferred", **(how or {})}, "simulator": part("simulator", simulator),
            "world": dict(world) if world else node("world", "layout", boxes=BOXES),
            "behaviours": {name: node("behaviours", name) for name in behaviours}, "needs": part("needs", needs),
            "fusion": part("fusion", fusion), "curiosity": part("curiosity", curiosity),
            "learner": part("learner", learner), "exploration": part("exploration", exploration), **top}


def run(**settings: Any) -> dict[str, dict[str, list]]:
    """The tables of a run of :func:`config`."""
    from attnlab.robot.episodes import play_run
    return play_run(RunPlan(config(**settings)))[0]

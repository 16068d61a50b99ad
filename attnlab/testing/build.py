"""Parts and whole runs for tests, built without a command line."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, cast

from attnlab import registry
from attnlab.figures.base import FigureContext
from attnlab.loading import config_folders, load_all
from attnlab.paths import conf_dir
from attnlab.reading import Reading
from attnlab.robot.contexts import Making
from attnlab.robot.plan import RunPlan
from attnlab.settings import build, defaults_of
from attnlab.testing.log import BLOCKS, small_log
from attnlab.worlds.base import Layout, World

PERIODS = [1, 4, 8, 12]
BOXES = [{"kind": kind, "x_m": x, "y_m": y} for kind, x, y in
         (("obstacle", 1.2, 2.8), ("obstacle", 2.8, 1.2), ("food", 0.25, 1.0), ("water", 3.75, 3.0))]


def node(group: str, name: str, **settings: Any) -> dict[str, Any]:
    """The config of ``group=name``: a part with its defaults, a preset, or a yaml file; changed by ``settings``.
    ``simulator=log`` has a small log of its own."""
    load_all()
    if (group, name) == ("reading", "inferred"):
        return {"name": name, **defaults_of(Reading), **settings}
    spec = registry.find(group, name)
    if (group, name) == ("simulator", "log"):
        settings = {"file": small_log(), "blocks": BLOCKS, **settings}
    return {**(spec.nodes()[name] if spec else _written(group, name)), **settings}


def _written(group: str, name: str) -> dict[str, Any]:
    """The config of an option that is a yaml file of ours or of a plugin, on top of those in its ``defaults``."""
    from omegaconf import OmegaConf
    folders = [folder / group for folder in (conf_dir(), *config_folders())]
    file = next((folder / f"{name}.yaml" for folder in folders if (folder / f"{name}.yaml").is_file()), None)
    if file is None:
        known = {option for spec in registry.parts.values() if spec.group == group for option in spec.nodes()}
        written = {file.stem for folder in folders for file in folder.glob("*.yaml")}
        raise registry.unknown(group, name, group, sorted(known | written))
    own = cast("dict[str, Any]", OmegaConf.to_container(OmegaConf.load(file)))
    below = own.pop("defaults", [])
    order = below if "_self_" in below else [*below, "_self_"]
    merged = OmegaConf.merge(*(own if name == "_self_" else node(group, name) for name in order))
    return cast("dict[str, Any]", OmegaConf.to_container(merged))


def part_of(group: str, name: str) -> registry.Spec:
    """The part that ``group=name`` sets, whichever of the three it is."""
    return registry.get(group, node(group, name), group)


def reading(**settings: Any) -> Reading:
    """The default reading but for ``settings``."""
    return build(Reading, settings, "reading")


def layout(seed: int = 0, name: str = "layout", **settings: Any) -> Layout:
    """The world of the paper, or another."""
    boxes = {"boxes": BOXES} if name == "layout" else {}
    world: World = registry.make("world", node("world", name, **{**boxes, **settings}), None)
    return world.build(seed)


def make(group: str, name: str, *, seed: int = 0, how: Mapping[str, Any] | None = None, world: Layout | None = None,
         behaviour: str | None = None, levels: Sequence[str] | None = None, **settings: Any) -> Any:
    """The part ``group=name`` with ``settings``, under the reading ``how``; streams from ``seed``. ``behaviour`` and
    ``levels`` are a learner's context (AVOID with all three if left out), or settings of a measure."""
    if group == "measure":
        settings |= {name: value for name, value in (("behaviour", behaviour), ("levels", levels)) if value is not None}
    making = Making(reading(**(how or {})), seed, world or layout(), PERIODS, tuple(levels or ("low", "LH", "HH")),
                    behaviour or "avoid")
    context = FigureContext() if group == "figure" else making.context(group, name)
    return registry.make(group, node(group, name, **settings), context)


def config(*, simulator: Any = "planar", behaviours: tuple[str, ...] = ("avoid", "eat", "drink"),
           world: Mapping[str, Any] | None = None, how: Mapping[str, Any] | None = None, curiosity: Any = "litman",
           learner: Any = "q_learning", exploration: Any = "softmax", needs: Any = "survival",
           fusion: Any = "min_speed_sum_turn", probe: Any = (), **top: Any) -> dict[str, Any]:
    """A run's config; a part is a name or {name: ..., setting: ...}; probes are names, or nodes by name. Short unless
    ``top`` says otherwise."""
    def part(group: str, chosen: Any) -> dict[str, Any]:
        return node(group, chosen) if isinstance(chosen, str) else node(group, **chosen)
    return {"seed": 0, "train_episodes": 2, "validation_episodes": 1, "max_cycles": 120, "record": "all",
            "reading": {"name": "inferred", **(how or {})}, "simulator": part("simulator", simulator),
            "world": dict(world) if world else node("world", "layout", boxes=BOXES),
            "behaviours": {name: node("behaviours", name) for name in behaviours}, "needs": part("needs", needs),
            "fusion": part("fusion", fusion), "curiosity": part("curiosity", curiosity),
            "probe": dict(probe) if isinstance(probe, Mapping) else {name: node("probe", name) for name in probe},
            "learner": part("learner", learner), "exploration": part("exploration", exploration), **top}


def run(**settings: Any) -> dict[str, dict[str, list[Any]]]:
    """The tables of a run of :func:`config`."""
    from attnlab.robot.episodes import play_run
    return play_run(RunPlan(config(**settings)))[0]

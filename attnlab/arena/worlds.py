"""Ways in worlds: what to type for their study, and what came of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from attnlab.arena.board import Row
from attnlab.arena.summary import STEADY
from attnlab.arena.ways import BETWEEN
from attnlab.errors import ConfigError

if TYPE_CHECKING:
    from attnlab.results.load import Study

WORLDS = ("paper", "open", "cluttered", "wandering")
PERIODS = (11, 10, 9, 6, 3, 1.5)  # mean periods of the steady clocks, beside the fixed ones of 1, 4, 8 and 12
AVOID, LONGEST = (8, 4), 12  # of blind clocks that look for AVOID more often than for all else
# Episodes of training and validation: what 10 seeds of all ways in four worlds can have in ten minutes of two cores,
# told from the CPU time of four runs; 100 validate everywhere in this project.
EPISODES = (300, 100)
SPLIT = {"learner", "learner.of", "learner.name", "world", "seed", "curiosity", "simulator"}  # named otherwise


def commands(names: Sequence[str], worlds: Sequence[str], seeds: int, study: str, cap: float | None,
             look_costs: Sequence[float], more: Sequence[str]) -> list[list[str]]:
    """What to type for the study of ways x worlds, command after command: the ways, free or under a cap of looks a
    second for all behaviours; clocks of any mean period, by which equal looks are compared; clocks as blind that give
    AVOID more looks than others, by which it shows what is won by that alone; and the robot that is curious, where
    Q-learning is asked for. ``look_costs``: e_nb of eq 10, UoE, the robot's own if empty."""
    playing = [name for name in names if name != BETWEEN]
    own = {word.partition("=")[0] for word in more}
    rest = [f"world={','.join(worlds)}", f"seed=0-{seeds - 1}" if seeds > 1 else "seed=0", f"study={study}",
            "picture=false", "report=false",
            *(f"{name}={value}" for name, value in (
                ("simulator", "planar"), ("record", "last"), ("cluster", "threads"), ("curiosity", "none"),
                ("train_episodes", EPISODES[0]), ("validation_episodes", EPISODES[1])) if name not in own)]
    if look_costs:
        rest.append(f"needs.activation_energy={','.join(f'{cost:g}' for cost in look_costs)}")
    rest += more
    learners = ([f"learner={','.join(playing)}"] if cap is None else
                ["learner=capped", f"learner.of={','.join(playing)}", f"learner.looks_per_s={cap:g}"])
    found = [[*learners, *rest],
             ["learner=steady", f"learner.period={','.join(f'{period:g}' for period in PERIODS)}", *rest]]
    if cap is None and "behaviours" not in own:
        found.append(["learner=fixed", f"learner.period={LONGEST}",
                      f"+learner.periods.avoid={','.join(map(str, AVOID))}", *rest])
    if "q_learning" in playing and "curiosity" not in own and cap is None:
        found.append(["learner=q_learning", *(word for word in rest if word != "curiosity=none"), "curiosity=litman"])
    return found


def checked(names: Sequence[str], worlds: Sequence[str], more: Sequence[str]) -> None:
    """Raise ConfigError for a world, a way or a setting that is none, before anything runs."""
    from attnlab.cli.calls import composed
    single = [f"{name}={value.partition(',')[0]}" for name, _, value in (word.partition("=") for word in more)]
    if not any(word.startswith("simulator=") for word in single):
        single.append("simulator=planar")
    for world in worlds:
        composed([f"world={world}", *single])
    for name in names:
        if name != BETWEEN:
            composed([f"learner={name}", "simulator=planar"])


def opened(path: Path) -> Study:
    """The study of a folder. Raises ConfigError if there is none, or nothing of it is complete."""
    from attnlab.results.load import load
    try:
        study = load(path)
    except ConfigError as cause:
        raise ConfigError("--study", str(cause)) from None
    if not study.complete:
        raise ConfigError("--study", f"{path} holds no complete run", "Name a study: outputs/STUDY")
    return study


def world_rows(study: Study, made: Mapping[str, Any]) -> list[Row]:
    """A row a run: looks a cycle and behaviour, lost survival (1 - its mean), from validation episodes."""
    episodes, behaviours = study.episodes, study.behaviours
    episodes = episodes[episodes["phase"] == "validation"]
    behaviours = behaviours[behaviours["phase"] == "validation"]
    if episodes.empty:
        raise ConfigError("--study", f"{study.path} holds no validation episode", "validation_episodes=100")
    by_run, settings, rows = dict(iter(behaviours.groupby("run"))), settings_of(study), []
    for run, mine in episodes.groupby("run"):
        looks, cycles = by_run[run], float(mine["cycles"].sum())
        config, apart = study.config(str(run)), settings.get(str(run), {})
        rows.append(Row(place_of(config, apart), name_of(config, apart), f"seed {study.seed(str(run))}",
                        float(looks["activations"].sum()) / cycles / looks["behaviour"].nunique(),
                        min(1.0, max(0.0, 1.0 - float(mine["survival"].mean()))),
                        {"deaths": float((mine["death"] != "none").mean()), "safety": float(mine["safety_mean"].mean()),
                         "energy": float(mine["energy_mean"].mean())}, False,
                        {**made, "code": study.about(str(run)).get("code") or {}, "settings": config["learner"],
                         "episodes": [config["train_episodes"], config["validation_episodes"]]}))
    return rows


def settings_of(study: Study) -> dict[str, dict[str, Any]]:
    """Of each run: the settings that set its condition apart from others."""
    conditions = study.file.by_name()
    return {run.name: dict(conditions[run.condition].settings) for run in study.file.runs}


def place_of(config: Mapping[str, Any], apart: Mapping[str, Any]) -> str:
    """A world, the simulator unless it is planar, and settings beside the learner's that were swept: another price of a
    look is another place."""
    simulator = config["simulator"]["name"]
    more = [f"{key.rpartition('.')[2]}={value}" for key, value in apart.items()
            if key not in SPLIT and not key.startswith("learner.") and value is not None]
    return ", ".join([f"world {config['world']['name']}{'' if simulator == 'planar' else f' ({simulator})'}", *more])


def name_of(config: Mapping[str, Any], apart: Mapping[str, Any]) -> str:
    """What a way is called: its learner, the model of curiosity if it has one, and what else sets it apart."""
    node, curiosity = config["learner"], config["curiosity"]["name"]
    if node["name"] == "steady":
        return f"{STEADY}{node['period']:g})"
    if isinstance(node.get("periods"), Mapping) and str(node["name"]).startswith("fixed"):  # presets have its settings
        return " ".join([f"fixed_{node['period']}", *(f"{b}={p}" for b, p in node["periods"].items())])
    inner = node.get("of", node["name"]) if node["name"] == "capped" else node["name"]
    name = str(inner["name"] if isinstance(inner, Mapping) else inner)
    more = [f"{key.rpartition('.')[2]}={value}" for key, value in apart.items()
            if key not in SPLIT and key.startswith("learner.") and value is not None]
    return " ".join([name if curiosity == "none" else f"{name}+{curiosity}", *more])


def told(study: Study) -> list[str]:
    """What is not as it was asked for."""
    missing = [name for name in study.file.runs if name.name not in set(study.complete)]
    return [f"{len(missing)} of {len(study.file.runs)} runs are missing or failed"] if missing else []

"""``python -m attnlab.enjoy RUN [world=... simulator=... episodes=...]``: a robot that has learned lives again.

It learns nothing more and takes what it holds for best, in the world it knows or in another. ``study=NAME`` keeps what
it does there as a study, with all cycles.
"""

from __future__ import annotations

import argparse
import shlex
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from attnlab.config import RunSettings
from attnlab.console import guarded
from attnlab.errors import ConfigError, nearest
from attnlab.loading import load_all

if TYPE_CHECKING:
    import pandas as pd

    from attnlab.robot.plan import RunPlan

OF_THE_WORLD = ("world", "simulator", "needs", "fusion", "reading", "max_cycles", "seed", "record", "engine", "probe",
                "outputs")  # what may be other than it was
OWN = ("episodes", "study")
HINT = "python -m attnlab.enjoy outputs/STUDY/RUN world=cluttered"


def main(argv: Sequence[str]) -> int:
    """Entry point; 0, or 1 if a kept run failed. Writes nothing unless a study is named."""
    parser = argparse.ArgumentParser(prog="python -m attnlab.enjoy",
                                     description="Let the robot of a complete run live again, without learning.")
    parser.add_argument("run", help="folder of a complete run")
    parser.add_argument("settings", nargs="*", help=f"episodes=100, study=NAME, and of {', '.join(OF_THE_WORLD)}")
    given = parser.parse_args(list(argv))
    load_all()
    from attnlab.results.one import no_run
    from attnlab.results.states import read_config, state_of
    from attnlab.robot.plan import RunPlan
    folder = Path(given.run)
    status, why, about = state_of(folder)
    stored = read_config(folder)
    if status != "complete" or stored is None:
        raise no_run(folder, why or status)
    own, typed = parted(given.settings)
    plan = RunPlan(other_life(stored, folder, own, typed))
    s = plan.settings
    print(f"{folder}: {s.validation_episodes} episodes in world={s.world['name']}, simulator={s.simulator['name']}, "
          f"seed={s.seed}, after {stored['train_episodes']} of training", flush=True)
    if "study" in own:
        home = kept(plan, [*(about.get("overrides") or ()), *typed])
        if home is None:
            return 1
        here = read(home)
    else:
        from attnlab.robot.engines import choose
        from attnlab.robot.episodes import play_run
        tables, _ = play_run(plan, engine=choose(plan).name)
        here = as_frames(tables)
    print("\n".join(table(here, read(folder))))
    if "study" in own:
        print(f"\nwatch it  python -m attnlab.replay {shlex.quote(str(home))}")
    return 0


def parted(settings: Sequence[str]) -> tuple[dict[str, str], list[str]]:
    """(the command's own settings, those of the run's config). Raises ConfigError."""
    own, typed = dict[str, str](), list[str]()
    for setting in settings:
        name, is_set, value = setting.partition("=")
        head = name.partition(".")[0]
        if not is_set or not value:
            raise ConfigError(setting, "is no setting", HINT)
        if name in OWN:
            own[name] = value
        elif head in OF_THE_WORLD:
            typed.append(setting)
        elif head not in RunSettings.__dataclass_fields__:
            raise ConfigError(name, "no such setting", nearest(head, (*OWN, *OF_THE_WORLD)))
        else:
            raise ConfigError(name, "belongs to the robot, which lives as it has learned",
                              nearest(head, (*OWN, *OF_THE_WORLD)))
    if "episodes" in own and not (own["episodes"].isdecimal() and int(own["episodes"]) > 0):
        raise ConfigError("episodes", f"is {own['episodes']}, must be a whole number above 0")
    return own, typed


def other_life(stored: Mapping[str, Any], folder: Path, own: Mapping[str, str], typed: Sequence[str]
               ) -> dict[str, Any]:
    """The config of a run in which the robot of ``folder`` lives greedily. Raises ConfigError."""
    from attnlab.cli.calls import composed
    from attnlab.robot.agents import pinned
    from attnlab.tables.flat import dig
    new: dict[str, Any] = {**stored, "reading": dict(stored["reading"])}
    chosen = composed(typed)
    for setting in typed:
        name = setting.partition("=")[0]
        head, _, rest = name.partition(".")
        if not rest:
            new[head] = chosen[head]
            continue
        path, _, last = rest.rpartition(".")
        new[head] = dict(new[head])
        node = dig(new[head], path)
        if not isinstance(node, dict):
            raise ConfigError(name, f"{head}={new[head].get('name')} has no such setting")
        node[last] = dig(chosen, name)
    if any(setting.startswith("simulator=") for setting in typed):  # the one to live in, not one to train in
        new["validation"] = {**(stored.get("validation") or {}), "simulator": None, "drive": None}
    new["reading"]["validation_exploration"] = "greedy"
    record = dig(new, "record") if any(setting.startswith("record=") for setting in typed) else \
        "validation" if "study" in own else "none"
    new |= {"train_episodes": 0, "validation_episodes": int(own.get("episodes", stored["validation_episodes"] or 100)),
            "study": own.get("study", "enjoy"), "record": record, "picture": False, "report": False, "fresh": False,
            "variants": None, "labels": {}, "callback": {}, "cluster": {"name": "serial"},
            "start_from": str(folder)}
    return pinned(new)


def kept(plan: RunPlan, typed: Sequence[str]) -> Path | None:
    """Do this run in its study; its folder, None if it failed. ``typed``: what more would be typed for it."""
    from attnlab.launch.drive import complete
    from attnlab.launch.jobs import check_once, condition_of, make_job
    from attnlab.launch.place import check_place
    from attnlab.robot.agents import MARK
    s = plan.settings
    job = make_job(plan, [], {}, [], condition_of(plan.config, {}))
    check_once([job])
    check_place([job])
    mine = {"start_from": str(s.start_from).partition(MARK)[0], "train_episodes": 0,
            "validation_episodes": s.validation_episodes, "record": s.record, "study": s.study, "picture": "false",
            "report": "false"}
    last = {text.partition("=")[0]: text for text in typed} | {name: f"{name}={value}" for name, value in mine.items()}
    failed = complete([job], list(last.values()))
    return None if failed else job.folder


def read(folder: Path) -> tuple[pd.DataFrame, pd.DataFrame]:
    """(episodes, behaviours) of the validation of a stored run."""
    import pandas as pd
    try:
        episodes, behaviours = (pd.read_parquet(folder / f"{name}.parquet") for name in ("episodes", "behaviours"))
    except Exception as cause:  # noqa: BLE001  whatever the reader makes of a damaged file
        raise ConfigError(str(folder), f"its tables cannot be read ({str(cause).splitlines()[0]})",
                          "Run it again with fresh=true") from None
    return tuple(frame[frame["phase"] == "validation"] for frame in (episodes, behaviours))  # type: ignore[return-value]


def as_frames(tables: Mapping[str, Mapping[str, list[Any]]]) -> tuple[pd.DataFrame, pd.DataFrame]:
    """(episodes, behaviours) of a run that was not stored."""
    import pandas as pd
    return pd.DataFrame(tables["episodes"]), pd.DataFrame(tables["behaviours"])


def table(here: tuple[pd.DataFrame, pd.DataFrame], there: tuple[pd.DataFrame, pd.DataFrame]) -> Iterator[str]:
    """What it came to, beside what the run's own validation had, as lines."""
    from attnlab.stats.intervals import difference_interval
    causes = sorted({*here[0]["death"], *there[0]["death"]} - {"none"})
    mine, its = columns_of(*here, causes), columns_of(*there, causes)
    yield f"{'':22}{'here':>10}{'its validation':>17}   difference [95 % interval]"
    for name, values in mine.items():
        other = its.get(name, [])
        unit, factor = (" %", 100.0) if name.startswith(("survival", "died")) else ("", 1.0)
        cells = [f"{factor * sum(v) / len(v):.1f}{unit}" if len(v) else "-" for v in (values, other)]
        d, low, high = (factor * x for x in difference_interval(values, other))
        far = f"{d:+.1f} [{low:+.1f}, {high:+.1f}]" if low == low else "-"
        yield f"{name:22}{cells[0]:>10}{cells[1]:>17}   {far}"
    episodes = [len(frame[0]) for frame in (here, there)]
    yield (f"means over {episodes[0]} and {episodes[1]} episodes of this one robot; the intervals (Welch's) say how "
           "sure they are of it, not of robots of other seeds")


def columns_of(episodes: pd.DataFrame, behaviours: pd.DataFrame, causes: Sequence[str]) -> dict[str, list[float]]:
    """A number for each episode, by what it is."""
    cycles = episodes["cycles"].to_numpy()
    looks = behaviours.groupby("episode", sort=False)["activations"].sum().reindex(episodes["episode"]).to_numpy()
    found: dict[str, Any] = {"survival": episodes["survival"], "died": episodes["death"] != "none"}
    found |= {f"died: {cause}": episodes["death"] == cause for cause in causes}
    found |= {name: episodes[name] for name in ("meals", "drinks") if episodes[name].notna().all()}
    found["looks in 100 cycles"] = 100.0 * looks / cycles
    return {name: [float(value) for value in values] for name, values in found.items()}


if __name__ == "__main__":
    sys.exit(guarded(main))

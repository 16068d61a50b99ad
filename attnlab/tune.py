"""``python -m attnlab.tune --goal MEASURE --search SETTING=LOW:HIGH ...``: settings that make a measure best.

Optuna asks and is told; what it asks for are runs of a study like any other, with several seeds each, and its journal
is in the study's folder, so that the same command goes on where it was stopped. Needs the extra ``optuna``.
"""

from __future__ import annotations

import argparse
import csv
import io
import math
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from attnlab.arithmetic import total
from attnlab.console import guarded
from attnlab.errors import ConfigError
from attnlab.loading import load_all

if TYPE_CHECKING:
    from attnlab.launch.jobs import Job

JOURNAL, TABLE = "tune.journal", "tune.csv"
SHOWN = 10  # trials


def main(argv: Sequence[str]) -> int:
    """Entry point; 0, or 1 if no trial has a value."""
    parser = argparse.ArgumentParser(prog="python -m attnlab.tune", description="Look for settings that make a measure "
                                     "best, by Optuna's sampler; a trial is one run for each seed.")
    parser.add_argument("overrides", nargs="*", help="of all runs, as for python -m attnlab: study=NAME curiosity=none")
    parser.add_argument("--goal", required=True, metavar="MEASURE",
                        help="any measure, or one with settings: '{name: survival, phase: train}'")
    parser.add_argument("--search", action="append", required=True, metavar="SETTING=VALUES",
                        help="LOW:HIGH, log:LOW:HIGH, or words with | between; several times for several settings")
    parser.add_argument("--trials", type=int, default=30, metavar="N", help="trials in all (default 30)")
    parser.add_argument("--seeds", default="0-2", help="of each trial (default 0-2)")
    parser.add_argument("--minimise", action="store_true", help="the least is best")
    given = parser.parse_args(list(argv))
    if given.trials < 1:
        raise ConfigError("--trials", f"is {given.trials}, must be at least 1")
    try:
        import optuna
    except ImportError:
        raise ConfigError("attnlab.tune", "optuna is not installed", "pip install 'attnlab[optuna]'") from None
    load_all()
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    bench = Bench(given.overrides, given.goal, given.seeds)
    space = dict(map(values_of, given.search))
    tried = {name: edges(values) for name, values in space.items()}
    for i in range(max(map(len, tried.values()))):  # what is wrong with a setting is said before anything is written
        bench.jobs({name: values[min(i, len(values) - 1)] for name, values in tried.items()})
    storage = _storage(bench.folder)
    while True:
        study = _study(optuna, storage, given)
        trials = study.get_trials(deepcopy=False)
        open_ones = [trial for trial in trials if trial.state == optuna.trial.TrialState.RUNNING
                     and set(trial.params) == set(space)]
        done = sum(trial.state.is_finished() for trial in trials)
        if done >= given.trials:
            break
        trial = open_ones[0] if open_ones else study.ask(dict(zip(space, map(_distribution, space.values()),
                                                                  strict=True)))
        value = bench.value(trial.params)
        if value is None:
            study.tell(trial.number, state=optuna.trial.TrialState.FAIL)
        else:
            study.tell(trial.number, value)
        print(f"trial {done + 1} of {given.trials}: {value if value is None else format(value, '.4g')} with "
              f"{_said(trial.params)}", flush=True)
    return report(bench.folder, study.get_trials(deepcopy=False), list(space), given)


class Bench:
    """Where trials are played. Raises ConfigError."""

    def __init__(self, overrides: Sequence[str], goal: str, seed_text: str):
        import yaml

        from attnlab import registry
        from attnlab.cli.calls import composer
        from attnlab.cli.main import opened
        from attnlab.tables.ranges import seeds
        try:
            node = yaml.safe_load(goal)
        except yaml.YAMLError:
            node = None
        node = {"name": node} if isinstance(node, str) else node
        if not isinstance(node, Mapping) or "name" not in node:
            raise ConfigError("--goal", f"{goal!r} is no measure", "--goal survival, '{name: survival, phase: train}'")
        try:
            self.measure = registry.make("measure", node, None, "--goal")
        except TypeError as cause:
            raise ConfigError("--goal", f"{node['name']} needs more: {cause}", "'{name: ..., setting: ...}'") from None
        self.composer, self.overrides = composer(), list(overrides)
        self.base, self.seeds = opened(overrides)[1], [int(seed) for seed in seeds("--seeds", seed_text)]
        first = self.composer.config(self.base)
        self.folder = Path(first["outputs"]).expanduser() / first["study"]

    def jobs(self, settings: Mapping[str, Any]) -> list[Job]:
        """A trial's runs, checked."""
        from attnlab.cli.main import opened
        from attnlab.launch.jobs import check_once, condition_of, make_job
        from attnlab.launch.place import check_place
        from attnlab.launch.variants import as_override
        from attnlab.robot.agents import pinned
        from attnlab.robot.plan import RunPlan
        typed = [f"{name}={as_override(value)}" for name, value in settings.items()]
        overrides = [o for o in self.base if o.partition("=")[0] not in settings] + opened(typed)[1]
        config = pinned(self.composer.config(overrides))
        condition = condition_of(config, settings, overrides)
        found, plan = list[Any](), None
        for seed in self.seeds:
            plan = RunPlan({**config, "seed": seed}) if plan is None else plan.with_seed(seed)
            found.append(make_job(plan, [*overrides, f"seed={seed}"], settings, list(settings), condition))
        check_once(found)
        check_place(found)
        return found

    def value(self, settings: Mapping[str, Any]) -> float | None:
        """Mean of the goal over the seeds; None if it has none. What is there is not run again."""
        from attnlab.launch.drive import complete
        from attnlab.measures.base import CannotMeasure
        from attnlab.results.conditions import Conditions, Runs
        from attnlab.results.load import Study
        jobs = self.jobs(settings)
        failed = complete(jobs, [*jobs[0].overrides[:-1], f"seed={','.join(map(str, self.seeds))}"])
        if failed:
            return None
        runs = Runs(Conditions(Study(self.folder), {}), {}, {job.settings.seed: job.run for job in jobs})
        try:
            found = list(self.measure.of(runs).values())
        except CannotMeasure as cause:
            raise ConfigError("--goal", f"cannot be taken: {cause}", "Another measure, or other settings") from None
        return total(found) / len(found) if found and all(map(math.isfinite, found)) else None


def values_of(text: str) -> tuple[str, tuple[Any, ...]]:
    """``SETTING=VALUES`` as (name, ("range", low, high, is it logarithmic?) or ("choice", ...)). Raises ConfigError."""
    import yaml
    name, _, values = text.partition("=")
    parts = values.removeprefix("log:").split(":")
    if not name or not values or (len(parts) != 2 and "|" not in values):
        raise ConfigError("--search", f"'{text}' says nothing to choose from",
                          "NAME=0.1:0.9, NAME=log:0.01:1 or NAME=a|b")
    if "|" in values:
        choices = [yaml.safe_load(value) for value in values.split("|")]
        if not all(isinstance(value, (str, int, float, bool)) for value in choices):
            raise ConfigError("--search", f"'{text}' has a choice that is no word or number", "=a|b|c")
        return name, ("choice", *choices)
    low, high = (yaml.safe_load(part) for part in parts)
    if not all(isinstance(end, (int, float)) and math.isfinite(end) for end in (low, high)) or not low < high:
        raise ConfigError("--search", f"'{text}' is no range", "LOW:HIGH, numbers, the lower one first")
    if values.startswith("log:") and low <= 0:
        raise ConfigError("--search", f"'{text}' begins at {low}, and a logarithm needs more than 0", "log:0.01:1")
    return name, ("range", low, high, values.startswith("log:"))


def edges(values: Sequence[Any]) -> Sequence[Any]:
    """Both ends of a range, or all choices."""
    return values[1:] if values[0] == "choice" else values[1:3]


def _distribution(values: Sequence[Any]) -> Any:
    from optuna.distributions import CategoricalDistribution, FloatDistribution, IntDistribution
    if values[0] == "choice":
        return CategoricalDistribution(values[1:])
    _, low, high, log = values
    whole = isinstance(low, int) and isinstance(high, int)
    return IntDistribution(low, high, log=log) if whole else FloatDistribution(float(low), float(high), log=log)


def _storage(folder: Path) -> Any:
    from optuna.storages import JournalStorage
    from optuna.storages.journal import JournalFileBackend
    folder.mkdir(parents=True, exist_ok=True)
    return JournalStorage(JournalFileBackend(str(folder / JOURNAL)))


def _study(optuna: Any, storage: Any, given: argparse.Namespace) -> Any:
    """The search as it stands. Its draws depend on how many trials there are, so that one that was stopped goes on as
    it would have."""
    name = f"{given.goal} {'least' if given.minimise else 'most'} {' '.join(sorted(given.search))} {given.seeds} " \
           f"{' '.join(sorted(given.overrides))}"
    study = optuna.create_study(storage=storage, study_name=name, load_if_exists=True,
                                direction="minimize" if given.minimise else "maximize")
    study.sampler = optuna.samplers.TPESampler(seed=len(study.get_trials(deepcopy=False)))
    return study


def report(folder: Path, trials: Sequence[Any], names: Sequence[str], given: argparse.Namespace) -> int:
    """Write all trials as a table, and say the best."""
    from attnlab.tables.files import write_bytes
    sign = 1.0 if given.minimise else -1.0
    ranked = sorted(trials, key=lambda trial: (trial.value is None, sign * (trial.value or 0.0), trial.number))
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(["trial", "value", *names])
    rows.writerows([trial.number, "" if trial.value is None else repr(trial.value),
                    *(trial.params.get(name, "") for name in names)] for trial in ranked)
    write_bytes(folder / TABLE, text.getvalue().encode())
    print(f"\n{given.goal}, means over seeds {given.seeds}, best of {len(trials)} trials:")
    for trial in ranked[:SHOWN]:
        print(f"  {'-' if trial.value is None else format(trial.value, '.4g'):>10}  {_said(trial.params)}")
    print(f"all of them: {folder / TABLE}. The best was chosen by these seeds: believe it when fresh ones say so too")
    return 0 if ranked and ranked[0].value is not None else 1


def _said(settings: Mapping[str, Any]) -> str:
    return " ".join(f"{name}={value:.4g}" if isinstance(value, float) else f"{name}={value}"
                    for name, value in settings.items())


if __name__ == "__main__":
    sys.exit(guarded(main))

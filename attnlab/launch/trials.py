"""A search: Optuna asks for settings and is told what they are worth; what it asks for are runs of the study.

Its journal is in the study's folder, so that the same command goes on where it was stopped, and asks what it would have
asked. What a trial was worth to each seed is kept there too, so that the page needs no tables.
"""

from __future__ import annotations

import hashlib
import math
import shlex
import sys
import warnings
from collections.abc import Mapping, Sequence
from typing import Any

from attnlab.config import TuneSettings, digits_of, that_count
from attnlab.errors import ConfigError
from attnlab.launch.drive import as_typed, complete
from attnlab.launch.expand import Expansion
from attnlab.launch.jobs import check_once
from attnlab.launch.place import check_place
from attnlab.launch.space import axis
from attnlab.launch.worth import goal_of, worth
from attnlab.report.tuned import Seen, Trial, Tuned, page, said, shown
from attnlab.tables.csvs import csv_bytes
from attnlab.tables.files import write_bytes
from attnlab.tables.flat import dig
from attnlab.tables.numbers import mean_of
from attnlab.tables.ranges import compact

JOURNAL, TABLE, PAGE = "tune.journal", "tune.csv", "tune.html"
AGAIN = "again"  # a trial that is tried once more names the one it stands for
BEST = 10  # trials that are printed
FRESH = 20  # seeds that the best is to be believed by


class Tuning:
    """A search as it was asked for, checked: nothing of it has been written. Raises ConfigError."""

    def __init__(self, expansion: Expansion, wanted: TuneSettings, typed: Sequence[str]):
        try:
            import optuna
        except ImportError:
            raise ConfigError("tune.goal", "optuna is not installed", "pip install 'attnlab[tune]'") from None
        self.optuna, self.expansion, self.wanted, self.typed = optuna, expansion, wanted, list(typed)
        optuna.logging.set_verbosity(optuna.logging.WARNING)
        self.measure = goal_of(wanted.goal)
        self.seeds = expansion.seeds or []
        if len(self.seeds) < 2:
            raise ConfigError("seed", "a trial needs several: the best of one seed is that seed's luck", "seed=0-2")
        base = expansion.base()
        self.fresh = bool(base["fresh"])
        self.axes = [axis(override, dig(base, name)) for name, override in expansion.sweeps().items()]
        if not self.axes:
            raise ConfigError("tune", "there is nothing to choose from", "learner.alpha=interval(0.1,0.9)")
        kept = that_count({**base, "seed": 0})
        self.name = digits_of({**kept, "tune": [self.goal, wanted.minimise, self.seeds, *map(repr, self.axes)]})
        tried = {a.name: a.edges for a in self.axes}
        for i in range(max(map(len, tried.values()))):  # what is wrong with a value is said before anything is written
            jobs = expansion.trial({name: values[min(i, len(values) - 1)] for name, values in tried.items()})
        check_once(jobs)
        self.folder = jobs[0].folder.parent
        if jobs[0].settings.cluster["name"] == "slurm":
            raise ConfigError("cluster=slurm", "leaves before runs are done, and a search must know how they ended",
                              "cluster=local within a job, or ray or dask")
        check_place(jobs * wanted.trials)

    @property
    def goal(self) -> str:
        """The measure as it is typed."""
        goal = self.wanted.goal
        return goal if isinstance(goal, str) else "{" + ", ".join(f"{k}: {v}" for k, v in goal.items()) + "}"

    def run(self) -> int:
        """Try what is left to try; 0, or 1 if no trial has a value."""
        states, distributions = self.optuna.trial.TrialState, {a.name: a.distribution() for a in self.axes}
        study = self._study()
        self._again(study)
        self._write(study)
        while True:
            kept = _kept(study)
            done, waiting = sum(t.state.is_finished() for t in kept), any(t.state == states.WAITING for t in kept)
            if done >= self.wanted.trials and not waiting:
                break
            # Its draws depend on how many trials there were: one that was stopped goes on as it would have.
            study.sampler = self.optuna.samplers.TPESampler(seed=_draw(self.name, done))
            trial = study.ask(distributions)
            point = self._point(trial.params)
            values, why = self._play(point)
            value = mean_of(values.values())
            trial.set_user_attr("seeds", {str(seed): found for seed, found in values.items()})
            trial.set_user_attr("why", why)
            study.tell(trial.number, value, state=states.FAIL if value is None else states.COMPLETE,
                       skip_if_finished=True)
            print(f"trial {done + 1} of {max(self.wanted.trials, len(kept))}: "
                  f"{why if value is None else f'{value:.4g}'} with {said(point)}", flush=True)
            self._write(study)
        return self._end(self._write(study, last=True))

    def _study(self) -> Any:
        """The search as it stands in its journal."""
        from optuna.storages import JournalStorage
        from optuna.storages.journal import JournalFileBackend
        self.folder.mkdir(parents=True, exist_ok=True)
        journal = self.folder / JOURNAL
        try:
            storage = JournalStorage(JournalFileBackend(str(journal)))
            if self.fresh and self.name in self.optuna.get_all_study_names(storage):
                self.optuna.delete_study(study_name=self.name, storage=storage)
            return self.optuna.create_study(storage=storage, study_name=self.name, load_if_exists=True,
                                            direction="minimize" if self.wanted.minimise else "maximize")
        except (ValueError, KeyError, TypeError) as cause:
            raise ConfigError(str(journal), f"is no journal that can be read ({' '.join(str(cause).split())})",
                              "Move it away: runs that are there are not run again") from None

    def _again(self, study: Any) -> None:
        """Trials that were stopped, and those that failed, are tried once more, as runs are."""
        states = self.optuna.trial.TrialState
        for trial in _kept(study):
            if trial.state == states.RUNNING:
                study.tell(trial.number, state=states.FAIL, skip_if_finished=True)
            if trial.state in (states.RUNNING, states.FAIL) and set(trial.params) == {a.name for a in self.axes}:
                study.enqueue_trial(trial.params, user_attrs={AGAIN: trial.number})

    def _point(self, params: Mapping[str, Any]) -> dict[str, str]:
        """What Optuna chose, as it is typed."""
        return {a.name: a.text(params[a.name]) for a in self.axes}

    def _play(self, point: Mapping[str, str]) -> tuple[dict[int, float], str]:
        """(what the goal is for each seed, or why it is nothing); what is there already is not run again."""
        jobs = self.expansion.trial(point)
        check_once(jobs)
        failed = complete(jobs, self.typed)
        return ({}, f"{failed[0][0].run}: {failed[0][1]}") if failed else worth(self.measure, jobs)

    def _write(self, study: Any, last: bool = False) -> Tuned:
        """All trials so far as a table and a page."""
        found = self._seen(study, self._importance(study) if last else {})
        names = [a.name for a in self.axes]
        write_bytes(self.folder / TABLE, csv_bytes(
            ["trial", "value", *names, *(f"seed {seed}" for seed in self.seeds), "failed"],
            ([trial.number, "" if trial.value is None else repr(trial.value),
              *(trial.settings[name] for name in names),
              *(repr(trial.seeds[seed]) if seed in trial.seeds else "" for seed in self.seeds), trial.failed]
             for trial in found.ranked())))
        write_bytes(self.folder / PAGE, page(found).encode())
        return found

    def _seen(self, study: Any, importance: Mapping[str, float]) -> Tuned:
        """The search for a reader."""
        trials = []
        for number, trial in enumerate(_kept(study), 1):
            if trial.state.is_finished() and set(trial.params) == {a.name for a in self.axes}:
                about = trial.user_attrs
                trials.append(Trial(number, self._point(trial.params), trial.value,
                                    {int(seed): value for seed, value in about.get("seeds", {}).items()},
                                    str(about.get("why") or "was stopped") if trial.value is None else ""))
        kept = [text for text in as_typed(self.typed)
                if text.partition("=")[0].partition(".")[0].lstrip("+~") not in {"tune", "seed", "study"}
                and text.partition("=")[0].lstrip("+~") not in {a.name for a in self.axes}]
        fresh = max(self.seeds) + 1
        again = [*kept, *(["tune.goal=null"] if any("experiment=" in text for text in kept) else [])]
        rest = [f"seed={fresh}-{fresh + FRESH - 1}", f"study={self.folder.name}_best"]
        return Tuned(self.folder.name, self.goal, str(self.measure.unit), self.wanted.minimise, compact(self.seeds),
                     self.wanted.trials, [Seen(a.name, a.words, a.low, a.high, a.log) for a in self.axes], trials,
                     importance, command(self.typed), {
                         t.number: command([*again, *(f"{self.expansion.key(name)}={text}"
                                                      for name, text in t.settings.items()), *rest]) for t in trials})

    def _importance(self, study: Any) -> dict[str, float]:
        """The share of each setting in what the best trials have in common (PED-ANOVA); empty if it cannot be told."""
        evaluator = self.optuna.importance.PedAnovaImportanceEvaluator()
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("error", UserWarning)  # that they will be equal
                found = self.optuna.importance.get_param_importances(study, evaluator=evaluator)
        except (ValueError, RuntimeError, UserWarning):  # too few trials, or all of one value
            return {}
        return {name: float(value) for name, value in found.items() if math.isfinite(value)}

    def _end(self, found: Tuned) -> int:
        """Say the best."""
        print(f"\n{found.title}, best of {len(found.trials)} trials:")
        for trial in found.ranked()[:BEST]:
            print(f"  {'failed' if trial.value is None else shown(trial.value):>10}  {said(trial.settings)}")
        print(f"table  {self.folder / TABLE}\npage   {self.folder / PAGE}")
        best = found.best
        if best is None:
            print("no trial has a value; the same command tries them again", file=sys.stderr)
            return 1
        print(f"The best was chosen by these seeds. On fresh ones:\n  {found.commands[best.number]}")
        return 0


def _draw(name: str, done: int) -> int:
    """A seed for Optuna: those of neighbours must not look alike, as 0, 1, 2 do to its generator's first draws."""
    return int.from_bytes(hashlib.sha256(f"{name} {done}".encode()).digest()[:4], "big")


def command(arguments: Sequence[str]) -> str:
    """As it is typed."""
    return "python -m attnlab " + shlex.join(arguments)


def _kept(study: Any) -> list[Any]:
    """Optuna's trials in the order in which they were first asked for; one that was tried again stands for itself."""
    found: dict[int, Any] = {}
    home: dict[int, int] = {}
    for trial in study.get_trials(deepcopy=False):
        home[trial.number] = home.get(trial.user_attrs.get(AGAIN, -1), trial.number)
        found[home[trial.number]] = trial
    return [found[number] for number in sorted(found)]

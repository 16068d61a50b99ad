"""All that other code needs, in one place.

For a notebook or a script::

    import attnlab
    config = attnlab.compose("+experiment=cr_vs_ncr", "seed=3")     # one run's config
    tables = attnlab.simulate(config)                               # its five tables, as pandas frames
    study = attnlab.sweep(["+experiment=cr_vs_ncr", "seed=0-4"])    # many runs, kept in outputs/
    attnlab.plot.survival(study)                                    # the report's figures
    attnlab.verdicts(study)                                         # and its verdicts

For a plugin::

    from attnlab.api import Behaviour, Need, register, setting
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from attnlab.behaviours.base import Behaviour, Command, Senses
from attnlab.callbacks.base import Callback
from attnlab.clusters.base import Cluster
from attnlab.curiosity.base import Curiosity
from attnlab.equations import avoid_reward, need_reward
from attnlab.errors import ConfigError
from attnlab.exploration.base import Exploration
from attnlab.figures.base import Figure
from attnlab.fusion.base import Fusion
from attnlab.learners.base import Learner
from attnlab.measures.base import CannotMeasure, Measure, Phase
from attnlab.needs.base import Body, Need, Needs
from attnlab.penalty.base import Penalty
from attnlab.probes.base import Lived, Probe
from attnlab.registry import register
from attnlab.results.load import Studies, Study, load
from attnlab.settings import setting
from attnlab.simulators.base import Blob, Simulator
from attnlab.streams import stream
from attnlab.tables.schema import Column
from attnlab.worlds.base import Layout, World, check_start, outer_walls
from attnlab.worlds.geometry import Solid

if TYPE_CHECKING:
    import pandas as pd

__all__ = [
    "Behaviour", "Blob", "Body", "Callback", "CannotMeasure", "Cluster", "Column", "Command", "ConfigError",
    "Curiosity", "Exploration", "Figure", "Fusion", "Layout", "Learner", "Lived", "Measure", "Need", "Needs", "Penalty",
    "Phase", "Probe", "Senses", "Simulator", "Solid", "Studies", "Study", "Tables", "World", "avoid_reward",
    "check_start", "compose", "load", "need_reward", "outer_walls", "register", "setting", "simulate", "stream",
    "sweep", "verdicts"]


class Tables(NamedTuple):
    """The tables of one run, as pandas frames; docs/tables.md has their columns."""
    episodes: pd.DataFrame
    behaviours: pd.DataFrame
    policy: pd.DataFrame
    cycles: pd.DataFrame
    coverage: pd.DataFrame


def compose(*overrides: str) -> dict[str, Any]:
    """The resolved config of one run, as ``python -m attnlab`` would compose it: ``compose("curiosity=none",
    "seed=3")``. What an experiment sweeps is left at its default. Raises ConfigError as the command line would."""
    from attnlab.cli.calls import composed
    return composed(list(overrides))


def simulate(config: Mapping[str, Any]) -> Tables:
    """Run it here, write nothing. ``config``: from :func:`compose`, changed as you like; it is checked first. Raises
    ConfigError, and what a part raises."""
    import pandas as pd

    from attnlab.loading import load_all
    from attnlab.robot.episodes import play_run
    from attnlab.robot.plan import RunPlan
    from attnlab.tables.schema import TABLES
    load_all()
    tables, _ = play_run(RunPlan(config))
    return Tables(*(pd.DataFrame(tables[name]) for name in TABLES))


def sweep(overrides: Sequence[str]) -> Study:
    """Run what is missing of a study, as the command line does, and return it: ``sweep(["curiosity=litman,none",
    "seed=0-4", "study=mine"])``. Runs that fail are rows of its ``runs``. Raises ConfigError."""
    from attnlab.cli.calls import swept
    return Study(swept(list(overrides)))


def verdicts(study: Study | str | Path, claims: str | None = None) -> pd.DataFrame:
    """What a claims file says of a study, by the rules of the report: a row a comparison, with the columns of
    verdicts.csv and ``word``, the verdict as the page has it (*supported* of one's own). ``claims``: name or path of
    the file; the one that the runs were started under if left out. Raises ConfigError."""
    from io import BytesIO

    import pandas as pd

    from attnlab.claims.files import load_claims
    from attnlab.claims.judge import judge
    from attnlab.claims.roles import strata
    from attnlab.loading import load_all
    from attnlab.report.build import claims_of
    from attnlab.report.verdicts import as_csv
    from attnlab.results.conditions import Conditions
    load_all()
    study = load(study)
    rules = load_claims(claims or claims_of(study))
    conditions = Conditions(study, rules.labels)
    judged = {name: judge(rules, conditions, settings) for name, settings in strata(rules, conditions).items()}
    words = [verdict.word for of in judged.values() for verdict in of for _ in verdict.parts]
    return pd.read_csv(BytesIO(as_csv(judged)), dtype={"unit": str}).assign(word=words)

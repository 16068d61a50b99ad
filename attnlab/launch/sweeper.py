"""Hydra's sweep as a study: every job composed and checked before the first one runs, complete ones left alone.

Registered from the command line under the name ``basic``, in this process only, so that experiment files can be chosen
as usual and no other Hydra application is touched.
"""

from __future__ import annotations

import itertools
import sys
import types
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

from hydra.core.config_search_path import ConfigSearchPath
from hydra.core.config_store import ConfigStore
from hydra.core.override_parser.types import Override
from hydra.core.plugins import Plugins
from hydra.plugins.search_path_plugin import SearchPathPlugin
from hydra.plugins.sweeper import Sweeper
from hydra.types import HydraContext, TaskFunction
from omegaconf import DictConfig, OmegaConf

from attnlab.claims import claims_mark
from attnlab.claims.files import load_claims
from attnlab.config import COSMETIC
from attnlab.errors import ConfigError
from attnlab.groups import GROUPS
from attnlab.launch.compose import Composer
from attnlab.launch.door import MOST_RUNS, Door
from attnlab.launch.jobs import Job, check_different, condition_of, make_job
from attnlab.launch.place import check_place
from attnlab.launch.variants import as_override, read_variants
from attnlab.loading import config_folders
from attnlab.registry import make
from attnlab.robot.plan import RunPlan
from attnlab.tables.ranges import RANGED, seeds

NAMESPACE = "hydra_plugins.attnlab"


class StudySweeper(Sweeper):
    """Expands a sweep to jobs and hands them to :mod:`attnlab.launch.drive`.

    ``exit_code`` is what the process should end with, ``folder`` the study's: Hydra's main returns nothing.
    """
    exit_code = 0
    folder = Path()

    def __init__(self, params: dict[str, str] | None = None):
        self.params = params

    def setup(self, *, hydra_context: HydraContext, task_function: TaskFunction, config: DictConfig) -> None:
        self.loader, self.master = hydra_context.config_loader, config

    def sweep(self, arguments: list[str]) -> None:
        from attnlab.launch.drive import drive
        jobs = self.jobs(arguments)
        check_place(jobs)
        type(self).folder = jobs[0].folder.parent
        type(self).exit_code = drive(jobs, arguments)

    def jobs(self, arguments: Sequence[str]) -> list[Job]:
        """All jobs of the sweep, checked."""
        composer, door = Composer(self.loader, self.master), Door(self.loader)
        merged = self._merged(door, arguments)
        swept = [_name(override) for override in merged.values() if override.is_sweep_override()]
        for name in sorted(name for name in swept if name.partition(".")[0] in COSMETIC):
            raise ConfigError(name, "cannot be swept: all runs of a command go to one study", f"{name}=...")
        _check_size(merged.values())
        node = self.master.variants
        variants = read_variants(OmegaConf.to_container(node) if OmegaConf.is_config(node) else node)
        for together in variants.values():
            for key, value in together.items():
                door.check_setting(key, value)
        jobs: list[Job] = []
        for typed in itertools.product(*(_choices(o) for key, o in merged.items() if key != "seed")):
            for variant, together in variants.items():
                # What is swept or typed for one of a variant's settings gives way: the variant is what is compared.
                overrides = [o for o in typed if _key(o) not in together]
                overrides += [f"{key}={as_override(value)}" for key, value in together.items()]
                values = {key: _value(overrides, key) for key in swept if key != "seed" and key not in together}
                named = list(values)
                if variant is not None:
                    values.update({"variant": variant, **{key: _shown(value) for key, value in together.items()}})
                    named.append("variant")
                jobs += _of_condition(composer.config(overrides), overrides, values, named, merged.get("seed"))
        check_different(jobs)
        _check_once(jobs)
        _check_added(composer, [choices[0] for choices in map(_choices, merged.values())])
        return jobs

    def _merged(self, door: Door, arguments: Sequence[str]) -> dict[str, Override]:
        """Overrides by setting: what the experiment file sweeps, replaced by what is typed."""
        params = []
        for key, value in (self.params or {}).items():
            text = ",".join(map(str, seeds(key, str(value)))) if key in RANGED else value
            params.append(f"{key}={text}")
        merged: dict[str, Override] = {}
        for override in (*door.check(door.in_place(params)), *door.parsed(arguments)):
            name = _name(override)
            several = override.is_add() and name in GROUPS and GROUPS[name].chosen == "list"  # +behaviours=rest
            merged[str(override.input_line) if several else name] = override
        return merged


def _of_condition(config: dict[str, Any], overrides: list[str], values: dict[str, Any], named: list[str],
                  seed: Override | None) -> Iterator[Job]:
    """The jobs of a condition, one a seed; its config is checked once, its world for every seed."""
    condition = condition_of(config, values, overrides)
    numbers = [config["seed"]] if seed is None else [int(o.partition("=")[2]) for o in _choices(seed)]
    plan = None
    for number in numbers:
        plan = RunPlan({**config, "seed": number}) if plan is None else plan.with_seed(number)
        more = [] if seed is None else [f"seed={number}"]
        yield make_job(plan, [*overrides, *more], values, named, condition)


def _check_added(composer: Composer, overrides: Sequence[str]) -> None:
    """What ``+behaviours=rest`` adds must not be there without it: it would be said and change nothing."""
    for text in overrides:
        override = composer.parsed(text)
        group, added = override.key_or_group, str(override.value())
        if not (override.is_add() and group in GROUPS and GROUPS[group].chosen == "list"):
            continue
        without = [other for other in overrides if other != text and f"{group}.{added}." not in other.partition("=")[0]]
        if added in composer.config(without)[group]:
            raise ConfigError(group, f"has '{added}' already, so that +{group}={added} adds nothing", "Leave it out")


def _check_once(jobs: Sequence[Job]) -> None:
    """What is the same for all jobs of a command: the cluster, and the claims file, whose mark they keep."""
    settings = jobs[0].settings
    make("cluster", settings.cluster, None).check()
    load_claims(settings.claims_file)
    claims = claims_mark(settings.claims_file)
    for job in jobs:
        job.claims = claims


def _check_size(overrides: Iterable[Override]) -> None:
    count = 1
    for override in overrides:
        if override.is_discrete_sweep():
            count *= max(1, sum(1 for _ in override.sweep_string_iterator()))
        elif override.is_sweep_override():
            raise ConfigError(override.get_key_element(), "interval(...) cannot be swept over all its values",
                              "List them: a,b,c")
    if count > MOST_RUNS:
        raise ConfigError("-m", f"this sweep has {count:,} runs, more than {MOST_RUNS:,}")


def _choices(override: Override) -> list[str]:
    """An override as a list of plain ones."""
    key = override.get_key_element()
    if override.is_sweep_override():
        return [f"{key}={value}" for value in override.sweep_string_iterator()]
    return [f"{key}={override.get_value_element_as_str()}" if not override.is_delete() else str(override.input_line)]


def _name(override: Override) -> str:
    return str(override.get_key_element().lstrip("+~"))


def _key(override: str) -> str:
    return override.partition("=")[0].lstrip("+~")


def _value(overrides: Sequence[str], key: str) -> Any:
    import yaml
    text = next(o.partition("=")[2] for o in overrides if _key(o) == key)
    value = yaml.safe_load(text) if text[:1] not in "[{" else text
    return _shown(value) if value is not None else text


def _shown(value: Any) -> Any:
    return value if isinstance(value, (int, float, bool, str)) else str(value)


class PluginFolders(SearchPathPlugin):
    """plugins/ may hold config groups too: plugins/world/mine.yaml is ``world=mine``."""

    def manipulate_search_path(self, search_path: ConfigSearchPath) -> None:
        for folder in config_folders():
            search_path.append(provider="attnlab", path=f"file://{folder}")


def register_with_hydra() -> None:
    """Make Hydra use the above in this process."""
    plugins = Plugins.instance()
    # Hydra instantiates plugins of the hydra_plugins namespace alone. A module installed there would be imported by
    # every Hydra application of the environment, so this one goes by that name in this process only.
    try:
        import hydra_plugins as namespace
    except ImportError:
        namespace = sys.modules["hydra_plugins"] = types.ModuleType("hydra_plugins")
        namespace.__path__ = []
    namespace.attnlab = sys.modules[NAMESPACE] = sys.modules[__name__]
    for part in (StudySweeper, PluginFolders):
        part.__module__ = NAMESPACE
        plugins.register(part)
    ConfigStore.instance().store(group="hydra/sweeper", name="basic", provider="attnlab", node={
        "_target_": f"{NAMESPACE}.StudySweeper", "params": None})

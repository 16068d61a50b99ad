"""Hydra's sweep as a study: every job composed and checked before the first one runs, complete ones left alone.

Registered from the command line under the name ``basic``, in this process only, so that experiment files and
launchers from other packages can be chosen as usual and no other Hydra application is touched.
"""

from __future__ import annotations

import copy
import itertools
import sys
import types
from collections.abc import Sequence
from typing import Any

from hydra.core.config_store import ConfigStore
from hydra.core.override_parser.overrides_parser import OverridesParser
from hydra.core.plugins import Plugins
from hydra.plugins.search_path_plugin import SearchPathPlugin
from hydra.plugins.sweeper import Sweeper
from omegaconf import OmegaConf, open_dict

from attnlab.errors import ConfigError
from attnlab.launch.ranges import RANGED, seeds
from attnlab.launch.study import Job, check_place, make_job
from attnlab.launch.variants import as_override, read_variants
from attnlab.loading import config_folders

MOST_RUNS = 100_000
NAMESPACE = "hydra_plugins.attnlab"


class StudySweeper(Sweeper):
    """Expands a sweep to jobs and hands them to :mod:`attnlab.launch.drive`.

    ``exit_code`` is what the process should end with: Hydra's main returns nothing.
    """
    exit_code = 0

    def __init__(self, params: dict[str, str] | None = None):
        self.params = params

    def setup(self, *, hydra_context, task_function, config) -> None:
        self.hydra_context, self.task_function, self.config = hydra_context, task_function, config

    def sweep(self, arguments: list[str]) -> None:
        from attnlab.launch.drive import drive
        jobs, swept = self.jobs(arguments)
        check_place(jobs)
        type(self).exit_code = drive(jobs, arguments)

    def jobs(self, arguments: Sequence[str]) -> tuple[list[Job], list[str]]:
        """All jobs of the sweep, checked, and the names of the swept settings (but seed)."""
        parser = OverridesParser.create(config_loader=self.hydra_context.config_loader)
        given = {override.get_key_element(): override for override in parser.parse_overrides(list(arguments))}
        params = []
        for key, value in (self.params or {}).items():
            text = ",".join(map(str, seeds(key, str(value)))) if key in RANGED else value
            params.append(f"{key}={text}")
        merged = {override.get_key_element(): override for override in parser.parse_overrides(params)}
        merged.update(given)  # what is typed replaces what the experiment sweeps
        swept = [key.lstrip("+~") for key, override in merged.items() if override.is_sweep_override()]
        for name in ("study", "outputs", "fresh", "cluster", "labels"):
            if name in swept:
                raise ConfigError(name, "cannot be swept: all runs of a command go to one study", f"{name}=...")
        self._check_size(merged.values())
        variants = read_variants(OmegaConf.to_container(self.config.variants) if self.config.variants else None)
        choices = [[f"{key}={value}" for value in override.sweep_string_iterator()] if override.is_sweep_override()
                   else [f"{key}={override.get_value_element_as_str()}"] for key, override in merged.items()]
        combinations = list(itertools.product(*choices))
        composed: dict[tuple[str, ...], dict] = {}
        jobs: dict[str, Job] = {}
        for typed in combinations:
            for name, together in variants.items():
                # What is swept or typed for one of a variant's settings gives way: the variant is what is compared.
                overrides = [o for o in typed if _key(o) not in together]
                overrides += [f"{key}={as_override(value)}" for key, value in together.items()]
                config = self._compose(tuple(overrides), composed)
                values = {key: self._value(overrides, key) for key in swept if key != "seed"}
                if name is not None:
                    values.update({"variant": name, **{key: _plain(value) for key, value in together.items()}})
                named = [key for key in values if key not in together]
                job = make_job(config, overrides, values, named)
                jobs.setdefault(job.key, job)
        return list(jobs.values()), [key for key in swept if key != "seed"]

    def _check_size(self, overrides) -> None:
        count = 1
        for override in overrides:
            if override.is_discrete_sweep():
                count *= max(1, sum(1 for _ in override.sweep_string_iterator()))
            elif override.is_sweep_override():
                raise ConfigError(override.get_key_element(), "interval(...) cannot be swept over all its values",
                                  "List them: a,b,c")
        if count > MOST_RUNS:
            raise ConfigError("-m", f"this sweep has {count:,} runs, more than {MOST_RUNS:,}")

    def _compose(self, overrides: tuple[str, ...], composed: dict) -> dict[str, Any]:
        """The resolved config of a job; runs that differ in the seed alone are composed once."""
        rest = tuple(o for o in overrides if not o.startswith("seed="))
        if rest not in composed:
            config = self.hydra_context.config_loader.load_sweep_config(self.config, list(rest))
            with open_dict(config):
                config.pop("hydra")
            composed[rest] = OmegaConf.to_container(config, resolve=True)
        config = copy.deepcopy(composed[rest])
        for override in overrides:
            if override.startswith("seed="):
                config["seed"] = int(override.partition("=")[2])
        return config

    @staticmethod
    def _value(overrides: Sequence[str], key: str) -> Any:
        import yaml
        text = next(o.partition("=")[2] for o in overrides if _key(o) == key)
        value = yaml.safe_load(text) if text[:1] not in "[{" else text
        return value if isinstance(value, (int, float, bool, str)) else text


def _key(override: str) -> str:
    return override.partition("=")[0].lstrip("+~")


def _plain(value: Any) -> Any:
    return value if isinstance(value, (int, float, bool, str)) else str(value)


class PluginFolders(SearchPathPlugin):
    """plugins/ may hold config groups too: plugins/world/mine.yaml is ``world=mine``."""

    def manipulate_search_path(self, search_path) -> None:
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

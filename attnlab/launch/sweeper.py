"""Hydra's sweep as a study: every job composed and checked before the first one runs, complete ones left alone.

Registered from the command line under the name ``basic``, in this process only, so that experiment files can be chosen
as usual and no other Hydra application is touched.
"""

from __future__ import annotations

import sys
import types
from collections.abc import Iterable, Sequence
from pathlib import Path

from hydra._internal.sources_registry import SourcesRegistry
from hydra.core.config_search_path import ConfigSearchPath
from hydra.core.config_store import ConfigStore
from hydra.core.override_parser.types import Override
from hydra.core.plugins import Plugins
from hydra.plugins.search_path_plugin import SearchPathPlugin
from hydra.plugins.sweeper import Sweeper
from hydra.types import HydraContext, TaskFunction
from omegaconf import DictConfig, OmegaConf

from attnlab.config import COSMETIC, TuneSettings
from attnlab.errors import ConfigError
from attnlab.groups import GROUPS
from attnlab.launch.compose import Composer
from attnlab.launch.door import MOST_RUNS, Door
from attnlab.launch.expand import Expansion, choices, name_of
from attnlab.launch.foreign import StudyLauncher
from attnlab.launch.harmless import CheckedFiles
from attnlab.launch.jobs import Job, check_once
from attnlab.launch.pilots import UndecidedError, sound
from attnlab.launch.place import check_place
from attnlab.launch.searchpath import SCHEME
from attnlab.launch.variants import read_design, read_variants
from attnlab.loading import config_folders
from attnlab.settings import build
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
        wanted = build(TuneSettings, OmegaConf.to_container(self.master.tune), "tune")
        if wanted.goal is not None:
            from attnlab.launch.trials import Tuning
            tuning = Tuning(self._expansion(arguments), wanted, arguments)
            if self.master.variants is not None:
                raise ConfigError("variants", "are compared, and a search chooses", "Sweep the settings themselves")
            type(self).folder = tuning.folder
            type(self).exit_code = tuning.run()
            return
        try:
            jobs = self.jobs(arguments)
        except UndecidedError as cause:
            print(cause, file=sys.stderr)
            type(self).folder, type(self).exit_code = cause.folder, 1
            return
        check_place(jobs)
        type(self).folder = jobs[0].folder.parent
        type(self).exit_code = drive(jobs, arguments)

    def jobs(self, arguments: Sequence[str]) -> list[Job]:
        """All jobs of the sweep, checked."""
        expansion = self._expansion(arguments)
        _check_size(expansion.merged.values())
        node = self.master.variants
        node = OmegaConf.to_container(node) if OmegaConf.is_config(node) else node
        design = read_design(node)
        jobs = expansion.jobs(read_variants(node) if design is None or design.pilot is None else
                              design.variants(sound(design, expansion, arguments)))
        check_once(jobs)
        return jobs

    def _expansion(self, arguments: Sequence[str]) -> Expansion:
        """What is asked for, as jobs can be made of it."""
        composer, door = Composer(self.loader, self.master), Door(self.loader)
        expansion = Expansion(composer, door, self._merged(door, arguments))
        for name in sorted(name for name in expansion.swept if name.partition(".")[0] in COSMETIC):
            raise ConfigError(name, "cannot be swept: all runs of a command go to one study", f"{name}=...")
        _check_added(composer, [choices(o)[0] for o in expansion.merged.values()
                                if not o.is_sweep_override() or o.is_discrete_sweep()])
        return expansion

    def _merged(self, door: Door, arguments: Sequence[str]) -> dict[str, Override]:
        """Overrides by setting: what the experiment file sweeps, replaced by what is typed."""
        params = []
        for key, value in (self.params or {}).items():
            text = ",".join(map(str, seeds(key, str(value)))) if key in RANGED else value
            params.append(f"{key}={text}")
        merged: dict[str, Override] = {}
        for override in (*door.check(door.in_place(params)), *door.parsed(arguments)):
            name = name_of(override)
            several = override.is_add() and name in GROUPS and GROUPS[name].chosen == "list"  # +behaviours=rest
            merged[str(override.input_line) if several else name] = override
        return merged


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


def _check_size(overrides: Iterable[Override]) -> None:
    count = 1
    for override in overrides:
        if override.is_discrete_sweep():
            count *= max(1, sum(1 for _ in override.sweep_string_iterator()))
        elif override.is_sweep_override():
            raise ConfigError(override.get_key_element(), "interval(...) cannot be swept over all its values",
                              "List them: a,b,c; or look for the best: tune.goal=survival")
    if count > MOST_RUNS:
        raise ConfigError("-m", f"this sweep has {count:,} runs, more than {MOST_RUNS:,}")


class PluginFolders(SearchPathPlugin):
    """plugins/ may hold config groups too: plugins/world/mine.yaml is ``world=mine``."""

    def manipulate_search_path(self, search_path: ConfigSearchPath) -> None:
        for folder in config_folders():
            search_path.append(provider="attnlab", path=f"{SCHEME}://{folder}")


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
    for part in (StudySweeper, PluginFolders, StudyLauncher):
        part.__module__ = NAMESPACE
        plugins.register(part)
    SourcesRegistry.instance().register(CheckedFiles)
    ConfigStore.instance().store(group="hydra/sweeper", name="basic", provider="attnlab", node={
        "_target_": f"{NAMESPACE}.StudySweeper", "params": None})
    ConfigStore.instance().store(group="hydra/launcher", name="basic", provider="attnlab", node={
        "_target_": f"{NAMESPACE}.StudyLauncher"})

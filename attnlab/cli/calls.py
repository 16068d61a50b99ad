"""What the command line does, for Python code."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from attnlab.cli.explain import explain
from attnlab.cli.main import hydra_application, opened
from attnlab.cli.store import store_options
from attnlab.loading import load_all
from attnlab.paths import conf_dir

if TYPE_CHECKING:
    from attnlab.launch.compose import Composer


def composed(overrides: Sequence[str]) -> dict[str, Any]:
    """The resolved config of one run, as plain data. Raises ConfigError."""
    from hydra import compose, initialize_config_dir
    from hydra.errors import HydraException
    from omegaconf import OmegaConf, open_dict
    from omegaconf.errors import OmegaConfBaseException

    from attnlab.launch.compose import named_by_file
    from attnlab.launch.sweeper import register_with_hydra
    load_all()
    store_options()
    register_with_hydra()
    try:
        _, arguments = opened(overrides)
        with initialize_config_dir(str(conf_dir()), version_base="1.3"):
            config = compose("config", arguments, return_hydra_config=True)
        choices = dict(config.hydra.runtime.choices)
        with open_dict(config):
            config.pop("hydra")
        found: dict[str, Any] = OmegaConf.to_container(config, resolve=True)  # type: ignore[assignment]  # a mapping
    except (HydraException, OmegaConfBaseException) as cause:
        raise explain(cause) or cause from None
    return named_by_file(found, choices)


def composer() -> Composer:
    """What composes any number of configs, for a study whose conditions come one after the other."""
    from hydra import compose, initialize_config_dir
    from hydra.core.global_hydra import GlobalHydra

    from attnlab.launch.compose import Composer
    from attnlab.launch.sweeper import register_with_hydra
    load_all()
    store_options()
    register_with_hydra()
    with initialize_config_dir(str(conf_dir()), version_base="1.3"):
        master = compose("config", [], return_hydra_config=True)
        return Composer(GlobalHydra.instance().config_loader(), master)


def swept(overrides: Sequence[str]) -> Path:
    """Run what is missing of the study that these overrides ask for; its folder. Raises ConfigError."""
    from attnlab.launch.foreign import StudyLauncher
    from attnlab.launch.sweeper import StudySweeper
    load_all()
    hydra_application(list(overrides))
    return StudyLauncher.folder if StudyLauncher.kept else StudySweeper.folder

"""What the command line does, for Python code."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from attnlab.cli.argv import normalise
from attnlab.cli.explain import explain
from attnlab.cli.main import hydra_application
from attnlab.cli.store import store_options
from attnlab.loading import load_all
from attnlab.paths import conf_dir


def composed(overrides: Sequence[str]) -> dict[str, Any]:
    """The resolved config of one run, as plain data. Raises ConfigError."""
    from hydra import compose, initialize_config_dir
    from hydra.errors import HydraException
    from omegaconf import OmegaConf
    from omegaconf.errors import OmegaConfBaseException

    from attnlab.launch.sweeper import register_with_hydra
    load_all()
    store_options()
    register_with_hydra()
    arguments = normalise(list(overrides))
    try:
        with initialize_config_dir(str(conf_dir()), version_base="1.3"):
            config = compose("config", arguments)
        found: dict[str, Any] = OmegaConf.to_container(config, resolve=True)  # type: ignore[assignment]  # a mapping
    except (HydraException, OmegaConfBaseException) as cause:
        raise explain(cause, arguments) or cause from None
    return found


def swept(overrides: Sequence[str]) -> Path:
    """Run what is missing of the study that these overrides ask for; its folder. Raises ConfigError."""
    from attnlab.launch.sweeper import StudySweeper
    load_all()
    hydra_application(normalise(list(overrides)))
    return StudySweeper.folder

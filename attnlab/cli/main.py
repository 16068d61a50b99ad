"""``python -m attnlab``: arguments, Hydra, and errors that say what to do."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from typing import Any

from attnlab import __version__, registry
from attnlab.cli.argv import ASKS, normalise
from attnlab.console import guarded, heard
from attnlab.errors import ConfigError, describe
from attnlab.loading import load_all
from attnlab.paths import conf_dir


def main(argv: Sequence[str] | None = None) -> int:
    """Entry point; returns the exit code (0 complete, 1 a run failed, 2 wrong command line or config)."""
    return guarded(_main, argv)


def _main(argv: Sequence[str]) -> int:
    arguments = list(argv)
    if any(flag in arguments for flag in ("--help", "-h")):
        from attnlab.cli.helptext import help_text
        load_all()
        print(help_text())
        return 0
    if "--version" in arguments:
        print(f"attnlab {__version__}")
        return 0
    with heard():
        load_all()
    for file, cause in registry.failures.values():
        print(f"attnlab: {file} did not load and is left out: {describe(cause)}", file=sys.stderr)
    return hydra_application(arguments)


def hydra_application(arguments: list[str]) -> int:
    """Run Hydra's application on these arguments, once they are known to mean something."""
    os.environ["HYDRA_FULL_ERROR"] = "1"  # raise, so that errors can be explained
    import hydra

    from attnlab.cli.explain import explain
    from attnlab.cli.store import store_options
    from attnlab.launch.foreign import StudyLauncher, held_back
    from attnlab.launch.sweeper import StudySweeper, register_with_hydra
    StudySweeper.exit_code = 0
    store_options()
    register_with_hydra()

    @hydra.main(version_base="1.3", config_path=str(conf_dir()), config_name="config")
    def application(config: Any) -> None:
        """Never called: the sweeper does the runs."""

    saved = sys.argv
    try:
        flags, overrides = opened(arguments)
        overrides = held_back(overrides)
        if not any(flag.partition("=")[0] in (*ASKS, "-m", "--multirun") for flag in flags):
            flags = ["-m", *flags]  # every invocation is a study, if of one run
        sys.argv = ["attnlab", *flags, *overrides]
        application()
    except (ConfigError, KeyboardInterrupt):
        raise
    except SystemExit as end:  # Hydra's own word on a flag, which it has said
        return 2 if end.code else 0
    except Exception as cause:
        problem = None if os.environ.get("ATTNLAB_DEBUG") else explain(cause)
        if problem is None and StudyLauncher.failed:  # as a sweeper does that was told of it
            print(f"attnlab: the sweeper stopped: {describe(cause)}", file=sys.stderr)
            return 1
        if problem is None:
            raise
        raise problem from None
    finally:
        sys.argv = saved
    return 1 if StudyLauncher.failed else StudySweeper.exit_code


def opened(arguments: Sequence[str]) -> tuple[list[str], list[str]]:
    """(flags, overrides) after the door's checks. Raises ConfigError. Parts must be stored in Hydra already."""
    from hydra import initialize_config_dir
    from hydra.core.global_hydra import GlobalHydra

    from attnlab.launch.door import Door
    flags, overrides = normalise(list(arguments))
    with initialize_config_dir(str(conf_dir()), version_base="1.3"):
        door = Door(GlobalHydra.instance().config_loader())
        overrides = door.in_place(overrides)
        door.check(overrides)
    return flags, overrides

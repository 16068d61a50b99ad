"""One run read back."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from attnlab.errors import ConfigError
from attnlab.results.states import state_of
from attnlab.tables.study import FILE

if TYPE_CHECKING:
    import pandas as pd


def no_run(folder: Path, why: str) -> ConfigError:
    """The error for a folder that is no complete run; of a study it names a run."""
    if not folder.is_dir():
        why = "there is no such folder"
    elif (folder / FILE).is_file():
        runs = sorted(path.parent for path in folder.glob("*/run.json"))
        return ConfigError(str(folder), "is a study, not a run of one", f"One of its runs: {runs[0]}" if runs else
                           "It has none yet")
    return ConfigError(str(folder), f"no complete run ({why})", "Name a run: outputs/<study>/<run>")


def read_run(folder: Path) -> tuple[pd.DataFrame, dict[str, Any]]:
    """(cycles of the last recorded episode, config) of a complete run."""
    import pandas as pd
    import yaml
    status, why, _ = state_of(folder)
    if status != "complete":
        raise no_run(folder, f"{status}: {why}")
    cycles = pd.read_parquet(folder / "cycles.parquet")
    if cycles.empty:
        raise ConfigError(str(folder), "no episode's cycles were stored", "Run it again with record=last")
    last = cycles[["phase", "episode"]].iloc[-1]
    chosen = cycles[(cycles["phase"] == last["phase"]) & (cycles["episode"] == last["episode"])]
    return chosen.reset_index(drop=True), yaml.safe_load((folder / "config.yaml").read_text())

"""One run read back."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from attnlab.errors import ConfigError
from attnlab.results.states import state_of

if TYPE_CHECKING:
    import pandas as pd


def read_run(folder: Path) -> tuple[pd.DataFrame, dict[str, Any]]:
    """(cycles of the last recorded episode, config) of a complete run."""
    import pandas as pd
    import yaml
    status, why, _ = state_of(folder)
    if status != "complete":
        raise ConfigError(str(folder), f"no complete run ({status}: {why})", "Name a run: outputs/<study>/<run>")
    cycles = pd.read_parquet(folder / "cycles.parquet")
    if cycles.empty:
        raise ConfigError(str(folder), "no episode's cycles were stored", "Run it again with record=last")
    last = cycles[["phase", "episode"]].iloc[-1]
    chosen = cycles[(cycles["phase"] == last["phase"]) & (cycles["episode"] == last["episode"])]
    return chosen.reset_index(drop=True), yaml.safe_load((folder / "config.yaml").read_text())

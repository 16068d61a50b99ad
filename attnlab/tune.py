"""``python -m attnlab.tune --goal MEASURE --search SETTING=LOW:HIGH ...``: settings that make a measure best.

Another way to type ``python -m attnlab +experiment=tune``: flags become its settings, and the same code does it
(:mod:`attnlab.launch.trials`). Needs the extra ``tune``.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from attnlab.console import guarded
from attnlab.errors import ConfigError


def main(argv: Sequence[str]) -> int:
    """Entry point; 0, or 1 if no trial has a value."""
    parser = argparse.ArgumentParser(prog="python -m attnlab.tune", description="Look for settings that make a measure "
                                     "best, by Optuna's sampler; a trial is one run for each seed.")
    parser.add_argument("overrides", nargs="*", help="of all runs, as for python -m attnlab: study=NAME curiosity=none")
    parser.add_argument("--goal", required=True, metavar="MEASURE",
                        help="any measure, or one with settings: '{name: survival, phase: train}'")
    parser.add_argument("--search", action="append", required=True, metavar="SETTING=VALUES",
                        help="LOW:HIGH, log:LOW:HIGH, or words with | between; several times for several settings")
    parser.add_argument("--trials", default="30", metavar="N", help="trials in all (default 30)")
    parser.add_argument("--seeds", default="0-2", help="of each trial (default 0-2)")
    parser.add_argument("--minimise", action="store_true", help="the least is best")
    given = parser.parse_args(list(argv))
    from attnlab.cli.main import main as attnlab
    from attnlab.loading import load_all
    load_all()
    quiet = [f"{name}=false" for name in ("picture", "report") if not any(o.startswith(f"{name}=")
                                                                          for o in given.overrides)]
    return attnlab([f"tune.goal={given.goal}", f"tune.trials={given.trials}",
                    *(["tune.minimise=true"] if given.minimise else []), *map(sweep_of, given.search), *quiet,
                    *given.overrides, f"seed={given.seeds}"])


def sweep_of(text: str) -> str:
    """``SETTING=VALUES`` in the grammar of a sweep. Raises ConfigError."""
    name, _, values = text.partition("=")
    words, ends = values.split("|"), values.removeprefix("log:").split(":")
    if name and len(words) > 1 and all(words):
        return f"{name}={','.join(words)}"
    if name and len(ends) == 2 and all(ends):
        return f"{name}=tag(log,interval({','.join(ends)}))" if values.startswith("log:") else \
            f"{name}=interval({','.join(ends)})"
    raise ConfigError("--search", f"'{text}' says nothing to choose from", "NAME=0.1:0.9, NAME=log:0.01:1 or NAME=a|b")


if __name__ == "__main__":
    sys.exit(guarded(main))

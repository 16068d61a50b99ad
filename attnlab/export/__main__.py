"""``python -m attnlab.export STUDY --csv [--out DIR]``: a study's tables as CSV;
``python -m attnlab.export RUN --mcap | --rerun [--episode N] [--out FILE]``: an episode for the tools of robotics."""

from __future__ import annotations

import argparse
import importlib.util
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from attnlab.console import guarded
from attnlab.errors import ConfigError

FORMATS = {"mcap": ("mcap", ".mcap", "logs"), "rerun": ("rerun", ".rrd", "rerun")}  # module, ending, extra


def main(argv: Sequence[str]) -> int:
    """Entry point; returns 0."""
    parser = argparse.ArgumentParser(prog="python -m attnlab.export",
                                     description="A study's tables, or an episode of a run, in another format.")
    parser.add_argument("study", metavar="STUDY|RUN", help="folder of a study, its name in outputs/, folder of a run")
    kind = parser.add_mutually_exclusive_group()
    kind.add_argument("--csv", action="store_true", help="of a study: comma-separated values, a file a table")
    kind.add_argument("--mcap", action="store_true", help="of a run: an episode as an MCAP log (extra logs)")
    kind.add_argument("--rerun", action="store_true", help="of a run: an episode as a Rerun recording (extra rerun)")
    parser.add_argument("--episode", type=int, help="number of the episode; the last recorded one if left out")
    parser.add_argument("--phase", choices=["train", "validation"], help="of the episode; validation if left out")
    parser.add_argument("--out", type=Path, help="folder of the CSV files (csv/ in the study), or the file "
                                                 "(episode.mcap, episode.rrd in the run)")
    given = parser.parse_args(list(argv))
    for name in FORMATS:
        if getattr(given, name):
            return _episode(name, given)
    if not given.csv:
        raise ConfigError("export", "names no format", "--csv of a study, --mcap or --rerun of a run")
    if given.episode is not None or given.phase is not None:
        raise ConfigError("--episode", "belongs to --mcap and --rerun: --csv has all episodes")
    from attnlab.results.export import export_csv
    from attnlab.results.load import Study, folder_of
    folder = folder_of(given.study)
    for file in export_csv(Study(folder), given.out or folder / "csv"):
        print(file)
    return 0


def _episode(name: str, given: Any) -> int:
    """Write an episode in a format of this name, whole or not at all."""
    module, ending, extra = FORMATS[name]
    if importlib.util.find_spec(module) is None:
        raise ConfigError(f"--{name}", f"needs the package {module}, which is not installed here",
                          f"pip install 'attnlab[{extra}]'")
    out = given.out or Path(given.study) / f"episode{ending}"
    if out.suffix != ending:
        raise ConfigError("--out", f"{out.name} does not end in {ending}", f"--out episode{ending}")
    from attnlab.loading import load_all
    from attnlab.replay.again import live_again
    from attnlab.replay.track import choose, open_run, track_of
    from attnlab.tables.files import whole
    load_all()
    run = open_run(Path(given.study))
    phase, episode, cycles = choose(run, given.phase, given.episode)
    lived = None
    if cycles is None:
        print(f"attnlab: simulating {run.folder.name} again, because its cycles were not recorded", file=sys.stderr)
        lived = live_again(run.plan, run.folder, phase, episode)
    notes: list[str] = []
    track = track_of(run, phase, episode, cycles, lived, notes)
    for note in notes:
        print(f"attnlab: {note}", file=sys.stderr)
    if name == "mcap":
        from attnlab.export.to_mcap import write
    else:
        from attnlab.export.to_rerun import write
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        with whole(out) as temporary:
            write(track, run.plan.layout, temporary)
    except OSError as cause:
        raise ConfigError("--out", f"{out} cannot be written ({cause.strerror or cause})") from None
    print(out)
    return 0


if __name__ == "__main__":
    sys.exit(guarded(main))

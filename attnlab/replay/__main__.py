"""``python -m attnlab.replay RUN``: a page on which an episode of a run is watched, scrubbed, and changed."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from attnlab.console import guarded
from attnlab.errors import ConfigError
from attnlab.loading import load_all
from attnlab.replay.again import live_again
from attnlab.replay.model import why_not
from attnlab.replay.page import page, world_of
from attnlab.replay.track import SURPRISING, Recorded, choose, open_run, track_of
from attnlab.simulators.robot import SONARS
from attnlab.tables.files import write_bytes


def main(argv: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m attnlab.replay",
                                     description="Write a page on which an episode of a run can be watched.")
    parser.add_argument("run", type=Path, help="folder of a complete run")
    parser.add_argument("--episode", type=int, help="number of the episode; the last recorded one if left out")
    parser.add_argument("--phase", choices=["train", "validation"], help="of the episode; validation if left out")
    parser.add_argument("--with", type=Path, dest="other", metavar="RUN2", help="another run beside it")
    parser.add_argument("--out", type=Path, help="the page's file; replay.html in the run's folder if left out")
    parser.add_argument("--quick", action="store_true", help="do not simulate the run again, so without what-if")
    given = parser.parse_args(argv)
    load_all()
    runs = [open_run(folder) for folder in (given.run, given.other) if folder is not None]
    out = given.out or given.run / "replay.html"
    if out.is_dir():
        raise ConfigError("--out", f"{out} is a folder", f"--out {out / 'replay.html'}")
    notes: list[str] = []
    phase, episode, _ = chosen = choose(runs[0], given.phase, given.episode)
    tracks = [_track(runs[0], *chosen, notes, not given.quick)]
    tracks += [_track(run, *choose(run, phase, episode), notes, False) for run in runs[1:]]
    worlds = [world_of(run.plan.layout, SONARS) for run in runs]
    out.parent.mkdir(parents=True, exist_ok=True)
    write_bytes(out, page(tracks, worlds, notes, SURPRISING).encode())
    print(out)
    return 0


def _track(run: Recorded, phase: str, episode: int, cycles: Any, notes: list[str], what_if: bool) -> dict[str, Any]:
    """The track of an episode; the run is simulated again if its cycles were not recorded, or for the what-if."""
    if cycles is None:
        notes.append(f"{run.folder.name}: the cycles of {phase} episode {episode} were not recorded; they are here "
                     "from simulating that run again.")
    lived = None
    if cycles is None or (what_if and not why_not(run.plan, phase)):
        why = "because its cycles were not recorded" if cycles is None else "for the what-if (--quick leaves it out)"
        print(f"attnlab: simulating {run.folder.name} again, {why}", file=sys.stderr)
        lived = live_again(run.plan, run.folder, phase, episode)
    return track_of(run, phase, episode, cycles, lived, notes)


if __name__ == "__main__":
    sys.exit(guarded(main))

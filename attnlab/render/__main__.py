"""``python -m attnlab.render RUN --out run.mp4``: an episode of a run as a film, with what the robot attends to."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from itertools import islice
from pathlib import Path

from attnlab.console import guarded
from attnlab.errors import ConfigError
from attnlab.loading import load_all
from attnlab.render.film import frames, write_gif, write_mp4
from attnlab.replay.again import live_again
from attnlab.replay.track import choose, open_run, track_of
from attnlab.tables.files import whole


def main(argv: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m attnlab.render", description="Film an episode of a run.")
    parser.add_argument("run", type=Path, help="folder of a complete run")
    parser.add_argument("--out", type=Path, help="film.mp4 or film.gif; film.gif in the run's folder if left out")
    parser.add_argument("--episode", type=int, help="number of the episode; the last recorded one if left out")
    parser.add_argument("--phase", choices=["train", "validation"], help="of the episode; validation if left out")
    parser.add_argument("--from", type=int, default=0, dest="first", help="first cycle")
    parser.add_argument("--cycles", type=int, help="how many cycles; all if left out")
    parser.add_argument("--every", type=int, default=4, help="a picture every so many cycles")
    parser.add_argument("--speed", type=float, default=4.0, help="times as fast as the robot")
    given = parser.parse_args(argv)
    out: Path = given.out or given.run / "film.gif"
    if out.suffix not in (".gif", ".mp4"):
        raise ConfigError("--out", f"{out.name} is neither .gif nor .mp4", "--out film.gif")
    for name in ("every", "speed", "cycles"):
        if getattr(given, name) is not None and getattr(given, name) <= 0:
            raise ConfigError(f"--{name}", f"is {getattr(given, name)}, must be more than 0")
    load_all()
    run = open_run(given.run)
    phase, episode, cycles = choose(run, given.phase, given.episode)
    lived = None
    if cycles is None:
        print(f"attnlab: simulating {run.folder.name} again, because its cycles were not recorded", file=sys.stderr)
        lived = live_again(run.plan, run.folder, phase, episode)
    notes: list[str] = []
    track = track_of(run, phase, episode, cycles, lived, notes)
    for note in notes:
        print(f"attnlab: {note}", file=sys.stderr)
    if not 0 <= given.first < track["n"]:
        raise ConfigError("--from", f"is {given.first}; the episode has cycles 0 to {track['n'] - 1}")
    with run.plan.simulator(validation=phase == "validation") as simulator:
        fov_rad = simulator.camera.fov_rad
    skip = given.first // given.every
    wanted = None if given.cycles is None else skip + max(1, given.cycles // given.every)
    pictures = islice(frames(track, run.plan.layout, fov_rad, given.every), skip, wanted)
    seconds = track["dt"] * given.every / given.speed  # of a picture
    out.parent.mkdir(parents=True, exist_ok=True)
    with whole(out) as temporary:
        if out.suffix == ".gif":
            write_gif(list(pictures), temporary, max(20, round(1000 * seconds)))
        else:
            write_mp4(pictures, temporary, 1 / seconds)
    print(out)
    return 0


if __name__ == "__main__":
    sys.exit(guarded(main))

"""A log of a real robot, lived through again: everything is as it was recorded, whatever the robot would do."""

from __future__ import annotations

import hashlib
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass, fields
from functools import lru_cache
from math import ceil
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from attnlab.errors import ConfigError
from attnlab.logs.base import LogSettings
from attnlab.logs.file import Log
from attnlab.logs.rows import SHORTEST, Rows
from attnlab.reading import Reading
from attnlab.registry import register
from attnlab.settings import setting
from attnlab.simulators.base import Blob, SensorParams, Simulator, SimulatorContext
from attnlab.simulators.robot import SONARS
from attnlab.worlds.floor import LONGEST_M

OF_THE_LOG = [field.name for field in fields(LogSettings)]
LONGEST_CYCLE_S = 1.0  # of reading.dt_s


@register("simulator", "log")
class Logged(Simulator):
    """A robot's log (docs/logs.md) cut into blocks of equal length: an episode is a stretch of a block without holes.

    Every second block is for training, whose episodes go through them again and again, the others for validation. In
    cycle k sensors give what the log has at its k-th cycle, when they are asked. Distances are those of the log's
    sensor, no radius is added; nothing is in view of a camera, nothing is run into. The pose is the log's, shifted to a
    bare floor (``world=floor``), or NaN if it has none. Commands change nothing: only behaviours that name this
    simulator work in it. Draws nothing at random.
    """
    recorded = True
    interpreted = "what it shows is read from a file"

    @dataclass
    class Params(SensorParams, LogSettings):
        file: str = setting("", "the log: CSV, CARMEN, MRPT rawlog or MCAP, perhaps gzipped")
        format: Literal["csv", "carmen", "rawlog", "mcap"] | None = setting(None, "of the file; told from its content "
                                                                            "if left out")
        blocks: int = setting(8, "parts of equal length", low=2, high=100_000)
        held_out: Literal["odd", "even"] = setting(
            "odd", "blocks, counted from 0, that validation has and training has not; odd,even exchanges them")
        cycle: Literal["scan", "time"] = setting(
            "scan", "a machine cycle is a scan of the log, which sets reading.dt_s, or it takes reading.dt_s and shows "
            "the last scan until then")
        hearing: Literal["cones", "sectors"] = setting(
            "cones", "a sonar hears the nearest beam within 7.5 degrees of its axis (15 if there is none), or of all "
            "beams that are nearer to its axis than to another's")
        poses: bool = setting(True, "the log's poses; false: none")
        sha256: str | None = setting(None, "of the file, in hexadecimal digits; found out if left out")

    params: Params

    def __init__(self, params: Params, context: SimulatorContext):
        super().__init__(params, context)
        self._rows = rows_of(params, context.dt_s)
        self.dt_s = self._rows.cycle_s
        blocks = self._rows.stretches(params.blocks)
        odd, even = ([stretch for block in blocks[first::2] for stretch in block] for first in (1, 0))
        self._train, self._held_out = (even, odd) if params.held_out == "odd" else (odd, even)
        if not (odd and even):
            raise ConfigError("simulator.blocks", f"{params.blocks} blocks of the {self._rows.count} cycles of "
                              f"{Path(params.file).name} leave training or validation without an episode of {SHORTEST} "
                              "cycles", "Ask for fewer blocks, or take a longer log")
        longest = max(high - low for low, high in odd + even)
        if longest > context.max_cycles:
            raise ConfigError("simulator.blocks", f"an episode would have {longest} cycles, and max_cycles is "
                              f"{context.max_cycles}", f"max_cycles={longest}, or simulator.blocks="
                              f"{ceil(self._rows.count / context.max_cycles)}")
        self.begin("train", 0)

    @classmethod
    def settles(cls, params: Params, config: Mapping[str, Any]) -> dict[str, Any]:
        reading, world = config.get("reading") or {}, (config.get("world") or {}).get("name")
        dt_s = float(reading.get("dt_s", Reading.dt_s))
        rows = rows_of(params, dt_s)
        if world not in (None, "paper", "layout", "floor"):  # the first two are defaults
            raise ConfigError(f"world={world}", "a log has no other world than its own", "Leave it out")
        if rows.cycle_s > LONGEST_CYCLE_S:
            raise ConfigError("simulator.file", f"{Path(params.file).name} has a scan every {rows.cycle_s:.3g} s: it "
                              "was thinned, and when to look cannot be judged on it",
                              "It can be appraised: python -m attnlab.appraise --log FILE")
        if params.cycle == "scan" and dt_s not in (Reading.dt_s, rows.cycle_s):
            raise ConfigError("reading.dt_s", f"is {dt_s:g} s, and a cycle is a scan of the log, {rows.cycle_s:g} s",
                              "Leave it out, or take simulator.cycle=time")
        if max(rows.width_m, rows.depth_m) > LONGEST_M:
            raise ConfigError("simulator.poses", f"the path of {Path(params.file).name} spans "
                              f"{max(rows.width_m, rows.depth_m):,.0f} m, and a floor has {LONGEST_M:g} at most",
                              "simulator.poses=false leaves it out")
        size = {"width_m": ceil(rows.width_m * 10) / 10, "depth_m": ceil(rows.depth_m * 10) / 10}
        return {"simulator": {**config["simulator"], "sha256": sha256_of(params.file)},
                "world": {"name": "floor", **size}, "reading": {**reading, "dt_s": rows.cycle_s}}

    def told(self) -> list[str]:
        return [f"{Path(self.params.file).name}: {line}" for line in self._rows.told]

    def begin(self, phase: str, episode: int) -> tuple[int, tuple[float, float, float]]:
        mine = self._held_out if phase == "validation" else self._train
        self._stretch = low, high = mine[episode % len(mine)]
        self._shown = self._rows.read(low, high - low)
        x, y, heading = self._shown[0, :3].tolist()
        return high - low, (x, y, heading)

    def place(self, x: float, y: float, heading: float) -> None:
        """Start the episode that :meth:`begin` chose anew; where it starts is the log's to say."""
        n = len(self._shown)
        self.cycle, self.trace[:n], self.trace[n] = 0, self._shown[:, :3], self._shown[-1, :3]

    def sonar(self, count: int = len(SONARS)) -> list[float]:
        found: list[float] = self._shown[min(self.cycle, len(self._shown) - 1), 3:3 + count].tolist()
        return found

    def echoes(self, count: int = len(SONARS)) -> list[float]:
        return self.sonar(count)

    def gaps(self) -> npt.NDArray[np.float64]:
        after = np.minimum(np.arange(1, self.cycle + 1), len(self._shown) - 1)
        nearest: npt.NDArray[np.float64] = self._shown[after, 3:11].min(axis=1)
        return nearest

    def blobs(self) -> list[Blob]:
        return []

    def advance(self, v: float, w: float, cycles: int) -> tuple[int, bool]:
        self.cycle += cycles
        return cycles, False

    def snapshot(self) -> Any:
        return self._stretch, super().snapshot()

    def restore(self, state: Any) -> None:
        self._stretch, kept = state
        self._shown = self._rows.read(self._stretch[0], self._stretch[1] - self._stretch[0])
        self.place(*self._shown[0, :3])
        super().restore(kept)


def rows_of(params: Logged.Params, dt_s: float) -> Rows:
    """The cycles of the log that is named, read once a process. Raises ConfigError."""
    if not params.file:
        raise ConfigError("simulator.file", "names no log", "simulator.file=FILE; docs/logs.md says how to get some")
    try:
        found = sha256_of(params.file)
        if params.sha256 not in (None, found):
            raise ConfigError("simulator.file", f"{params.file} is not the file that was named: its sha256 is {found}",
                              "Leave out simulator.sha256 to take it as it is")
        settings = tuple(getattr(params, name) for name in OF_THE_LOG)
        return _read(str(Path(params.file).expanduser()), found, params.format, settings, params.sonar_range_m,
                     params.hearing, dt_s if params.cycle == "time" else None, params.poses)
    except OSError as cause:
        raise ConfigError("simulator.file", f"{params.file} cannot be read, or its cycles not be kept in "
                          f"{tempfile.gettempdir()} ({cause.strerror})", "TMPDIR names another folder") from None
    except ConfigError as error:
        where = {"log": "simulator.file"}.get(error.setting, error.setting)
        raise ConfigError(where if where.startswith("simulator.") else f"simulator.{where}", error.problem,
                          error.hint) from None


@lru_cache(maxsize=4)
def _read(file: str, _sha256: str, kind: str | None, settings: tuple[Any, ...], *how: Any) -> Rows:
    """A file that was changed is read again."""
    return Rows(Log(file, LogSettings(**dict(zip(OF_THE_LOG, settings, strict=True))), kind), *how)


def sha256_of(file: str) -> str:
    """Of a file's bytes. Raises ConfigError if there is none."""
    path = Path(file).expanduser()
    if not path.is_file():
        raise ConfigError("simulator.file", f"there is no file {file}", "docs/logs.md says how to get logs")
    about = path.stat()
    return _digest(str(path), about.st_size, about.st_mtime_ns, about.st_ino)


@lru_cache(maxsize=16)
def _digest(path: str, *_: int) -> str:
    with Path(path).open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()

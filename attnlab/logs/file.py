"""A log's file: what format it has, and its scans, checked one by one."""

from __future__ import annotations

import gzip
import io
import re
import zlib
from collections.abc import Iterator
from contextlib import suppress
from math import isfinite, isnan, nan
from pathlib import Path
from typing import IO, cast

from attnlab.errors import ConfigError, nearest
from attnlab.logs import carmen, csv, mcap, rawlog
from attnlab.logs.base import Ledger, LogSettings, Raw, Reader, Scan

READERS: dict[str, Reader] = {"csv": csv.read, "carmen": carmen.read, "rawlog": rawlog.read, "mcap": mcap.read}
GZIP, MCAP = b"\x1f\x8b", b"\x89MCAP0\r\n"
PEEK = 1 << 16
CARMEN = re.compile(rb"^(#|PARAM |ODOM |FLASER |RLASER |ROBOTLASER1 |RAWLASER1 |SYNC |TRUEPOS )", re.MULTILINE)
RAWLOG = re.compile(rb"^[\x81-\xbf](?:mrpt::[a-z]+::)?C[A-Z]\w+[\x00-\x20]")


class Log:
    """The scans of a file, read as they are asked for; each pass reads it anew and has a ledger of its own.

    Guaranteed of what comes: times rise, poses are finite, every scan has the beams of the first one, and each range is
    within [range_min, range_max] or NaN, where range_max means that nothing was heard. Everything else is in
    ``ledger``. Raises ConfigError if there is no such file, or it is of no format known here.
    """

    def __init__(self, path: Path | str, settings: LogSettings | None = None, kind: str | None = None):
        self.path, self.settings = Path(path), settings or LogSettings()
        self.ledger = Ledger()
        if not self.path.is_file():
            raise ConfigError("log", f"there is no file {self.path}")
        if kind is not None and kind not in READERS:
            raise ConfigError("log", f"no format is called '{kind}'", nearest(kind, READERS))
        with self._open(Ledger()) as stream:
            found = format_of(stream.read(PEEK))
        if kind is not None and found != kind and not (kind == "csv" and found is None):
            raise ConfigError("log", f"{self.path.name} is no {kind} file", f"It looks like {found}" if found else "")
        if found is None:
            raise ConfigError("log", f"{self.path.name} is of no format known here", f"Known: {', '.join(READERS)}; "
                              "docs/logs.md tells how each begins")
        self.kind = found
        ending = Path(self.path.name.removesuffix(".gz")).suffix
        named = {".csv": "csv", ".mcap": "mcap", ".rawlog": "rawlog"}.get(ending)
        self._lies = f"named as {named}, it holds {found}" if named and named != found else ""

    def _open(self, ledger: Ledger) -> IO[bytes]:
        with self.path.open("rb") as file:
            packed = file.read(2) == GZIP
        if not packed:
            return self.path.open("rb")
        return cast(IO[bytes], io.BufferedReader(_Unpacked(self.path, ledger), PEEK))

    def __iter__(self) -> Iterator[Scan]:
        self.ledger = ledger = Ledger()
        if self._lies:
            ledger.note(self._lies)
        beams, last, silent = None, float("-inf"), True
        with self._open(ledger) as stream:
            for raw in READERS[self.kind](stream, self.settings, ledger):
                beams = beams or raw.beams
                reason = problem(raw, len(beams.bearings_rad), last)
                if reason:
                    ledger.skip(reason, raw.place)
                    continue
                ranges = heard(raw)
                missing = sum(r != r for r in ranges)  # those that are NaN
                if missing == len(ranges):
                    ledger.skip("scan without a valid beam", raw.place)
                    continue
                if missing:
                    ledger.skip("beam without a valid range", raw.place, missing)
                if raw.time_s - last > self.settings.hole_s and last > float("-inf"):
                    ledger.skip(f"hole of more than {self.settings.hole_s:g} s", raw.place)
                last = raw.time_s
                silent = silent and min(r for r in ranges if not isnan(r)) >= raw.beams.range_max_m
                yield Scan(raw.time_s, ranges, raw.beams, raw.pose)
        if beams is None:
            ledger.note("it holds no scan")
        elif silent and last > float("-inf"):
            ledger.note(f"no beam ever heard anything within {beams.range_max_m:g} m: are its ranges metres?")


def problem(raw: Raw, count: int, last_s: float) -> str:
    """Why a scan cannot be used, or nothing."""
    if not isfinite(raw.time_s):
        return "scan without a time"
    if raw.time_s <= last_s:
        return "scan whose time does not rise"
    if len(raw.ranges_m) != count or len(raw.beams.bearings_rad) != count:
        return "scan of another number of beams"
    if not all(map(isfinite, raw.beams.bearings_rad)):
        return "scan without bearings"
    if raw.pose is not None and not all(map(isfinite, raw.pose)):
        return "scan without a finite pose"
    return ""


def heard(raw: Raw) -> tuple[float, ...]:
    """The ranges, each within what can be heard: range_max beyond it (infinite ones too), NaN where there is none."""
    _, low, high = raw.beams
    return tuple(high if r >= high else r if r >= low and r > 0.0 else nan for r in raw.ranges_m)


def format_of(start: bytes) -> str | None:
    """The format that a file's first bytes show."""
    if start.startswith(MCAP):
        return "mcap"
    if RAWLOG.match(start):
        return "rawlog"
    if b"\0" in start:
        return None
    if CARMEN.search(start):
        return "carmen"
    first = next((line for line in start.splitlines() if line.strip()), b"")
    return "csv" if b"," in first else None


class _Unpacked(io.RawIOBase):
    """A gzip file that may be cut off or damaged: it ends there, and the ledger knows."""

    def __init__(self, path: Path, ledger: Ledger):
        self._file, self._ledger, self._done = gzip.open(path), ledger, 0  # noqa: SIM115  closed with this
        self._broken = False

    def readable(self) -> bool:
        return True

    def readinto(self, buffer: bytearray | memoryview) -> int:  # type: ignore[override]
        data = b""
        try:
            data = b"" if self._broken else self._file.read1(len(buffer))
        except (EOFError, gzip.BadGzipFile, zlib.error):
            self._broken = True
            self._ledger.skip("gzip file that is cut off or damaged: what came before it was read",
                              f"after {self._done} bytes")
        buffer[:len(data)] = data
        self._done += len(data)
        return len(data)

    def close(self) -> None:
        with suppress(OSError):
            self._file.close()
        super().close()

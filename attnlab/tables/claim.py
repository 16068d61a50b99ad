"""Who does a run: a folder that one process alone can make, kept fresh for as long as it works.

``STUDY/.claims/KEY.N/`` holds ``owner.json`` (who) and ``beat`` (how far: episodes and cycles). It is made whole and
renamed into place, which one process alone can do. It is dead if its process is gone (told on its own machine), or if
nothing was heard of it for ``PATIENCE_S``, both times by the file server's clock. Who finds a dead claim makes the one
of the next number, which again one alone can do; the highest number counts, and who lost his must write no more.
"""

from __future__ import annotations

import contextlib
import os
import platform
import secrets
import shutil
import threading
import time
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from attnlab.tables.files import read_json, write_json
from attnlab.tables.processes import birth, is_running

FOLDER = ".claims"
BEAT_S = 5.0  # between two signs of life
PATIENCE_S = 120.0  # without one: longer than a file server's clients keep old times (NFS: 60 s)


@dataclass(frozen=True)
class Claim:
    """A claim that was ours when it was made. ``path``: its folder; ``token``: ours alone."""
    path: Path
    token: str

    def beat(self, episodes: int = 0, cycles: int = 0) -> None:
        """A sign of life, and how far the run is. It keeps no claim alive that is not ours."""
        if not self.held():
            return
        with contextlib.suppress(OSError), (self.path / "beat").open("r+b", buffering=0) as file:
            file.write(b"%012d %015d\n" % (episodes, cycles))

    def held(self) -> bool:
        """Is it still ours?"""
        key, _, number = self.path.name.rpartition(".")
        return (read_json(self.path / "owner.json") or {}).get("token") == self.token and \
            max(_numbers(self.path.parent, key), default=-1) == int(number)

    def release(self) -> None:
        """Give it back; nothing happens if it is ours no more."""
        if (read_json(self.path / "owner.json") or {}).get("token") == self.token:
            _remove(self.path)


class Standing(NamedTuple):
    """What a claim says from outside. ``working_s``: from its beginning to its last sign of life, ``silent_s``: since
    then; ``dead``: empty, or why."""
    key: str
    owner: dict[str, Any]
    episodes: int
    cycles: int
    working_s: float
    silent_s: float
    dead: str


def take(study: Path, key: str) -> Claim | None:
    """The claim on the run with this key, or None if somebody who is alive has it."""
    home = study / FOLDER
    home.mkdir(parents=True, exist_ok=True)
    while True:
        numbers = _numbers(home, key)
        last = max(numbers, default=0)
        if last:
            found = _standing(home / f"{key}.{last}", None)
            if found is None:  # given back in this moment
                continue
            if not found.dead:
                return None
        claim = _made(home, key, last + 1)
        if claim is None:  # somebody was faster
            continue
        if not claim.held():  # a listing may miss what is made while it is read
            claim.release()
            return None
        for number in numbers:
            _remove(home / f"{key}.{number}")
        return claim


def standings(study: Path) -> dict[str, Standing]:
    """All claims of a study by key."""
    home, found = study / FOLDER, dict[str, Standing]()
    names = sorted(_names(home), key=lambda name: int(name.rpartition(".")[2]))
    clock = server_time(home) if names else 0.0
    for name in names:
        standing = _standing(home / name, clock)
        if standing is not None:
            found[standing.key] = standing
    return found


def sweep(study: Path) -> None:
    """Remove what killed processes left half made."""
    home = study / FOLDER
    left = list(home.glob(".*")) if home.is_dir() else []
    clock = server_time(home) if left else 0.0
    for path in left:
        with contextlib.suppress(OSError):
            if clock - path.stat().st_mtime > PATIENCE_S:
                shutil.rmtree(path, ignore_errors=True) if path.is_dir() else path.unlink()


def clear(study: Path, done: Collection[str]) -> None:
    """Remove what killed processes kept on the complete runs with these keys."""
    home = study / FOLDER
    for name in _names(home):
        standing = _standing(home / name, None) if name.rpartition(".")[0] in done else None
        if standing is not None and standing.dead:
            _remove(home / name)


@contextlib.contextmanager
def beating(claim: Claim) -> Iterator[list[int]]:
    """Signs of life from a thread while the block works; it sets the list to [episodes, cycles] as it goes on."""
    far, done = [0, 0], threading.Event()

    def beat() -> None:
        while not done.wait(BEAT_S):
            claim.beat(*far)
    thread = threading.Thread(target=beat, daemon=True)
    thread.start()
    try:
        yield far
    finally:
        done.set()
        thread.join()


@cache
def place() -> str:
    """Where processes can see each other: a machine since it was started, and there a namespace of process numbers."""
    found = [platform.node()]
    with contextlib.suppress(OSError):
        found.append(Path("/proc/sys/kernel/random/boot_id").read_text().strip())
    with contextlib.suppress(OSError):
        found.append(str(Path("/proc/self/ns/pid").readlink()))
    return " ".join(found)


def server_time(home: Path) -> float:
    """The clock (s) by which files in this folder get their times. A clock that cannot be asked is ours."""
    probe = home / f".now.{secrets.token_hex(4)}"
    try:
        probe.touch()
        return probe.stat().st_mtime
    except OSError:
        return time.time()
    finally:
        with contextlib.suppress(OSError):
            probe.unlink()


def _names(home: Path) -> list[str]:
    try:
        return [name for name in os.listdir(home)  # noqa: PTH208  names are wanted
                if name[0] != "." and name.rpartition(".")[2].isdigit()]
    except OSError:
        return []


def _numbers(home: Path, key: str) -> list[int]:
    return [int(name.rpartition(".")[2]) for name in _names(home) if name.rpartition(".")[0] == key]


def _made(home: Path, key: str, number: int) -> Claim | None:
    token = secrets.token_hex(8)
    draft, path = home / f".{key}.{token}", home / f"{key}.{number}"
    draft.mkdir()
    write_json(draft / "owner.json", {"token": token, "place": place(), "host": platform.node(), "pid": os.getpid(),
                                      "pid_birth": birth(os.getpid())})
    (draft / "beat").write_bytes(b"%012d %015d\n" % (0, 0))
    try:
        draft.rename(path)  # refused if it is there: no claim is ever an empty folder
    except OSError:
        shutil.rmtree(draft, ignore_errors=True)
        return None
    return Claim(path, token)


def _remove(path: Path) -> None:
    gone = path.with_name(f".{path.name}.{secrets.token_hex(4)}")
    with contextlib.suppress(OSError):
        path.rename(gone)
        shutil.rmtree(gone, ignore_errors=True)


def _standing(path: Path, clock: float | None) -> Standing | None:
    """What is to be said of a claim; None if it is there no more."""
    try:
        text = (path / "beat").read_text()  # first, so that its time is never older than what it says
        last, begun = ((path / name).stat().st_mtime for name in ("beat", "owner.json"))
    except OSError:
        return None if not path.exists() else Standing(path.name.rpartition(".")[0], {}, 0, 0, 0.0, 0.0, "half made")
    owner = read_json(path / "owner.json") or {}
    silent = max(0.0, (server_time(path.parent) if clock is None else clock) - last)
    dead = ""
    if owner.get("place") == place() and not is_running({**owner, "host": platform.node()}, 0.0):
        dead = f"process {owner.get('pid')} of {owner.get('host')} is gone"
    elif silent > PATIENCE_S:
        dead = f"nothing was heard of process {owner.get('pid')} of {owner.get('host')} for {silent:.0f} s"
    words = text.split()
    far = [int(word) for word in words] if len(words) == 2 and all(map(str.isdigit, words)) else [0, 0]
    return Standing(path.name.rpartition(".")[0], owner, far[0], far[1], last - begun, silent, dead)

"""The compiled engine: plays an agent's episodes from the same objects, and leaves them as the interpreted one does."""

from __future__ import annotations

import hashlib
import re
from pathlib import Path
from typing import Any
from zlib import crc32

import numpy as np

from attnlab.attention import Activation
from attnlab.compiled.entry import Died, Episode, entries
from attnlab.compiled.layout import Memory
from attnlab.compiled.methods import sources
from attnlab.cycle import Agent
from attnlab.exploration.base import Exploration
from attnlab.penalty.base import check_shares
from attnlab.tables.code import package_hash

# What the recorder and the checks ask of an agent's objects when an episode has ended.
SEEN = {"body": ("values", "energy", "meals"), "simulator": ("cycle",), "history": ("rows",)}
ATTENTION = ("action", "command")


class Uncompilable(Exception):
    """These parts do not compile; the message says which and why, on one line."""


class Compiled:
    """Plays episodes as :func:`attnlab.robot.episode.run_episode` does. The parts' objects are laid out in memory once;
    after an episode those have what the recorder reads, after :meth:`finish` all of it.

    Raises :class:`Uncompilable`. ``explorations``: those that will be used, compiled at once. With ``only_kept``
    nothing is compiled: ``is_there`` says whether the code was on the disk. ``looks``: the tables of all logs, in the
    order of the behaviours.
    """

    def __init__(self, agent: Agent, explorations: list[Exploration], only_kept: bool = False):
        self.looks = np.zeros((len(agent.attentions), agent.max_cycles + 1, len(Activation._fields)))
        for attention, table in zip(agent.attentions, self.looks, strict=True):
            attention.log.table, attention.log.rows = table, 0
        agent.history.table = np.zeros((agent.max_cycles + 2, 3 + len(agent.body.needs)))
        agent.history.rows = 0
        agent.body.larder.reserve(len(agent.simulator.layout.solids))
        self._memory, self._agent = Memory(explorations), agent
        kind, self._at = self._memory.place(agent)
        self._reads = [self._memory.reader(getattr(agent, name), fields) for name, fields in SEEN.items()]
        for attention in agent.attentions:
            self._reads += [self._memory.reader(attention, ATTENTION), self._memory.reader(attention.log, ("rows",))]
        self._causes = {crc32(cause.encode()): cause for cause in ("crash", "energy", *agent.body.names)}
        found = self._entries(kind, self._memory.exploration, only_kept)
        self.is_there = found is not None
        if found is not None:
            self._episode, self._died = found

    def __call__(self, agent: Agent, exploration: Exploration, start: tuple[float, float, float], learning: bool
                 ) -> tuple[str | None, list[float]]:
        if type(exploration).start is not Exploration.start:  # a schedule may have changed it
            self._memory.push(exploration)
        memory, attentions = self._memory, agent.attentions
        cause = self._causes.get(self._episode(self._at, memory.address(exploration), learning, *start))
        for read in self._reads:
            read()
        agent.body.dead = cause is not None
        memory.write(agent.body, "dead")
        if cause is None:
            return None, [0.0] * len(attentions)
        shares = check_shares(agent.penalty, cause, [attention.behaviour for attention in attentions])
        return cause, [self._died(memory.address(attention), share, learning)
                       for attention, share in zip(attentions, shares, strict=True)]

    def finish(self) -> None:
        """All objects as they are in memory: what was learned, what was drawn."""
        self._memory.pull_all()

    def _entries(self, agent: Any, exploration: Any, only_kept: bool) -> tuple[Episode, Died] | None:
        of = agent.layout["attentions"].of
        text = f"{agent} {exploration} {of} {package_hash()} {files_of([agent, exploration])}"
        try:
            return entries(hashlib.sha256(text.encode()).hexdigest()[:24], agent, exploration, of, only_kept)
        except Exception as cause:  # whatever numba makes of a part's code
            raise Uncompilable(reason(str(cause), self._memory.left_out)) from cause


def files_of(kinds: list[Any]) -> str:
    """A hash of the files that plugins' classes stand in, for their code is in no package's hash."""
    files = sorted({file for kind in kinds for file in sources(kind)})
    return hashlib.sha256(b"".join(Path(file).read_bytes() for file in files)).hexdigest()[:16]


def reason(message: str, left_out: dict[str, str]) -> str:
    """numba's innermost complaint on one line: where, what, and why a field that is missed has no place."""
    inner = message[message.rfind("nopython frontend)"):].removeprefix("nopython frontend)")
    what = next((line.strip() for line in inner.splitlines() if line.strip()), "numba refuses it")
    places = re.findall(r'File "([^"]+)", line (\d+)', inner)
    missed = re.search(r"Unknown attribute '(\w+)'", inner)
    field = "memory()" if missed and missed[1] == "_fresh" else missed[1] if missed else ""
    why = [f"{name} is {held}" for name, held in left_out.items() if field and name.endswith(f".{field}")]
    where = f"{Path(places[0][0]).name}:{places[0][1]}: " if places else ""
    return " ".join(f"{where}{'; '.join(why) or what}".split())

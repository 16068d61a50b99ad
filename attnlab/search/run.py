"""The search from its command to its tables."""

from __future__ import annotations

import argparse
import hashlib
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence

from attnlab.claims import claims_mark
from attnlab.claims.files import load_claims
from attnlab.cli.calls import composer
from attnlab.cli.main import opened
from attnlab.config import COSMETIC
from attnlab.errors import ConfigError
from attnlab.loading import named_file
from attnlab.report import verdicts
from attnlab.search import answer, finals, score
from attnlab.search.bench import Bench, Played
from attnlab.search.journal import Journal
from attnlab.search.plan import Clock, told
from attnlab.search.rungs import UNSOUND, Ladder, Rung, Step, climb, fixed, parse
from attnlab.search.space import Row, Space, code
from attnlab.tables.files import write_bytes

BASE = ("simulator=planar", "record=none")
PAIR = ("treatment", "control")  # who plays in the rungs; the others join the finalists
FINALS = "finals"


class Search:
    """``given``: the command's options, checked; ``fresh``: seeds of the finalists. Raises ConfigError."""

    def __init__(self, given: argparse.Namespace, fresh: Sequence[int], command: str):
        self.given, self.fresh = given, list(fresh)
        self.claims, self.space = load_claims(given.claims), Space.of(given.points)
        for role in PAIR:
            if role not in self.claims.roles:
                raise ConfigError("--claims", f"{self.claims.path.name} has no role '{role}'")
        base = [*(b for b in BASE if not any(o.startswith(b.partition("=")[0] + "=") for o in given.overrides)),
                *given.overrides]
        for setting in (o.partition("=")[0].lstrip("+") for o in given.overrides):
            if any(setting in level for of in self.space.points.values() for level in of.values()):
                raise ConfigError(setting, "is set by an open point, which is searched over", "Leave it out")
        composing = composer()
        self.bench = Bench(given.out, composing, opened(base)[1], self.claims, claims_mark(given.claims), [command])
        points = hashlib.sha256(named_file("multiverse", given.points, "--points").read_bytes()).hexdigest()
        asked = {"--seed": given.seed, "--first-seed": given.first_seed, "--rungs": given.rungs,
                 "--points": points[:16], "--claims": self.claims.sha256[:16],
                 "overrides": [o for o in base if o.partition("=")[0].partition(".")[0] not in COSMETIC]}
        self.journal = Journal(given.out, asked)
        self.clock = Clock(given.minutes, **self.journal.clock)

    def run(self) -> Iterator[str]:
        """All that is missing; lines of what comes about. Writes the tables."""
        yield f"{self.space.size:,} readings: {len(self.space.points)} open points, all combinations"
        self._references()
        for place, step in enumerate(climb(self.space, self._ladder(), self.given.seed, self._score,
                                           self.journal.steps), 1):
            yield self._line(place, step)
            last = step
        best = [row for row in last.best if any(row)]  # the first levels are `inferred`, which is judged anyway
        rows = {f"r{i}": row for i, row in enumerate(best[:self.given.finalists], 1)}
        readings = {name: self.space.settings(row) for name, row in rows.items()}
        found = finals.judged(self._final({**finals.REFERENCES, **readings}), self.claims, self.given.episodes)
        if not found:
            raise ConfigError(FINALS, "no finalist has runs to judge", "python -m attnlab.retry does those that failed")
        table = finals.finalists_csv(found, rows, {n: self.space.told(r) for n, r in rows.items()},
                                     list(self.space.points))
        self._write({"finalists": table, "rungs": finals.rungs_csv(self.journal.steps),
                     "claims": finals.claims_csv(self.journal.steps, self.journal.claims, list(self.claims.claims)),
                     "verdicts": verdicts.as_csv({of.name: of.verdicts for of in found}).decode()})
        yield from answer.sentences(answer.read(table))
        yield f"the same search without a clock: --rungs {told([step.rung for step in self.journal.steps])}"

    def _final(self, readings: Mapping[str, Mapping[str, object]]) -> Played:
        return self.bench.play(FINALS, readings, list(self.claims.roles), self.fresh, self.given.episodes)

    def _references(self) -> None:
        """What the finalists are held against comes first, and tells how fast whole runs are."""
        started = time.monotonic()
        played = self._final(finals.REFERENCES)
        if played.done and not self.journal.clock:
            self.clock.run_s = played.seconds / played.done / (self.bench.at_once or 1)
        self.clock.ends = self.given.finalists * len(self.claims.roles) * len(self.fresh)
        self.clock.spent_s += time.monotonic() - started
        self._keep()

    def _ladder(self) -> Ladder:
        """The rungs that were typed, or those that fit the time. One that was begun stays as it was."""
        ladder = fixed(parse(self.given.rungs)) if self.given.rungs else \
            lambda place: self.clock.rung(place, len(PAIR))

        def begun(place: int) -> Rung | None:
            if self.journal.begun is None:
                self.journal.begun = ladder(place)
                self._keep()
            return self.journal.begun
        return begun

    def _score(self, place: int, rung: Rung, rows: Sequence[Row]) -> dict[Row, float]:
        """Play the readings of a rung, and what each is worth: the sum of its claims' scores. Whether one is sound its
        control says alone, so that the others play for the sound ones only."""
        started = time.monotonic()
        signs = score.signs(self.claims, PAIR, rung.episodes)
        readings = {code(row): self.space.settings(row) for row in rows}
        seeds = self.journal.seeds(rung, self.given.first_seed)

        def play(names: Iterable[str], roles: Sequence[str]) -> Played:
            return self.bench.play(f"rung{place + 1}", {name: readings[name] for name in names}, roles, seeds,
                                   rung.episodes)
        controls = play(readings, PAIR[1:]).runs
        said = {row: score.why_unsound(controls[code(row)]["control"], rung.episodes) for row in rows}
        sound = [row for row in rows if not said[row]]
        claims = {}
        if sound:
            played = play(map(code, sound), PAIR).runs
            claims = {row: score.scores(signs, played[code(row)]) for row in sound}
        found = {row: score.worth(claims[row]) if row in claims else UNSOUND for row in rows}
        self.clock.took(time.monotonic() - started)
        self.journal.done(Step(rung, found), claims, {row: why for row, why in said.items() if why})
        self._keep()
        return found

    def _keep(self) -> None:
        clock = self.clock
        self.journal.clock = {"run_s": clock.run_s, "ends": clock.ends, "spent_s": clock.spent_s, "tempo": clock.tempo,
                              "foreseen": clock.foreseen}
        self.journal.write()

    def _line(self, place: int, step: Step) -> str:
        best = step.best
        claims = self.journal.claims[place - 1][best[0]]
        clear = [key for key, of in claims.items() if of >= score.CLEAR]
        return (f"rung {place} ({step.rung}): {len(best)} of {len(step.scores)} readings are sound; best "
                f"{step.scores[best[0]]:.1f} of {len(claims)}, with {len(clear)} clear: {', '.join(clear)}")

    def _write(self, tables: Mapping[str, str]) -> None:
        for name, text in tables.items():
            write_bytes(self.given.out / f"{name}.csv", text.encode())

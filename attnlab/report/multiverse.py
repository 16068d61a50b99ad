"""What the paper's ambiguities do to its claims: a study with many readings, judged reading by reading and together."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from attnlab.claims.findings import Finding
from attnlab.claims.judge import PartVerdict, Verdict
from attnlab.claims.parts import PAIRED
from attnlab.claims.roles import Combinations
from attnlab.stats.specification import Joint, joint_test, standardised, variance_shares
from attnlab.tables.flat import text

Floats = npt.NDArray[np.float64]
LEAST_READINGS = 8  # fewer combinations are shown as a plain matrix
LEAST_SEEDS = 2  # that every reading must share for a joint test
ROBUST = 0.75  # share of the readings on one side that makes a statement robust, if the joint test is clear
HANGS = 0.5  # share of the variance that lies with one factor if the statement hangs on it


class Moved(NamedTuple):
    """Share of the readings with this level in which a claim holds, less the share with the default level."""
    claim: str
    factor: str
    level: str
    default: str
    difference: float


class Signed(NamedTuple):
    """A comparison of two roles as a measure that is above 0 where it is as claimed."""
    claim: str
    part: int
    title: str
    sign: float


@dataclass
class Multiverse:
    """``holds`` (claims, readings): 1, 0, or nan where untestable. ``levels``: factor -> level by reading.

    ``differences`` (readings, measures, seeds) of ``measures``, signed as claimed; ``effects``, ``low``, ``high``
    (readings, measures): standardised, with t intervals; ``joint``: None where the readings share too few seeds.
    ``shares``: of each measure the variance of its effects by factor.
    """
    ids: list[str]
    titles: list[str]
    names: list[str]
    holds: Floats
    reproduced: npt.NDArray[np.bool_]
    levels: dict[str, list[str]]
    defaults: dict[str, str]
    moved: list[Moved]
    measures: list[Signed]
    differences: Floats
    effects: Floats
    low: Floats
    high: Floats
    joint: Joint | None
    shares: list[dict[str, float]]

    def share(self, row: int) -> tuple[float, int]:
        """(share of the testable readings in which claim ``row`` holds, how many can test it)."""
        seen = self.holds[row][~np.isnan(self.holds[row])]
        return (float(seen.mean()) if seen.size else float("nan")), int(seen.size)

    def statement(self, measure: int) -> str:
        """What kind of statement a measure makes: robust, hangs on a factor, or not told from chance."""
        effects = self.effects[:, measure]
        side = np.sign(np.nanmedian(effects))
        agree = float((np.sign(effects[~np.isnan(effects)]) == side).mean())
        factor, share = self.mover(measure)
        if share >= HANGS:
            return f"hangs on {factor}"
        if self.joint is not None and self.joint.p_family[measure] <= 0.05 and agree >= ROBUST:
            return "as claimed, in most readings" if side > 0 else "the opposite, in most readings"
        return "not told from chance" if self.joint is None or self.joint.p_family[measure] > 0.05 else "mixed"

    def mover(self, measure: int) -> tuple[str, float]:
        """The factor with the largest share of a measure's variance over readings."""
        named = {name: share for name, share in self.shares[measure].items() if name != "other"}
        return max(named.items(), key=lambda item: item[1], default=("nothing", 0.0))


def analyse(combinations: Combinations, judged: Mapping[str, Sequence[Verdict]]) -> Multiverse:
    """Shares of claims, signed effects and their joint test. Settings that always change together are one factor."""
    verdicts = list(judged.values())
    first = verdicts[0]
    holds = np.array([[np.nan if of[i].verdict is Finding.UNTESTABLE else float(of[i].holds) for of in verdicts]
                      for i in range(len(first))])
    reproduced = np.array([[of[i].verdict is Finding.REPRODUCED for of in verdicts] for i in range(len(first))])
    levels, defaults = _factors(list(combinations.values()))
    moved = [found for i, verdict in enumerate(first) for factor, of in levels.items()
             for found in _moved(verdict.id, factor, np.array(of), defaults[factor], holds[i])]
    measures = _signed(first)
    differences = _differences(verdicts, measures)
    there = [m for m in range(len(measures)) if not np.isnan(differences[:, m]).all()]
    measures, differences = [measures[m] for m in there], differences[:, there]
    effects = standardised(differences)
    low, high = _ends(differences, effects)
    joint = joint_test(differences) if measures and differences.shape[-1] >= LEAST_SEEDS else None
    return Multiverse([v.id for v in first], [v.claim.title for v in first], list(judged), holds, reproduced, levels,
                      defaults, moved, measures, differences, effects, low, high, joint,
                      [variance_shares(column, levels) for column in effects.T])


def _signed(verdicts: Sequence[Verdict]) -> list[Signed]:
    """Every comparison of two roles that has a side, each once."""
    found: dict[tuple[str, ...], Signed] = {}
    for verdict in verdicts:
        for i, part in enumerate(of.part for of in verdict.parts):
            key = (repr(sorted(part.node.items(), key=str)), part.test, part.role, part.against)
            if part.test in PAIRED and (part.direction != "about" or part.test == "not_lower") and key not in found:
                sign = -1.0 if part.direction in ("lower", "at_most") else 1.0
                told = [name if value is True else str(value) for name, value in part.node.items()
                        if value is not False and not isinstance(value, list)]
                found[key] = Signed(verdict.id, i, f"{verdict.id} {', '.join(told).replace('_', ' ')}", sign)
    return list(found.values())


def _differences(verdicts: Sequence[Sequence[Verdict]], measures: Sequence[Signed]) -> Floats:
    """(readings, measures, seeds), over all seeds that any reading has; nan where it has none."""
    by_id = [{verdict.id: verdict.parts for verdict in of} for of in verdicts]
    parts: list[list[PartVerdict]] = [[of[m.claim][m.part] for m in measures] for of in by_id]
    seeds = sorted({seed for row in parts for part in row for seed in part.sample})
    found = np.full((len(verdicts), len(measures), len(seeds)), np.nan)
    place = {seed: i for i, seed in enumerate(seeds)}
    for r, row in enumerate(parts):
        for m, part in enumerate(row):
            for seed, value in part.sample.items():
                found[r, m, place[seed]] = measures[m].sign * value
    return found


def _ends(differences: Floats, effects: Floats) -> tuple[Floats, Floats]:
    """The t interval of each mean, in standard deviations: effect -+ t / sqrt(n)."""
    from scipy.stats import t as student
    count = (~np.isnan(differences)).sum(axis=-1)
    reach = np.where(count > 1, student.ppf(0.975, np.maximum(count - 1, 1)) / np.sqrt(np.maximum(count, 1)), np.nan)
    return effects - reach, effects + reach


def _factors(readings: Sequence[Mapping[str, str]]) -> tuple[dict[str, list[str]], dict[str, str]]:
    import dataclasses

    from attnlab.reading import Reading
    plain = {f"reading.{name}": text(value) for name, value in dataclasses.asdict(Reading()).items()}
    merged: dict[tuple[int, ...], list[str]] = {}
    for name in readings[0]:
        if name == "variant":
            continue  # the name of a combination, not a setting of it
        column = [settings[name] for settings in readings]
        codes = tuple(list(dict.fromkeys(column)).index(value) for value in column)
        if len(set(codes)) > 1:
            merged.setdefault(codes, []).append(name)
    levels, defaults = {}, {}
    for names in merged.values():
        label = " + ".join(name.removeprefix("reading.") for name in names)
        column = [" + ".join(settings[name] for name in names) for settings in readings]
        usual = " + ".join(plain.get(name, "") for name in names)
        levels[label] = column
        defaults[label] = usual if usual in column else column[0]
    return levels, defaults


def _moved(claim: str, factor: str, of: npt.NDArray[np.str_], default: str, holds: Floats) -> list[Moved]:
    """Differences of shares between each level and the default: descriptions of a fixed design, without intervals."""
    known = ~np.isnan(holds)
    base = holds[known & (of == default)]
    found = []
    for level in dict.fromkeys(of.tolist()):
        here = holds[known & (of == level)]
        if level != default and len(base) and len(here):
            found.append(Moved(claim, factor, level, default, float(here.mean() - base.mean())))
    return found


def effects_csv(found: Multiverse) -> bytes:
    sink = io.StringIO()
    writer = csv.writer(sink, lineterminator="\n")
    writer.writerow(["claim", "factor", "level", "default", "difference_of_shares"])
    for e in found.moved:
        writer.writerow([*e[:4], f"{e.difference:.4f}"])
    return sink.getvalue().encode()


def curve_csv(found: Multiverse) -> bytes:
    """A row a measure and reading: the signed standardised effect with its interval, and its family-wise p."""
    sink = io.StringIO()
    writer = csv.writer(sink, lineterminator="\n")
    writer.writerow(["measure", "claim", "reading", "effect_d", "low", "high", "p_of_readings", *found.levels])
    for m, measure in enumerate(found.measures):
        for r in np.argsort(found.effects[:, m], kind="stable"):
            p = found.joint.of_readings[r, m] if found.joint else float("nan")
            numbers = (found.effects[r, m], found.low[r, m], found.high[r, m], p)
            writer.writerow([measure.title, measure.claim, found.names[r], *(f"{x:.5g}" for x in numbers),
                             *(of[r] for of in found.levels.values())])
    return sink.getvalue().encode()


def joint_csv(found: Multiverse) -> bytes:
    """A row a measure: its median effect, clear readings, joint p, and the variance of its effects by factor."""
    sink = io.StringIO()
    writer = csv.writer(sink, lineterminator="\n")
    writer.writerow(["measure", "claim", "readings", "seeds", "median_d", "clear_as_claimed", "clear_opposite",
                     "p_joint", "p_family", "patterns", "statement", "moved_most_by", "its_share"])
    for m, measure in enumerate(found.measures):
        j = found.joint
        numbers = [np.nan] * 5 if j is None else [j.median[m], j.clear[m], j.opposite[m], j.p[m], j.p_family[m]]
        mover, share = found.mover(m)
        writer.writerow([measure.title, measure.claim, len(found.names), found.differences.shape[-1],
                         *(f"{x:.5g}" for x in numbers), j.patterns if j else 0, found.statement(m), mover,
                         f"{share:.4f}"])
    return sink.getvalue().encode()


def combinations_csv(combinations: Combinations, judged: Mapping[str, Sequence[Verdict]]) -> bytes:
    """A row a combination: its settings, and the verdict on every claim."""
    sink = io.StringIO()
    writer = csv.writer(sink, lineterminator="\n")
    first = next(iter(judged.values()), [])
    writer.writerow(["combination", *next(iter(combinations.values()), {}), *(v.id for v in first)])
    for (name, verdicts), settings in zip(judged.items(), combinations.values(), strict=True):
        writer.writerow([name, *settings.values(), *(v.verdict for v in verdicts)])
    return sink.getvalue().encode()

"""The search finds a reading that is known to be best, the same one each time, and goes on where it was stopped."""

import csv
import json
from pathlib import Path

import numpy as np
import pytest

from attnlab.claims.files import load_claims
from attnlab.errors import ConfigError
from attnlab.launch.multiverse import DEFAULT
from attnlab.search import answer
from attnlab.search.journal import Journal
from attnlab.search.plan import SHAPE, Clock
from attnlab.search.rungs import UNSOUND, Rung, Step, climb, fixed, parse
from attnlab.search.score import as_claimed, signs
from attnlab.search.space import Space, code, row_of

RUNGS = [Rung(120, 1, 10), Rung(60, 2, 20), Rung(60, 3, 40), Rung(60, 4, 80), Rung(60, 6, 80)]


@pytest.fixture(scope="module")
def space():
    return Space.of(DEFAULT)


class Landscape:
    """A claim holds where each of its two or three points has the level that it needs; what is seen of it is noisy, the
    less so the more seeds. Readings in which point 0 has its last level are not sound."""

    def __init__(self, space, seed):
        rng = np.random.default_rng(seed)
        self.best = tuple(int(level) for level in rng.integers(0, space.levels))
        self.best = (0, *self.best[1:])
        places = rng.permutation(len(space.levels))
        self.claims = [places[i:i + 3] for i in range(0, len(places), 3)]
        self.last, self.noise, self.asked = space.levels[0] - 1, np.random.default_rng(seed + 1), []

    def holds(self, row):
        return sum(all(row[p] == self.best[p] for p in claim) for claim in self.claims)

    def near(self, row):
        """Effects point the right way before they are there."""
        return sum(np.mean([row[p] == self.best[p] for p in claim]) for claim in self.claims)

    def score(self, place, rung, rows):
        self.asked.append((place, rung, list(rows)))
        return {row: UNSOUND if row[0] == self.last else
                self.near(row) + 0.5 * self.noise.standard_normal() / np.sqrt(rung.seeds) for row in rows}


def made_up(*levels):
    """A space of points with so many levels each; what they set does not matter."""
    return Space({f"p{i}": {str(j): {"reading.need_start": j} for j in range(of)} for i, of in enumerate(levels)})


def test_a_planted_reading_is_climbed_to():
    space, found, at_random = made_up(*[2] * 21, *[3] * 7, 4, 4), [], []
    for seed in range(3):
        land = Landscape(space, seed)
        *_, last = climb(space, fixed(RUNGS), seed, land.score)
        assert all(row[0] != land.last for row in last.best)
        found.append(max(land.holds(row) for row in last.best[:8]))
        at_random.append(max(land.holds(row) for row in np.random.default_rng(seed + 50).integers(
            0, space.levels, (sum(rung.readings for rung in RUNGS), len(space.levels)))))
    assert max(at_random) <= 5  # of 10 claims, with as many readings tried and no climbing
    assert min(found) >= 6 and np.mean(found) >= np.mean(at_random) + 2


def test_the_best_of_a_small_space_is_found():
    small = made_up(*[2] * 6)
    best = (1, 0, 1, 1, 0, 1)
    steps = list(climb(small, fixed([Rung(16, 1, 10)] + [Rung(12, 1, 10)] * 4), 0, lambda place, rung, rows: {
        row: float(sum(a == b for a, b in zip(row, best, strict=True))) for row in rows}))
    assert steps[-1].best[0] == best and steps[-1].scores[best] == 6


def test_the_same_seed_gives_the_same_search():
    space = made_up(*[2] * 12)

    def rows(seed):
        land = Landscape(space, 7)
        list(climb(space, fixed(RUNGS[:3]), seed, land.score))
        return [rows for _, _, rows in land.asked]
    assert rows(1) == rows(1)
    assert rows(1) != rows(2)


def test_it_goes_on_where_it_was_stopped(space, tmp_path):
    land, journal = Landscape(space, 3), Journal(tmp_path, {"--seed": 0})
    whole = list(climb(space, fixed(RUNGS[:3]), 0, land.score))
    for step in whole[:2]:
        journal.done(step, {row: {"C1": 1.0} for row in step.best}, {})
    journal.begun = RUNGS[2]
    journal.write()
    again = Journal(tmp_path, {"--seed": 0})
    assert again.steps == whole[:2] and again.begun == RUNGS[2]
    assert list(again.seeds(RUNGS[2], 100)) == [103, 104, 105]  # one and two were used before
    asked = []
    for _ in climb(space, fixed(RUNGS[:3]), 0, lambda place, rung, rows: asked.append((place, rows)) or
                   dict.fromkeys(rows, 1.0), again.steps):
        pass
    assert asked == [(2, land.asked[2][2])]
    with pytest.raises(ConfigError, match="--seed: is 1, and .* is of a search with 0"):
        Journal(tmp_path, {"--seed": 1})


def test_readings_are_even_and_valid(space):
    rows = space.first(60, 0)
    assert len(set(rows)) == 60 and all(space.may_be(row) for row in rows)
    for place, levels in enumerate(space.levels):
        counts = np.bincount([row[place] for row in rows], minlength=levels)
        assert counts.min() >= 60 // levels - 2
    assert row_of(code(rows[0])) == rows[0]
    told = space.told((0,) * len(space.levels))
    assert list(told) == list(space.points) and told["need_k"] == "1"
    child = space.child(rows[0], rows[1], np.random.default_rng(0))
    assert sum(c not in (a, b) for c, a, b in zip(child, *rows[:2], strict=True)) <= 4


def test_nothing_sound_is_one_line(space):
    with pytest.raises(ConfigError, match="none of the 5 readings of rung 1 is sound"):
        list(climb(space, fixed([Rung(5, 1, 10)]), 0, lambda place, rung, rows: dict.fromkeys(rows, UNSOUND)))


def test_shorter_lives_have_shorter_windows():
    claims = load_claims("dinocera2014")
    short = signs(claims, ("treatment", "control"), 100)
    assert short["C1"][0].measure.params.episodes == [0, 50]
    c2 = short["C2"][0]
    assert (c2.part.number, c2.part.tolerance, c2.measure.params.block) == (60, 10, 10)
    assert c2.measure.params.episodes == [0, 100] and c2.measure.params.level == 99.5
    assert short["C5"][0].measure.params.early == [0, 40]
    assert len(short["C27"]) == 1  # the other comparison is with a robot that the rungs do not play
    whole = signs(claims, tuple(claims.roles), 500)
    assert [len(of) for of in whole.values()] == [sum(p.counts for p in c.parts) for c in claims.claims.values()]
    assert whole["C2"][0].part is claims.claims["C2"].parts[0]


def test_signs_are_those_of_the_rules():
    parts = {key: claim.parts for key, claim in load_claims("dinocera2014").claims.items()}
    assert list(as_claimed(parts["C1"][0], np.array([-1.0, 0.0, 2.0]))) == [True, False, False]  # lower
    assert list(as_claimed(parts["C2"][0], np.array([250.0, np.inf, 350.0]))) == [True, False, True]  # 300 +- 50
    assert list(as_claimed(parts["C3"][0], np.array([400.0, np.inf, 350.0]))) == [True, True, False]  # at least 400
    assert list(as_claimed(parts["C26"][0], np.array([-0.03, -0.04]))) == [True, False]  # not lower by 0.036


def test_rungs_fit_the_time():
    clock = Clock(60, run_s=0.9, ends=480)
    rungs = []
    for place in range(len(SHAPE)):
        rungs.append(clock.rung(place, 2))
        clock.took(clock.foreseen * 1.2)  # scoring takes time, too
    assert clock.rung(len(SHAPE), 2) is None
    assert clock.spent_s + 480 * 0.9 <= 3600
    assert all(rung.readings >= 20 for rung in rungs) and [rung[1:] for rung in rungs] == list(SHAPE)
    with pytest.raises(ConfigError, match=r"--minutes: 3 are too few at 0.90 s a run. About \d+ would do"):
        Clock(3, run_s=0.9, ends=480).rung(0, 2)


@pytest.mark.parametrize(("typed", "said"), [
    (["--rungs", "400:2"], "--rungs: '400:2' is no rung"), (["--rungs", "1:2:10"], "--rungs: '1:2:10' has 1 readings"),
    (["--minutes", "0"], "--minutes: is 0, must be from 0.1"),
    (["--fresh-seeds", "5-2"], "--fresh-seeds: 5-2 runs back"),
    (["--fresh-seeds", "101-110"], "--fresh-seeds: seed 101 takes part in the rungs"),
    (["--points", "nowhere"], "no multiverse file is called 'nowhere'"), (["learner.alpah=1"], "learner.alpah"),
    (["--claims", "nowhere"], "no claims file is called 'nowhere'"), (["reading.need_k=2"], "is set by an open point")])
def test_what_cannot_be_is_one_line_and_nothing_is_written(here, tmp_path, typed, said):
    done = here(*typed, module="attnlab.search")
    assert done.returncode == 2 and said in done.stderr and done.stderr.count("\n") == 1
    assert not list(tmp_path.iterdir())


def row(name, holds, code="01", not_sound="", seeds="20"):
    verdicts = {f"C{i}": "direction only" if f"C{i}" in holds else "not reproduced" for i in range(1, 6)}
    return {"reading": name, "code": code, "not_sound": not_sound, "seeds": seeds, "contradicted": "0", **verdicts,
            "cycles": "1150"}


def test_the_answer_says_what_the_table_says():
    rows = [row("inferred", ["C1", "C4"], ""), row("table4", [], "", "nobody eats"), row("r1", ["C1", "C2", "C3"]),
            row("r2", ["C1"]), row("r3", ["C1", "C2", "C3", "C4"], not_sound="nobody drinks")]
    said = answer.sentences(rows)
    assert said[0].startswith("At most 3 of 5 claims hold together (C1, C2, C3), in reading r1, judged on 20 seeds")
    assert said[0].endswith("so the paper is not true in any reading that was found.")
    assert said[1] == "On the same seeds `inferred` has 2 (C1, C4); the best reading gains C2, C3 and loses C4."
    assert said[2].endswith("gains C1, C2, C3 and loses nothing; `table4` is not sound: nobody eats.")
    assert said[3] == "Of the 2 sound finalists, none has C4, C5; C1 holds in all of them."
    assert answer.sentences([row("r1", [f"C{i}" for i in range(1, 6)])])[0].endswith("in which the paper is true.")
    assert answer.sentences([row("r1", [], not_sound="survives 80.00 %")]) == [
        "No reading that was judged is sound on the fresh seeds."]


@pytest.mark.long
def test_a_tiny_search_stopped_and_gone_on(here, tmp_path):
    typed = ["--rungs", "16:1:30,4:1:30", "--finalists", "1", "--fresh-seeds", "500-501", "--episodes", "30",
             "cluster=serial"]
    first = here(*typed, module="attnlab.search")
    assert first.returncode == 0 and "claims hold together" in first.stdout
    folder = tmp_path / "outputs" / "search"
    tables = {f"{name}.csv": (folder / f"{name}.csv").read_bytes()
              for name in ("rungs", "claims", "finalists", "verdicts")}
    rows = list(csv.DictReader((folder / "finalists.csv").read_text().splitlines()))
    assert [of["reading"] for of in rows[:2]] == ["inferred", "table4"] and rows[2]["reading"] == "r1"
    journal = json.loads((folder / "search.json").read_text())
    journal["rungs"].pop()  # as if it had been stopped in the second rung, of whose runs one was lost
    (folder / "search.json").write_text(json.dumps(journal))
    next(Path(folder / "rung2").glob("*/run.json")).unlink()
    again = here(*typed, module="attnlab.search")
    assert again.returncode == 0 and "rung2: 1 run," in again.stdout.replace("runs", "run")
    assert {name: (folder / name).read_bytes() for name in tables} == tables


def test_a_step_leaves_out_what_is_not_sound():
    step = Step(Rung(3, 1, 10), {(0,): 1.0, (1,): UNSOUND, (2,): 2.0})
    assert step.best == [(2,), (0,)]
    assert parse("400:2:120, 100:4:250") == [Rung(400, 2, 120), Rung(100, 4, 250)]

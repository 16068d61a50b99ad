"""The figures of the project's own studies: what they compare, by hand, and that they draw a short form of each."""

from __future__ import annotations

from itertools import pairwise

import matplotlib.figure
import pytest

import attnlab
from attnlab.claims.files import load_claims
from attnlab.claims.roles import strata
from attnlab.figures.base import FigureContext, make
from attnlab.figures.budget_front import Spent, front
from attnlab.figures.compared import EARLY, LATE, SAFETY, VALID, Difference, asked, difference, looks, outcome
from attnlab.figures.held_levels import visited
from attnlab.figures.phase_map import cells, papers
from attnlab.figures.steps import steps
from attnlab.figures.style import drawing, png_bytes
from attnlab.results.conditions import Conditions

SHORT = ("train_episodes=5", "validation_episodes=2", "max_cycles=150", "seed=0-1", "cluster=serial", "engine=python",
         "report=false", "picture=false")
STUDIES = {"bigger_table": ("steps", ()), "clamped_levels": ("held_levels", ()),
           "matched_budget": ("budget_front", ("learner.looks_per_s=1.8,3.0",)),
           "where_curiosity_pays": ("phase_map", ("world.source_distance_m=1.0,4.03", "world.obstacles=1,2",
                                                  "reading.energy_well=3067"))}


@pytest.fixture(scope="module")
def short(tmp_path_factory):
    """A study in a short form by name, made once."""
    made = {}

    def get(name):
        if name not in made:
            outputs = tmp_path_factory.mktemp("own") / "outputs"
            made[name] = Conditions(attnlab.sweep([f"+experiment={name}", *SHORT, *STUDIES[name][1],
                                                   f"outputs={outputs}"]))
        return made[name]
    return get


@pytest.mark.parametrize("name", STUDIES)
def test_its_figure_draws_it_and_no_other_does(short, name):
    conditions = short(name)
    for figure in {figure for figure, _ in STUDIES.values()}:
        assert make(figure, FigureContext()).applies(conditions) == (figure == STUDIES[name][0])
    figure = make(STUDIES[name][0], FigureContext())
    with drawing():
        drawn = figure.draw(conditions)
        assert isinstance(drawn, matplotlib.figure.Figure) and png_bytes(drawn) == png_bytes(figure.draw(conditions))
    said = figure.say(conditions)
    assert said[0].isupper() and said.endswith(".")


def test_steps_are_between_neighbours_and_ranked(short):
    conditions = short("bigger_table")
    names = ["NCR, plain", "NCR, same states", "CR, liking shuffled", "CR", "CR, random w"]
    for which, found in steps(conditions).items():
        assert {name for name, _ in found} == {f"{b} − {a}" for a, b in pairwise(names)}
        values = [step.value for _, step in found]
        assert values == sorted(values, reverse=True)
        by_name = dict(found)
        first, second = (outcome(one.runs, which) for one in asked(conditions)[:2])
        assert by_name["NCR, same states − NCR, plain"].value == \
            pytest.approx(sum(second[seed] - first[seed] for seed in (0, 1)) / 2)


def test_outcomes_are_those_of_the_tables(short):
    """Five training episodes: the first half is three, as in the summary table."""
    conditions = short("bigger_table")
    one = asked(conditions)[0]
    rows = conditions.study.episodes[conditions.study.episodes["run"] == one.runs.runs[1]]
    for which, phase, chosen in ((EARLY, "train", slice(0, 3)), (LATE, "train", slice(3, 5)),
                                 (VALID, "validation", slice(0, 2))):
        assert outcome(one.runs, which)[1] == \
            pytest.approx(100 * rows.loc[rows["phase"] == phase, "survival"].iloc[chosen].mean())
    assert outcome(one.runs, SAFETY)[1] == pytest.approx(rows.loc[rows["phase"] == "validation", "safety_mean"].mean())
    acts = conditions.study.behaviours
    acts = acts[(acts["run"] == one.runs.runs[1]) & (acts["phase"] == "validation")]["activations"].sum()
    assert looks(one.runs)[1] == pytest.approx(acts / rows.loc[rows["phase"] == "validation", "cycles"].sum())


def test_a_difference_is_paired():
    """3 and 5 less 1 and 2: 2 and 3, mean 2.5; t(0.975, 1) = 12.706, standard error 0.5."""
    found = difference({1: 3.0, 2: 5.0, 3: 9.0}, {1: 1.0, 2: 2.0, 4: 0.0})
    assert found.value == 2.5 and found.seeds == 2 and found.side == 0
    assert (found.low, found.high) == pytest.approx((2.5 - 6.3531, 2.5 + 6.3531), abs=1e-3)
    assert difference({1: 1.0}, {2: 1.0}) is None
    assert Difference(1.0, 0.5, 1.5, 9).side == 1 and Difference(-1.0, -1.5, -0.5, 9).side == -1
    assert Difference(-1.26, -1.5, 0.04, 9).said(1) == "-1.3 [-1.5, +0.0]"


def test_the_front_by_hand():
    """(1, 80) and (2, 90) are on it; (2, 85) and (3, 90) are beaten; of two that are equal both are."""
    found = [Spent(name, 1.0, {0: x}, {0: y}) for name, x, y in
             (("c", 3.0, 90.0), ("b", 2.0, 90.0), ("d", 2.0, 85.0), ("a", 1.0, 80.0), ("e", 1.0, 80.0))]
    assert [one.name for one in front(found)] == ["a", "e", "b"]


def test_the_map_knows_the_papers_world_and_the_unsound(short):
    found = cells(short("where_curiosity_pays"))
    assert set(found) == {(x, float(y), 3067.0) for x in (1.0, 4.03) for y in (1, 2)}
    assert papers() == (4.03, 2.0, 3067.0)
    cell = found[papers()]
    assert set(cell.runs) == {"litman", "none same_states", "none plain"}
    plain = outcome(cell.runs["none plain"], EARLY)
    assert cell.sound == (sum(plain.values()) / 2 >= 90.0)
    step = cell.step("litman", "none plain", VALID)
    mine, theirs = (outcome(cell.runs[robot], VALID) for robot in ("litman", "none plain"))
    assert step.value == pytest.approx(sum(mine[seed] - theirs[seed] for seed in (0, 1)) / 2)


def test_states_that_were_visited(short):
    conditions = short("clamped_levels")
    run = next(iter(conditions.configs))
    rows = conditions.study.policy
    rows = rows[(rows["run"] == run) & (rows["curiosity_level"] == "HH")]
    states = {(b, p, x) for b, p, x, visits in zip(rows["behaviour"], rows["period"], rows["percept"], rows["visits"],
                                                   strict=True) if visits}
    assert visited(conditions, "HH")[run] == pytest.approx(100 * len(states) / (3 * 4 * 6))
    assert len({round(share, 9) for share in visited(conditions, "HH").values()}) <= 2  # a seed's training is one


def test_claims_are_judged_under_each_cap_and_in_each_world(short):
    """What tells no roles apart makes a combination, though conditions are variants."""
    found = {name: list(strata(load_claims(name), short(name))) for name in STUDIES}
    assert found["matched_budget"] == ["learner.looks_per_s=1.8", "learner.looks_per_s=3"]
    assert {name: len(of) for name, of in found.items()} == {"bigger_table": 1, "clamped_levels": 1,
                                                             "matched_budget": 2, "where_curiosity_pays": 4}

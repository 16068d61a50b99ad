"""The other ways to decide when to look, by hand and against value iteration. Their papers' toys: tests/toys."""

import inspect
import re
from itertools import combinations
from pathlib import Path
from random import Random
from types import SimpleNamespace

import pytest

import attnlab.learners
from attnlab import registry
from attnlab.errors import ConfigError
from attnlab.learners.chain import Chain
from attnlab.learners.tempo_rl import TempoTables
from attnlab.loading import load_all
from attnlab.reading import Reading
from attnlab.robot.plan import RunPlan
from attnlab.testing import config, make, run
from attnlab.testing.driving import clock, drive
from attnlab.testing.processes import PERIODS, RING, WALK, earn, optimal, powers

WAYS = ("q_learning", "double_q", "sarsa", "expected_sarsa", "q_lambda", "tempo_rl", "amrl", "tacos", "timing",
        "self_triggered", "bandwidth", "regulations")


def test_tempo_rl_by_hand():
    """alpha 1, gamma 0.5. 3 -> 5 in a cycle: Q(3) = 1 + 0.5 * Q(5) = 1; then 7 -> 3 after four at a rate of 2: 3.75 +
    0.5^4 * 1."""
    made = clock("tempo_rl", alpha=1.0, gamma=0.5)
    made.update(3, 0, 1.0, 5, -1, 1)
    made.update(7, 1, 2.0, 3, -1, 4)
    assert made.q[3] == [1.0, 0.0, 0.0, 0.0] and made.q[7] == [0.0, 3.8125, 0.0, 0.0]
    assert made.tables.behaviour[7] == [0.0]  # a period of four cycles says nothing of one
    made.terminal(7, 3, -10.0)
    assert made.q[7][3] == -10.0 and made.visits[7] == [0, 1, 0, 1]


def test_tempo_rl_learns_from_every_stretch_of_a_skip():
    """0 -> 1 -> 2 for rewards 1, 4, gamma 0.5, alpha 1, then the end: two steps of one, one of two (1 + 0.5 * 4), and
    three, which would have ended in the same way."""
    tables = TempoTables(3, 1, (1, 2, 3), alpha=1.0, gamma=0.5)
    tables.path([0, 1, 2], 0, [1.0, 4.0], ended=True)
    assert tables.behaviour == [[1.0], [4.0], [0.0]]  # Q(1) was not known when 0 was left
    assert tables.skip[0][0] == [1.0, 3.0, 3.0] and tables.skip[1][0] == [4.0, 4.0, 4.0]
    tables = TempoTables(3, 1, (1, 2), alpha=1.0, gamma=0.5)
    tables.behaviour[2][0] = 8.0
    tables.path([0, 1, 2], 0, [1.0, 4.0], ended=False)
    assert tables.skip[0][0] == [1.0, 1.0 + 0.5 * 4.0 + 0.25 * 8.0] and tables.skip[1][0] == [4.0 + 0.5 * 8.0, 0.0]


def test_tempo_rl_needs_what_is_between_only_if_it_says_so():
    assert not clock("tempo_rl").needs_between and clock("tempo_rl", observe="all").needs_between
    with pytest.raises(ConfigError, match="asks for the percepts between looks, which a robot that does not look has"):
        RunPlan(config(learner={"name": "tempo_rl", "observe": "all"}))


def test_amrl_by_hand():
    """c 1, alpha 1, gamma 0. After 8 cycles: the period of 8 learns 5 - 1; once the model knows that 2 follows 0 after
    four cycles, so does the period of 4 at 2. 12 is 4 + 8 and 8 + 4."""
    made = clock("amrl", alpha=1.0, gamma=0.0, look_cost=1.0)
    made.update(0, 2, 5.0, 3, -1, 8)
    assert made.q[0] == [0.0, 0.0, 4.0, 0.0] and made.estimate(0, 2) == 3 and made.estimate(0, 1) is None
    assert sum(map(any, made.q)) == 1
    made.update(0, 1, 9.0, 2, -1, 4)
    made.update(0, 2, 7.0, 3, -1, 8)
    assert made.q[2] == [0.0, 6.0, 0.0, 0.0]
    made.update(0, 3, 3.0, 1, -1, 12)
    assert made.q[2] == [0.0, 6.0, 2.0, 0.0] and made.q[3] == [0.0, 2.0, 0.0, 0.0]
    made.terminal(0, 3, -8.0)
    assert made.q[0][3] == -9.0 and made.visits[0] == [0, 1, 2, 2]


def test_the_model_of_amrl_believes_what_it_saw_most():
    made = clock("amrl")
    for after in (3, 4, 4, 3):
        made.update(0, 1, 0.0, after, -1, 4)
    assert made.estimate(0, 1) == 3  # the first of equals
    made.update(0, 1, 0.0, 4, -1, 4)
    assert made.estimate(0, 1) == 4


def test_tacos_by_hand():
    """gamma 0.5, four cycles at a rate of 1: 1 + .5 + .25 + .125 = 1.875, less 0.5, plus 0.5^4 * 8; half of it."""
    made = clock("tacos", alpha=0.5, gamma=0.5, look_cost=0.5)
    made.q[5] = [0.0, 8.0, 0.0, 0.0]
    made.update(0, 1, 1.0, 5, -1, 4)
    assert made.q[0][1] == pytest.approx(0.5 * (1.875 - 0.5 + 0.5))
    made.terminal(0, 0, -4.0)
    assert made.q[0][0] == pytest.approx(-2.25)


def test_a_chain_learns_a_cycle_from_looks_that_are_four_apart():
    """Without one look a cycle later: P^4 of the walk is known to 0.03 after 20,000 looks, and so is P."""
    chain, draw, percept = Chain(6, [4]), Random(0), 0
    for _ in range(20_000):
        start = percept
        for _ in range(4):
            percept = draw.choices(range(6), WALK[percept])[0]
        chain.add(start, 4, percept)
    for _ in range(60):
        chain.renew()
    for mine, true in zip(chain.powers[4], powers(WALK)[4], strict=False):
        assert mine[:6] == pytest.approx(true, abs=0.03) and mine[6] < 0.01
    for mine, true in zip(chain.step, WALK, strict=False):
        assert mine[:6] == pytest.approx(true, abs=0.08)
    assert chain.step[6] == [0.0] * 6 + [1.0] and all(sum(row) == pytest.approx(1.0) for row in chain.step)


def test_a_chain_is_renewed_ever_more_rarely():
    chain = Chain(6, [1])
    renewed = 0
    for _ in range(1000):
        if chain.add(0, 1, 0):
            chain.renew()
            renewed += 1
    assert 40 < renewed < 80 and not chain.add(0, 5, 1)  # a length that is not granted is not counted
    assert chain.looks == 1000


@pytest.mark.parametrize("name", ["timing", "tempo_rl", "tacos", "amrl"])
def test_values_are_those_of_value_iteration(name):
    """On the ring, where a percept follows another with certainty. For amrl rewards hang on the arrival alone, as its
    imagined looks have it; TempoRL's are one look ahead of looking always."""
    if name == "timing":
        made, exact = clock(name, sweeps=200), optimal(RING, earn, lambda p: 0.9)
        drive(made, RING, earn, 3000)
        assert made.plan == [pytest.approx(row, abs=0.05) for row in exact]
    elif name == "tacos":
        made = drive(clock(name, alpha=0.5, look_cost=0.2), RING, earn, 40_000)
        during = {p: (1 - 0.98 ** p) / 0.02 for p in PERIODS}
        exact = optimal(RING, lambda p, x: during[p] * earn(p, x), lambda p: 0.98 ** p, 0.2)
        assert [made.q[x] for x in range(6)] == [pytest.approx(row, abs=0.01) for row in exact]
    elif name == "amrl":
        made = drive(clock(name, look_cost=0.2), RING, lambda p, x: x / 5, 40_000)
        exact = optimal(RING, lambda p, x: x / 5, lambda p: 0.9, 0.2)
        assert [made.q[6 + x] for x in range(6)] == [pytest.approx(row, abs=1e-3) for row in exact]
    else:
        flat = [0.0] * 6
        for _ in range(500):
            flat = [earn(1, (x + 1) % 6) + 0.9 * flat[(x + 1) % 6] for x in range(6)]
        during = {p: (1 - 0.9 ** p) / 0.1 for p in PERIODS}
        exact = [[during[p] * earn(p, (x + p) % 6) + 0.9 ** p * flat[(x + p) % 6] for p in PERIODS] for x in range(6)]
        made = drive(clock(name), RING, earn, 40_000)
        assert [made.q[6 + x] for x in range(6)] == [pytest.approx(row, abs=1e-3) for row in exact]


def test_observing_all_learns_faster():
    """The same 60 looks: with the percepts between them TempoRL knows far more states and periods."""
    def known(observe):
        made = drive(clock("tempo_rl", observe=observe), RING, earn, 60)
        return sum(value != 0.0 for row in made.q for value in row)
    assert known("all") > 1.5 * known("endpoints")


def test_timing_by_hand():
    """gamma 0.5, c 1. From the first percept a cycle leads to the second (0.75, mean reward (2 + 4) / 2) or to death
    (0.25, -8): 0.75 (3 - 1) - 0.25 * 8 = -0.5. The second plan knows that the second percept is worth 4: + 0.75 * 0.5 *
    4."""
    made = clock("timing", gamma=0.5, look_cost=1.0, sweeps=1)
    made.update(0, 0, 2.0, 1, -1, 1)
    made.update(0, 0, 4.0, 1, -1, 1)
    made.terminal(0, 0, -8.0)
    made.chain.powers[1] = [[0.0, 0.75, 0.0, 0.0, 0.0, 0.0, 0.25], *([[0.0] * 6 + [1.0]] * 6)]
    made.plan = [[0.0] * 4 for _ in range(6)]
    made._replan()
    assert made.plan[0][0] == pytest.approx(-0.5) and made.visits[0] == [3, 0, 0, 0]
    made.plan = [[0.0] * 4, [4.0] * 4, *([0.0] * 4 for _ in range(4))]
    made._replan()
    assert made.plan[0][0] == pytest.approx(1.0) and made.values(6 * 3) == made.plan[0]


def test_self_triggered_by_hand():
    """Danger 0, 0.1, 0.1, 0.2, 0.2 ... cycles after a look at the last percept, cost 0.5: 0.4 within four cycles, 1.2
    within eight. Values 1/12, 4/12, then 0.5 less what is expected."""
    made = clock("self_triggered", look_cost=0.5)
    made.trace[5] = [0.0, 0.1, 0.1, 0.2, *[0.2] * 9]
    made.replan()
    assert made.plan[5] == pytest.approx([1 / 12, 4 / 12, 0.5 - 1.2, 0.5 - 2.0])
    assert made.plan[0] == pytest.approx([1.0, -4 / 12, -8 / 12, -1.0])  # dangerous: looked at in every cycle


def test_timing_plans_on_a_walk_with_noise():
    made = drive(clock("timing", sweeps=200), WALK, earn, 20_000)
    assert made.plan == [pytest.approx(row, abs=0.1) for row in optimal(WALK, earn, lambda p: 0.9)]


def harms(dangerous, most=12):
    """Chance of danger k cycles after a look at each percept of the walk, exactly."""
    return [[0.0 if x in dangerous else sum(power[x][d] for d in dangerous) for power in powers(WALK, most)]
            for x in range(6)]


def test_self_triggered_looks_before_harm_costs_a_look():
    """Danger is percepts 1 to 3 of AVOID. Of each percept the longest period whose expected harm is below the cost."""
    made, price = drive(clock("self_triggered", look_cost=0.8), WALK, earn, 20_000), 0.8
    for x, trace in enumerate(harms({0, 1, 2})):
        allowed = [p for p in PERIODS if sum(trace[1:p]) <= price]
        wanted = 1 if x < 3 else max(allowed)
        row = made.values(x)
        assert PERIODS[row.index(max(row))] == wanted, x
        assert made.trace[x] == pytest.approx(trace, abs=0.05)
    assert make("learner", "self_triggered", behaviour="eat").dangerous == [False] * 4 + [True] * 2
    assert make("learner", "self_triggered", behaviour="rest").dangerous == [True] * 2 + [False] * 4


@pytest.mark.parametrize("price", [0.05, 0.4, 2.0])
def test_bandwidth_looks_where_whittles_index_exceeds_the_price(price):
    """W(h) = h f(h+1) - sum f, over all periods 1 to 12: the least cost a cycle is where it first exceeds the price."""
    made = make("learner", "bandwidth", levels=("none",))
    made.trace = harms({0, 1, 2})
    made.market.price = price
    for x in range(3, 6):
        f = harms({0, 1, 2}, 14)[x]
        costs = [(price + sum(f[1:p])) / p for p in range(1, 14)]
        first = next((p for p in range(1, 14) if (p * f[p] - sum(f[1:p])) >= price), 13)
        assert costs.index(min(costs)) + 1 == first
        assert made.values(x) == pytest.approx([-costs[p - 1] for p in PERIODS])
    assert made.values(0) == pytest.approx([-(price + p - 1) / p for p in PERIODS])


def test_the_price_of_looks_keeps_a_shared_budget():
    """Two behaviours that look in every cycle raise it, by 0.02 (2 - 0.4) a cycle once both are known, of which each
    brings its half; rare looks lower it, never below nothing."""
    one, two = (clock("bandwidth") for _ in range(2))
    market = two.market = one.market
    market.means.append(0.0)
    one.update(0, 0, 0.0, 0, -1, 1)
    assert market.price == pytest.approx(0.1 + 0.02 * 0.6)
    two.update(0, 0, 0.0, 0, -1, 1)
    assert market.price == pytest.approx(0.112 + 0.02 * 1.6 / 2)
    for _ in range(300):
        one.update(0, 3, 0.0, 0, -1, 12)
        two.update(0, 3, 0.0, 0, -1, 12)
    assert market.price == 0.0


def test_regulations_by_hand():
    """No weights: emphasis a half, the wanted period 6.5 of 12. A reward of 1 where 0 was expected, after a period of
    one: e moves towards 1 by 0.5 * (1 - 0.5) along the influences 1, 1/5, 1/4, 0."""
    made = clock("regulations", rate=0.5, alpha=0.5, sharpness=12.0)
    state = 1 * 6 + 1  # a period of four in force, the second percept
    assert made.influences(state) == (1.0, 0.2, 0.25, 0.0) and made.emphasis(state) == 0.5
    assert made.values(state) == pytest.approx([-5.5, -2.5, -1.5, -5.5])
    made.update(state, 0, 1.0, 5, -1, 1)
    assert made.weights == pytest.approx([0.25, 0.05, 0.0625, 0.0]) and made.critic[1] == 0.5
    made.update(state, 0, 0.0, 5, -1, 1)  # worse than expected: nothing moves
    assert made.weights == pytest.approx([0.25, 0.05, 0.0625, 0.0]) and made.critic[1] == 0.25
    made.terminal(state, 0, -1500.0)
    assert made.critic[1] == pytest.approx(0.5 * 0.25 - 750.0)


def test_regulations_learn_to_look_when_it_pays():
    """Long periods pay at the lowest percept, short ones at the highest: the wanted periods come to lie that way."""
    made = clock("regulations", rate=0.2, gamma=0.0)
    draw = Random(0)
    for _ in range(6000):
        percept, action = draw.choice((0, 5)), draw.randrange(4)
        made.update(6 + percept, action, PERIODS[action] / 12 if percept == 0 else 1 / PERIODS[action], 6, -1, 4)
    wanted = {x: made.values(6 + x).index(max(made.values(6 + x))) for x in (0, 5)}
    assert wanted[0] > wanted[5] and made.weights[1] > 0.5


def test_emotional_clocks_by_hand():
    """AVOID's line grants 1, 4, 4, 8, 8, 12 for percepts 1 to 6. gain 0.5, fading 0.5: at the first percept u = 1, 1 *
    0.5 = 0.5 -> 1; a cycle later at the last, e = 0.5: 12 * 0.75 = 9 -> 8; eight later e is 0.002: 12."""
    made = clock("emotional", gain=0.5, fading=0.5)
    made.start()
    assert [made.decide(s, None, None) for s in (0, 0 * 6 + 5, 2 * 6 + 5)] == [0, 2, 3]
    made.start()
    assert made.decide(5, None, None) == 3
    calm = clock("emotional", gain=0.0)
    assert [calm.decide(x, None, None) for x in range(6)] == [0, 1, 1, 2, 2, 3]


def robot(*clocks):
    """(name, period, command) of each behaviour, as a fusion sees them."""
    return [SimpleNamespace(behaviour=SimpleNamespace(name=n), period=p, command=c) for n, p, c in clocks]


@pytest.mark.parametrize(("periods", "top_down", "fused"), [
    ((1, 4), {}, (0.1, 0.5)), ((4, 1), {}, (0.3, -0.2)), ((4, 4), {}, (0.1, 0.5)),
    ((1, 4), {"eat": 1.0}, (0.3, -0.2)), ((12, 1), {"avoid": 2.0}, (0.1, 0.5))])
def test_the_largest_emphasis_has_its_way(periods, top_down, fused):
    fusion = make("fusion", "contention", top_down=top_down)
    avoid, eat = ("avoid", periods[0], (0.1, 0.5)), ("eat", periods[1], (0.3, -0.2))
    fusion.attach(robot(avoid, ("drink", 1, None), eat))
    assert fusion.fuse([(0.1, 0.5), (0.3, -0.2)]) == fused


def test_who_asks_for_nothing_does_not_compete():
    """AVOID at full speed straight on leaves both motors to EAT, though it looks more often; without bids: ahead."""
    fusion, full = make("fusion", "contention"), Reading().v_max_m_s
    fusion.attach(robot(("avoid", 1, (full, 0.0)), ("eat", 12, (0.2, 0.3))))
    assert fusion.fuse([(full, 0.0), (0.2, 0.3)]) == (0.2, 0.3)
    fusion.attach(robot(("avoid", 1, (full, 0.4)), ("eat", 12, (0.2, 0.0))))
    assert fusion.fuse([(full, 0.4), (0.2, 0.0)]) == (0.2, 0.4)
    fusion.attach(robot(("avoid", 1, (full, 0.0))))
    assert fusion.fuse([(full, 0.0)]) == (full, 0.0) and fusion.fuse([]) == (0.0, 0.0)
    assert make("fusion", "contention").fuse([(9.0, 9.0)]) == (full, 1.5)  # alone, and cut to what the motors can


def test_no_two_ways_give_equal_tables():
    """The same run of 8 episodes by each: all q tables and all choices differ."""
    tables = {name: run(learner=name, curiosity="none", behaviours=("avoid", "eat"),
                        train_episodes=8, max_cycles=300)["policy"] for name in WAYS}
    for one, two in combinations(WAYS, 2):
        assert tables[one]["q"] != tables[two]["q"], (one, two)
        assert tables[one]["visits"] != tables[two]["visits"], (one, two)


def test_a_learner_is_a_short_file_that_names_its_source():
    load_all()
    folder = Path(attnlab.learners.__file__).parent
    assert not {file.name: n for file in folder.glob("*.py") if (n := len(file.read_text().splitlines())) > 120}
    for name in (*WAYS, "emotional", "monitor"):
        said = inspect.getdoc(registry.find("learner", name).cls)
        assert re.search(r"\b(19|20)\d\d\b", said), name
    for name in ("tempo_rl", "amrl", "timing", "tacos", "self_triggered", "bandwidth", "regulations", "emotional"):
        said = inspect.getdoc(registry.find("learner", name).cls)
        assert re.search(r"\b[Oo]urs\b", said), f"{name} does not say what is ours"

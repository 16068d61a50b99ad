"""Learning on blocks of a log, and the page: what is compared is fair, repeats itself, and can be added to."""

from random import Random

import pytest

from attnlab.arena import board
from attnlab.arena.drive import Drive, Task
from attnlab.arena.summary import at_equal_looks, interval, kept, leaders, on_front, ranks, standings
from attnlab.arena.ways import BETWEEN, DEFAULT, compete, decide_by, make, train, way
from attnlab.arena.words import words
from attnlab.errors import ConfigError
from attnlab.loading import load_all
from attnlab.registry import make as make_part
from tests.arena.drives import pulses

load_all()
TASK = Task(price=0.5)


class Spy:
    """A learner that writes down what it is told."""
    learns, on_policy, needs_between = True, False, False

    def __init__(self):
        self.told = []

    def start(self):
        pass

    def decide(self, state, exploration, draw):
        self.told.append(("decide", state))
        return 1

    def update(self, *args):
        self.told.append(("update", args))

    def watched(self, *args):
        self.told.append(("watched", args))


def test_a_learner_is_told_what_it_looked_at_and_no_more():
    """Period 4 over 11 cycles: looks at 0, 4, 8. The price is 0.5; of the first period one cycle is wrong."""
    made, spy = Drive("d", (0.9, 0.9, 0.9, 0.2, 0.2, 0.2, 0.2, 0.2, 0.2, 0.2, 0.2), (0,), 0.1, ()), Spy()
    train(spy, made, [(0, 11)], TASK, seed=0, epochs=1)
    assert spy.told == [("decide", 5), ("update", (5, 1, 1.0 - 1.5 / 4, 6 + 1, -1, 4)), ("decide", 7),
                        ("update", (7, 1, 1.0 - 0.5 / 4, 7, -1, 4)), ("decide", 7)]
    spy = Spy()
    spy.needs_between = True
    train(spy, made, [(0, 11)], TASK, seed=0, epochs=1)
    assert spy.told[1] == ("watched", ([5, 11, 11, 7, 7], [0.5, 1.0, 1.0, 0.0], False))


def test_nobody_is_judged_on_what_it_learned_from(monkeypatch):
    """Blocks that are changed change no judgement of their own parity's learning: those of other parity do."""
    made = pulses()
    length = len(made.near_m) // 8
    changed = Drive("c", tuple(0.95 if i // length == 2 else x for i, x in enumerate(made.near_m)), (0,), 0.1, ())
    first = compete(way("q_learning", TASK), made, TASK, 0, epochs=5)
    second = compete(way("q_learning", TASK), changed, TASK, 0, epochs=5)
    assert [a == b for a, b in zip(first[0::2], second[0::2], strict=True)] == [True, False, True, True]
    assert first != compete(way("q_learning", TASK), made, TASK, 1, epochs=5)
    assert first == compete(way("q_learning", TASK), made, TASK, 0, epochs=5)


@pytest.mark.parametrize("name", [*DEFAULT, BETWEEN])
def test_every_way_competes(name):
    made = pulses(600)
    scores = compete(way(name, TASK), made, TASK, 0, epochs=1)
    assert len(scores) == 8 and all(0 < s.looks <= s.cycles and s.missed <= s.onsets for s in scores)
    if name == "always_on":
        assert sum(s.blind + s.needless for s in scores) == 0


def test_learning_beats_chance_where_there_is_something_to_learn():
    made = pulses(3000)
    cost = {name: sum(s.cost(TASK.price) for s in compete(way(name, TASK), made, TASK, 0, epochs=10)) for name in
            ("q_learning", "random", "always_on")}
    assert cost["q_learning"] < cost["random"] < cost["always_on"]


def test_ways_that_are_none():
    for name, match in (("q_lerning", "Did you mean 'q_learning'"), ("q_learning(all)", "no learner is called"),
                        ("evolution", "plays whole episodes")):
        with pytest.raises(ConfigError, match=match):
            way(name, TASK)


def test_settings_of_a_price():
    """The price is in the reward; who plans by a cost of looks is given the same one, and danger begins at an onset."""
    assert way("amrl", TASK).node["look_cost"] == way("tacos", TASK).node["look_cost"] == 0.0
    assert way("self_triggered", TASK).node["look_cost"] == 0.5
    assert make(way("bandwidth", TASK), TASK, 0).dangerous == [True] * 4 + [False] * 2
    assert way(BETWEEN, TASK).between and not way("tempo_rl", TASK).between
    greedy = make_part("exploration", {"name": "greedy"}, None)
    assert decide_by(make(way("fixed_8", TASK), TASK, 0), greedy, Random(0))(0, 3) == 2


def row(way_name, unit, looks, harm, place="p", **more):
    return board.Row(place, way_name, unit, looks, harm, **more)


def test_equal_looks_by_hand():
    curve = [(0.1, 0.5), (0.5, 0.1), (1.0, 0.0)]
    assert at_equal_looks(curve, 0.3) == pytest.approx(0.3) and at_equal_looks(curve, 1.0) == 0.0
    assert at_equal_looks(curve, 0.05) is None and at_equal_looks([], 0.5) is None
    assert interval([1.0, 3.0]) == pytest.approx((2.0, -10.706, 14.706), abs=1e-3)
    assert interval([1.0]) == (1.0, 1.0, 1.0)


def small_board():
    """A way that halves the harm of a fixed clock of equal looks in eight blocks, one that is worse, one unclear."""
    rows = []
    for i in range(8):
        wobble = 0.01 * (i % 2)
        rows += [row("always_on", f"b{i}", 1.0, 0.0), row("fixed_4", f"b{i}", 0.25, 0.2),
                 row("fixed_12", f"b{i}", 0.08, 0.4), row("good", f"b{i}", 0.25, 0.1 + wobble),
                 row("bad", f"b{i}", 0.25, 0.3 + wobble), row("(knows)", f"b{i}", 0.05, 0.01),
                 row("so", f"b{i}", 0.25, 0.2 + (0.02 if i % 2 else -0.02))]
    return rows


def test_standings_say_what_is_clear():
    found = {s.way: s for s in standings(small_board())}
    assert {name: s.verdict for name, s in found.items()} == {
        "always_on": "", "fixed_4": "", "fixed_12": "", "good": "better", "bad": "worse", "so": "not clear",
        "(knows)": ""}
    assert found["good"].saved[0] == pytest.approx(0.095)
    assert {name for name, s in found.items() if s.front} == {"always_on", "good", "fixed_12"}
    assert all(s.verdict == "" for s in standings([r for r in small_board() if r.unit in ("b0", "b1")]))
    told = words("p", list(found.values()), 0.5)
    assert "best score is good's" in told and "worse (bad)" in told
    assert "1 are clearly better (good by 9.5 [9.1, 9.9] points at 25 looks)" in told and "(Holm over the 3," in told


def test_many_ways_are_corrected_for_being_many():
    """One way that saves a little in eight blocks is clear on its own, and not among twenty that save nothing."""
    saves = [0.01, 0.03, -0.005, 0.02, 0.015, 0.0, 0.025, 0.01]
    mine = [row("mine", f"b{i}", 0.25, 0.2 - x) for i, x in enumerate(saves)]
    alone = {s.way: s for s in standings([*small_board(), *mine])}["mine"]
    others = [row(f"w{k}", f"b{i}", 0.25, 0.2 + (0.01 if (i + k) % 2 else -0.01)) for k in range(20) for i in range(8)]
    crowd = {s.way: s for s in standings([*small_board(), *mine, *others])}["mine"]
    assert alone.p == pytest.approx(0.0171, abs=1e-4) and alone.p == crowd.p and alone.verdict == "better"
    assert crowd.holm == pytest.approx(22 * crowd.p) and crowd.verdict == "not clear"


def test_clocks_of_any_period_are_held_against_and_do_not_compete():
    """Between fixed ones at 0.25 and 0.08 looks stands a steady one that is better than the line between them."""
    rows = [r for r in small_board() if r.way != "(knows)"]
    near = [row("(steady 6)", f"b{i}", 0.17, 0.21) for i in range(8)]
    mine = [row("mine", f"b{i}", 0.17, 0.25) for i in range(8)]
    saved = [{s.way: s for s in standings(of)}["mine"].saved[0] for of in ([*rows, *mine], [*rows, *near, *mine])]
    assert saved == pytest.approx([(0.2 + 0.2 * 8 / 17) - 0.25, -0.04])
    found = {s.way: s for s in standings([*rows, *near, *mine])}
    assert not found["(steady 6)"].front and found["(steady 6)"].saved is None and found["mine"].front


def test_how_often_a_way_is_on_the_front():
    """always_on and the cheapest are in any sample; a way that beats another in half of the blocks only is not."""
    rows = [r for r in small_board() if r.way in ("always_on", "fixed_12")]
    rows += [row(name, f"b{i}", 0.25, 0.1 + (0.02 if i % 2 == odd else 0.0)) for odd, name in enumerate(("a", "b"))
             for i in range(8)]
    often = on_front({name: {r.unit: r for r in rows if r.way == name} for name in
                      ("always_on", "fixed_12", "a", "b")})
    assert often["always_on"] == often["fixed_12"] == 1.0
    assert 0.4 < often["a"] < 0.8 and 1.0 < often["a"] + often["b"] < 1.5


def test_ranks_change_with_the_price():
    found = standings(small_board())
    places = ranks(found, (0.0, 10.0))
    assert places["always_on"] == [1, 6] and places["fixed_12"][1] == 1 and "(knows)" not in places
    assert leaders(found) == [(0.0, 0.14, "always_on"), (0.15, 1.73, "good"), (1.74, 2.0, "fixed_12")]
    assert kept(found, 0.5, 0.5) == 1.0 and kept(found, 0.0, 100.0) < 0.5


def test_a_leaderboard_goes_to_a_file_and_back(tmp_path):
    rows = small_board()
    board.write_board(map(board.short, rows), tmp_path / "b.jsonl")
    found = {(r.way, r.unit): (r.place, r.looks, r.harm) for r in board.read_board(tmp_path / "b.jsonl")}
    assert found == {(r.way, r.unit): (r.place, pytest.approx(r.looks), pytest.approx(r.harm)) for r in rows}
    theirs = [row("mine", "b0", 0.3, 0.1), rows[0]]
    assert len(board.merged(rows, theirs)) == len(rows) + 1
    with pytest.raises(ConfigError, match="'good' in p .b0. is there already, with other numbers"):
        board.merged(rows, [row("good", "b0", 0.3, 0.1)])


NO_SHARE = '{"format": "attnlab arena 1", "place": "p", "way": "w", "unit": "u", "looks": %s, "harm": 0}'


@pytest.mark.parametrize("line", ["", "{}", "[]", "null", "none", '{"format": "x"}', '{"format": "attnlab arena 1"}',
                                  NO_SHARE % "2", NO_SHARE % "NaN", NO_SHARE % "null"])
def test_rows_that_are_none(tmp_path, line):
    (tmp_path / "b.jsonl").write_text(line + "\n")
    with pytest.raises(ConfigError, match="line 1 of b.jsonl is no row"):
        board.read_board(tmp_path / "b.jsonl")

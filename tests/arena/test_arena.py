"""Learning on blocks of a log, and the page: what is compared is fair, repeats itself, and can be added to."""

import json
import re
import subprocess
import sys
from random import Random

import pytest

from attnlab.arena import board
from attnlab.arena.__main__ import main
from attnlab.arena.drive import Drive, Task
from attnlab.arena.summary import at_equal_looks, interval, ranks, standings, words
from attnlab.arena.ways import BETWEEN, DEFAULT, compete, decide_by, make, train, way
from attnlab.errors import ConfigError
from attnlab.loading import load_all
from attnlab.registry import make as make_part

load_all()
TASK = Task(price=0.5)


def pulses(n=2000, seed=0):
    """Something near for 12 cycles after every 40 to 60 far ones; it comes closer over six cycles, so that it can be
    foreseen by who watches."""
    draw, near = Random(seed), []
    while len(near) < n:
        near += [0.95] * draw.randrange(40, 60) + [0.95 - 0.06 * k for k in range(6)] + [0.3] * 12
    return Drive("pulses", tuple(near[:n]), (0,), 0.1, ())


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
    assert interval([1.0, 3.0]) == pytest.approx((2.0, 12.706), abs=1e-3) and interval([1.0]) == (1.0, 0.0)


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
    assert "best score is good's" in told and "1 are clearly better (good)" in told and "worse (bad)" in told


def test_ranks_change_with_the_price():
    found = standings(small_board())
    places = ranks(found, (0.0, 10.0))
    assert places["always_on"] == [1, 6] and places["fixed_12"][1] == 1 and "(knows)" not in places


def test_a_leaderboard_goes_to_a_file_and_back(tmp_path):
    rows = small_board()
    board.write_board(rows, tmp_path / "b.jsonl")
    assert sorted(map(repr, board.read_board(tmp_path / "b.jsonl"))) == sorted(map(repr, rows))
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


def logged(tmp_path, name="pulses.csv"):
    made = pulses(900)
    (tmp_path / name).write_text("t_s,r10\n" + "\n".join(f"{0.1 * i},{x}" for i, x in enumerate(made.near_m)) + "\n")
    return str(tmp_path / name)


def test_the_command_makes_a_page_that_repeats_itself(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    arguments = ["--log", logged(tmp_path), "--ways", f"fixed_4,q_learning,monitor,{BETWEEN}", "--seeds", "2",
                 "--epochs", "2"]
    assert main([*arguments, "--out", "one"]) == 0
    assert "pulses: at a price of 0.5 a look" in capsys.readouterr().out
    assert main([*arguments, "--out", "one"]) == 0
    first = [(tmp_path / "one" / name).read_bytes() for name in ("index.html", "arena.md", "leaderboard.jsonl")]
    page = first[0].decode()
    assert not re.search("(src|href)=|https?://", page.replace("http://www.w3.org/2000/svg", ""))
    data = json.loads(re.search(r'<script id="data" type="application/json">(.*?)</script>', page, re.DOTALL)[1])
    assert {r["way"]: r["between"] for r in data["places"]["pulses"]} == {
        "fixed_4": False, "q_learning": False, "monitor": False, BETWEEN: True, "(knows the future)": False}
    assert page.count('class="look"') == 4 and "<svg" in page
    rows = board.read_board(tmp_path / "one" / "leaderboard.jsonl")
    assert len(rows) == 5 * 8 and rows[0].made["code"]["hash"] and "attnlab.arena" in rows[0].made["command"]
    mine = tmp_path / "mine.jsonl"
    board.write_board([row("theirs", f"block {i}", 0.2, 0.05, place="pulses") for i in range(8)], mine)
    assert main([*arguments, "--out", "two", "--add", str(mine)]) == 0
    assert "| theirs |" in (tmp_path / "two" / "arena.md").read_text()
    assert "| theirs |" not in first[1].decode()


@pytest.mark.parametrize(("arguments", "problem"), [
    ([], "--log: no place to compete in was named"), (["--log", "none.csv"], "there is no file none.csv"),
    (["--worlds", "paper", "--seeds", "0"], "--seeds: is 0, must be from 1"),
    (["--worlds", "paper", "--carry", "x"], "--carry: is for logs"),
    (["--log", "none.csv", "--price", "-1"], "--price: is -1.0"),
    (["--log", "none.csv", "--ways", "x"], "no learner is"),
    (["--add", "none.jsonl"], "there is no file none.jsonl"), (["--study", "none"], "there is no folder none"),
    (["--log", "none.csv", "train_episodes=3"], "train_episodes=3: is for the study in worlds"),
    (["--worlds", "paper", "--price", "nan"], "--price: is nan")])
def test_what_cannot_be_is_said_before_anything_runs(arguments, problem, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ConfigError, match=problem):
        main(arguments)
    assert not list(tmp_path.iterdir())


@pytest.mark.long
def test_ways_in_a_world_and_a_clock_carried_to_a_log(tmp_path):
    """One command in a fresh process: a study of two ways and two seeds, then its clock on a log."""
    def run(*arguments):
        return subprocess.run([sys.executable, "-m", *arguments], cwd=tmp_path, capture_output=True, text=True)
    done = run("attnlab.arena", "--worlds", "wandering", "--ways", "fixed_4,q_learning", "--seeds", "2", "--out", "w",
               "train_episodes=2", "validation_episodes=2", "max_cycles=200", "cluster=serial")
    assert done.returncode == 0, done.stderr
    rows = board.read_board(tmp_path / "w" / "leaderboard.jsonl")
    assert {(r.place, r.way, r.unit) for r in rows} == {("world wandering", w, f"seed {s}")
                                                        for w in ("fixed_4", "q_learning") for s in (0, 1)}
    assert all(0 < r.looks < 1 and 0 <= r.harm <= 1 and r.detail["safety"] >= 0 for r in rows)
    assert next(r for r in rows if r.way == "fixed_4").looks == pytest.approx(0.25, abs=0.01)
    learned = next((tmp_path / "outputs" / "arena_worlds").glob("q_learning*"))
    done = run("attnlab.arena", "--log", logged(tmp_path), "--ways", "fixed_4", "--carry", str(learned), "--out", "l",
               "--seeds", "1")
    assert done.returncode == 0, done.stderr
    assert "| q_learning (from simulation) |" in (tmp_path / "l" / "arena.md").read_text()

"""The command: its page repeats itself, holds what others add, and says what cannot be in a line."""

import json
import re
import subprocess
import sys

import pytest

from attnlab import registry
from attnlab.arena import board
from attnlab.arena.__main__ import main
from attnlab.arena.ways import BETWEEN
from attnlab.arena.worlds import PERIODS
from attnlab.errors import ConfigError
from attnlab.learners.fixed import NoLearner
from attnlab.registry import register
from tests.arena.drives import logged


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
    assert page.count('class="look b0"') == 4 and "<svg" in page
    ranked = [line.split(",")[1] for line in (tmp_path / "one" / "ranks.csv").read_text().splitlines()[1:]]
    harms = {r["way"]: r["harm"][0] for r in data["places"]["pulses"] if r["way"] != "(knows the future)"}
    assert ranked == sorted(harms, key=lambda name: (harms[name], name))
    rows = board.read_board(tmp_path / "one" / "leaderboard.jsonl")
    assert len(rows) == 5 * 8 and rows[0].made["code"]["hash"] and "attnlab.arena" in rows[0].made["command"]
    mine = tmp_path / "mine.jsonl"
    board.write_board([board.Row("pulses", "theirs", f"block {i}", 0.2, 0.05) for i in range(8)], mine)
    assert main([*arguments, "--out", "two", "--add", str(mine)]) == 0
    assert "| theirs |" in (tmp_path / "two" / "arena.md").read_text()
    assert "| theirs |" not in first[1].decode()


def test_a_learner_of_ones_own_joins_by_its_name(tmp_path, monkeypatch):
    """It stands in the table and on the board with its settings, and is judged as the others are."""
    @register("learner", "ones_own")
    class OnesOwn(NoLearner):
        """Looks again after the longest period, whatever it sees."""

        def decide(self, state, exploration, draw):
            return self.actions - 1
    monkeypatch.chdir(tmp_path)
    try:
        assert main(["--log", logged(tmp_path), "--ways", "fixed_12,ones_own", "--seeds", "1", "--out", "o"]) == 0
    finally:
        del registry.parts["learner", "ones_own"]
    rows = {name: [r for r in board.read_board(tmp_path / "o" / "leaderboard.jsonl") if r.way == name]
            for name in ("fixed_12", "ones_own")}
    assert [(r.looks, r.harm) for r in rows["ones_own"]] == [(r.looks, r.harm) for r in rows["fixed_12"]]
    assert rows["ones_own"][0].made["settings"]["name"] == "ones_own"


def test_prices_of_learning_are_a_sweep(tmp_path, monkeypatch):
    """Who learns is there at each price, who does not only once; a price changes what is learned."""
    monkeypatch.chdir(tmp_path)
    assert main(["--log", logged(tmp_path), "--ways", "fixed_4,q_learning", "--seeds", "1", "--train-prices", "0.01,5",
                 "--out", "o"]) == 0
    looks: dict[str, float] = {}
    for row in board.read_board(tmp_path / "o" / "leaderboard.jsonl"):
        looks[row.way] = looks.get(row.way, 0.0) + row.looks
    assert set(looks) == {"fixed_4", "q_learning", "q_learning price=0.01", "q_learning price=5", "(knows the future)"}
    assert looks["q_learning price=0.01"] > looks["q_learning price=5"]


def test_a_cap_holds_for_everybody(tmp_path, monkeypatch):
    """Two looks a second are a fifth of the cycles of a tenth of a second; each block's first is free."""
    monkeypatch.chdir(tmp_path)
    assert main(["--log", logged(tmp_path), "--ways", "always_on,q_learning", "--seeds", "1", "--cap", "2",
                 "--out", "o"]) == 0
    rows = board.read_board(tmp_path / "o" / "leaderboard.jsonl")
    assert all(row.looks <= 0.2 + 2 / 112 for row in rows)
    assert max(row.looks for row in rows) > 0.15


@pytest.mark.parametrize(("arguments", "problem"), [
    (["--log", "none.csv"], "there is no file none.csv"), (["--read", "none.csv"], "there is no file none.csv"),
    (["--worlds", "paper", "--seeds", "0"], "--seeds: is 0, must be from 1"),
    (["--worlds", "paper", "--carry", "x"], "--carry: is for logs"),
    (["--log", "none.csv", "--price", "-1"], "--price: is -1.0"),
    (["--log", "none.csv", "--ways", "x"], "no learner is"),
    (["--add", "none.jsonl"], "there is no file none.jsonl"), (["--study", "none"], "--study: none: there is no"),
    (["--study", "."], "--study: . holds no complete run"),
    (["--log", "none.csv", "train_episodes=3"], "train_episodes=3: is for the study in worlds"),
    (["--worlds", "paper", "--price", "nan"], "--price: is nan"),
    (["--worlds", "paper", "--cap", "0"], "--cap: is 0.0, must be from 0.001"),
    (["--worlds", "paper", "--look-cost", "2,-1"], "--look-cost: is -1.0"),
    (["--log", "none.csv", "--train-prices", "nan"], "--train-prices: is nan"),
    (["--add", "none.jsonl", "--train-prices", "1"], "--train-prices: is for logs"),
    (["--log", "none.csv", "--look-cost", "1"], "--look-cost: is for the study in worlds"),
    (["--worlds", "paper", "--seeds", "1e3"], "--seeds: must be a whole number, not '1e3'"),
    (["--worlds", "paper", "--price", "dear"], "--price: must be a number, not 'dear'"),
    (["--worlds", "papr"], "Did you mean 'paper'"), (["--worlds", ""], "--worlds: names no world"),
    (["--worlds", "paper", "--ways", "q_lerning"], "Did you mean 'q_learning'"),
    (["--worlds", "paper", "--ways", "q_learning,"], "no learner is called ''"),
    (["--worlds", "paper", "train_episods=3"], "train_episods")])
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
    steady = [f"(steady {period:g})" for period in PERIODS]
    ways = ["fixed_4", "q_learning", "q_learning+litman", "fixed_12 avoid=8", "fixed_12 avoid=4", *steady]
    assert {r.place for r in rows} == {"world wandering"}
    assert {(r.way, r.unit) for r in rows} == {(w, f"seed {s}") for w in ways for s in (0, 1)}
    assert all(r.made["code"]["hash"] and r.made["study"] == "arena_worlds" for r in rows)
    page = (tmp_path / "w" / "index.html").read_text()
    assert page.count('class="look b2"') == 5  # of five ways that compete, each of three behaviours
    assert all(0 < r.looks < 1 and 0 <= r.harm <= 1 and r.detail["safety"] >= 0 for r in rows)
    assert next(r for r in rows if r.way == "fixed_4").looks == pytest.approx(0.25, abs=0.01)
    learned = next((tmp_path / "outputs" / "arena_worlds").glob("q_learning*"))
    done = run("attnlab.arena", "--log", logged(tmp_path), "--ways", "fixed_4", "--carry", str(learned), "--out", "l",
               "--seeds", "1")
    assert done.returncode == 0, done.stderr
    assert "| q_learning (from simulation) |" in (tmp_path / "l" / "arena.md").read_text()

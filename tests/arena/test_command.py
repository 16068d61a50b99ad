"""The command: its page repeats itself, holds what others add, and says what cannot be in a line."""

import json
import re
import subprocess
import sys

import pytest

from attnlab.arena import board
from attnlab.arena.__main__ import main
from attnlab.arena.ways import BETWEEN
from attnlab.arena.worlds import PERIODS
from attnlab.errors import ConfigError
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


@pytest.mark.parametrize(("arguments", "problem"), [
    (["--log", "none.csv"], "there is no file none.csv"), (["--read", "none.csv"], "there is no file none.csv"),
    (["--worlds", "paper", "--seeds", "0"], "--seeds: is 0, must be from 1"),
    (["--worlds", "paper", "--carry", "x"], "--carry: is for logs"),
    (["--log", "none.csv", "--price", "-1"], "--price: is -1.0"),
    (["--log", "none.csv", "--ways", "x"], "no learner is"),
    (["--add", "none.jsonl"], "there is no file none.jsonl"), (["--study", "none"], "there is no such study"),
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
    ways = ["fixed_4", "q_learning", "q_learning+litman", *steady]
    assert {r.place for r in rows} == {"world wandering"}
    assert {(r.way, r.unit) for r in rows} == {(w, f"seed {s}") for w in ways for s in (0, 1)}
    assert all(r.made["code"]["hash"] and r.made["study"] == "arena_worlds" for r in rows)
    page = (tmp_path / "w" / "index.html").read_text()
    assert page.count('class="look b2"') == 3  # of three ways that compete, each of three behaviours
    assert all(0 < r.looks < 1 and 0 <= r.harm <= 1 and r.detail["safety"] >= 0 for r in rows)
    assert next(r for r in rows if r.way == "fixed_4").looks == pytest.approx(0.25, abs=0.01)
    learned = next((tmp_path / "outputs" / "arena_worlds").glob("q_learning*"))
    done = run("attnlab.arena", "--log", logged(tmp_path), "--ways", "fixed_4", "--carry", str(learned), "--out", "l",
               "--seeds", "1")
    assert done.returncode == 0, done.stderr
    assert "| q_learning (from simulation) |" in (tmp_path / "l" / "arena.md").read_text()

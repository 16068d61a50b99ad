"""One claim a run: made by one alone, taken over from the dead, kept from those who were thought so."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from types import SimpleNamespace

import pytest

from attnlab.launch.jobs import ended_under
from attnlab.launch.shared import done_by_others
from attnlab.robot.folder import ClaimLostError, run_to_folder
from attnlab.tables.claim import FOLDER, PATIENCE_S, beating, clear, place, standings, sweep, take
from attnlab.tables.files import read_json, write_json
from attnlab.testing.build import config

INFO = {"run": "run", "key": "k", "overrides": [], "swept": {}}


def old(path, seconds):
    """Let a file be that old."""
    at = path.stat().st_mtime - seconds
    os.utime(path, (at, at))


def gone():
    """A number that no living process has."""
    process = subprocess.Popen([sys.executable, "-c", ""])
    process.wait()
    return process.pid


def owned_by(claim, **who):
    owner = json.loads((claim.path / "owner.json").read_text())
    (claim.path / "owner.json").write_text(json.dumps({**owner, **who}))


def test_of_many_who_ask_at_once_one_gets_it(tmp_path):
    with ThreadPoolExecutor(16) as pool:
        for round_ in range(20):
            found = [claim for claim in pool.map(take, [tmp_path] * 16, [f"key{round_}"] * 16) if claim]
            assert len(found) == 1 and found[0].held()


def test_of_many_who_find_a_dead_one_one_gets_it(tmp_path):
    pid = gone()
    with ThreadPoolExecutor(16) as pool:
        for round_ in range(20):
            dead = take(tmp_path, f"key{round_}")
            owned_by(dead, pid=pid)
            found = [claim for claim in pool.map(take, [tmp_path] * 16, [f"key{round_}"] * 16) if claim]
            assert len(found) == 1 and found[0].held() and not dead.held()
    assert sorted(path.name for path in (tmp_path / FOLDER).iterdir()) == sorted(f"key{i}.2" for i in range(20))


def test_what_the_dead_kept_on_complete_runs_is_cleared(tmp_path):
    kept = [take(tmp_path, key) for key in ("done", "mine", "missing")]
    for claim in (kept[0], kept[2]):
        owned_by(claim, pid=gone())
    clear(tmp_path, {"done", "mine"})
    assert sorted(standings(tmp_path)) == ["mine", "missing"]
    clear(tmp_path / "no study", {"done"})


def test_given_back_it_is_free_and_leaves_nothing(tmp_path):
    claim = take(tmp_path, "key")
    assert take(tmp_path, "key") is None and take(tmp_path, "other") is not None
    claim.release()
    assert take(tmp_path, "key").held()
    claim.release()  # ours no more: the other keeps his
    assert set(standings(tmp_path)) == {"key", "other"}
    claim.beat(5, 5)
    assert standings(tmp_path)["key"].episodes == 0


@pytest.mark.parametrize(("who", "silent", "free"), [
    ({}, 0, False), ({}, PATIENCE_S + 9, True),                                    # alive; alive, and stuck
    ({"pid": "gone"}, 0, True),                                                    # dead here: at once
    ({"pid": "gone", "place": "elsewhere"}, 0, False),                             # dead elsewhere: not to be told yet
    ({"pid": "gone", "place": "elsewhere"}, PATIENCE_S + 9, True),
    ({"pid_birth": 1}, 0, True)])                                                  # its number is used again
def test_who_is_dead(tmp_path, who, silent, free):
    claim = take(tmp_path, "key")
    owned_by(claim, **{name: gone() if value == "gone" else value for name, value in who.items()})
    old(claim.path / "beat", silent)
    assert (take(tmp_path, "key") is not None) is free
    assert claim.held() is not free


def test_signs_of_life_keep_it(tmp_path, monkeypatch):
    monkeypatch.setattr("attnlab.tables.claim.BEAT_S", 0.01)
    claim = take(tmp_path, "key")
    old(claim.path / "beat", PATIENCE_S + 9)
    assert standings(tmp_path)["key"].dead
    with beating(claim) as far:
        far[:] = 3, 700
        while not (standing := standings(tmp_path)["key"]).episodes:
            pass
    assert not standing.dead and standing.cycles == 700 and standing.owner["place"] == place()


def test_what_was_left_half_made_is_swept(tmp_path):
    (tmp_path / FOLDER / ".key.abc").mkdir(parents=True)
    (tmp_path / FOLDER / ".now.abc").touch()
    sweep(tmp_path)
    assert len(list((tmp_path / FOLDER).iterdir())) == 2  # it may be in the making
    for path in (tmp_path / FOLDER).iterdir():
        old(path, PATIENCE_S + 9)
    sweep(tmp_path)
    assert not list((tmp_path / FOLDER).iterdir())


def test_who_lost_his_writes_no_more(tmp_path):
    """It was stopped, was thought dead, and comes back after another one has done the run."""
    short = config(train_episodes=2, validation_episodes=0, max_cycles=60)
    first, other = take(tmp_path, "k"), []

    def taken_over(episodes, cycles):
        if not other:
            old(first.path / "beat", PATIENCE_S + 9)
            other.append(take(tmp_path, "k"))
            assert run_to_folder(short, tmp_path / "run", INFO, claim=other[0])
            other.append({path.name: (path.read_bytes(), path.stat().st_mtime_ns)
                          for path in (tmp_path / "run").iterdir()})
    with pytest.raises(ClaimLostError):
        run_to_folder(short, tmp_path / "run", INFO, taken_over, first)
    now = {path.name: (path.read_bytes(), path.stat().st_mtime_ns) for path in (tmp_path / "run").iterdir()}
    assert now == other[1]
    assert json.loads((tmp_path / "run" / "run.json").read_text())["claim"] == other[0].token


@pytest.mark.parametrize("status", ["running", "failed", "complete"])
def test_what_ended_since_one_looked_is_not_done_again(tmp_path, status):
    """A run that was at work when a command planned ends under the claim it had then, and counts as done; one that
    had ended, and is asked for again, does not."""
    folder = tmp_path / "main" / "a-seed0-k"
    folder.mkdir(parents=True)
    write_json(folder / "run.json", {"status": status, "key": "k", "claim": "his"})
    job = SimpleNamespace(folder=folder, key="k", seen=ended_under(read_json(folder / "run.json")))
    assert done_by_others(job) is None
    write_json(folder / "run.json", {"status": "complete", "key": "k", "claim": "his"})
    assert (done_by_others(job) is not None) is (status == "running")
    write_json(folder / "run.json", {"status": "complete", "key": "k", "claim": "another's"})
    assert done_by_others(job) is not None

"""Judging on a log, by hand: what a clock that looks now and then knows, and the best that looks could do."""

from itertools import product
from pathlib import Path

import pytest

from attnlab.arena.drive import BLOCKS, Drive, Score, Task, judge, looks_of, oracle, read_drive, score_looks
from attnlab.errors import ConfigError
from attnlab.logs.file import Log

FAR, NEAR = 0.9, 0.2
TASK = Task(onset_m=0.6, price=0.5)
REAL = next((data for up in Path(__file__).resolve().parents if (data := up / "shared" / "data").is_dir()), None)


def drive(shape, starts=(0,), cycle_s=0.1):
    """A drive from a picture: . far, # near."""
    return Drive("made", tuple(NEAR if c == "#" else FAR for c in shape), starts, cycle_s, ())


@pytest.mark.parametrize(("shape", "looks", "score"), [
    ("....##....", [0], Score(10, 1, 1, 1, 0, 2, 0)),  # never seen: two blind cycles, an onset missed
    ("....##....", [0, 4], Score(10, 2, 1, 0, 0, 0, 4)),  # seen at once; believed near until the end
    ("....##....", [0, 5, 6], Score(10, 3, 1, 0, 1, 1, 0)),  # a cycle late
    (".#.#......", [0, 3], Score(10, 2, 2, 1, 0, 1, 6)),
    ("##........", [0], Score(10, 1, 0, 0, 0, 0, 8)),  # near from the start is no onset
    ("....######", [0, 8], Score(10, 2, 1, 0, 4, 4, 0)),
    ("....######", [0], Score(10, 1, 1, 1, 0, 6, 0))])
def test_scores_by_hand(shape, looks, score):
    assert score_looks(drive(shape), (0, len(shape)), TASK, looks) == score
    assert score.cost(0.5) == 0.5 * len(looks) + score.blind + score.needless


def test_a_clock_sees_only_what_it_looks_at():
    """Period 4 when far, 1 when near: 0, 4 (near), 5 (near), 6 (far), 10."""
    made, asked = drive("....##........"), []

    def decide(action, percept):
        asked.append((action, percept))
        return 0 if percept < 3 else 1
    looks = list(looks_of(made, (0, 14), TASK, decide))
    assert looks == [(0, 4), (4, 1), (5, 1), (6, 4), (10, 4)]
    assert asked == [(0, 5), (1, 1), (0, 1), (0, 5), (1, 5)]
    assert judge(made, [(0, 14)], TASK, decide) == Score(14, 5, 1, 0, 0, 0, 0)


def test_stretches_begin_anew():
    """Two stretches: each begins with a look, and nothing is believed across a hole."""
    made = drive("....####....####", (0, 8))
    score = judge(made, [(0, 8), (8, 16)], Task(periods=(12,)), lambda action, percept: 0)
    assert (score.looks, score.onsets, score.missed, score.blind) == (2, 2, 2, 8)


def brute(shape, price):
    """The least cost over all sets of looks that hold the first cycle."""
    made = drive(shape)
    return min(score_looks(made, (0, len(shape)), TASK, [0, *(i + 1 for i, on in enumerate(chosen) if on)]).cost(price)
               for chosen in product((0, 1), repeat=len(shape) - 1))


@pytest.mark.parametrize("price", [0.1, 0.5, 1.0, 1.5, 2.5])
@pytest.mark.parametrize("shape", ["..........", ".#.#.##..#", "###...#..#", "....##....", "#.........", "..#....##."])
def test_who_knows_the_future_cannot_be_beaten(shape, price):
    found = oracle(drive(shape), [(0, len(shape))], Task(price=price))
    assert found.cost(price) == pytest.approx(brute(shape, price))


def test_blocks_are_of_equal_length_and_cut_at_holes():
    made = drive("." * 83, (0, 25, 40))
    blocks = made.blocks(8)
    assert [blocks[0], blocks[2], blocks[3]] == [[(0, 10)], [(20, 25), (25, 31)], [(31, 40), (40, 41)]]
    assert sum(high - low for block in blocks for low, high in block) == 83


def test_a_log_becomes_a_drive(tmp_path):
    rows = [f"{0.1 * i + (5 if i >= 150 else 0)},{0.5 if i % 50 == 49 else 2},3" for i in range(300)]
    (tmp_path / "a.csv").write_text("t_s,r10,r-90\n" + "\n".join(rows) + "\n")
    made = read_drive(Log(tmp_path / "a.csv"))
    assert (made.name, len(made.near_m), made.starts) == ("a", 300, (0, 150))
    assert made.cycle_s == pytest.approx(0.1) and made.near_m[49] == 0.5 and made.near_m[50] == 2.0
    assert made.told == ("1 x hole of more than 1 s (first: line 152)",)
    (tmp_path / "b.csv").write_text("t_s,r10\n" + "\n".join(rows[:100]) + "\n")
    with pytest.raises(ConfigError, match="judging needs 300"):
        read_drive(Log(tmp_path / "b.csv"))


@pytest.mark.skipif(REAL is None, reason="the logs of real robots are not here")
def test_the_figures_of_the_scitos_log():
    """Clocks of fixed period over the whole of it: looks, onsets missed of 71."""
    made = read_drive(Log(REAL / "scitos-g5-24-ultrasound.csv.gz"))
    found = {}
    for period in (1, 4, 8, 12):
        score = judge(made, [(0, len(made.near_m))], Task(periods=(period,)), lambda action, percept: 0)
        assert score.onsets == 71
        found[period] = score.looks, score.missed
    assert found == {1: (5456, 0), 4: (1364, 11), 8: (682, 20), 12: (455, 25)}
    assert len(made.blocks()) == BLOCKS

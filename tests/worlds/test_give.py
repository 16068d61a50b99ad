"""GIVE before a scripted hand: faster or nearer, looked at more often (the paper's Fig 1)."""

import pytest

from attnlab.behaviours.give import giving_period, salience
from attnlab.errors import ConfigError
from attnlab.robot.episodes import play_run
from attnlab.robot.plan import RunPlan
from attnlab.testing import config, make

EVERY = list(range(1, 13))


def watched(keyframes, **top):
    """(experiment, cycles table) of one episode before this hand."""
    experiment = RunPlan(config(
        simulator={"name": "scripted", "keyframes": keyframes}, behaviours=("give",), needs="energy_only",
        learner="monitor", curiosity="none", periods=EVERY, how={"percept_bins": 100}, train_episodes=1,
        validation_episodes=0, **top))
    return experiment, play_run(experiment)[0]["cycles"]


def test_formula():
    assert salience(1.5, 0.0, 1.5, 1.0) == 0.0
    assert salience(0.75, 0.2, 1.5, 1.0) == 0.5  # the nearer of both counts
    assert salience(1.5, 0.8, 1.5, 1.0) == 0.8
    assert salience(0.0, 9.0, 1.5, 1.0) == 1.0
    assert [giving_period(s, 1, 12) for s in (0.0, 0.5, 1.0)] == [12, round(6.5), 1]


def test_the_nearer_a_hand_at_rest_the_shorter_the_period():
    periods = []
    for distance in (1.5, 1.2, 0.9, 0.6, 0.3, 0.0):
        _, cycles = watched([[0.0, distance]], max_cycles=60)
        periods.append(cycles["give_period"][-1])
    assert periods == sorted(periods, reverse=True) and (periods[0], periods[-1]) == (12, 1)


def test_the_faster_a_far_hand_the_shorter_the_period():
    shortest = []
    for seconds in (16.0, 8.0, 4.0, 2.0):
        _, cycles = watched([[0.0, 5.0], [1.0, 5.0], [1.0 + seconds, 1.5]], max_cycles=120)
        moving = [p for p, c in zip(cycles["give_period"], cycles["cycle"], strict=True) if c * 0.1565 < 1 + seconds]
        shortest.append(min(moving[12:]))  # after the first look
    assert shortest == sorted(shortest, reverse=True) and shortest[0] > shortest[-1] == 1


def test_the_period_is_the_formula_but_for_the_width_of_a_percept():
    experiment, cycles = watched([[0.0, 1.5], [3.0, 1.5], [6.0, 0.8], [10.0, 0.8], [11.0, 0.25], [20.0, 0.25]],
                                 max_cycles=150)
    hand = experiment.simulator()
    looked = 0
    for cycle, active, period in zip(cycles["cycle"], cycles["give_active"], cycles["give_period"], strict=True):
        if active:
            hand.cycle = cycle
            assert abs(period - giving_period(salience(*hand.hand(), 1.5, 1.0), 1, 12)) <= 1
            looked += 1
    assert looked > 20


def test_minimum_jerk_between_keyframes():
    hand = make("simulator", "scripted", keyframes=[[1.0, 1.0], [3.0, 0.0]])
    assert [hand.at(t)[0] for t in (0.0, 1.0, 2.0, 3.0, 9.0)] == pytest.approx([1.0, 1.0, 0.5, 0.0, 0.0])
    u = 0.25
    assert hand.at(1.5)[0] == pytest.approx(1 - (10 * u**3 - 15 * u**4 + 6 * u**5))
    top = max((hand.at(t / 1000 + 1)[0] - hand.at(t / 1000 + 1.001)[0]) / 0.001 for t in range(2000))
    assert top == pytest.approx(1.875 * 1.0 / 2.0, rel=1e-3)  # its peak speed is 15/8 of the mean


def test_hand_from_csv(tmp_path):
    path = tmp_path / "hand.csv"
    path.write_text("t_s,x_m,y_m\n0,3,4\n10,0,0\n")
    hand = make("simulator", "scripted", csv=str(path))
    hand.place(0, 0, 0)
    hand.advance(0, 0, 10)
    distance, speed = hand.hand()
    assert distance == pytest.approx(5.0 - 0.5 * 10 * hand.dt_s) and speed == pytest.approx(0.5)


@pytest.mark.parametrize(("text", "message"), [
    ("t_s,x_m,y_m\n0,1,1\n1,a,1\n", "line 3 of .* is not a number in each of t_s, x_m, y_m"),
    ("t_s,x_m\n0,1\n", "line 2 .* is not a number"),
    ("t_s,x_m,y_m\n1,1,1\n1,1,1\n", "line 3 .* t_s must rise"),
    ("t_s,x_m,y_m\n", "holds no row"),
])
def test_a_wrong_csv_is_one_clear_error(tmp_path, text, message):
    path = tmp_path / "hand.csv"
    path.write_text(text)
    with pytest.raises(ConfigError, match=message):
        make("simulator", "scripted", csv=str(path))


def test_other_mistakes():
    with pytest.raises(ConfigError, match="there is no file nowhere.csv"):
        make("simulator", "scripted", csv="nowhere.csv")
    with pytest.raises(ConfigError, match="must rise"):
        make("simulator", "scripted", keyframes=[[1.0, 1.0], [0.0, 1.0]])
    with pytest.raises(ConfigError, match=r"behaviours.give: does not work in simulator=planar. simulator=scripted"):
        RunPlan(config(behaviours=("give",)))


def test_fig1_from_a_run(tmp_path):
    from attnlab.fig1 import main, timeline
    from attnlab.robot.folder import run_to_folder
    chosen = config(simulator="scripted", behaviours=("give",), needs="energy_only", learner="monitor",
                    curiosity="none", periods=EVERY, how={"percept_bins": 100}, max_cycles=160, train_episodes=1)
    assert run_to_folder(chosen, tmp_path / "run", {"run": "run", "key": "k", "overrides": [], "swept": {}})
    rows = timeline(tmp_path / "run")
    rest, close = rows[(rows["t_s"] > 2.0) & (rows["t_s"] < 4)], rows[(rows["t_s"] > 16) & (rows["t_s"] < 19)]
    assert set(rest["period"]) == {12} and close["period"].max() <= 3
    assert close["active"].mean() > 4 * rest["active"].mean()
    assert main([str(tmp_path / "run"), "--out", str(tmp_path / "fig.png")]) == 0
    assert (tmp_path / "fig.png").read_bytes()[:4] == b"\x89PNG"

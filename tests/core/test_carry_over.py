"""Energy carried from one episode to the next."""

from __future__ import annotations

from attnlab.robot.episodes import play_run
from attnlab.robot.plan import RunPlan
from attnlab.testing import config


def test_energy_is_carried_over_but_not_from_the_dead():
    reading = {"energy_carry_over": True, "energy_death": True}
    experiment = RunPlan(config(how=reading, max_cycles=1150, train_episodes=12, validation_episodes=0, record="none"))
    episodes = play_run(experiment)[0]["episodes"]
    deaths, ends, starts = episodes["death"], episodes["energy_min"], episodes["energy_max"]
    assert "energy" in deaths  # a robot spends more in an episode than it finds
    for before in range(11):
        if deaths[before] == "none":
            assert starts[before + 1] < 4600.0
        else:
            assert starts[before + 1] > 4500.0, (deaths[before], ends[before])

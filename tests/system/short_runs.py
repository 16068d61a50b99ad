"""Short planar runs, some of each part, and their digests: ``python short_runs.py`` prints them as JSON on any Python,
``python short_runs.py --compiled`` those of a few by the compiled engine.

``python short_runs.py --write`` makes them the golden ones: do that when a change is meant to change numbers, never
otherwise.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from attnlab.testing import config
from attnlab.testing.digest import digest

GOLDEN = Path(__file__).with_name("golden.json")
CURIOSITIES = ("none", "additive", "composed", "count", "habituation", "information_gap", "learning_progress",
               "litman_gap", "litman_itti", "novelty_decay", "novelty_window", "optimal_arousal", "prediction_error",
               "random_wanting", "salience", "shuffled_liking", "surprise", "surprise_poisson", "surprise_reverse")
LEARNERS = ("sarsa", "expected_sarsa", "double_q", "q_lambda", "monitor", "fixed_4", "random", "always_on")
EXPLORATIONS = ("epsilon_greedy", "greedy", "ucb1", "annealed")
READINGS = {"safety_distance": {"crash": "safety_distance"}, "same_states": {"non_curious": "same_states"},
            "clipped": {"energy_clipped": True, "needs_floored": True, "energy_death": True},
            "smdp": {"q_update": "smdp"}, "respawn": {"food_supply": "respawn", "penalised": "all"},
            "states": {"novelty_over": "state"}, "last_of_equals": {"tie_break": "last"},
            "any_of_equals": {"tie_break": "random"}}

RUNS = {
    "paper": config(max_cycles=1150),
    **{f"curiosity={name}": config(curiosity=name, max_cycles=500) for name in CURIOSITIES},
    **{f"learner={name}": config(learner=name, max_cycles=500) for name in LEARNERS},
    **{f"exploration={name}": config(exploration=name, max_cycles=500) for name in EXPLORATIONS},
    **{f"reading={name}": config(how=how, curiosity="none" if name == "same_states" else "litman", max_cycles=500)
       for name, how in READINGS.items()},
    "learner=capped": config(learner={"name": "capped", "looks_per_s": 2.4}, max_cycles=500),
    "validation.clamp_level=HH": config(validation={"clamp_level": "HH"}, max_cycles=500),
    "world=places": config(world={"name": "places", "layout": "apart", "of_each": 2}, max_cycles=500),
    "fusion=mean": config(fusion="mean", max_cycles=500),
    "behaviours=avoid,wander,rest": config(behaviours=("avoid", "wander", "rest"), max_cycles=500),
    "simulator=scripted": config(simulator="scripted", behaviours=("give",), needs="energy_only"),
    "simulator=log": config(simulator="log", behaviours=("watch",), needs="energy_only"),
}
COMPILED = ("paper", "curiosity=none", "reading=clipped", "world=places")  # two compositions, each compiled once


def digests(engine: str = "python") -> dict[str, str]:
    from attnlab.robot.episodes import play_run
    from attnlab.robot.plan import RunPlan
    return {name: digest(play_run(RunPlan(RUNS[name]), engine=engine)[0])
            for name in (RUNS if engine == "python" else COMPILED)}


if __name__ == "__main__":
    text = json.dumps(digests("compiled" if "--compiled" in sys.argv else "python"), indent=1) + "\n"
    if sys.argv[1:] == ["--write"]:
        GOLDEN.write_text(text)
    print(text, end="")

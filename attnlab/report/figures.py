"""The figures of a report, in their order on the page."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from attnlab.measures.rewards import Reward
from attnlab.report import curves, economics, episode, found, policies, space


@dataclass
class Figure:
    """A figure of the report: how it is drawn, what the paper shows there, how to say what was found."""
    key: str
    title: str
    paper: str
    draw: Callable
    say: Callable


def _rewards() -> list[tuple[str, Reward]]:
    return [("reward ", Reward(Reward.Params())), ("extrinsic part ", Reward(Reward.Params(extrinsic=True)))]


FIGURES = [
    Figure("fig06_survival", "Fig 6: survival", "NCR survives better until about episode 250 and starts above 90 %; CR "
           "reaches 100 % around episode 300, NCR not before 450.", curves.survival,
           found.start_and_end("survival", " %", 100)),
    Figure("fig07_rewards", "Fig 7: cumulative rewards", "CR's AVOID reward is unsatisfactory until about episode 200 "
           "and converges from 300; NCR's EAT and DRINK rewards end higher, CR's global reward ends higher and "
           "converges faster. CR is paid on another scale (eq 4), so its extrinsic part is drawn too.", curves.rewards,
           found.validation(_rewards(), " UoR an episode")),
    Figure("fig08a_needs", "Fig 8A: needs within an episode", "CR alternates eating and drinking in a rhythm; NCR "
           "waits until it is very hungry or very thirsty.", episode.needs, found.meals),
    Figure("fig08b_maximum_need", "Fig 8B: largest need of an episode", "NCR's largest need is on average always above "
           "CR's.", curves.maximum_need, found.start_and_end("hunger_max", " UoE hunger", block=10, digits=0)),
    Figure("fig09_safety", "Fig 9: safety", "CR is safer: 0.61 on average against 0.38.", curves.safety,
           found.start_and_end("safety_mean", "", block=10, digits=2)),
    Figure("fig10_energy", "Fig 10: energy", "CR keeps its energy above E_well, at a high and stable level.",
           curves.energy, found.start_and_end("energy_mean", " UoE", block=10, digits=0)),
    Figure("fig11_paths", "Fig 11: paths and coverage", "CR's traces of 500 episodes cover 50 % of the area, NCR's 44 "
           "%, and CR's path seems smoother. Shade: visits in training of the first seed (dark: often); line: its last "
           "recorded episode from the circle on; green: food, blue: water.", space.paths, found.coverage),
    Figure("policies", "Learned policies", "NCR DRINK learns 12 in bins 1-4 and 1 in bins 5-6; CR with low curiosity "
           "12 in 1-3 and 1 in 4-6; CR with high curiosity 1 or 2 (read 4) everywhere. Large: the period that most "
           "seeds learned; small: how many of the seeds that visited the bin; grey: never visited, or nothing learned. "
           "Low: no wanting; LH: wanting, little liking; HH: both.", policies.heat_maps, found.policies),
    Figure("attention_raster", "Who looked when", "Not in the paper. Each tick is an activation, its colour the period "
           "until the next look; hunger and thirst below on the same axis.", episode.raster, found.looks),
    Figure("attention_economics", "Attention economics", "The paper gives 443 activations of CR and 364 of NCR in "
           "about 1150 cycles (39 and 32 in 100). Large marks are means with 95 % intervals, small ones seeds; grey: "
           "baselines, if given.", economics.economics, found.costs),
]

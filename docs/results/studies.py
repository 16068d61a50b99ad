"""The studies of this folder: what is typed for each, and which conditions are held against which."""

from __future__ import annotations

from dataclasses import dataclass

from attnlab.claims import DEFAULT

CR, NCR = "CR", "NCR"
SAME, PLAIN = "NCR, same states", "NCR, plain"
SHUFFLED, RANDOM_W = "CR, liking shuffled", "CR, random w"
OWN_LEVEL, LEVELS = "its own level", ("held at low", "held at LH", "held at HH")
CAPS = ("1.8", "2.2", "2.6", "3")  # looks a second
FIXED, LEARNED, MOTIVATED = "fixed at 4", "learned (2012, NCR)", "motivated (2014, CR)"
DEEP, NETWORKS, RIVALS = "deep", ("DQN", "PPO"), ("Q-learning (NCR)", "TempoRL", "fixed at 4", "random")
SHORT = ("seed=0-1", "train_episodes=12", "validation_episodes=4", "max_cycles=150")  # does it work? in minutes


@dataclass(frozen=True)
class Study:
    """``typed``: arguments of ``python -m attnlab``; ``pairs``: (condition, the one it is held against), "" for every
    other condition; ``page``: is its whole report kept here? ``claims``: the file it is judged by; ``figures``: those
    that its page has, all if empty; ``leave``: tables that are not kept; ``short``: typed, too, with --short;
    ``extra``: (package, the extra of ours that brings it), without which it is left out."""
    name: str
    typed: tuple[str, ...]
    what: str
    pairs: tuple[tuple[str, str], ...] = ()
    page: bool = False
    claims: str = DEFAULT
    figures: tuple[str, ...] = ()
    leave: tuple[str, ...] = ()
    short: tuple[str, ...] = ()
    extra: tuple[str, str] | None = None

    @property
    def command(self) -> str:
        """As it is typed."""
        return " ".join(["python -m attnlab", *self.typed])


# Studies of this project's own questions, each judged by a claims file of its own.
OWN = (
    Study("bigger_table", ("+experiment=bigger_table",), "CR and its controls, a ladder of five, planar",
          ((SAME, PLAIN), (SHUFFLED, SAME), (CR, SHUFFLED), (RANDOM_W, CR), (CR, SAME), (CR, PLAIN)), page=True,
          claims="bigger_table", figures=("steps", "survival")),
    Study("matched_budget", ("+experiment=matched_budget",),
          "learned, fixed and random clocks under equal caps, planar",
          tuple((f"looks_per_s={cap} {one}", f"looks_per_s={cap} {other}") for cap in CAPS
                for one, other in ((CR, SAME), (CR, PLAIN), (PLAIN, "fixed at 4"), (PLAIN, "random"))), page=True,
          claims="matched_budget", figures=("budget_front",), leave=("seeds",)),
    Study("where_curiosity_pays", ("+experiment=where_curiosity_pays",),
          "a map of 75 worlds, 250 and 50 episodes, planar",
          page=True, claims="where_curiosity_pays", figures=("phase_map",),
          leave=("seeds", "verdicts", "effects", "curve", "joint", "table5"),
          short=("world.source_distance_m=1.0,4.03", "world.obstacles=2,4")),
    Study("clamped_levels", ("+experiment=clamped_levels",), "CR with its curiosity level held in validation, planar",
          tuple((level, OWN_LEVEL) for level in LEVELS), page=True, claims="clamped_levels", figures=("held_levels",)),
)
STUDIES = (
    Study("cr_vs_ncr", ("+experiment=cr_vs_ncr", "-m", "seed=0-19"), "CR and NCR on pybullet, reading `inferred`",
          ((CR, NCR),)),
    Study("cr_vs_ncr_planar", ("+experiment=cr_vs_ncr", "-m", "seed=0-19", "simulator=planar",
                               "study=cr_vs_ncr_planar"), "the same on planar", ((CR, NCR),)),
    Study("cr_vs_ncr_table4", ("+experiment=cr_vs_ncr", "-m", "seed=0-19", "simulator=planar", "reading=table4",
                               "study=cr_vs_ncr_table4"), "on planar, reading `table4`", ((CR, NCR),)),
    Study("controls", ("+experiment=controls", "-m", "seed=0-19"), "CR and both of its controls, planar",
          ((CR, PLAIN), (CR, SAME), (SAME, PLAIN))),
    Study("baselines", ("+experiment=baselines", "-m", "seed=0-4"), "attention that learns nothing, planar"),
    Study("generations", ("+experiment=generations", "-m", "seed=0-4"),
          "set by hand, evolved, learned, motivated, and baselines; planar",
          ((FIXED, LEARNED), (MOTIVATED, LEARNED), ("", LEARNED)), page=True),
    Study("curiosities", ("+experiment=curiosities", "-m", "seed=0-4"), "every model of curiosity, planar",
          (("", NCR),), page=True),
    Study(DEEP, (f"+experiment={DEEP}", "-m", "seed=0-2"), "DQN and PPO beside tables, fixed and random clocks, planar",
          tuple((network, rival) for network in NETWORKS for rival in RIVALS), page=True,
          leave=("verdicts", "table5", "combinations", "effects"),
          short=("learner=q_learning,tempo_rl,fixed_4,random",),
          extra=("stable_baselines3", "sb3")),
    *OWN,
    Study("multiverse", ("+experiment=multiverse", "-m"), "readings of what the paper leaves open, planar",
          page=True, claims="multiverse", figures=("multiverse_curves",),
          leave=("seeds", "verdicts", "curve", "table5", "conditions"),
          short=("seed=0-5", "variants.size=8", "variants.pilot.episodes=8", "variants.pilot.survival=0",
                 "variants.pilot.candidates=96")),
)
BY_NAME = {study.name: study for study in STUDIES}

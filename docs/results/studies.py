"""The studies of this folder: what is typed for each, and which conditions are held against which."""

from __future__ import annotations

from dataclasses import dataclass

CR, NCR = "CR", "NCR"
SAME, PLAIN = "NCR, same states", "NCR, plain"
FIXED, LEARNED, MOTIVATED = "fixed at 4", "learned (2012, NCR)", "motivated (2014, CR)"
SHORT = ("seed=0-1", "train_episodes=12", "validation_episodes=4", "max_cycles=150")  # does it work? in minutes


@dataclass(frozen=True)
class Study:
    """``typed``: arguments of ``python -m attnlab``; ``pairs``: (condition, the one it is held against), "" for every
    other condition; ``page``: is its whole report kept here?"""
    name: str
    typed: tuple[str, ...]
    what: str
    pairs: tuple[tuple[str, str], ...] = ()
    page: bool = False

    @property
    def command(self) -> str:
        """As it is typed."""
        return " ".join(["python -m attnlab", *self.typed])


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
)
BY_NAME = {study.name: study for study in STUDIES}

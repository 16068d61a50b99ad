"""Can a reading of the paper be meant at all?"""

from __future__ import annotations

EARLY_EPISODES = 100  # of training, whose survival is asked for
LEAST_EARLY = 90.0  # %: the paper's non-curious robot "starts from a value over 90%" (Fig 6)


def unsound(survival: float, meals: float, drinks: float, least: float = LEAST_EARLY) -> str:
    """Why a reading is not sound; empty if it is. ``survival``: of the plain non-curious robot over its first episodes,
    in %, which must be above ``least``; ``meals`` and ``drinks``: how many anybody had. What is not known is not
    sound."""
    return "; ".join([f"survives {survival:.2f} %"] * (not survival > least) + ["nobody eats"] * (not meals > 0)
                     + ["nobody drinks"] * (not drinks > 0))

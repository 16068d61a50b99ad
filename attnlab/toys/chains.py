"""AMRL-Q on the chains of its paper, and the clock that is made of it here on the first of them."""

from __future__ import annotations

from random import Random

from attnlab.equations import q_update
from attnlab.learners.amrl import ActiveMeasure, Followed
from attnlab.learners.base import LearnerContext
from attnlab.reading import Reading
from attnlab.testing.processes import MeasuredChain

ALPHA, DISCOUNT, EPSILON, BIAS = 0.1, 0.9, 0.1, 0.1  # as in the agents and experiments of CanAI2021_AMRL
LAST = 100  # episodes that tell what was learned
MOST = 10_000  # steps of an episode, ours: theirs go on until the goal
PERIODS = (1, 2, 4, 8)  # ours


def play_chain(chain: MeasuredChain, seed: int, episodes: int, always: bool = False) -> dict[str, float]:
    """AMRL-Q: an action is a move with or without a measurement, 0 and 1 left, 2 and 3 right, odd ones measure; the
    values of those that do begin at ``BIAS``. A state that is not measured is taken to be the one that followed most
    often, or, where none was seen, the first, as theirs is. ``always``: Q-learning, which pays for every state.

    Means of the last ``LAST`` training episodes, exploration and all: ``costed_return``, ``free_return`` (the same
    without what measuring cost), ``measurements``; and of all of them: ``costed_return_all``, ``free_return_all``."""
    draw, model = Random(seed), Followed(chain.states, 2)
    actions = (1, 3) if always else (0, 1, 2, 3)
    q = [[BIAS if action % 2 and not always else 0.0 for action in range(4)] for _ in range(chain.states)]
    told: list[tuple[float, int]] = []  # the return without costs, measurements
    for _ in range(episodes):
        place = believed = 0
        ended, earned, looks, taken = False, 0.0, 0, 0
        while not ended and taken < MOST:
            action = draw.choice(actions) if draw.random() < EPSILON else _first_best(q[believed], actions)
            move, looking = divmod(action, 2)
            place, reward, ended = chain.step(place, move)
            after = place
            if looking:
                model.saw(believed, move, place)
            else:
                after = max(0, model.usual[believed][move])
            cost = chain.cost if looking else 0.0
            best = max(q[after][action] for action in actions)
            q[believed][action] = q_update(q[believed][action], reward - cost, best, ALPHA, DISCOUNT)
            believed, earned, looks, taken = after, earned + reward, looks + looking, taken + 1
        told.append((earned, looks))
    return summary(told, chain.cost)


def _first_best(values: list[float], actions: tuple[int, ...]) -> int:
    return max(actions, key=lambda action: values[action])


def summary(told: list[tuple[float, int]], cost: float) -> dict[str, float]:
    """The quantities of episodes: (return without costs, measurements)."""
    def mean(values: list[float]) -> float:
        return sum(values) / len(values)
    free, costed = [earned for earned, _ in told], [earned - cost * looks for earned, looks in told]
    return {"costed_return": mean(costed[-LAST:]), "free_return": mean(free[-LAST:]),
            "measurements": mean([float(looks) for _, looks in told[-LAST:]]), "costed_return_all": mean(costed),
            "free_return_all": mean(free)}


def play_chain_clock(chain: MeasuredChain, seed: int, episodes: int, always: bool = False) -> dict[str, float]:
    """``learner=amrl`` as it is here: a robot that goes right until the end, and whose clock chooses how many of
    ``PERIODS`` steps pass until it looks. Epsilon-greedy as above. ``always``: it looks after every step."""
    context = LearnerContext(Reading(), "avoid", ("none",), PERIODS, chain.states, Random(seed))
    made, draw = ActiveMeasure(ActiveMeasure.Params(alpha=ALPHA, gamma=DISCOUNT, look_cost=chain.cost), context), \
        Random(seed)
    told = []
    for _ in range(episodes):
        place, state, ended, earned, looks = 0, 0, False, 0.0, 0
        while not ended:
            values = made.values(state)
            action = 0 if always else draw.randrange(len(PERIODS)) if draw.random() < EPSILON else \
                values.index(max(values))
            within, left = 0.0, PERIODS[action]
            while left and not ended:
                place, reward, ended = chain.step(place, 1)
                within, left = within + reward, left - 1
            after = action * chain.states + place
            if ended:
                made.terminal(state, action, within)
            else:
                made.update(state, action, within, after, -1, PERIODS[action])
            state, earned, looks = after, earned + within, looks + 1
        told.append((earned, looks))
    return summary(told, chain.cost)

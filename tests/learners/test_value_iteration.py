"""On a small known decision process every learner reaches the values of exact value iteration."""

from random import Random

import pytest

from attnlab.testing import make
from attnlab.testing.processes import PERIODS
from attnlab.testing.processes import TRAP_NEXT as NEXT
from attnlab.testing.processes import TRAP_REWARD as REWARD

GAMMA, STATES, ACTIONS, END = 0.9, 4, 4, 3


def optimal(smdp: bool = False, epsilon: float = 0.0) -> list[list[float]]:
    """Q* by value iteration, of the policies that choose at random with probability epsilon; END is the end."""
    q = [[0.0] * ACTIONS for _ in range(STATES)]
    for _ in range(3000):
        v = [(1 - epsilon) * max(row) + epsilon * sum(row) / ACTIONS for row in q]
        q = [[REWARD[s][a] + (0.0 if NEXT[s][a] == END else GAMMA ** (PERIODS[a] if smdp else 1) * v[NEXT[s][a]])
              for a in range(ACTIONS)] for s in range(END)] + [[0.0] * ACTIONS]
    return q[:END]


def learn(name: str, exploration, episodes: int, **settings) -> list[list[float]]:
    """The table after that many episodes of at most 50 steps."""
    learner = make("learner", name, gamma=GAMMA, levels=("none",), **settings)
    draw, start = Random(1), Random(2)
    for episode in range(episodes):
        exploration.start(episode)
        learner.start()
        state = start.randrange(END)
        action = learner.decide(state, exploration, draw)
        for _ in range(50):
            after, reward = NEXT[state][action], REWARD[state][action]
            if after == END:
                learner.terminal(state, action, reward)
                break
            chosen = learner.decide(after, exploration, draw) if learner.on_policy else -1
            learner.update(state, action, reward, after, chosen, PERIODS[action])
            state, action = after, chosen if learner.on_policy else learner.decide(after, exploration, draw)
    return [learner.values(s) for s in range(END)]


def greedy_but(epsilon):
    return make("exploration", "epsilon_greedy", epsilon=epsilon)


@pytest.mark.parametrize(("name", "epsilon", "alpha", "update"), [
    ("q_learning", 1.0, 0.5, "decision"), ("q_learning", 1.0, 0.5, "smdp"), ("double_q", 1.0, 0.5, "decision"),
    ("q_lambda", 0.3, 0.2, "decision")])
def test_off_policy_learners_reach_the_optimal_values(name, epsilon, alpha, update):
    q = learn(name, greedy_but(epsilon), 1500, alpha=alpha, how={"q_update": update})
    for row, best in zip(q, optimal(smdp=update == "smdp"), strict=True):
        assert row == pytest.approx(best, abs=1e-3)


@pytest.mark.parametrize("epsilon", [0.3, 1.0])
def test_on_policy_learners_reach_the_best_values_under_their_exploration(epsilon):
    """Expected SARSA has no noise here and is exact; SARSA's actions are drawn, its values within the noise of them."""
    exact = optimal(epsilon=epsilon)
    expected = learn("expected_sarsa", greedy_but(epsilon), 1500, alpha=0.2)
    sampled = learn("sarsa", greedy_but(epsilon), 8000, alpha=0.005)
    for best, first, second in zip(exact, expected, sampled, strict=True):
        assert first == pytest.approx(best, abs=1e-3)
        assert second == pytest.approx(best, abs=0.3)
    assert max(optimal()[0]) - max(exact[0]) > 0.5  # far from what an off-policy learner finds


def test_q_lambda_without_traces_is_q_learning():
    walk = make("exploration", "epsilon_greedy", epsilon=1.0)
    assert learn("q_lambda", walk, 30, lam=0.0) == [pytest.approx(row) for row in learn("q_learning", walk, 30)]


def test_traces_carry_a_penalty_back():
    """One episode 0 -> 1 -> 2 -> trap along greedy actions: by hand, alpha 0.5, gamma 0.9, lambda 0.5."""
    learner = make("learner", "q_lambda", alpha=0.5, gamma=0.9, lam=0.5, levels=("none",))
    learner.update(0, 1, 0.0, 1, 0, 4)
    learner.update(1, 1, 0.0, 2, 0, 4)
    learner.terminal(2, 3, -10.0)
    assert learner.q[2][3] == pytest.approx(-5.0)
    assert learner.q[1][1] == pytest.approx(-5.0 * 0.45)
    assert learner.q[0][1] == pytest.approx(-5.0 * 0.45 ** 2)


def test_double_q_is_less_fooled_by_luck():
    """All rewards are noise of mean 0: the mean of both tables overestimates less than one table does."""
    def top(name):
        learner, noise = make("learner", name, alpha=0.1, gamma=0.9, levels=("none",)), Random(3)
        for _ in range(4000):
            learner.update(0, noise.randrange(4), noise.gauss(0, 1), 0, 0, 1)
        return max(learner.values(0))
    assert top("q_learning") > 2 * abs(top("double_q"))

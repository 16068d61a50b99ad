"""On a small known decision process every learner reaches the values of exact value iteration."""

from random import Random

import pytest

from attnlab.testing import make

GAMMA, STATES, ACTIONS, END = 0.9, 4, 4, 3
PERIODS = [1, 4, 8, 12]
# A ring of three states and a trap: a = 0 stays, 1 goes on, 2 goes back, 3 falls into the trap from state 2.
NEXT = [[0, 1, 2, 0], [1, 2, 0, 1], [2, 0, 1, END]]
REWARD = [[0.1, 0.0, 0.3, 0.2], [0.0, 0.9, 0.2, 0.1], [0.3, 0.1, 0.0, -5.0]]


def optimal(smdp: bool) -> list[list[float]]:
    """Q* by value iteration; END is the end."""
    q = [[0.0] * ACTIONS for _ in range(STATES)]
    for _ in range(3000):
        q = [[REWARD[s][a] + (0.0 if NEXT[s][a] == END else GAMMA ** (PERIODS[a] if smdp else 1) * max(q[NEXT[s][a]]))
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


def schedule(episodes):
    """Epsilon falls from 1 to 0: what is learned on policy becomes the greedy policy's."""
    return make("exploration", "annealed", over="epsilon_greedy", what="epsilon", first=1.0, last=0.0,
                episodes=episodes, shape="linear")


@pytest.mark.parametrize("name", ["q_learning", "double_q", "smdp_q"])
def test_off_policy_learners_reach_the_optimal_values(name):
    q = learn(name, make("exploration", "epsilon_greedy", epsilon=1.0), 800, alpha=0.5)
    for row, best in zip(q, optimal(name == "smdp_q"), strict=True):
        assert row == pytest.approx(best, abs=1e-3)


@pytest.mark.parametrize("name", ["sarsa", "expected_sarsa", "q_lambda"])
def test_on_policy_learners_reach_them_as_exploration_ends(name):
    q = learn(name, schedule(1500), 2000, alpha=0.1)
    for row, best in zip(q, optimal(False), strict=True):
        assert max(row) == pytest.approx(max(best), abs=0.05)
        assert row.index(max(row)) == best.index(max(best))


def test_sarsa_learns_the_policy_it_follows_and_q_learning_does_not():
    """Under random choices SARSA's values are those of the random policy, by exact evaluation."""
    v = [0.0] * STATES
    for _ in range(3000):
        v = [sum(REWARD[s][a] + GAMMA * v[NEXT[s][a]] for a in range(ACTIONS)) / ACTIONS for s in range(END)] + [0.0]
    exact = [[REWARD[s][a] + GAMMA * v[NEXT[s][a]] for a in range(ACTIONS)] for s in range(END)]
    wandering = make("exploration", "epsilon_greedy", epsilon=1.0)
    expected = learn("expected_sarsa", wandering, 4000, alpha=0.02)
    for row, value in zip(expected, exact, strict=True):
        assert row == pytest.approx(value, abs=0.05)
    sampled = learn("sarsa", wandering, 8000, alpha=0.005)
    for row, value in zip(sampled, exact, strict=True):
        assert row == pytest.approx(value, abs=0.3)
    assert max(optimal(False)[0]) - max(exact[0]) > 1.0


def test_smdp_q_is_q_learning_under_the_reading_smdp():
    walk = make("exploration", "epsilon_greedy", epsilon=0.5)
    assert learn("smdp_q", walk, 50) == learn("q_learning", walk, 50, how={"q_update": "smdp"})


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

"""Where compiled code is entered to live many robots until their next decision each, in one call."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from attnlab.compiled.entry import at_address, root
from attnlab.compiled.methods import OPTIONS
from attnlab.compiled.words import word_code
from attnlab.cycle import machine_cycle
from attnlab.gym.play import Look, look
from attnlab.kernels.compile import compiled

WAIT, START = -1, -2  # in place of a robot's first action: leave it alone; begin an episode at its pose
ALIVE, OVER = 0, 1  # how it stands; any other number is the word of what it died of
FOUND = (*Look._fields, "action", "fires")  # columns of what is found of each behaviour that is decided for
OF_ROBOT, OF_OURS = ("agent", "exploration"), ("attention", "told")  # columns of addresses

Steps = Callable[[Any, Any, Any, Any, Any, Any, Any], int]
Died = Callable[[int, float, bool], float]
_made: dict[str, tuple[Steps, Died]] = {}


def entries(key: str, agent: Any, exploration: Any, attention: Any, told: Any) -> tuple[Steps, Died]:
    """The compiled functions of robots of this kind; ``key`` says of which code and kinds. Raises whatever numba does
    if a part does not compile."""
    if key in _made:
        return _made[key]
    agent_key, exploration_key = root(f"{key} agent", agent), root(f"{key} exploration", exploration)
    attention_key, told_key = root(f"{key} attention", attention), root(f"{key} told", told)

    def steps(robots, ours, actions, poses, found, moments, ended):
        """n robots, of each k behaviours that are decided for: ``robots`` (n, 2) and ``ours`` (n, k, 2) addresses,
        ``actions`` (n, k), ``poses`` (n, 3) m, m, rad; written are ``found`` (n, k, 9), what was looked at last where
        nobody fires, ``moments`` (n, 2) cycle and energy, and ``ended`` (n,)."""
        for i in range(len(actions)):
            if actions[i, 0] == WAIT:
                continue
            robot = at_address(robots[i, 0], agent_key)
            if actions[i, 0] == START:
                robot.start(poses[i, 0], poses[i, 1], poses[i, 2])
                ended[i] = ALIVE
            else:
                for j in range(actions.shape[1]):
                    at_address(ours[i, j, 1], told_key).action = actions[i, j]
                cause, over, fires = None, False, False
                while cause is None and not over and not fires:
                    _, cause = machine_cycle(robot, at_address(robots[i, 1], exploration_key), True)
                    over = robot.simulator.cycle >= robot.max_cycles
                    for j in range(actions.shape[1]):
                        fires = fires or at_address(ours[i, j, 0], attention_key).due == robot.simulator.cycle
                robot.now.cycle = robot.simulator.cycle
                ended[i] = word_code(cause) if cause is not None else OVER if over else ALIVE
            for j in range(actions.shape[1]):
                mine, row = at_address(ours[i, j, 0], attention_key), found[i, j]
                row[8] = 1.0 if ended[i] == ALIVE and mine.due == robot.simulator.cycle else 0.0
                if row[8] > 0.0:
                    row[0], row[1], row[2], row[3], row[4], row[5], row[6] = look(mine, robot.now)
                row[7] = mine.action
            moments[i, 0], moments[i, 1] = robot.simulator.cycle, robot.body.energy
        return 0

    def died(attention_at: int, share: float, learning: bool) -> float:
        return at_address(attention_at, attention_key).died(share, learning)
    arrays = "int64[:, ::1], int64[:, :, ::1], int64[:, ::1], float64[:, ::1], float64[:, :, ::1], float64[:, ::1]"
    _made[key] = (
        compiled(f"int64({arrays}, int64[::1])", nogil=True, **OPTIONS)(steps),
        compiled("float64(int64, float64, boolean)", nogil=True, **OPTIONS)(died))
    return _made[key]

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

WAIT, START = -1, -2  # in place of an action: leave this robot alone; begin an episode at its pose
ALIVE, OVER = 0, 1  # how it stands; any other number is the word of what it died of
FOUND = (*Look._fields, "cycle", "energy", "action")  # columns of what is found of each
AT = ("agent", "exploration", "attention", "told")  # columns of addresses

Steps = Callable[[Any, Any, Any, Any, Any], int]
Died = Callable[[int, float, bool], float]
_made: dict[str, tuple[Steps, Died]] = {}


def entries(key: str, agent: Any, exploration: Any, attention: Any, told: Any) -> tuple[Steps, Died]:
    """The compiled functions of robots of this kind; ``key`` says of which code and kinds. Raises whatever numba does
    if a part does not compile."""
    if key in _made:
        return _made[key]
    agent_key, exploration_key = root(f"{key} agent", agent), root(f"{key} exploration", exploration)
    attention_key, told_key = root(f"{key} attention", attention), root(f"{key} told", told)

    def steps(robots, actions, poses, found, ended):
        for i in range(len(actions)):
            if actions[i] == WAIT:
                continue
            robot = at_address(robots[i, 0], agent_key)
            mine = at_address(robots[i, 2], attention_key)
            if actions[i] == START:
                robot.start(poses[i, 0], poses[i, 1], poses[i, 2])
                ended[i] = ALIVE
            else:
                at_address(robots[i, 3], told_key).action = actions[i]
                ended[i] = go(robot, at_address(robots[i, 1], exploration_key), mine)
            row = found[i]
            if ended[i] == ALIVE:
                row[0], row[1], row[2], row[3], row[4], row[5], row[6] = look(mine, robot.now)
            row[7], row[8], row[9] = robot.simulator.cycle, robot.body.energy, mine.action
        return 0

    def died(attention_at: int, share: float, learning: bool) -> float:
        return at_address(attention_at, attention_key).died(share, learning)
    _made[key] = (
        compiled("int64(int64[:, ::1], int64[::1], float64[:, ::1], float64[:, ::1], int64[::1])", nogil=True,
                 **OPTIONS)(steps),
        compiled("float64(int64, float64, boolean)", nogil=True, **OPTIONS)(died))
    return _made[key]


def go(robot, exploration, mine):
    """Live on until ``mine`` fires, or the end."""
    cause, over = None, False
    while cause is None and not over:
        _, cause = machine_cycle(robot, exploration, True)
        over = robot.simulator.cycle >= robot.max_cycles
        if mine.due == robot.simulator.cycle:
            break
    robot.now.cycle = robot.simulator.cycle
    return word_code(cause) if cause is not None else OVER if over else ALIVE

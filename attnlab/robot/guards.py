"""Who did it: errors that name the file of the part at fault, found without a check on every activation.

What a part returned is checked at the end of an episode, from its log; when something raised, the parts are asked again
(their reads are pure), and the innermost file that is not ours is named.
"""

from __future__ import annotations

import traceback
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from attnlab import registry
from attnlab.attention import Attention
from attnlab.cycle import Agent
from attnlab.errors import PartError, describe
from attnlab.paths import PACKAGE

SLACK = 1e-9  # of rounding


def check_log(attention: Attention) -> None:
    """Everything an episode's log holds is within what was promised. Raises :class:`PartError`."""
    behaviour, curiosity, looks = attention.behaviour, attention.curiosity, attention.log.columns()
    slack = SLACK * (1.0 + abs(behaviour.sigma_high))
    low, high, levels = behaviour.sigma_low - slack, behaviour.sigma_high + slack, len(curiosity.levels)
    fine = ((low <= looks.sigma) & (looks.sigma <= high) & (looks.wanting >= -SLACK) & (looks.wanting <= 1.0 + SLACK)
            & (looks.liking >= -SLACK) & (looks.liking <= 1.0 + SLACK) & (looks.level >= 0) & (looks.level < levels))
    fine[1:] &= np.isfinite(looks.reward[1:])
    for _, sigma, _, level, _, wanting, liking, _, reward, extrinsic in () if fine.all() else attention.log.looks():
        if not low <= sigma <= high:
            raise PartError(behaviour, f"perceived {sigma}, outside [{behaviour.sigma_low}, {behaviour.sigma_high}]")
        if not (-SLACK <= wanting <= 1.0 + SLACK and -SLACK <= liking <= 1.0 + SLACK):
            raise PartError(curiosity, f"gave wanting {wanting} and liking {liking}; both must be within [0, 1]")
        if not 0 <= level < levels:
            raise PartError(curiosity, f"gave level {level}, no index of {curiosity.levels}")
        if reward is not None and not isfinite(reward):
            if extrinsic is None or not isfinite(extrinsic):
                raise PartError(behaviour, f"gave reward {extrinsic}")
            raise PartError(curiosity, f"mixed a reward of {reward}")
    if attention.action < 0:
        raise PartError(attention.learner, f"chose {attention.action}, no index of the periods {attention.periods}")


def check_commands(agent: Agent) -> None:
    """Every held command is two finite numbers. Raises :class:`PartError`."""
    for attention in agent.attentions:
        command: Any = attention.command  # a part's word for it
        try:
            fine = command is None or (len(command) == 2 and isfinite(command[0]) and isfinite(command[1]))
        except TypeError:
            fine = False
        if not fine:
            raise PartError(attention.behaviour, f"commanded {command!r}; expected (v m/s, w rad/s) or None")


def diagnose(agent: Agent) -> None:
    """After something raised: raise :class:`PartError` if a part's present answers are out of bounds."""
    check_commands(agent)
    for attention in agent.attentions:
        check_log(attention)
        behaviour, curiosity, learner, now = attention.behaviour, attention.curiosity, attention.learner, agent.now
        sigma: Any = behaviour.percept(now)  # a part's word, as the two below
        if not isinstance(sigma, (int, float)) or not behaviour.sigma_low <= sigma <= behaviour.sigma_high:
            raise PartError(behaviour, f"perceived {sigma!r}, outside [{behaviour.sigma_low}, {behaviour.sigma_high}]")
        wanting = curiosity.wanting(attention.memory, agent.body.energy)
        level: Any = curiosity.level(wanting, attention.liking)
        if not isinstance(level, int) or not 0 <= level < len(curiosity.levels):
            raise PartError(curiosity, f"gave level {level!r}, no index of {curiosity.levels}")
        action: Any = attention.action
        if not isinstance(action, int) or not 0 <= action < len(attention.periods):
            raise PartError(learner, f"chose {action!r}, no index of the periods {attention.periods}")


def blame(cause: BaseException) -> str:
    """``file:line`` of the innermost frame in a part that is not ours, or else of ours."""
    frames = traceback.extract_tb(cause.__traceback__)
    folders = {str(Path(spec.origin).parent) for spec in registry.parts.values()
               if not Path(spec.origin).is_relative_to(PACKAGE)}
    theirs = [f for f in frames if str(Path(f.filename).parent) in folders]
    ours = [f for f in frames if Path(f.filename).is_relative_to(PACKAGE)]
    found = theirs or ours or list(frames)
    if not found:
        return "a part"
    chosen = found[-1]
    path = Path(chosen.filename)
    return f"{path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path}:{chosen.lineno}"


def verdict(cause: BaseException) -> str:
    """One line that says what went wrong and in which file."""
    if isinstance(cause, PartError):
        return str(cause)
    return " ".join(f"{blame(cause)}: {describe(cause)}".split())

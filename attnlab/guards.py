"""Who did it: errors that name the file of the part at fault, found without a check on every activation.

What a part returned is checked at the end of an episode, from its log; when something raised, the parts are asked again
(their reads are pure), and the innermost file that is not ours is named.
"""

from __future__ import annotations

import inspect
import traceback
from collections.abc import Sequence
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

from attnlab.paths import PACKAGE

if TYPE_CHECKING:
    from attnlab.attention import Attention
    from attnlab.behaviours.base import Behaviour
    from attnlab.cycle import Agent
    from attnlab.penalty.base import Penalty

SLACK = 1e-9  # of rounding


class PartError(RuntimeError):
    """A part broke a promise; the message begins with its file."""

    def __init__(self, part: Any, problem: str):
        super().__init__(f"{file_of(part)}: '{getattr(part, 'name', type(part).__name__)}' {problem}")


def file_of(part: Any) -> str:
    """The file of a part's class, as short as it can be said."""
    path = Path(inspect.getsourcefile(type(part)) or type(part).__module__)
    return str(path.relative_to(Path.cwd())) if path.is_relative_to(Path.cwd()) else str(path)


def check_log(attention: Attention) -> None:
    """Everything an episode's log holds is within what was promised. Raises :class:`PartError`."""
    behaviour, curiosity = attention.behaviour, attention.curiosity
    slack = SLACK * (1.0 + abs(behaviour.sigma_high))
    low, high, levels = behaviour.sigma_low - slack, behaviour.sigma_high + slack, len(curiosity.levels)
    for _, sigma, _, level, _, wanting, liking, _, reward, extrinsic in attention.log:
        if not low <= sigma <= high:
            raise PartError(behaviour, f"perceived {sigma}, outside [{behaviour.sigma_low}, {behaviour.sigma_high}]")
        if not (-SLACK <= wanting <= 1.0 + SLACK and -SLACK <= liking <= 1.0 + SLACK):
            raise PartError(curiosity, f"gave wanting {wanting} and liking {liking}; both must be within [0, 1]")
        if not 0 <= level < levels:
            raise PartError(curiosity, f"gave level {level}, no index of {curiosity.levels}")
        if reward is not None and not isfinite(reward):
            if not isfinite(extrinsic):
                raise PartError(behaviour, f"gave reward {extrinsic}")
            raise PartError(curiosity, f"mixed a reward of {reward}")
    if attention.action < 0:
        raise PartError(attention.learner, f"chose {attention.action}, no index of the periods {attention.periods}")


def check_commands(agent: Agent) -> None:
    """Every held command is two finite numbers. Raises :class:`PartError`."""
    for attention in agent.attentions:
        command = attention.command
        try:
            fine = command is None or (len(command) == 2 and isfinite(command[0]) and isfinite(command[1]))
        except TypeError:
            fine = False
        if not fine:
            raise PartError(attention.behaviour, f"commanded {command!r}; expected (v m/s, w rad/s) or None")


def check_shares(penalty: Penalty, cause: str, behaviours: Sequence[Behaviour]) -> list[float]:
    """What a router of the penalty answers: a share within [0, 1] for each. Raises :class:`PartError`."""
    shares = list(penalty.shares(cause, behaviours))
    if len(shares) != len(behaviours) or not all(0.0 <= share <= 1.0 for share in shares):
        raise PartError(penalty, f"gave the shares {shares} to {len(behaviours)} behaviours; each must be in [0, 1]")
    return shares


def diagnose(agent: Agent) -> None:
    """After something raised: raise :class:`PartError` if a part's present answers are out of bounds."""
    check_commands(agent)
    for attention in agent.attentions:
        check_log(attention)
        behaviour, curiosity, learner, now = attention.behaviour, attention.curiosity, attention.learner, agent.now
        sigma = behaviour.percept(now)
        if not isinstance(sigma, (int, float)) or not behaviour.sigma_low <= sigma <= behaviour.sigma_high:
            raise PartError(behaviour, f"perceived {sigma!r}, outside [{behaviour.sigma_low}, {behaviour.sigma_high}]")
        wanting = curiosity.wanting(attention.memory, agent.body.energy)
        level = curiosity.level(wanting, attention.liking)
        if not isinstance(level, int) or not 0 <= level < len(curiosity.levels):
            raise PartError(curiosity, f"gave level {level!r}, no index of {curiosity.levels}")
        if not isinstance(attention.action, int) or not 0 <= attention.action < len(attention.periods):
            raise PartError(learner, f"chose {attention.action!r}, no index of the periods {attention.periods}")


def blame(cause: BaseException) -> str:
    """``file:line`` of the innermost frame in a part that is not ours, or else of ours."""
    from attnlab import registry
    frames = traceback.extract_tb(cause.__traceback__)
    folders = {str(Path(spec.origin).parent) for spec in registry.parts.values()
               if not Path(spec.origin).is_relative_to(PACKAGE)}
    theirs = [f for f in frames if str(Path(f.filename).parent) in folders]
    ours = [f for f in frames if Path(f.filename).is_relative_to(PACKAGE)]
    chosen = (theirs or ours or frames or [None])[-1]
    if chosen is None:
        return "a part"
    path = Path(chosen.filename)
    return f"{path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path}:{chosen.lineno}"


def verdict(cause: BaseException) -> str:
    """One line that says what went wrong and in which file."""
    from attnlab.registry import describe
    if isinstance(cause, PartError):
        return str(cause)
    return " ".join(f"{blame(cause)}: {describe(cause)}".split())

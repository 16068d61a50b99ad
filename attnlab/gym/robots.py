"""A robot in memory, of which compiled code lives many until their next decision: what
:class:`attnlab.gym.play.Play` does with one, from the same methods."""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Any

from attnlab.compiled.engine import Compiled, Uncompilable, files_of, reason
from attnlab.compiled.methods import one_of
from attnlab.exploration.base import Exploration
from attnlab.gym import play as of_one
from attnlab.gym import steps
from attnlab.gym.play import Play
from attnlab.penalty.base import check_shares
from attnlab.tables.code import package_hash


class Robot(Compiled):
    """A :class:`Play`; ``at`` and ``ours``: the addresses of :data:`attnlab.gym.steps.OF_ROBOT` and, for each behaviour
    that is decided for, of :data:`attnlab.gym.steps.OF_OURS`. Raises :class:`Uncompilable`."""

    def __init__(self, play: Play):
        self.play = play
        super().__init__(play.agent, [play.exploration])
        memory = self._memory
        self.steps: Any = self._episode  # of all robots of this kind
        self.at = self._at, memory.address(play.exploration)
        self.ours = [(memory.address(attention), memory.address(play.told[name]))
                     for name, attention in play.attentions.items()]

    def start(self) -> tuple[float, float, float]:
        """The next episode: where it starts."""
        play = self.play
        play.episode += 1
        play.exploration.start(play.episode)
        if type(play.exploration).start is not Exploration.start:  # a schedule may have changed it
            self._memory.push(play.exploration)
        return play.plan.start_pose("train", play.episode)

    def death(self, word: int) -> tuple[str, list[float]]:
        """What the robot died of, and the penalties of those who are decided for; all learn from theirs."""
        cause, agent = self._causes[word], self._agent
        agent.body.dead = True
        self._memory.write(agent.body, "dead")
        shares = check_shares(agent.penalty, cause, [attention.behaviour for attention in agent.attentions])
        paid = [self._died(self._memory.address(attention), share, True)
                for attention, share in zip(agent.attentions, shares, strict=True)]
        return cause, [share for attention, share in zip(agent.attentions, paid, strict=True)
                       if attention.behaviour.name in self.play.attentions]

    def _entries(self, agent: Any, exploration: Any, only_kept: bool) -> Any:
        kinds = tuple(dict.fromkeys(self._memory.place(one)[0] for one in self.play.told.values()))
        told = kinds[0] if len(kinds) == 1 else one_of(kinds)
        attention = agent.layout["attentions"].of
        ours = b"".join(Path(str(file)).read_bytes() for file in (steps.__file__, of_one.__file__))
        text = f"{agent} {exploration} {told} {package_hash()} {files_of([agent, exploration])}"
        key = hashlib.sha256(text.encode() + ours).hexdigest()[:24]
        try:
            return steps.entries(key, agent, exploration, attention, told)
        except Exception as cause:  # whatever numba makes of a part's code
            raise Uncompilable(reason(str(cause), self._memory.left_out)) from cause

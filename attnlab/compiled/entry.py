"""Where compiled code is entered: an episode, and the penalty of one behaviour. Kept by numba on disk."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from numba import types
from numba.extending import intrinsic

from attnlab.compiled import counterparts  # noqa: F401  registers them
from attnlab.compiled.kinds import INTEGER, Reference
from attnlab.compiled.methods import OPTIONS
from attnlab.compiled.words import word_code
from attnlab.cycle import live
from attnlab.kernels.compile import compiled, is_kept

Episode = Callable[[int, int, bool, float, float, float], int]
Died = Callable[[int, float, bool], float]

_roots: dict[str, Any] = {}  # by key: what kind of object is at an address
_entries: dict[str, tuple[Episode, Died]] = {}  # by key: what this process has loaded or compiled


@intrinsic(prefer_literal=True)
def at_address(_: Any, address: Any, key: Any) -> Any:
    """The object at an address, of the kind that was announced under this key."""
    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return builder.inttoptr(args[0], INTEGER.as_pointer())
    return _roots[key.literal_value](types.int64, key), generate


def root(key: str, kind: Any) -> str:
    """Announce under a key what kind of object :func:`at_address` is to find; the key."""
    _roots[key] = kind
    return key


def entries(key: str, agent: Reference, exploration: Any, attention: Any, only_kept: bool = False
            ) -> tuple[Episode, Died] | None:
    """The compiled functions of an agent of this kind, from the disk if they are there, otherwise None with
    ``only_kept``; ``key`` says of which code and kinds. Raises whatever numba does if a part does not compile."""
    if key in _entries:
        return _entries[key]
    agent_key, exploration_key = root(f"{key} agent", agent), root(f"{key} exploration", exploration)
    attention_key = root(f"{key} attention", attention)

    def episode(agent_at: int, exploration_at: int, learning: bool, x: float, y: float, heading: float) -> int:
        agent = at_address(agent_at, agent_key)
        agent.start(x, y, heading)
        cause = live(agent, at_address(exploration_at, exploration_key), learning)
        return 0 if cause is None else word_code(cause)

    def died(attention_at: int, share: float, learning: bool) -> float:
        return at_address(attention_at, attention_key).died(share, learning)
    both = ("int64(int64, int64, boolean, float64, float64, float64)", episode), \
        ("float64(int64, float64, boolean)", died)
    if only_kept and not all(is_kept(signature, function, nogil=True, **OPTIONS) for signature, function in both):
        return None
    one, other = (compiled(signature, nogil=True, **OPTIONS)(function) for signature, function in both)
    _entries[key] = one, other
    return one, other

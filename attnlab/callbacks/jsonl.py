"""A line an episode, while the run goes on."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from attnlab.callbacks.base import Callback
from attnlab.probes.base import Lived
from attnlab.registry import register


@register("callback", "jsonl")
class JsonLines(Callback):
    """Appends phase, episode, survival and death of every episode to ``episodes.jsonl`` in the run's folder, for those
    who want to look on (``tail -f``). The tables stay the truth."""

    def start(self, config: Mapping[str, Any]) -> None:
        if self.folder is not None:
            (self.folder / "episodes.jsonl").unlink(missing_ok=True)

    def episode(self, lived: Lived) -> None:
        if self.folder is not None:
            line = {"phase": lived.phase, "episode": lived.episode, "survival": lived.cycles / lived.max_cycles,
                    "death": lived.death}
            with (self.folder / "episodes.jsonl").open("a") as file:
                file.write(json.dumps(line) + "\n")

"""Weights & Biases."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from attnlab.callbacks.base import Callback
from attnlab.callbacks.scalars import flat, scalars
from attnlab.probes.base import Lived
from attnlab.registry import register
from attnlab.settings import setting


@register("callback", "wandb")
class Wandb(Callback):
    """A run of Weights & Biases for each run, in ``wandb/`` of the run's folder; ``wandb sync`` uploads it later. Needs
    the extra ``wandb``. Offline unless it is told otherwise: nothing leaves this machine by itself."""

    @dataclass
    class Params:
        project: str = setting("attnlab", "of Weights & Biases")
        mode: Literal["offline", "online"] = setting("offline", "write to disk, or to their server")

    params: Params
    requires, extra = ("wandb",), "wandb"

    def start(self, config: Mapping[str, Any]) -> None:
        import wandb
        where = str(self.folder) if self.folder is not None else None
        self._run = wandb.init(project=self.params.project, name=self.run, config=flat(config), dir=where,
                               mode=self.params.mode, reinit="create_new", settings=wandb.Settings(silent=True))

    def episode(self, lived: Lived) -> None:
        self._run.log({**scalars(lived), "episode": lived.episode})

    def end(self, status: str) -> None:
        self._run.finish(exit_code=0 if status == "complete" else 1)

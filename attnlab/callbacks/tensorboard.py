"""TensorBoard."""

from __future__ import annotations

from typing import Any

from attnlab.callbacks.base import Callback
from attnlab.callbacks.scalars import scalars
from attnlab.probes.base import Lived
from attnlab.registry import register


@register("callback", "tensorboard")
class TensorBoard(Callback):
    """An event file in ``tensorboard/`` of the run's folder, a step an episode: ``tensorboard --logdir outputs/STUDY``.
    Needs the extra ``tensorboard``, and neither TensorFlow nor PyTorch. Nothing is written for a run that is not
    stored."""
    requires, extra = ("tensorboard",), "tensorboard"

    def episode(self, lived: Lived) -> None:
        if self.folder is None:
            return
        from tensorboard.compat.proto.event_pb2 import Event
        from tensorboard.compat.proto.summary_pb2 import Summary
        values = [Summary.Value(tag=name, simple_value=value) for name, value in scalars(lived).items()]
        self._writer().add_event(Event(step=lived.episode, summary=Summary(value=values)))

    def _writer(self) -> Any:
        if not hasattr(self, "_open"):
            import shutil

            from tensorboard.summary.writer.event_file_writer import EventFileWriter
            assert self.folder is not None, "asked only for runs that are stored"
            shutil.rmtree(self.folder / "tensorboard", ignore_errors=True)
            self._open = EventFileWriter(str(self.folder / "tensorboard"))
        return self._open

    def end(self, status: str) -> None:
        if hasattr(self, "_open"):
            self._open.close()

"""MLflow."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from attnlab.callbacks.base import Callback
from attnlab.callbacks.scalars import flat, scalars
from attnlab.probes.base import Lived
from attnlab.registry import register
from attnlab.settings import setting
from attnlab.tables.lock import locked


@register("callback", "mlflow")
class Mlflow(Callback):
    """A run of MLflow for each run: the settings as parameters, a step an episode. Needs the extra ``mlflow``. The
    default database is ``mlflow.db`` in the study's folder (``mlflow ui --backend-store-uri sqlite:///outputs/STUDY/mlflow.db``),
    and then nothing is written for a run that is not stored."""

    @dataclass
    class Params:
        uri: str | None = setting(None, "where MLflow keeps its runs: a database or a server; left out: in the study")
        experiment: str = setting("attnlab", "of MLflow")

    params: Params
    requires, extra = ("mlflow", "sqlalchemy", "alembic"), "mlflow"

    def start(self, config: Mapping[str, Any]) -> None:
        self._client = None
        if self.folder is None:
            return
        import logging

        from mlflow import MlflowClient
        logging.getLogger("mlflow").setLevel(logging.WARNING)  # it tells of every table it makes
        uri = self.params.uri or f"sqlite:///{(self.folder.parent / 'mlflow.db').resolve()}"
        with locked(self.folder.parent):  # two runs that make the tables at once would break them
            self._client = client = MlflowClient(uri)
            found = client.get_experiment_by_name(self.params.experiment)
            where = found.experiment_id if found else client.create_experiment(self.params.experiment)
        self._id = client.create_run(where, run_name=self.run).info.run_id
        for name, value in flat(config).items():
            client.log_param(self._id, name.replace("[", "(").replace("]", ")"), str(value)[:500])

    def episode(self, lived: Lived) -> None:
        if self._client is None:
            return
        import time

        from mlflow.entities import Metric
        now = int(time.time() * 1000)
        self._client.log_batch(self._id, metrics=[Metric(name, value, now, lived.episode)
                                                  for name, value in scalars(lived).items()])

    def end(self, status: str) -> None:
        if self._client is not None:
            self._client.set_terminated(self._id, "FINISHED" if status == "complete" else "FAILED")

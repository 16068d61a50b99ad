"""TensorBoard, MLflow and Weights & Biases are told what the tables say; each with the real package."""

import json

import pandas as pd
import pytest

from attnlab.loading import load_all
from attnlab.robot.folder import run_to_folder
from attnlab.testing import config
from attnlab.testing.build import node


@pytest.fixture
def watched(tmp_path):
    """A function that runs a short run with a callback: (its folder, its training episodes, its behaviours)."""
    load_all()

    def run(name, **settings):
        folder = tmp_path / "study" / "run"
        chosen = config(train_episodes=3, max_cycles=60, callback={name: node("callback", name, **settings)})
        assert run_to_folder(chosen, folder, {"run": "run", "key": "k", "overrides": [], "swept": {}})
        assert "callbacks" not in json.loads((folder / "run.json").read_text())  # it raised nothing
        tables = [pd.read_parquet(folder / f"{table}.parquet") for table in ("episodes", "behaviours")]
        return folder, *(table[table["phase"] == "train"] for table in tables)
    return run


def test_tensorboard(watched):
    pytest.importorskip("tensorboard")
    from tensorboard.backend.event_processing.event_accumulator import EventAccumulator
    folder, episodes, behaviours = watched("tensorboard")
    found = EventAccumulator(str(folder / "tensorboard"))
    found.Reload()
    seen = found.Scalars("train/energy_mean")
    assert [event.step for event in seen] == [0, 1, 2]
    assert [event.value for event in seen] == pytest.approx(episodes["energy_mean"].tolist())
    acts = behaviours.loc[behaviours["behaviour"] == "eat", "activations"].tolist()
    assert [event.value for event in found.Scalars("train/eat/activations")] == acts
    assert "validation/survival" in found.Tags()["scalars"]


def test_mlflow(watched):
    mlflow = pytest.importorskip("mlflow")
    pytest.importorskip("sqlalchemy")
    folder, _, behaviours = watched("mlflow")
    client = mlflow.MlflowClient(f"sqlite:///{folder.parent / 'mlflow.db'}")
    [run] = client.search_runs([client.get_experiment_by_name("attnlab").experiment_id])
    assert run.data.params["learner.alpha"] == "0.8" and run.info.status == "FINISHED"
    rewards = [metric.value for metric in client.get_metric_history(run.info.run_id, "train/avoid/reward")]
    assert rewards == pytest.approx(behaviours.loc[behaviours["behaviour"] == "avoid", "reward"].tolist())


def entries(data):
    """What a log in LevelDB's format holds: after 7 bytes of its own, blocks of 32 KiB of (checksum, length, type)."""
    at, whole = 7, b""
    while at + 7 <= len(data):
        if (room := 32768 - at % 32768) < 7:
            at += room
            continue
        length, kind = int.from_bytes(data[at + 4:at + 6], "little"), data[at + 6]
        whole += data[at + 7:at + 7 + length]
        at += 7 + length
        if kind in (1, 4):  # whole, or the last piece
            yield whole
            whole = b""


def test_wandb_offline(watched):
    pytest.importorskip("wandb")
    from wandb.proto import wandb_internal_pb2
    folder, episodes, _ = watched("wandb")
    [file] = (folder / "wandb").glob("offline-run-*/*.wandb")
    told = []
    for entry in entries(file.read_bytes()):
        record = wandb_internal_pb2.Record()
        record.ParseFromString(entry)
        told += [json.loads(item.value_json) for item in record.history.item
                 if (item.nested_key[0] if item.nested_key else item.key) == "train/path_m"]
    assert told == pytest.approx(episodes["path_m"].tolist())

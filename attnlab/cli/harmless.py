"""Config files of one's own, looked at before Hydra reads them: they set values and run no code."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from hydra.core.override_parser.types import Override

from attnlab.errors import ConfigError
from attnlab.loading import config_folders
from attnlab.tables.yamls import read_yaml

RUNS_CODE = ("_target_", "()")  # what Hydra, and Python's logging, take for the name of something to call


def check_files(overrides: Iterable[Override]) -> bool:
    """Look at the chosen config files that are not ours; were there any? Raises ConfigError that names the file."""
    found = False
    for override in overrides:
        group = str(override.get_key_element()).lstrip("+~")
        names = override.value() if not override.is_sweep_override() else []
        for name in names if isinstance(names, list) else [names]:
            for folder in config_folders():
                file = folder / group / f"{name}.yaml"
                if file.is_file():
                    _check_file(file)
                    found = True
    return found


def check_composed(hydra: Mapping[str, Any]) -> None:
    """Look at what all files together ask of Hydra. Raises ConfigError."""
    if hydra.get("callbacks"):
        raise ConfigError("hydra.callbacks", "a config file asks for callbacks, which run code",
                          "Who watches a run is a part of ours: callback=[...]")


def _check_file(file: Path) -> None:
    from yaml import YAMLError
    try:
        content = read_yaml(file.read_text())
    except (YAMLError, UnicodeDecodeError):
        return  # composing says where
    except ValueError as cause:
        raise ConfigError(str(file), str(cause), "Write it without anchors") from None
    nodes: list[Any] = [content]
    while nodes:
        node = nodes.pop()
        if isinstance(node, Mapping):
            for key, value in node.items():
                if key in RUNS_CODE or str(key).replace("/", ".").startswith("hydra.callbacks") or \
                        "hydra/callbacks" in str(key) or (key == "callbacks" and node is _hydra(content)):
                    raise ConfigError(str(file), f"{key} names code to run, and a config file sets values only",
                                      "A part of one's own: docs/authors.md")
                nodes.append(value)
        elif isinstance(node, list):
            nodes += node


def _hydra(content: Any) -> Any:
    return content.get("hydra") if isinstance(content, Mapping) else None

"""Config files of one's own, looked at as Hydra loads them: they set values and run no code."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from hydra._internal.core_plugins.file_config_source import FileConfigSource
from hydra.plugins.config_source import ConfigResult

from attnlab.errors import ConfigError
from attnlab.launch.searchpath import SCHEME
from attnlab.tables.yamls import read_yaml

RUNS_CODE = ("_target_", "()")  # what Hydra, and Python's logging, take for the name of something to call


class CheckedFiles(FileConfigSource):
    """A folder of config files whose content is looked at before Hydra has it, whoever names them: a command line, a
    sweep, another file."""

    @staticmethod
    def scheme() -> str:
        return SCHEME

    def load_config(self, config_path: str) -> ConfigResult:
        """As Hydra's own. Raises ConfigError that names the file."""
        file = Path(self.path) / self._normalize_file_name(config_path)
        if file.is_file():
            check_file(file)
        return super().load_config(config_path)


def check_file(file: Path) -> None:
    """Raise ConfigError if a file names code, or stands for more than can be held."""
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
                if "hydra/sweeper" in str(key):
                    raise ConfigError(str(file), "a sweeper is chosen by a config file, and a sweeper runs code",
                                      f"Type hydra/sweeper={value}")
                nodes.append(value)
        elif isinstance(node, list):
            nodes += node
    hydra = _hydra(content)
    sweeper = hydra.get("sweeper") if isinstance(hydra, Mapping) else None
    for key in sweeper if isinstance(sweeper, Mapping) else ():
        if key != "params":  # some sweepers take names of functions
            raise ConfigError(str(file), f"hydra.sweeper.{key} is for the command line",
                              f"Type hydra.sweeper.{key}=...")


def _hydra(content: Any) -> Any:
    return content.get("hydra") if isinstance(content, Mapping) else None

"""Summary tables: read, checked, typed."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from attnlab.errors import ConfigError, nearest
from attnlab.loading import named_file
from attnlab.settings import build, setting

if TYPE_CHECKING:
    from yaml import SafeLoader, ScalarNode

DEFAULT = "dinocera2014_table5"
QUANTITIES = ("energy_max", "energy_min", "energy_mean", "safety_max", "safety_min", "safety_mean", "hunger_mean",
              "hunger_max", "thirst_mean", "thirst_max", "active_cycles")
PREFIXES = ("reward", "activations")


class Cell(NamedTuple):
    """A printed number: mean, standard deviation (None if not given), and half a unit of its last digit."""
    mean: float
    sd: float | None
    rounding: float


@dataclass
class Settings:
    """Of the model behind the table. All in the paper's units."""
    periods: list[int] = setting([1, 4, 8, 12], "periods of the clocks", unit="mc", low=1)
    e_u: float = setting(1.0, "energy a cycle", unit="UoE", low=0)
    e_nb: float = setting(1.0, "energy an activation", unit="UoE", low=0)
    k: float = setting(1.0, "growth of each need an activation", unit="UoE", low=0)
    meal: float = setting(150.0, "what a meal or a drink gives", unit="UoE", low=0)
    need_max: float = setting(1500.0, "largest need", unit="UoE", above=0)
    energy_well: dict[float, str] = setting({}, "candidates for E_well: value -> where it is said")


@dataclass
class _File:
    title: str = setting("", "")
    cycles: dict[int, str] = setting({}, "candidates for the cycles of an episode: value -> where it is said")
    settings: Settings = setting(Settings(), "")
    conditions: list[str] = setting([], "names of the columns")
    extrinsic_only: list[str] = setting([], "conditions whose rewards hold no intrinsic part")
    above_well: list[str] = setting([], "conditions said to keep their energy above E_well")
    episodes: int = setting(100, "episodes that the means are over", low=1)
    cells: dict[str, Any] = setting({}, "quantity -> condition -> [mean, sd]")
    undecided: list[Any] = setting([], "groups of cells that cannot be told apart")
    notes: list[str] = setting([], "")


@dataclass
class Table:
    """A checked summary table. ``cells[quantity][condition]``."""
    title: str
    cycles: dict[int, str]
    settings: Settings
    conditions: list[str]
    extrinsic_only: list[str]
    above_well: list[str]
    episodes: int
    cells: dict[str, dict[str, Cell]]
    undecided: list[tuple[str, tuple[str, ...]]]
    notes: list[str]

    def get(self, quantity: str, condition: str) -> Cell | None:
        return self.cells.get(quantity, {}).get(condition)

    def group(self, prefix: str, condition: str) -> dict[str, Cell]:
        """Cells ``prefix.<behaviour>`` of a condition, but for the global one."""
        found = {name.partition(".")[2]: of[condition] for name, of in self.cells.items()
                 if name.startswith(f"{prefix}.") and condition in of}
        found.pop("global", None)
        return found

    def is_undecided(self, quantity: str, condition: str) -> bool:
        return any(condition == c and quantity in cells for c, cells in self.undecided)


def load_table(name: str | None = None) -> Table:
    """The summary table of this name or path. Raises ConfigError naming file and cell."""
    import yaml
    path = named_file("audit", name or DEFAULT, "audit")
    try:
        content = yaml.load(path.read_text(), _loader())
    except (yaml.YAMLError, UnicodeDecodeError, OSError) as cause:
        raise ConfigError(path.name, f"is no readable YAML: {cause}") from None
    if not isinstance(content, Mapping):
        raise ConfigError(path.name, "expected settings by name")
    raw = content.get("cells") if isinstance(content.get("cells"), Mapping) else {}
    file = build(_File, _numbers({**content, "cells": {}}), path.name)
    if not file.conditions or not raw:
        raise ConfigError(f"{path.name}.{'cells' if file.conditions else 'conditions'}", "is missing")
    if not file.cycles or not all(isinstance(n, int) and n > 0 for n in file.cycles):
        raise ConfigError(f"{path.name}.cycles", "expected whole numbers of cycles with where each is said",
                          "cycles: {1150: the text}")
    cells = {str(q): _row(str(q), of, file.conditions, f"{path.name}.cells.{q}") for q, of in raw.items()}
    undecided = [_undecided(u, cells, f"{path.name}.undecided") for u in file.undecided]
    return Table(file.title or path.stem, file.cycles, file.settings, file.conditions, file.extrinsic_only,
                 file.above_well, file.episodes, cells, undecided, file.notes)


def _row(quantity: str, of: Any, conditions: list[str], where: str) -> dict[str, Cell]:
    if quantity not in QUANTITIES and quantity.partition(".")[0] not in PREFIXES:
        raise ConfigError(where, "no such quantity", nearest(quantity, [*QUANTITIES, "reward.eat", "activations.eat"]))
    if not isinstance(of, Mapping):
        raise ConfigError(where, f"expected a cell for each condition, got {of!r}")
    for condition in of:
        if condition not in conditions:
            raise ConfigError(f"{where}.{condition}", "no such condition", nearest(str(condition), conditions))
    return {str(condition): _cell(value, f"{where}.{condition}") for condition, value in of.items()}


def _cell(value: Any, where: str) -> Cell:
    printed = value if isinstance(value, list) else [value]
    try:
        numbers = [float(str(n)) for n in printed]
        if len(numbers) not in (1, 2) or not all(map(math.isfinite, numbers)):
            raise ValueError
    except ValueError:
        raise ConfigError(where, f"{value!r} is no number with a deviation", "Write [mean, deviation]") from None
    if len(numbers) == 2 and numbers[1] < 0:
        raise ConfigError(where, f"a standard deviation of {numbers[1]} cannot be")
    decimals = len(str(printed[0]).partition(".")[2])
    return Cell(numbers[0], numbers[1] if len(numbers) == 2 else None, 0.5 * 10.0 ** -decimals)


def _undecided(node: Any, cells: Mapping[str, Any], where: str) -> tuple[str, tuple[str, ...]]:
    if not isinstance(node, Mapping) or set(node) != {"condition", "cells"}:
        raise ConfigError(where, f"expected condition and cells, got {node!r}")
    for name in node["cells"]:
        if name not in cells:
            raise ConfigError(where, f"names the cell '{name}'", nearest(str(name), cells))
    return str(node["condition"]), tuple(map(str, node["cells"]))


def _numbers(node: Any) -> Any:
    """Numbers where the loader kept texts as printed."""
    if isinstance(node, Mapping):
        return {_numbers(key): _numbers(value) for key, value in node.items()}
    if isinstance(node, list):
        return [_numbers(item) for item in node]
    if isinstance(node, _Printed):
        return int(node) if "." not in node and "e" not in node.lower() else float(node)
    return node


class _Printed(str):
    """A number as it was written, so that 1.00 keeps its two decimals."""


def _loader() -> type[SafeLoader]:
    """A safe YAML loader that keeps numbers as printed; made when needed, for this module is imported lightly."""
    import yaml

    class AsPrinted(yaml.SafeLoader):
        pass

    def printed(loader: SafeLoader, node: ScalarNode) -> Any:
        text = loader.construct_scalar(node)
        try:
            float(text)
        except ValueError:
            return loader.construct_yaml_float(node) if node.tag.endswith("float") else loader.construct_yaml_int(node)
        return _Printed(text)
    AsPrinted.add_constructor("tag:yaml.org,2002:float", printed)
    AsPrinted.add_constructor("tag:yaml.org,2002:int", printed)
    return AsPrinted

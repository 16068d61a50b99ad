"""The one door: built-in parts, files in plugins/ and pip packages register here, in the same way.

    @register("curiosity", "mine")
    class Mine(Curiosity):
        '''What it is, its source, what it draws at random.'''
        @dataclass
        class Params: ...

A module that fails to load is kept in :data:`failures`, shown by ``python -m attnlab.parts``, and raised with its
cause when somebody asks for it by name; the others go on.
"""

from __future__ import annotations

import dataclasses
import hashlib
import importlib
import inspect
import os
import pkgutil
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from attnlab import settings
from attnlab.errors import ConfigError, nearest
from attnlab.paths import PACKAGE, plugins_dir

GROUPS = {  # folder of conf/ -> package of attnlab that holds the built-in parts
    "simulator": "simulators", "world": "worlds", "behaviours": "behaviours", "needs": "needs", "fusion": "fusion",
    "curiosity": "curiosity", "learner": "learners", "exploration": "exploration", "penalty": "penalty",
    "measure": "measures",
}
NO_OPTION = ("measure",)  # parts of a report: configured in a claims file, where parameters may be required
ENTRY_POINTS = "attnlab.plugins"


@dataclasses.dataclass
class NoParams:
    """A part without settings."""


@dataclasses.dataclass(frozen=True)
class Spec:
    """A registered part: where it comes from and what it takes."""
    group: str
    name: str
    cls: type
    presets: Mapping[str, Mapping[str, Any]]
    origin: str

    @property
    def params(self) -> type:
        return getattr(self.cls, "Params", NoParams)

    def nodes(self) -> dict[str, dict]:
        """Config options of this part by option name: the part with its defaults, and its presets."""
        base = settings.defaults_of(self.params)
        nodes = {self.name: {"name": self.name, **base}}
        for preset, values in self.presets.items():
            nodes[preset] = {"name": preset, "part": self.name, **base, **values}
        return nodes


parts: dict[tuple[str, str], Spec] = {}
failures: dict[str, tuple[str, BaseException]] = {}  # module or entry point -> (file, what it raised)
_packages: list[str] = []  # modules of entry points
_loaded = False


def register(group: str, name: str, *, presets: Mapping[str, Mapping[str, Any]] | None = None) -> Callable:
    """Class decorator: ``group=name`` now means this class. ``presets`` are further options: name -> parameters."""
    def door(cls: type) -> type:
        origin = inspect.getsourcefile(cls) or cls.__module__
        if group not in GROUPS:
            raise ValueError(f"{origin}: there is no group '{group}'. {nearest(group, GROUPS)}")
        if inspect.isabstract(cls):
            raise TypeError(f"{origin}: {cls.__name__} lacks {', '.join(sorted(cls.__abstractmethods__))}")
        check_params(group, cls, origin)
        for option in (name, *(presets or {})):
            old = find(group, option)
            if old is not None and old.cls is not cls:
                raise ValueError(f"{origin}: {group} '{option}' is already registered by {old.origin}")
        parts[group, name] = Spec(group, name, cls, presets or {}, origin)
        return cls
    return door


def check_params(group: str, cls: type, origin: str) -> None:
    """Raise TypeError unless the parameters of a part are a dataclass of typed fields whose defaults are valid."""
    params = getattr(cls, "Params", NoParams)
    if not dataclasses.is_dataclass(params):
        raise TypeError(f"{origin}: {cls.__name__}.Params must be a dataclass with typed fields")
    for name, value in vars(params).items():
        if not (name.startswith("_") or callable(value) or name in params.__annotations__
                or isinstance(value, (property, staticmethod, classmethod))):
            raise TypeError(f"{origin}: parameter '{name}' of {cls.__name__} has no type: write {name}: float = ...")
    if group in NO_OPTION:
        return
    for field in dataclasses.fields(params):
        if field.default is field.default_factory is dataclasses.MISSING:
            raise TypeError(f"{origin}: parameter '{field.name}' of {cls.__name__} has no default")
    try:
        settings.build(params, settings.defaults_of(params), group)
    except (ConfigError, NameError) as cause:
        raise TypeError(f"{origin}: {cls.__name__}'s parameters do not accept their own defaults: {cause}") from None


def find(group: str, option: str) -> Spec | None:
    """The part behind an option name (its own or a preset's), or None."""
    for spec in parts.values():
        if spec.group == group and (option == spec.name or option in spec.presets):
            return spec
    return None


def get(group: str, node: Mapping[str, Any], where: str) -> Spec:
    """The part that a config node names."""
    name = node.get("part") or node.get("name")
    spec = parts.get((group, str(name)))
    if spec is None:
        raise unknown(group, str(name), where)
    return spec


def unknown(group: str, name: str, where: str, known: list[str] | None = None) -> ConfigError:
    """The error for a name nobody registered: the cause, if a plugin of that name failed to load."""
    for module, (file, cause) in failures.items():
        if module.rpartition(".")[2] == name or f"'{name}'" in str(cause):
            return ConfigError(f"{where}={name}", f"{file} did not load: {describe(cause)}", "Mend that file")
    names = known or [option for spec in parts.values() if spec.group == group for option in spec.nodes()]
    return ConfigError(f"{where}={name}", f"no {group} is called '{name}'", nearest(name, names))


def plugin_hashes(config: Mapping[str, Any]) -> dict[str, str]:
    """Plugin and package files that a run's config names parts of: file -> sha256, so that a run knows its code."""
    words, nodes = set(), [config]
    while nodes:
        node = nodes.pop()
        if isinstance(node, Mapping):
            words |= set(map(str, node))
            nodes += node.values()
        elif isinstance(node, (list, tuple)):
            nodes += node
        elif isinstance(node, str):
            words.add(node)
    files = {Path(spec.origin) for spec in parts.values() if spec.group not in NO_OPTION
             and not words.isdisjoint((spec.name, *spec.presets)) and not Path(spec.origin).is_relative_to(PACKAGE)}
    return {f"{file.parent.name}/{file.name}": hashlib.sha256(file.read_bytes()).hexdigest()[:16]
            for file in sorted(files) if file.is_file()}


def describe(cause: BaseException) -> str:
    """One line: the error's type, message, and for a syntax error its line."""
    line = f" (line {cause.lineno})" if isinstance(cause, SyntaxError) and cause.lineno else ""
    text = cause.msg if isinstance(cause, SyntaxError) else str(cause)
    return f"{type(cause).__name__}: {text}{line}"


def build_params(group: str, node: Mapping[str, Any], where: str) -> tuple[Spec, Any]:
    """The part a node names, and its checked parameters."""
    if not isinstance(node, Mapping) or not (node.get("part") or node.get("name")):
        known = sorted(s.name for s in parts.values() if s.group == group)
        if isinstance(node, Mapping) and node:
            raise ConfigError(where, f"the {group} file chosen does not say which part it sets",
                              f"Write 'part: {known[0]}' into it (known: {', '.join(known)})")
        raise ConfigError(where, f"expected the name of a {group}, got {node!r}", nearest("", known))
    spec = get(group, node, where)
    values = {key: value for key, value in node.items() if key not in ("name", "part")}
    return spec, settings.build(spec.params, values, where)


def make(group: str, node: Mapping[str, Any], context: Any, where: str = "") -> Any:
    """Construct the part that a config node names; its class is called with (params, context)."""
    where = where or group
    spec, params = build_params(group, node, where)
    try:
        part = spec.cls(params, context)
    except ConfigError as error:
        inner = error.setting if error.setting.startswith(where) else f"{where}.{error.setting}"
        raise ConfigError(inner, error.problem, error.hint) from None
    part.name = node["name"]
    return part


def plugin_folders() -> list[Path]:
    """Where drop-in parts live: in the folder one works in, in $ATTNLAB_PLUGINS, and those shipped as examples."""
    more = os.environ.get("ATTNLAB_PLUGINS", "").split(os.pathsep)
    folders = [Path.cwd() / "plugins", *map(Path, more), plugins_dir()]
    unique = dict.fromkeys(folder.resolve() for folder in folders if str(folder) not in ("", ".") and folder.is_dir())
    return list(unique)


def config_folders() -> list[Path]:
    """Folders that may hold config groups (a world, an experiment), found by Hydra after ours: plugins/ folders, and
    ``conf`` beside the module of a pip package's entry point. Call after :func:`load_all`."""
    beside = [Path(sys.modules[module].__file__).parent / "conf" for module in _packages]
    return [*plugin_folders(), *(folder for folder in beside if folder.is_dir())]


def load_all() -> None:
    """Import every built-in part, every plugins/ file and every ``attnlab.plugins`` entry point, once a process."""
    global _loaded
    if _loaded:
        return
    _loaded = True
    for package_name in GROUPS.values():
        package = importlib.import_module(f"attnlab.{package_name}")
        for module in pkgutil.iter_modules(package.__path__):
            importlib.import_module(f"attnlab.{package_name}.{module.name}")
    plugins = importlib.import_module("attnlab.plugins")
    folders = plugin_folders()
    plugins.__path__.extend(str(folder) for folder in folders if str(folder) not in plugins.__path__)
    mine = {file.name for folder in folders if folder != plugins_dir() for file in folder.glob("*.py")}
    for folder in folders:
        for file in sorted(folder.glob("*.py")):
            replaced = folder == plugins_dir() and file.name in mine  # a file of one's own instead of our example
            if not file.name.startswith("_") and not replaced:
                _load(f"attnlab.plugins.{file.stem}", str(file))
    from importlib.metadata import entry_points
    for point in sorted(entry_points(group=ENTRY_POINTS), key=lambda p: p.name):
        module = point.value.partition(":")[0]
        if _load(module, f"entry point {point.name} ({point.value})", point.name):
            _packages.append(module)


def _load(module: str, origin: str, alias: str | None = None) -> bool:
    before = dict(parts)
    try:
        if module in sys.modules and not alias and sys.modules[module].__file__ != origin:
            raise ImportError(f"another plugin file has the same name: {sys.modules[module].__file__}")
        importlib.import_module(module)
        return True
    except (Exception, SystemExit) as cause:  # noqa: BLE001  a plugin may raise anything; it is kept, and shown
        parts.clear()
        parts.update(before)
        failures[alias or module] = (origin, cause)
        return False

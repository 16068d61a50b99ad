"""The postman: brings every module that holds parts to the door (:mod:`attnlab.registry`)."""

from __future__ import annotations

import hashlib
import importlib
import os
import pkgutil
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from attnlab.errors import ConfigError, nearest
from attnlab.groups import GROUPS
from attnlab.paths import PACKAGE, conf_dir, plugins_dir
from attnlab.registry import Spec, failures, parts

ENTRY_POINTS = "attnlab.plugins"
_packages: list[str] = []  # modules of entry points
_loaded = False


def plugin_folders() -> list[Path]:
    """Where drop-in parts live: in the folder one works in, in $ATTNLAB_PLUGINS, and those shipped as examples."""
    more = os.environ.get("ATTNLAB_PLUGINS", "").split(os.pathsep)
    folders = [Path.cwd() / "plugins", *map(Path, more), plugins_dir()]
    unique = dict.fromkeys(folder.resolve() for folder in folders if str(folder) not in ("", ".") and folder.is_dir())
    return list(unique)


def config_folders() -> list[Path]:
    """Folders that may hold config groups (a world, an experiment) and named files (claims), found after ours:
    plugins/ folders, and ``conf`` beside the module of a pip package's entry point. Call after :func:`load_all`."""
    beside = [Path(file).parent / "conf" for module in _packages if (file := sys.modules[module].__file__)]
    return [*plugin_folders(), *(folder for folder in beside if folder.is_dir())]


def config_homes(group: str) -> list[Path]:
    """The folders that hold the files of a group (claims, audit, world), ours first."""
    load_all()
    return [folder / group for folder in (conf_dir(), *config_folders()) if (folder / group).is_dir()]


def named_file(group: str, name: str, setting: str) -> Path:
    """The file of a group of files by its name (dinocera2014) or its path. Raises ConfigError naming ``setting``."""
    path = Path(name)
    if path.suffix in (".yaml", ".yml") or len(path.parts) > 1:
        if path.is_file():
            return path
        raise ConfigError(f"{setting}={name}", "there is no such file")
    homes = config_homes(group)
    found = next((home / f"{name}.yaml" for home in homes if (home / f"{name}.yaml").is_file()), None)
    if found is None:
        raise ConfigError(f"{setting}={name}", f"no {group} file is called '{name}'",
                          nearest(name, {file.stem for home in homes for file in home.glob("*.yaml")}))
    return found


def load_all() -> None:
    """Import every built-in part, every plugins/ file and every ``attnlab.plugins`` entry point, once a process."""
    global _loaded
    if _loaded:
        return
    _loaded = True
    load_built_in()
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


def load_built_in() -> None:
    """Import every built-in part."""
    for group in GROUPS.values():
        package = importlib.import_module(f"attnlab.{group.package}")
        for module in pkgutil.iter_modules(package.__path__):
            importlib.import_module(f"attnlab.{group.package}.{module.name}")


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


def plugin_hashes(config: Mapping[str, Any]) -> dict[str, str]:
    """Plugin files that a run's config names parts of: file -> sha256 (16 digits), so that a run knows its code. Of a
    pip package every Python file counts, for a part may call any of them."""
    found = {name: hashlib.sha256(file.read_bytes()).hexdigest()[:16] for spec in _plugins_of(config)
             for name, file in _files_of(spec, Path(spec.origin))}
    return dict(sorted(found.items()))


def plugin_versions(config: Mapping[str, Any]) -> dict[str, str]:
    """Version of every pip package, by its name, of which a run's config names a part."""
    from importlib.metadata import entry_points
    roots = {spec.cls.__module__.partition(".")[0] for spec in _plugins_of(config)} - {"attnlab"}
    points = entry_points(group=ENTRY_POINTS) if roots else ()
    return {point.dist.name: point.dist.version for point in points
            if point.dist is not None and point.module.partition(".")[0] in roots}


def _plugins_of(config: Mapping[str, Any]) -> list[Spec]:
    """Parts of a run, not built in, that its config names."""
    words = set(_words(config))
    return [spec for spec in parts.values()
            if GROUPS[spec.group].in_key and not GROUPS[spec.group].in_report and not words.isdisjoint(spec.options)
            and not spec.origin.startswith(f"{PACKAGE}{os.sep}") and Path(spec.origin).is_file()]


def _files_of(spec: Spec, origin: Path) -> Iterator[tuple[str, Path]]:
    """(name, file) of what a plugin part may run: its own file and the _helpers beside it, or all of its package."""
    root = spec.cls.__module__.partition(".")[0]
    top = getattr(sys.modules.get(root), "__file__", None)
    if spec.cls.__module__.startswith("attnlab.") or top is None or Path(top).name != "__init__.py":
        for file in (origin, *sorted(origin.parent.glob("_*.py"))):
            yield f"{origin.parent.name}/{file.name}", file
        return
    folder = Path(top).parent
    for file in sorted(folder.rglob("*.py")):
        yield f"{folder.name}/{file.relative_to(folder)}", file


def _words(config: Mapping[str, Any]) -> Iterator[str]:
    """Every name and text in a config."""
    nodes: list[Any] = [config]
    while nodes:
        node = nodes.pop()
        if isinstance(node, Mapping):
            yield from map(str, node)
            nodes += node.values()
        elif isinstance(node, (list, tuple)):
            nodes += node
        elif isinstance(node, str):
            yield node

"""Every part in words: what ``python -m attnlab.parts`` prints."""

from __future__ import annotations

import dataclasses
import inspect
import re
import sys
import textwrap
import typing
from collections.abc import Iterable
from pathlib import Path

from attnlab import registry
from attnlab.console import table_width
from attnlab.errors import ConfigError, describe, nearest
from attnlab.groups import GROUPS
from attnlab.loading import config_folders
from attnlab.paths import PACKAGE, conf_dir
from attnlab.settings import choices_of


def short(path: str) -> str:
    """A path relative to the folder one works in, if it is below it."""
    try:
        return str(Path(path).resolve().relative_to(Path.cwd()))
    except ValueError:
        return path


def source(spec: registry.Spec) -> str:
    """``built in``, ``plugin`` or ``package``: which of the three doors a part came through."""
    origin = Path(spec.origin)
    if spec.cls.__module__.startswith("attnlab.plugins."):
        return "plugin"
    return "built in" if origin.is_relative_to(PACKAGE) else "package"


def summary(cls: type, width: int = 100) -> str:
    """The first paragraph on one line: of the file if it holds one part, otherwise of the class."""
    alone = sum(spec.cls.__module__ == cls.__module__ for spec in registry.parts.values()) == 1
    text = (alone and sys.modules[cls.__module__].__doc__) or inspect.getdoc(cls) or "(no docstring)"
    return textwrap.shorten(text.strip().split("\n\n")[0], width, placeholder=" ...")


def reflowed(text: str) -> str:
    """A docstring for a terminal: paragraphs as wide as it is, those with lines set apart (lists, code, tables) as they
    stand, references by their names."""
    text = re.sub(r":\w+:`~?([^`]+)`", r"\1", text)
    return "\n\n".join(part if any(line[:1] in " -*|" for line in part.split("\n")) or part.endswith("::") else
                       textwrap.fill(part, table_width(), break_long_words=False, break_on_hyphens=False)
                       for part in text.split("\n\n"))


def named_configs() -> dict[tuple[str, str], Path]:
    """Options that exist as a yaml file alone: (group, name) -> file."""
    taken = {(spec.group, option) for spec in registry.parts.values() for option in spec.options}
    return {(file.parent.name, file.stem): file for group in ("reading", *GROUPS)
            for folder in (conf_dir(), *config_folders()) for file in sorted((folder / group).glob("*.yaml"))
            if (group, file.stem) not in taken}


def options(group: str) -> list[str]:
    """Names that can stand after ``group=``."""
    names = {option for spec in registry.parts.values() if spec.group == group for option in spec.options}
    for folder in (conf_dir(), *config_folders()):
        names |= {file.stem for file in (folder / group).glob("*.yaml")}
    return sorted(names | ({"inferred"} if group == "reading" else set()))


def kind_of(hint: typing.Any) -> str:
    """A type as one reads it: ``float``, ``list[float]``, ``str or none``."""
    if choices_of(hint):
        return "str or none" if type(None) in typing.get_args(hint) else "str"
    if isinstance(hint, type) and not typing.get_args(hint):
        return hint.__name__
    return str(hint).replace("typing.", "").replace(" | None", " or none")


def parameters(params: type, prefix: str = "") -> Iterable[str]:
    """A line a parameter: name, type, default, unit, range, meaning; those of a nested dataclass after it."""
    hints = typing.get_type_hints(params)
    for field in dataclasses.fields(params):
        make, meta = field.default_factory, field.metadata
        value = field.default if make is dataclasses.MISSING else make()
        if dataclasses.is_dataclass(value):
            yield f"  {prefix}{field.name}: {meta.get('doc', '')}"
            yield from parameters(type(value), f"{prefix}{field.name}.")
            continue
        bounds = [f"at least {meta['low']}" if meta.get("low") is not None else "",
                  f"more than {meta['above']}" if meta.get("above") is not None else "",
                  f"at most {meta['high']}" if meta.get("high") is not None else "",
                  "one of " + ", ".join(map(str, choices)) if (choices := choices_of(hints[field.name])) else ""]
        unit = f" {meta['unit']}" if meta.get("unit") else ""
        limits = f" ({', '.join(filter(None, bounds))})" if any(bounds) else ""
        yield f"  {prefix}{field.name}: {kind_of(hints[field.name])} = {value}{unit}{limits}"
        yield textwrap.fill(meta.get("doc") or "(undocumented)", table_width(), initial_indent=" " * 6,
                            subsequent_indent=" " * 6)


def about(spec: registry.Spec, option: str) -> str:
    """All about one part."""
    kind = GROUPS[spec.group]
    lines = [f"{spec.group}={option}   {source(spec)}: {short(spec.origin)}"]
    if option != spec.name:
        lines.append(f"  a preset of {spec.name}: " + ", ".join(f"{k}={v}" for k, v in spec.presets[option].items()))
    lines += ["", reflowed(inspect.getdoc(spec.cls) or "(no docstring)"), ""]
    if hasattr(spec.cls, "interpreted"):
        lines += [reflowed(f"Engine: Python alone; {spec.cls.interpreted}." if spec.cls.interpreted else "Engine: "
                           "compiles (engine=compiled; what does not runs as Python, and run.json says why)."), ""]
    if dataclasses.fields(spec.params):
        node = kind.node(option) if kind.chosen == "list" else spec.group
        lines += [f"Parameters (set with {node}.<name>=<value>)", *parameters(spec.params)]
    else:
        lines.append("It takes no parameters." + (f" Used as {kind.typed(option)}." if kind.setting else ""))
    if spec.presets and option == spec.name:
        lines += ["Presets:", *(f"  {name}: {values}" for name, values in spec.presets.items())]
    return "\n".join(lines)


def about_config(group: str, name: str, file: Path) -> str:
    """All about an option that is a yaml file, and for a reading the settings it may change."""
    lines = [f"{group}={name}   config: {short(str(file))}", "", file.read_text().rstrip()]
    return "\n".join(lines)


def about_reading() -> str:
    """The default reading: every setting it holds."""
    from attnlab import reading
    return "\n".join([f"reading=inferred   built in: {short(reading.__file__)}", "", inspect.getdoc(reading) or "", "",
                      "Parameters (set with reading.<name>=<value>)", *parameters(reading.Reading)])


def find(wanted: str) -> str:
    """The text about every part of this name (``name`` or ``group/name``)."""
    group, _, name = wanted.rpartition("/")
    found = [about(spec, name) for spec in registry.parts.values()
             if name in spec.options and group in ("", spec.group)]
    found += [about_config(g, n, file) for (g, n), file in named_configs().items() if n == name and group in ("", g)]
    if wanted in ("inferred", "reading", "reading/inferred"):
        found = [about_reading()]
    for module, (file, cause) in registry.failures.items():
        if name in (module, module.rpartition(".")[2]):
            found.append(f"{short(file)} failed to load: {describe(cause)}")
    if not found:
        names = [option for spec in registry.parts.values() for option in spec.options]
        raise ConfigError(wanted, "no part is called that", nearest(name, {*names, *(n for _, n in named_configs())}))
    return "\n\n".join(found)


def rows(group: str) -> Iterable[tuple[str, str, str]]:
    """(option, where it comes from, what it is) of all options of a group."""
    if group == "reading":
        yield "inferred", "built in", "The default reading of the paper's open points"
    for spec in sorted((s for s in registry.parts.values() if s.group == group), key=lambda s: s.name):
        where = "built in" if source(spec) == "built in" else f"{source(spec)}, {short(spec.origin)}"
        yield spec.name, where, summary(spec.cls) + " (not compiled)" * bool(getattr(spec.cls, "interpreted", ""))
        for preset, values in sorted(spec.presets.items()):
            yield preset, where, f"{spec.name} with " + ", ".join(f"{k}={v}" for k, v in values.items())
    for (owner, name), file in named_configs().items():
        if owner == group:
            first = file.read_text().partition("\n")[0]
            yield name, "config", first.lstrip("# ") if first.startswith("#") else short(str(file))


def table() -> str:
    """All parts by group, a line each, and what failed to load."""
    lines = []
    for group, what in {"reading": "how the paper's open points are read",
                        **{g.name: g.what for g in GROUPS.values()}}.items():
        lines += [f"{group}: {what}", *(f"  {name:<20} {where:<10} {what}" for name, where, what in rows(group))]
    if registry.failures:
        lines += ["", "failed to load (the others are not affected)"]
        lines += [f"  {short(file)}: {describe(cause)}" for file, cause in registry.failures.values()]
    return "\n".join(lines)

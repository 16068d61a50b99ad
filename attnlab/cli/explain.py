"""Hydra's exceptions as one line that names the setting, what is wrong, and the nearest right name."""

from __future__ import annotations

import re
from collections.abc import Sequence

from attnlab import registry
from attnlab.errors import ConfigError, nearest
from attnlab.loading import config_folders
from attnlab.paths import conf_dir


def explain(cause: BaseException, arguments: Sequence[str]) -> ConfigError | None:
    """The user's error behind an exception out of Hydra, or None if it is ours."""
    from hydra.errors import HydraException
    from omegaconf.errors import OmegaConfBaseException
    from yaml import MarkedYAMLError
    chain, link = [], cause
    while link is not None:
        chain.append(link)
        link = link.__cause__ or link.__context__
    for link in chain:
        if isinstance(link, ConfigError):
            return link
    for link in chain:
        if isinstance(link, MarkedYAMLError):
            mark = link.problem_mark or link.context_mark
            where = f"{mark.name}:{mark.line + 1}" if mark else "a config file"
            return ConfigError(where, f"is no YAML ({link.problem})", "Look at the line above it too")
    if not any(isinstance(link, (HydraException, OmegaConfBaseException)) for link in chain):
        return None
    texts = [str(link) for link in chain]
    for text in texts:
        for rule in (_missing_option, _no_match, _unknown_key, _grammar):
            error = rule(text, arguments)
            if error is not None:
                return error
    return ConfigError("config", texts[0].strip().splitlines()[0] if texts[0].strip() else type(cause).__name__,
                       "python -m attnlab --help shows the settings")


def _missing_option(text: str, arguments: Sequence[str]) -> ConfigError | None:
    match = re.search(r"Could not (?:find|load) '([\w./-]+)/([^/']+)'", text)
    if not match:
        return None
    group, name = match[1], match[2]
    known = options(group)
    if not known:
        typed = next((a for a in arguments if a.lstrip("+").startswith(group)), group)
        return ConfigError(typed.lstrip("+"), "no such group of parts", nearest(group, [*registry.GROUPS, "reading",
                                                                                         "experiment", "cluster"]))
    return registry.unknown(group, name, group, known)


def _no_match(text: str, arguments: Sequence[str]) -> ConfigError | None:
    match = re.search(r"Could not override '([^']+)'", text) or re.search(r"Key '([^']+)' is not in struct", text)
    if not match:
        return None
    key = match[1]
    return _nearest_key(key)


def _unknown_key(text: str, arguments: Sequence[str]) -> ConfigError | None:
    match = re.search(r"full_key: ([\w.\[\]-]+)", text)
    return _nearest_key(match[1]) if match and "not in" in text else None


def _nearest_key(key: str) -> ConfigError:
    from attnlab.cli.store import GROUPS_OF_RUN, root_node
    from attnlab.config import ValidationSettings
    from attnlab.reading import Reading
    head, _, last = key.rpartition(".")
    group, part = head.partition(".")[0], head.rpartition(".")[2]
    owners = [spec for spec in registry.parts.values()
              if spec.group in GROUPS_OF_RUN and last in spec.params.__dataclass_fields__]
    if not head:
        nodes = ["reading"] if last in Reading.__dataclass_fields__ else \
            sorted({f"behaviours.{spec.name}" if spec.group == "behaviours" else spec.group for spec in owners})
        meant = " or ".join(f"'{node}.{last}'" for node in nodes[:4])
        return ConfigError(key, "no such setting", f"Did you mean {meant}?" if meant else
                           nearest(key, [*root_node(), *GROUPS_OF_RUN]))
    rivals = sorted(spec.name for spec in owners if spec.group == group != "behaviours")
    if rivals:
        return ConfigError(key, f"the {group} chosen has no such setting",
                           "It is one of " + ", ".join(f"{group}={name}" for name in rivals[:6]))
    of_group = {"validation": ValidationSettings, "reading": Reading}.get(group)
    known = set(of_group.__dataclass_fields__ if of_group else ())
    for spec in registry.parts.values():
        if spec.group == group and (group != "behaviours" or spec.name == part):
            known |= set(spec.params.__dataclass_fields__)
    return ConfigError(key, "no such setting", nearest(last, known) if known else
                       "Is the part it belongs to chosen? python -m attnlab.parts lists all")


def _grammar(text: str, arguments: Sequence[str]) -> ConfigError | None:
    if not re.search(r"mismatched input|extraneous input|no viable alternative|token recognition|missing EQUAL", text):
        return None
    from hydra.core.override_parser.overrides_parser import OverridesParser
    from hydra.errors import HydraException
    parser = OverridesParser.create()
    for argument in arguments:
        try:
            if not argument.startswith("-"):
                parser.parse_overrides([argument])
        except HydraException as cause:
            return ConfigError(argument, f"cannot be read ({str(cause).splitlines()[0]})",
                               "Write setting=value, and quote special characters: 'study=\"my study\"'")
    return None


def options(group: str) -> list[str]:
    """Names that can stand after ``group=``."""
    names = {option for spec in registry.parts.values() if spec.group == group for option in spec.nodes()}
    for folder in (conf_dir(), *config_folders()):
        names |= {file.stem for file in (folder / group).glob("*.yaml")}
    names |= {"reading": {"inferred"}}.get(group, set())
    return sorted(names)

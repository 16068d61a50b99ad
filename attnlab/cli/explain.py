"""What can only be found while composing, as one line: a config file that is wrong, a setting of a part not chosen."""

from __future__ import annotations

from attnlab import registry
from attnlab.config import RunSettings, check_path
from attnlab.errors import ConfigError
from attnlab.groups import GROUPS


def explain(cause: BaseException) -> ConfigError | None:
    """The user's error behind an exception out of Hydra, or None if it is ours."""
    from hydra.errors import HydraException, MissingConfigException
    from omegaconf.errors import ConfigAttributeError, ConfigKeyError, OmegaConfBaseException
    from yaml import MarkedYAMLError
    chain: list[BaseException] = []
    link: BaseException | None = cause
    while link is not None:
        chain.append(link)
        link = link.__cause__ or link.__context__
    for link in chain:
        if isinstance(link, ConfigError):
            return link
        if isinstance(link, MarkedYAMLError):
            mark = link.problem_mark or link.context_mark
            where = f"{mark.name}:{mark.line + 1}" if mark else "a config file"
            return ConfigError(where, f"is no YAML ({link.problem})", "Look at the line above it too")
        if isinstance(link, MissingConfigException) and link.missing_cfg_file:
            group, _, name = link.missing_cfg_file.rpartition("/")
            return registry.unknown(group, name, group, list(link.options or ())) if group else _first_line(link)
        if isinstance(link, (ConfigKeyError, ConfigAttributeError)) and link.full_key:
            return not_chosen(str(link.full_key))
    if any(isinstance(link, (HydraException, OmegaConfBaseException)) for link in chain):
        return _first_line(chain[0])
    return None


def not_chosen(key: str) -> ConfigError:
    """The error for a setting that some part has, and the parts chosen have not."""
    try:
        check_path(key)
    except ConfigError as error:
        return error
    group, _, rest = key.partition(".")
    if group in GROUPS and GROUPS[group].chosen == "list":
        part = rest.partition(".")[0]
        return ConfigError(key, f"{part} is not among the {group} of this run", f"Add it: +{group}={part}")
    if group not in GROUPS:
        return ConfigError(key, "is not there to be set", f"Add it: +{key}=...")
    rivals = sorted(spec.name for spec in registry.parts.values()
                    if spec.group == group and rest.partition(".")[0] in spec.params.__dataclass_fields__)
    return ConfigError(key, f"the {group} chosen has no such setting",
                       "It is one of " + ", ".join(f"{group}={name}" for name in rivals[:6]))


def _first_line(cause: BaseException) -> ConfigError:
    lines = str(cause).strip().splitlines() or [type(cause).__name__]
    place = str(getattr(cause, "full_key", "") or "config")
    known = place.partition(".")[0] in RunSettings.__dataclass_fields__
    return ConfigError(place if known else "config", lines[0].rstrip("."),
                       "python -m attnlab --help shows the settings")

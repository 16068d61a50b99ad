"""From what a user types to what Hydra parses: a pure function over the arguments."""

from __future__ import annotations

import re

from attnlab.errors import ConfigError, nearest
from attnlab.tables.ranges import RANGED, seeds

FLAGS = ("-m", "--multirun", "-h", "--help", "--version", "-c", "--cfg", "-p", "--package", "--resolve", "-cn",
         "--config-name", "-cp", "--config-path", "-cd", "--config-dir", "-i", "--info", "--hydra-help", "-sc",
         "--shell-completion", "-r", "--run")


def normalise(argv: list[str]) -> list[str]:
    """Flags first (Hydra's parser refuses a flag between overrides), seed ranges written out, ``experiment=`` as
    ``+experiment=``. Raises ConfigError for a seed that is none."""
    flags, overrides, takes_value = [], [], False
    for argument in argv:
        if takes_value or (argument.startswith("-") and "=" not in argument.split("[")[0]) or argument.startswith("--"):
            if not takes_value and argument.split("=")[0] not in FLAGS:
                raise ConfigError(argument, "no such flag", nearest(argument, FLAGS))
            flags.append(argument)
            takes_value = argument in ("-p", "--package", "-cp", "--config-path", "-cn", "--config-name", "-cd",
                                       "--config-dir", "-c", "--cfg", "-i", "--info")
            continue
        overrides.append(_override(argument))
    return flags + _one_list(overrides)


def _one_list(overrides: list[str]) -> list[str]:
    """``behaviours=[a,b] +behaviours=c`` as ``behaviours=[a,b,c]``; Hydra would drop the c without a word."""
    lists = [o for o in overrides if o.startswith("behaviours=[")]
    more = [o for o in overrides if o.startswith("+behaviours=")]
    if not lists or not more:
        return overrides
    if len(lists) > 1 or not re.fullmatch(r"behaviours=\[[\w\s,]*\]", lists[0]) or \
            not all(re.fullmatch(r"\+behaviours=\w+", o) for o in more):
        raise ConfigError("behaviours", "a list and +behaviours together mean one list, and these do not make one",
                          "Write all names into the list: behaviours=[a,b,c]")
    names = [name.strip() for name in lists[0][len("behaviours=["):-1].split(",") if name.strip()]
    names += [o.partition("=")[2] for o in more]
    whole = f"behaviours=[{','.join(dict.fromkeys(names))}]"
    return [whole if o == lists[0] else o for o in overrides if o not in more]


def _override(argument: str) -> str:
    key, equals, value = argument.partition("=")
    if key == "experiment":
        return "+" + argument
    if key == "behaviours" and re.fullmatch(r"\w+(,\w+)+", value):  # Hydra would take it for a sweep
        raise ConfigError(argument, "a robot's behaviours stand in brackets", f"behaviours=[{value}]; robots of one "
                          f"behaviour each: behaviours={','.join(f'[{name}]' for name in value.split(','))}")
    if key == "labels":  # names of one's own, which Hydra would call unknown
        return "++" + argument
    if equals and key in RANGED:
        return f"{key}={','.join(map(str, seeds(key, value)))}"
    return argument

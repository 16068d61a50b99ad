"""From what a user types to what Hydra parses: a pure function over the arguments."""

from __future__ import annotations

import re

from attnlab.errors import ConfigError, nearest
from attnlab.launch.searchpath import searchpath
from attnlab.tables.ranges import RANGED, seeds

INFOS = ("all", "config", "defaults", "defaults-tree", "plugins", "searchpath")

TAKE_VALUES = {"-c": ("job", "hydra", "all"), "--cfg": ("job", "hydra", "all"), "-p": (), "--package": (),
               "-cd": (), "--config-dir": (),
               "-i": INFOS, "--info": INFOS, "-sc": (), "--shell-completion": ()}
ASKS = ("-c", "--cfg", "-i", "--info", "--hydra-help", "-sc", "--shell-completion")  # shown, and nothing is run
OF_CFG = ("--resolve", "-p", "--package")
FOLDER = ("-cd", "--config-dir")  # the same as hydra.searchpath, which the door knows
FLAGS = ("-m", "--multirun", "-h", "--help", "--version", "--resolve", "--hydra-help", *TAKE_VALUES)


def normalise(argv: list[str]) -> tuple[list[str], list[str]]:
    """(flags, overrides): Hydra's parser refuses a flag between overrides. Seed ranges are written out. Raises
    ConfigError for a flag or a seed that is none."""
    flags: list[str] = []
    overrides: list[str] = []
    waiting = ""  # the flag that takes the next argument
    for argument in argv:
        if waiting:
            _check_value(waiting, argument)
            if waiting in FOLDER:
                overrides.append(searchpath([argument]))
            else:
                flags.append(argument)
            waiting = ""
        elif (argument.startswith("-") and "=" not in argument.split("[")[0]) or argument.startswith("--"):
            name, equals, value = argument.partition("=")
            if name not in FLAGS:
                raise ConfigError(argument, "no such flag", f"A setting stands without dashes: {argument.lstrip('-')}"
                                  if equals else nearest(name, FLAGS))
            if equals and name in TAKE_VALUES:
                _check_value(name, value)
            elif equals:
                raise ConfigError(argument, "takes no value", f"Write {name}")
            waiting = name if name in TAKE_VALUES and not equals else ""
            if name in FOLDER:
                overrides += [searchpath([value])] if equals else []
            elif argument not in flags:
                flags.append(argument)
        else:
            overrides.append(_override(argument))
    if waiting:
        _check_value(waiting, "")
    return _together(flags), _one_list(overrides)


def _together(flags: list[str]) -> list[str]:
    """The flags, if Hydra can do what they ask in one go."""
    named = [flag.partition("=")[0] for flag in flags]
    asks = [flag for flag in named if flag in ASKS]
    if len(asks) > 1:
        raise ConfigError(asks[1], f"cannot go with {asks[0]}", "One at a time")
    for flag in named:
        if flag in OF_CFG and not {"-c", "--cfg"} & set(named):
            raise ConfigError(flag, "says how a config is shown", f"Write --cfg job {flag}")
    return [flag for flag in flags if flag not in ("-m", "--multirun")] if asks else flags


def _check_value(flag: str, value: str) -> None:
    known = TAKE_VALUES[flag]
    if not value or (known and value not in known):
        raise ConfigError(flag, f"cannot take '{value}'" if value else "says nothing",
                          f"One of: {', '.join(known)}" if known else f"Write {flag} VALUE")


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
    twice = [name for name in names if names.count(name) > 1]
    if twice:
        raise ConfigError("behaviours", f"{' '.join([*lists, *more])} names {twice[0]} twice", "Each once")
    whole = f"behaviours=[{','.join(names)}]"
    return [whole if o == lists[0] else o for o in overrides if o not in more]


def _override(argument: str) -> str:
    key, equals, value = argument.partition("=")
    if key == "behaviours" and re.fullmatch(r"\w+(,\w+)+", value):  # Hydra would take it for a sweep
        raise ConfigError(argument, "a robot's behaviours stand in brackets", f"behaviours=[{value}]; robots of one "
                          f"behaviour each: behaviours={','.join(f'[{name}]' for name in value.split(','))}")
    plain = key.lstrip("+")
    if equals and plain in RANGED:
        return f"{plain}={','.join(map(str, seeds(plain, value)))}"
    return argument

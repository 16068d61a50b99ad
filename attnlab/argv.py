"""From what a user types to what Hydra parses: a pure function over the arguments."""

from __future__ import annotations

import re

from attnlab.errors import ConfigError, nearest

RANGED = ("seed",)  # settings in which 0-4,7 means 0,1,2,3,4,7
_ITEM = re.compile(r"(\d+)(?:-(\d+))?\Z")
FLAGS = ("-m", "--multirun", "-h", "--help", "--version", "-c", "--cfg", "-p", "--package", "--resolve", "-cn",
         "--config-name", "-cp", "--config-path", "-cd", "--config-dir", "-i", "--info", "--hydra-help", "-sc",
         "--shell-completion", "-r", "--run")
MOST_SEEDS = 100_000


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


def seeds(key: str, text: str) -> list[int]:
    """``0-4,7`` as [0, 1, 2, 3, 4, 7]; Hydra's own ``range(0,5)`` and ``choice(...)`` are understood too."""
    inside = re.fullmatch(r"(range|choice)\(([\d,\s]*)\)", text.strip())
    if inside and inside[1] == "range":
        numbers = [int(n) for n in inside[2].split(",") if n.strip()]
        found = list(range(*numbers)) if 1 <= len(numbers) <= 3 else []
        if not found:
            raise ConfigError(key, f"{text} is empty", f"Write {key}=0-4")
    else:
        found = []
        for item in (inside[2] if inside else text).split(","):
            found += _item(key, item.strip(), text)
            if len(found) > MOST_SEEDS:
                raise ConfigError(key, f"{text} asks for more than {MOST_SEEDS} runs")
    twice = sorted({n for n in found if found.count(n) > 1}) if len(found) < 2000 else []
    if twice:
        raise ConfigError(key, f"{text} names {twice[0]} twice", "Each seed once")
    return found


def compact(numbers: list[int]) -> str:
    """The inverse of :func:`seeds`: [0, 1, 2, 7] as ``0-2,7``."""
    runs: list[list[int]] = []
    for n in numbers:
        if runs and n == runs[-1][-1] + 1:
            runs[-1].append(n)
        else:
            runs.append([n])
    return ",".join(f"{run[0]}-{run[-1]}" if len(run) > 1 else str(run[0]) for run in runs)


def _item(key: str, item: str, text: str) -> list[int]:
    if item.startswith("-") and item[1:].isdigit():
        raise ConfigError(key, f"is {item}, must be at least 0")
    match = _ITEM.match(item)
    if not match:
        raise ConfigError(key, f"'{item or text}' is not a whole number or a range", f"Write {key}=3, {key}=0-4,7")
    first, last = int(match[1]), int(match[2] if match[2] is not None else match[1])
    if last < first:
        raise ConfigError(key, f"{item} runs backwards", f"Write {key}={last}-{first}")
    if last - first > MOST_SEEDS:
        raise ConfigError(key, f"{item} asks for more than {MOST_SEEDS} runs")
    return list(range(first, last + 1))

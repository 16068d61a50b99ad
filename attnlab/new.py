"""``python -m attnlab.new behaviour nap``: a part that works, and its test, to start one's own from.

Writes plugins/<name>.py and tests/test_<name>.py in the folder one works in; never over a file that exists.
"""

from __future__ import annotations

import argparse
import keyword
import sys
from collections.abc import Sequence
from pathlib import Path
from string import Template

from attnlab import registry
from attnlab.console import guarded
from attnlab.errors import ConfigError, nearest
from attnlab.groups import GROUPS
from attnlab.loading import load_all
from attnlab.paths import PACKAGE, plugins_dir

TEMPLATES = PACKAGE / "templates"


def groups() -> list[str]:
    """Groups a part can be started in."""
    return sorted(file.stem for file in TEMPLATES.glob("*.txt") if not file.stem.endswith("_test"))


def by_any_name(word: str) -> str:
    """The group that somebody means who types its singular or plural."""
    return next((name for name in GROUPS if word.rstrip("s") == name.rstrip("s")), word)


def write(group: str, name: str, folder: Path) -> list[Path]:
    """The part and its test in ``folder``; their paths."""
    if group not in groups():
        raise ConfigError(group, "no part can be started in that group", nearest(group, groups()))
    if not name.isidentifier() or keyword.iskeyword(name) or not name.islower():
        raise ConfigError(name, "is no name for a part", "Small letters, digits and _: my_part")
    load_all()
    taken = registry.find(group, name)
    if taken is not None and Path(taken.origin).parent != plugins_dir():
        raise ConfigError(name, f"{group} '{name}' exists already: {taken.origin}", "Choose another name")
    paths = [folder / "plugins" / f"{name}.py", folder / "tests" / f"test_{name}.py"]
    for path in paths:
        if path.exists():
            raise ConfigError(str(path), "exists already", "Choose another name")
    words = {"name": name, "NAME": name.upper(), "Class": "".join(word.title() for word in name.split("_"))}
    for path, template in zip(paths, (f"{group}.txt", f"{group}_test.txt"), strict=True):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(Template((TEMPLATES / template).read_text()).substitute(words))
    return paths


def how_to_use(group: str, name: str) -> str:
    """A line with what uses the new part."""
    kind = GROUPS[group]
    if kind.in_report:
        return {"figure": "draw it    python -m attnlab.report STUDY"}.get(
            group, f"name it    measure: {{name: {name}}}, in a claims file")
    return f"run it     python -m attnlab {kind.typed(name)}"


def main(argv: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m attnlab.new", description="Start a part of your own.")
    parser.add_argument("group", help=", ".join(groups()))
    parser.add_argument("name", help="of the part, e.g. nap")
    given = parser.parse_args(argv)
    group = by_any_name(given.group)
    part, test = (path.relative_to(Path.cwd()) for path in write(group, given.name, Path.cwd()))
    print(f"{part}   the part\n{test}   its tests\n")
    print(f"test it    python -m pytest {test}\nsee it     python -m attnlab.parts {given.name}\n"
          f"{how_to_use(group, given.name)}")
    return 0


if __name__ == "__main__":
    sys.exit(guarded(main))

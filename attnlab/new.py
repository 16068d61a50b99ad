"""``python -m attnlab.new behaviour nap``: a part that works, and its test, to start one's own from.

Writes plugins/<name>.py and tests/test_<name>.py in the folder one works in; for an experiment, claims or a yaml world
plugins/<kind>/<name>.yaml; for a package a folder <name>. Never over a file that exists.
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
FILES = {  # kind -> (folder in plugins/, what uses it)
    "experiment": ("experiment", "run it     python -m attnlab +experiment={name} seed=0-5"),
    "claims": ("claims", "judge by it    python -m attnlab.report STUDY --claims {name}"),
    "yaml_world": ("world", "run in it  python -m attnlab world={name}")}


def groups() -> list[str]:
    """Groups a part can be started in."""
    return sorted(file.stem for file in TEMPLATES.glob("*.txt") if not file.stem.endswith("_test"))


def by_any_name(word: str) -> str:
    """The group that somebody means who types its singular or plural."""
    return next((name for name in GROUPS if word.rstrip("s") == name.rstrip("s")), word)


def write(group: str, name: str, folder: Path) -> list[Path]:
    """What is started in ``folder``; its paths, the one to begin with first."""
    kinds = [*groups(), *FILES, "package"]
    if group not in kinds:
        raise ConfigError(group, "nothing can be started under that name", nearest(group, kinds))
    if not name.isidentifier() or keyword.iskeyword(name) or not name.islower():
        raise ConfigError(name, "is no name for a part", "Small letters, digits and _: my_part")
    load_all()
    taken = registry.find("behaviours" if group == "package" else group, name)
    if taken is not None and Path(taken.origin).parent != plugins_dir():
        raise ConfigError(name, f"{group} '{name}' exists already: {taken.origin}", "Choose another name")
    wanted = _wanted(group, name)
    for path in wanted:
        if (folder / path).exists():
            raise ConfigError(str(folder / path), "exists already", "Choose another name")
    words = {"name": name, "NAME": name.upper(), "Class": "".join(word.title() for word in name.split("_"))}
    for path, template in wanted.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(Template((TEMPLATES / template).read_text()).substitute(words))
    return [folder / path for path in wanted]


def _wanted(group: str, name: str) -> dict[str, str]:
    """File -> the template it is made from."""
    if group in FILES:
        return {f"plugins/{FILES[group][0]}/{name}.yaml": f"files/{group}.txt"}
    if group == "package":
        return {f"{name}/README.md": "package/readme.txt", f"{name}/pyproject.toml": "package/pyproject.txt",
                f"{name}/src/{name}/__init__.py": "package/init.txt", f"{name}/src/{name}/part.py": "behaviours.txt",
                f"{name}/src/{name}/conf/experiment/{name}.yaml": "package/experiment.txt",
                f"{name}/tests/test_{name}.py": "behaviours_test.txt"}
    return {f"plugins/{name}.py": f"{group}.txt", f"tests/test_{name}.py": f"{group}_test.txt"}


def how_to_use(group: str, name: str) -> str:
    """A line with what uses the new part."""
    kind = GROUPS[group]
    if kind.in_report:
        return {"figure": "draw it    python -m attnlab.report STUDY"}.get(
            group, f"name it    measure: {{name: {name}}}, in a claims file")
    run = f"run it     python -m attnlab {kind.typed(name)}"
    if group == "behaviours":
        return f"{run}\ncompare    python -m attnlab 'behaviours=[avoid,eat,drink],[avoid,eat,drink,{name}]' seed=0-5"
    return run


def main(argv: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m attnlab.new", description="Start a part of your own.")
    parser.add_argument("group", help=", ".join([*groups(), *FILES, "package"]))
    parser.add_argument("name", help="of the part, e.g. nap")
    given = parser.parse_args(argv)
    group = given.group if given.group in FILES else by_any_name(given.group)
    part, *others = (path.relative_to(Path.cwd()) for path in write(group, given.name, Path.cwd()))
    if group in FILES:
        print(f"{part}\n\n{FILES[group][1].format(name=given.name)}")
        return 0
    if group == "package":
        print("\n".join(map(str, [part, *others])) + f"\n\ninstall it  pip install -e {given.name}\ntest it     "
              f"python -m pytest {given.name}/tests\nuse it      python -m attnlab +behaviours={given.name}")
        return 0
    (test,) = others
    print(f"{part!s:<{len(str(test))}}   the part\n{test}   its tests, which you change with it\n")
    print(f"test it    python -m pytest {test}\nsee it     python -m attnlab.parts {given.name}\n"
          f"{how_to_use(group, given.name)}")
    return 0


if __name__ == "__main__":
    sys.exit(guarded(main))

"""The plan of the house, as data, and what keeps the house to it."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

import pytest

from attnlab.tables.code import NUMBERS

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "attnlab"

# Rooms (packages, and modules at the top) from the ground up. A room imports from floors below its own, and from none
# beside it.
FLOORS = (
    ("__init__", "errors", "arithmetic", "equations", "streams", "paths", "pioneer", "kernels"),
    ("settings", "groups", "console"),
    ("registry", "reading", "logs"),
    ("worlds", "needs", "exploration", "fusion", "loading"),
    ("simulators", "learners", "config"),
    ("behaviours", "tables"),
    ("curiosity", "penalty"),
    ("attention",),
    ("cycle", "probes"),
    ("callbacks", "compiled"),
    # the two wings: what runs a robot, what reads a study
    ("robot", "results", "stats"),
    ("measures",),
    ("figures",),
    ("claims",),
    ("audit",),
    ("report",),
    # what knows both
    ("launch",),
    ("clusters",),
    ("cli", "testing", "clock"),
    ("certify", "appraise", "arena", "calibrate", "replay", "search", "toys", "gym", "fig1", "plot", "parts", "new",
     "api", "__main__", "enjoy", "index", "rerun", "retry", "tune", "watch", "work"),
    ("batch", "export", "render"),
)
TOP = {  # modules that are no commands
    "__init__", "api", "arithmetic", "attention", "batch", "clock", "config", "console", "cycle", "equations", "errors",
    "groups", "loading", "paths", "pioneer", "plot", "reading", "registry", "settings", "streams"}
# thin modules for python -m; the others are packages with __main__
COMMANDS = {"__main__", "enjoy", "fig1", "new", "parts", "index", "rerun", "retry", "tune", "watch", "work"}
NO_CODE = {"plugins", "templates"}
ROBOT = {"robot", "attention", "cycle"}
READER = {"results", "stats", "measures", "figures", "claims", "audit", "report"}
LONGEST = 250
HEAVY = ("pandas", "seaborn", "matplotlib", "scipy", "pybullet", "numba", "pyarrow")


def modules() -> dict[str, Path]:
    """Every module of the package by its dotted name within it."""
    found = {}
    for file in sorted(PACKAGE.rglob("*.py")):
        parts = file.relative_to(PACKAGE).with_suffix("").parts
        found[".".join(parts[:-1] if parts[-1] == "__init__" and len(parts) > 1 else parts)] = file
    return found


def imports(file: Path, known: dict[str, Path]) -> set[str]:
    """Modules of the package that a file imports, wherever in it, but for types alone."""
    tree = ast.parse(file.read_text())
    branches = [node for node in ast.walk(tree) if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.dump(node.test)]
    typed = {id(node) for branch in branches for node in ast.walk(branch)}
    found = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module and id(node) not in typed:
            if node.module == "attnlab":
                found |= {name.name if name.name in known else "__init__" for name in node.names}
            elif node.module.startswith("attnlab."):
                inside = node.module.removeprefix("attnlab.")
                found |= {f"{inside}.{name.name}" if f"{inside}.{name.name}" in known else inside
                          for name in node.names}
    return found


KNOWN = modules()
GRAPH = {name: imports(file, KNOWN) for name, file in KNOWN.items()}
FLOOR = {room: i for i, rooms in enumerate(FLOORS) for room in rooms}


def room(module: str) -> str:
    return module.partition(".")[0]


def test_every_room_is_on_the_plan():
    rooms = {room(module) for module in KNOWN} - NO_CODE
    assert rooms == set(FLOOR)
    assert sum(map(len, FLOORS)) == len(FLOOR)
    at_the_top = {file.stem for file in PACKAGE.glob("*.py")}
    assert at_the_top - TOP == COMMANDS


def test_nothing_is_imported_from_above_or_beside():
    wrong = [f"{module} imports {target}" for module, targets in GRAPH.items() for target in targets
             if room(target) != room(module) and room(module) not in NO_CODE
             and FLOOR[room(target)] >= FLOOR[room(module)]]
    assert not wrong


def test_there_is_no_circle():
    done: set[str] = set()

    def visit(module: str, path: tuple[str, ...]) -> None:
        assert module not in path, f"a circle: {' -> '.join((*path[path.index(module):], module))}"
        if module not in done:
            for target in GRAPH.get(module, ()):
                visit(target, (*path, module))
            done.add(module)
    for module in GRAPH:
        visit(module, ())


@pytest.mark.parametrize(("wing", "other"), [(ROBOT, READER), (READER, ROBOT)], ids=["robot", "reader"])
def test_the_wings_meet_only_in_tables(wing, other):
    """Nothing that runs a robot can reach what reads a study, and the other way round."""
    for start in (module for module in GRAPH if room(module) in wing):
        seen, queue = set(), [start]
        while queue:
            module = queue.pop()
            assert room(module) not in other, f"{start} reaches {module}"
            queue += [target for target in GRAPH.get(module, ()) if target not in seen]
            seen.update(GRAPH.get(module, ()))


def test_no_file_is_long():
    files = [file for folder in ("attnlab", "plugins", "benchmarks") for file in (ROOT / folder).rglob("*.py")]
    long = {str(file.relative_to(ROOT)): lines for file in files
            if (lines := len(file.read_text().splitlines())) > LONGEST}
    assert not long


@pytest.mark.parametrize("arguments", [["--help"], ["--version"], ["curiosity=litmann"]])
def test_nothing_heavy_is_imported_by(arguments):
    text = ("import sys\nfrom attnlab.cli.main import main\n"
            f"main({arguments!r})\nprint('HEAVY', [m for m in {HEAVY!r} if m in sys.modules])")
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, cwd=ROOT, timeout=60,
                          check=True)
    assert done.stdout.strip().endswith("HEAVY []"), done.stdout[-300:]


def test_the_hash_of_the_code_covers_all_that_numbers_come_from():
    """What a robot runs with, but for what finds and names parts; a resume under other code is known by this hash."""
    seen, queue = set(), [module for module in GRAPH if room(module) in ROBOT]
    while queue:
        module = queue.pop()
        if module not in seen:
            seen.add(module)
            queue += GRAPH.get(module, ())
    assert {room(module) for module in seen} - NUMBERS == {
        "__init__", "callbacks", "errors", "groups", "loading", "paths", "registry"}


def test_no_two_files_of_tests_share_a_name():
    """pytest imports them by it."""
    names = [path.name for path in (ROOT / "tests").rglob("test_*.py")]
    assert sorted(names) == sorted(set(names))

"""``python benchmarks/mutants.py``: do the fast tests notice when the arithmetic of the core is wrong?

    python benchmarks/mutants.py --mutants 90 --seed 1
    python benchmarks/mutants.py --mutants 20 attnlab/needs attnlab/cycle.py      of these files alone

A mutant is one small mistake in a file of the core: another operator, another comparison, a number that is one more or
is 0, a sign left out. Mutants are drawn by the seed, each is put into a copy of the project, and the fast tests are run
there: one that they let pass lives. Settings (their defaults and bounds) are declarations and stay as they are. Some
mutants cannot be noticed because they change nothing that happens; what lives must be read by a person.
"""

from __future__ import annotations

import argparse
import ast
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
COPIED = ("attnlab", "conf", "plugins", "tests", "pyproject.toml")
CORE = ("attention.py", "cycle.py", "equations.py", "reading.py", "behaviours", "needs", "fusion", "penalty",
        "learners", "exploration", "curiosity", "simulators/robot.py", "worlds/base.py")
FAST = ("behaviours", "equations", "core", "curiosity", "learners", "simulators/test_robot.py",
        "worlds/test_starts.py", "conformance")  # in this order; those that are there

OPERATORS = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult, ast.Mod: ast.Mult,
             ast.FloorDiv: ast.Mult, ast.Pow: ast.Mult}
COMPARISONS = {ast.Lt: (ast.LtE, ast.GtE), ast.LtE: (ast.Lt, ast.Gt), ast.Gt: (ast.GtE, ast.LtE),
               ast.GtE: (ast.Gt, ast.Lt), ast.Eq: (ast.NotEq,), ast.NotEq: (ast.Eq,)}


@dataclass(frozen=True)
class Mutant:
    """The ``change``-th change of the ``node``-th node of a file; ``text`` shows it."""
    path: Path
    node: int
    change: int
    text: str

    def source(self) -> str:
        """The file with the mistake in it."""
        tree = ast.parse(self.path.read_text())
        node = list(nodes(tree))[self.node]
        setattr(node, *changes(node)[self.change])
        return ast.unparse(tree)


def nodes(tree: ast.AST) -> Iterator[ast.AST]:
    """Every node but those of settings."""
    for child in ast.iter_child_nodes(tree):
        if not (isinstance(child, ast.Call) and getattr(child.func, "id", "") == "setting"):
            yield child
            yield from nodes(child)


def changes(node: ast.AST) -> list[tuple[str, Any]]:
    """(field, its wrong value) of each mistake that can be made at this node."""
    if isinstance(node, ast.BinOp | ast.AugAssign) and type(node.op) in OPERATORS:
        return [("op", OPERATORS[type(node.op)]())]
    if isinstance(node, ast.Compare):
        return [("ops", [*node.ops[:i], wrong(), *node.ops[i + 1:]]) for i, op in enumerate(node.ops)
                for wrong in COMPARISONS.get(type(op), ())]
    if isinstance(node, ast.Constant) and type(node.value) in (int, float):
        return [("value", value) for value in sorted({node.value + 1, 0} - {node.value})]
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        return [("op", ast.UAdd())]
    return []


def mutants_of(path: Path) -> Iterator[Mutant]:
    """All mutants of a file."""
    source = path.read_text()
    lines = source.splitlines()
    for number, node in enumerate(nodes(ast.parse(source))):
        before = ast.unparse(node) if changes(node) else ""
        for change, (field, value) in enumerate(changes(node)):
            right = getattr(node, field)
            setattr(node, field, value)
            after = ast.unparse(node)
            setattr(node, field, right)
            where = f"{path.relative_to(ROOT)}:{node.lineno}:{node.col_offset}"
            yield Mutant(path, number, change, f"{where}  {before}  ->  {after}   in: {lines[node.lineno - 1].strip()}")


def files(chosen: list[str]) -> list[Path]:
    """The Python files of these files and folders, in order."""
    found: set[Path] = set()
    for path in ((ROOT / name).resolve() for name in chosen):
        found |= set(path.rglob("*.py")) if path.is_dir() else {path}
    return sorted(found)


def passes(copy: Path, tests: list[str], timeout_s: float) -> bool:
    """Do the tests pass in this copy? Tests that do not end in time have noticed something."""
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", "--hypothesis-seed=0", *tests]
    # No bytecode is written: that of a mutant could be taken for that of the next one, made within the same second.
    run = subprocess.Popen(command, cwd=copy, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                           start_new_session=True, env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1",
                                                        "PYTHONPATH": str(copy)})
    try:
        return run.wait(timeout_s) == 0
    except subprocess.TimeoutExpired:
        return False
    finally:
        if run.poll() is None:
            os.killpg(run.pid, signal.SIGKILL)  # its own processes too
            run.wait()


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", default=[f"attnlab/{name}" for name in CORE], help="all of the core")
    parser.add_argument("--mutants", type=int, default=60, help="how many are drawn (60); 0 for all there are")
    parser.add_argument("--seed", type=int, default=0, help="of the draw (0)")
    parser.add_argument("--tests", nargs="+", default=FAST, help="files and folders of tests/, in the order they run")
    arguments = parser.parse_args()
    every = [mutant for path in files(arguments.files) for mutant in mutants_of(path)]
    drawn = random.Random(arguments.seed).sample(every, min(arguments.mutants or len(every), len(every)))
    tests = [f"tests/{name}" for name in arguments.tests if (ROOT / "tests" / name).exists()]
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder)
        for name in COPIED:
            if (ROOT / name).is_dir():
                shutil.copytree(ROOT / name, copy / name, ignore=shutil.ignore_patterns("*.pyc"))
            else:
                shutil.copy2(ROOT / name, copy / name)
        began = time.perf_counter()
        if not passes(copy, tests, 600.0):
            print("the tests fail without any mutant", file=sys.stderr)
            return 1
        limit = 30.0 + 5.0 * (time.perf_counter() - began)
        living = [mutant for i, mutant in enumerate(drawn, 1) if lives(mutant, copy, tests, limit, f"{i}/{len(drawn)}")]
    print(f"\n{len(living)} of {len(drawn)} mutants live ({len(living) / max(1, len(drawn)):.0%}); "
          f"{len(every)} could be drawn")
    for mutant in living:
        print(mutant.text)
    return 0


def lives(mutant: Mutant, copy: Path, tests: list[str], limit: float, which: str) -> bool:
    """Put the mutant into the copy, run the tests, take it out again."""
    place = copy / mutant.path.relative_to(ROOT)
    place.write_text(mutant.source())
    alive = passes(copy, tests, limit)
    shutil.copy2(mutant.path, place)
    print(f"{which} {'LIVES' if alive else 'dead '}  {mutant.text}", flush=True)
    return alive


if __name__ == "__main__":
    sys.exit(main())

"""Execute the notebooks of this folder, each in an empty one, and write what came out beside their cells.

    python docs/notebooks/make.py             all of them, or those that are named
    python docs/notebooks/make.py --check     write nothing; 1 if a cell says something else than is written

It needs the extra ``docs``. The same code gives the same words; of images it is asked that there are as many.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import sys
import tempfile
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
Book = dict[str, Any]
COLOUR = re.compile(r"\x1b\[[0-9;]*m")
SHOWN = ("text/html", "text/plain", "image/png")


def main() -> int:
    """Entry point; the exit code."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help="all if left out")
    parser.add_argument("--check", action="store_true", help="compare, and write nothing")
    given = parser.parse_args()
    differ = []
    for file in sorted(HERE.glob("*.ipynb")):
        if given.names and file.stem not in given.names:
            continue
        before = json.loads(file.read_text())
        after = executed(before)
        if not given.check:
            file.write_text(json.dumps(after, indent=1, ensure_ascii=False) + "\n")
        elif said(before) != said(after):
            differ.append(file.name)
            print(f"{file.name}: written\n{said(before)}\nnow\n{said(after)}", file=sys.stderr)
        print(file.name, "differs" if file.name in differ else "the same" if given.check else "executed")
    return 1 if differ else 0


def executed(book: Book) -> Book:
    """The notebook with what its cells give now. Raises CellExecutionError."""
    import nbformat
    from nbclient import NotebookClient
    os.environ["PYTHONPATH"] = str(ROOT)
    with tempfile.TemporaryDirectory() as home:
        made = NotebookClient(nbformat.reads(json.dumps(book), as_version=4), timeout=900, record_timing=False,
                              coalesce_streams=True, resources={"metadata": {"path": home}}).execute()
    made = json.loads(nbformat.writes(made))
    cells = [{**cell, "outputs": kept(cell["outputs"])} if cell["cell_type"] == "code" else cell
             for cell in made["cells"]]
    return {**book, "cells": cells}


def kept(outputs: list[Book]) -> list[Book]:
    """What is worth keeping of a cell's outputs: no progress, no colours, of values what a page shows."""
    found = [out for out in outputs if out.get("name") != "stderr"]
    for out in found:
        if "data" in out:
            out |= {"data": {kind: out["data"][kind] for kind in SHOWN if kind in out["data"]}, "metadata": {}}
        elif "text" in out:
            out["text"] = [COLOUR.sub("", line) for line in out["text"]]
    return found


def said(book: Book) -> list[list[str]]:
    """Of each cell with code its words, and "image" for an image."""
    return [["image" if "image/png" in out.get("data", {}) else
             "".join(out.get("text") or out["data"].get("text/plain", "")) for out in cell["outputs"]]
            for cell in book["cells"] if cell["cell_type"] == "code"]


if __name__ == "__main__":
    sys.exit(main())

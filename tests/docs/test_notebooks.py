"""The notebooks: their cells run, in order, in an empty folder; what stands below them is what they give."""

import json
import os
import re
import subprocess
import sys

import pytest

from tests.docs.typed import ROOT

HOME = ROOT / "docs" / "notebooks"
BOOKS = sorted(HOME.glob("*.ipynb"))
SHORTER = {r"train_episodes=\d+": "train_episodes=2", r"validation_episodes=\d+": "validation_episodes=1",
           r"seed=0-\d+": "seed=0-1", r"cluster.jobs=\d+": "cluster=serial"}


def cells(book):
    return [cell for cell in json.loads(book.read_text())["cells"] if cell["cell_type"] == "code"]


@pytest.mark.parametrize("book", BOOKS, ids=lambda book: book.stem)
def test_its_cells_run(book, tmp_path):
    """With two seeds and few short episodes; without a kernel of Jupyter's, which the extra ``docs`` brings."""
    code = "\n".join("".join(cell["source"]) for cell in cells(book))
    for long, short in SHORTER.items():
        code, count = re.subn(long, short, code)
        assert count == 1, long
    code = code.replace('"study=', '"max_cycles=80", "study=')
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, timeout=240,
                          env={**os.environ, "PYTHONPATH": str(ROOT), "MPLBACKEND": "agg"})
    assert done.returncode == 0, done.stderr
    assert len(list(tmp_path.glob("outputs/*/*/run.json"))) == 4


@pytest.mark.parametrize("book", BOOKS, ids=lambda book: book.stem)
def test_what_is_shown_was_executed(book):
    assert [cell["execution_count"] for cell in cells(book)] == list(range(1, len(cells(book)) + 1))
    outputs = [out for cell in cells(book) for out in cell["outputs"]]
    assert not [out for out in outputs if out["output_type"] == "error" or out.get("name") == "stderr"]
    assert any("image/png" in out.get("data", {}) for out in outputs)
    assert len(book.read_bytes()) < 300_000


def test_a_page_of_the_site_has_them(site_pages):
    for book in BOOKS:
        text, images = site_pages.notebook(book)
        assert all(f"]({name})" in text and data.startswith(b"\x89PNG") for name, data in images.items()) and images
        assert "<table>" in text and "\x1b" not in text and "style" not in text


@pytest.mark.long
def test_the_same_words_again():
    pytest.importorskip("nbclient")
    done = subprocess.run([sys.executable, str(HOME / "make.py"), "--check"], capture_output=True, text=True,
                          timeout=900)
    assert done.returncode == 0, done.stderr

"""The site builds without a warning, what it makes from the code is complete, and its commands do what it says."""

import importlib.util
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from attnlab import registry
from attnlab.paths import PACKAGE

ROOT = Path(__file__).resolve().parents[2]


def test_every_equation_has_its_function(site_pages):
    rows = [line.split("|") for line in site_pages.science().splitlines() if line.startswith("| (")]
    numbers = {int(number) for row in rows for number in re.findall(r"\((\d+)\)", row[3])}
    assert numbers == set(range(1, 14))
    assert all(".py`" in row[-2] for row in rows), "an equation that nobody calls"


def test_every_part_is_there(site_pages):
    page = site_pages.parts()
    for spec in registry.parts.values():
        if Path(spec.origin).is_relative_to(PACKAGE):
            assert f"### {spec.group}: {spec.name}\n" in page
            for name in spec.params.__dataclass_fields__:
                assert f"| `{name}` |" in page


def test_every_page_is_in_the_menu(site_pages):
    menu = set(re.findall(r"[\w/]+\.md", (ROOT / "mkdocs.yml").read_text().partition("\nnav:")[2]))
    books = {f"notebooks/{book.stem}.md" for book in (ROOT / "docs" / "notebooks").glob("*.ipynb")}
    written = {str(page.relative_to(ROOT / "docs")) for page in (ROOT / "docs").rglob("*.md")}
    assert menu == written | set(site_pages.PAGES) | books


def test_no_page_stands_in_the_way_of_another():
    """In the site a folder's README.md becomes its index.html."""
    assert not [page for page in (ROOT / "docs").rglob("index.html") if page.with_name("README.md").exists()]


def test_it_builds_without_a_warning(tmp_path):
    pytest.importorskip("mkdocs")
    done = subprocess.run([sys.executable, "-m", "mkdocs", "build", "--strict", "-q", "-d", str(tmp_path / "site")],
                          cwd=ROOT, capture_output=True, text=True, timeout=300,
                          env={**os.environ, "NO_MKDOCS_2_WARNING": "1"})
    assert done.returncode == 0 and "WARNING" not in done.stderr, done.stderr
    assert "percept_bin" in (tmp_path / "site" / "science" / "index.html").read_text()
    pages = list((tmp_path / "site").rglob("*.html"))
    asked = {host for page in pages for host in re.findall(r'(?:src|href)="(https?://[^/"]+)[^"]*\.(?:js|css|woff2?)"',
                                                            page.read_text())}
    assert not asked  # nothing is loaded from another host


@pytest.mark.long
def test_what_the_first_pages_tell_to_type(attnlab, tmp_path):
    """Every command of "Five minutes" and "See it", with fewer and shorter episodes."""
    typed = [line for page in ("index.md", "replay.md")
             for block in re.findall(r"```console\n(.*?)```", (ROOT / "docs" / page).read_text(), re.S)
             for line in block.splitlines() if "venv" not in line]
    assert len(typed) >= 10
    for line in typed:
        words = shlex.split(line)
        assert words[:2] == ["python", "-m"]
        module, *arguments = words[2:]
        if module == "attnlab":
            arguments = [re.sub(r"episodes=\d+", "episodes=2", a).replace("seed=0-5", "seed=0-1") for a in arguments]
            arguments += ["max_cycles=60", "simulator=planar", "picture=false", "report=false"]
        elif module == "attnlab.new":
            pass
        else:
            runs = sorted(p.parent for p in (tmp_path / "outputs" / "first_look").glob("*/run.json"))
            arguments = [a.replace("outputs/STUDY/RUN2", str(runs[1])).replace("outputs/STUDY/RUN", str(runs[0]))
                         .replace("outputs/first_look/RUN", str(runs[0])) for a in arguments]
            arguments = ["1" if before == "--episode" else "0" if before == "--from" else a
                         for before, a in zip(["", *arguments], arguments, strict=False)]
            needs = {"imageio_ffmpeg": arguments[-1].endswith(".mp4"), "rerun": "--rerun" in arguments}
            if any(used and importlib.util.find_spec(name) is None for name, used in needs.items()):
                continue
        done = attnlab(*arguments, module=module)
        assert done.returncode == 0, f"{line}: {done.stderr[-500:]}"
    assert (tmp_path / "both.html").is_file() and (tmp_path / "film.gif").is_file()

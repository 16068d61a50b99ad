"""All studies of a folder on one page: a card each, with what it found and links to its report and its replays."""

from __future__ import annotations

import os
from html import escape
from pathlib import Path
from urllib.parse import quote

from attnlab.errors import ConfigError, describe
from attnlab.report.forest import Row, picture, sentences
from attnlab.report.page import plain_page
from attnlab.results.by_run import by_run
from attnlab.results.load import Study, is_study
from attnlab.stats import mean_interval
from attnlab.tables.files import write_bytes

MOST_ROWS, MOST_REPLAYS, MOST_NAMES = 6, 3, 8


def build(outputs: Path, out: Path | None) -> Path:
    """Write the index of a folder of studies (``index.html`` in it if ``out`` is left out); its path. Raises
    ConfigError if there is no such folder, no study in it, or it cannot be written."""
    if not outputs.is_dir():
        raise ConfigError(str(outputs), "there is no such folder", "Give the folder that holds studies: outputs")
    if is_study(outputs):
        raise ConfigError(str(outputs), "is a study, not a folder of them", f"{outputs.parent}")
    studies = sorted((path for path in outputs.iterdir() if path.is_dir() and is_study(path)), key=lambda p: p.name)
    if not studies:
        raise ConfigError(str(outputs), "there is no study in it", "python -m attnlab +experiment=smoke")
    target = out or outputs / "index.html"
    if target.is_dir():
        raise ConfigError("--out", f"{target} is a folder", f"--out {target / 'index.html'}")
    cards = "".join(_card(path, target.parent) for path in studies)
    text = plain_page("Studies", f"{len(studies)} stud{'ies' if len(studies) > 1 else 'y'} in {outputs.name}.",
                      f'<div class=cards>{cards}</div><h2 id="again">Make it again</h2><pre>python -m attnlab.index '
                      f"{escape(outputs.name)}</pre><p>Two studies side by side: <code>python -m attnlab.report ONE "
                      "--against OTHER</code></p>", [])
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        write_bytes(target, text.encode())
    except OSError as cause:
        raise ConfigError("--out", f"{target} cannot be written ({cause.strerror or cause})") from None
    return target


def _card(path: Path, home: Path) -> str:
    """A study that cannot be read gets a card that says why."""
    try:
        inside = _told(Study(path), home)
    except Exception as cause:  # noqa: BLE001  a folder that somebody else wrote: it is named, and the others are shown
        inside = f"<p>cannot be read: {escape(describe(cause))}</p>"
    return f'<section class=card><h2 id="{escape(path.name)}">{escape(path.name)}</h2>{inside}</section>'


def _told(study: Study, home: Path) -> str:
    states = study.runs["status"].value_counts()
    state = ", ".join(f"{count} {name}" for name, count in states.items())
    names = [condition.name for condition in study.file.conditions]
    more = f" and {len(names) - MOST_NAMES} more" if len(names) > MOST_NAMES else ""
    rows = rows_of(study)
    found = f"<p>{escape(sentences(rows)[0])}</p>{picture(rows[:MOST_ROWS])}" if rows else \
        "<p>Nothing was found yet: no run is complete.</p>"
    if len(rows) > MOST_ROWS:
        found += f"<p class=small>The first {MOST_ROWS} of {len(rows)}, best first.</p>"
    return (f"<p class=small>{len(names)} condition{'s' * (len(names) != 1)}: "
            f"{escape(', '.join(names[:MOST_NAMES]))}{more}. Runs: {escape(state) or 'none'}.</p>{found}"
            f"<p class=files>{_links(study, home)}</p>")


def rows_of(study: Study) -> list[Row]:
    """Survival in validation (late in training where there is none) of every condition, best first, from the numbers
    in run.json: quick for thousands of runs."""
    found: dict[str, dict[int, float]] = {}
    named = study.named()
    for run, numbers in by_run(study).items():
        value = numbers["late"] if numbers["validation"] is None else numbers["validation"]
        if value is not None:
            found.setdefault(named[run], {})[study.seed(run)] = 100 * value
    rows = [Row(name, seeds, mean_interval(list(seeds.values()))) for name, seeds in found.items()]
    return sorted(rows, key=lambda row: -row.value[0])


def _links(study: Study, home: Path) -> str:
    def link(path: Path, text: str) -> str:
        return f'<a href="{escape(quote(Path(os.path.relpath(path, home)).as_posix()))}">{escape(text)}</a>'
    page, replays = study.path / "report" / "index.html", sorted(study.path.glob("*/replay.html"))
    where = study.path.name
    links = [link(page, "report") if page.is_file() else
             f"<code>python -m attnlab.report outputs/{escape(where)}</code>"]
    links += [link(of, f"replay of {of.parent.name}") for of in replays[:MOST_REPLAYS]]
    if not replays and study.complete:
        links.append(f"<code>python -m attnlab.replay outputs/{escape(where)}/{escape(study.complete[0])}</code>")
    return " ".join(links)

"""Where the page comes from: runs, versions, hashes, and the commands that make it again."""

from __future__ import annotations

import shlex
from collections import Counter
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from html import escape
from typing import Any

from attnlab import __version__
from attnlab.claims.files import Claims
from attnlab.report.page import Section, table
from attnlab.results.conditions import Conditions
from attnlab.results.load import Study
from attnlab.tables.ranges import compact

MOST_LINES = 12


def notes(study: Study, conditions: Conditions, claims: Claims) -> list[str]:
    """One line for everything that a reader must know before believing the page."""
    found = []
    runs = study.runs
    other = runs[runs["status"] != "complete"] if len(runs) else runs
    for status, group in other.groupby("status", sort=True) if len(other) else []:
        shown = group.head(8)
        named = [f"{run} ({why})" if why else str(run) for run, why in zip(shown["run"], shown["why"], strict=True)]
        more = f" and {len(group) - 8} more" if len(group) > 8 else ""
        found.append(f"{len(group)} of {len(runs)} runs are left out, {status}: {'; '.join(named)}{more}")
    found += conditions.notes + _small(conditions)
    found += _uneven(conditions)
    started = Counter((study.about(run).get("claims") or {}).get("sha256") for run in conditions.configs)
    unknown = started.pop(None, 0)
    for sha, count in sorted(started.items()):
        if sha != claims.sha256:
            found.append(f"{count} runs were started under another claims file (sha256 {str(sha)[:12]}…) than the one "
                         f"used here ({claims.path.name}, {claims.sha256[:12]}…): its rules may be younger than they")
    if unknown and started:
        found.append(f"{unknown} runs do not say which claims file they were started under")
    versions = {tuple(sorted((study.about(run).get("versions") or {}).items())) for run in conditions.configs}
    if len(versions) > 1:
        found.append(f"the runs were made by {len(versions)} different sets of versions (see Provenance)")
    codes = Counter(_code(study.about(run)) for run in conditions.configs)
    if len(codes) > 1:
        made = "; ".join(f"{count} by {of}" for of, count in codes.most_common())
        found.append(f"the runs were made by {len(codes)} versions of the code ({made}): fresh=true makes them anew")
    files: dict[str, set[str]] = {}
    for run in conditions.configs:
        for file, sha in (study.about(run).get("plugins") or {}).items():
            files.setdefault(file, set()).add(sha)
    found += [f"{file} was changed between runs: they were made by {len(shas)} versions of it"
              for file, shas in sorted(files.items()) if len(shas) > 1]
    return found


def _code(about: Mapping[str, Any]) -> str:
    """Which code made a run, in words."""
    code = about.get("code") or {}
    if not code.get("hash"):
        return "code that did not say which it is"
    commit = f", commit {code['commit']}{' with changes' * bool(code.get('dirty'))}" if code.get("commit") else ""
    return f"attnlab {code.get('version')}, code {code['hash']}{commit}"


def _small(conditions: Conditions) -> list[str]:
    """A study that is too small for verdicts."""
    seeds = max((len(conditions.runs(c, s).runs) for s in conditions.strata for c in conditions.curiosities), default=0)
    train = max((config.get("train_episodes") or 0 for config in conditions.configs.values()), default=0)
    if not conditions.configs or (seeds >= 6 and train >= 250):
        return []
    few = ", and with fewer than 6 seeds no p can fall below 0.05" if seeds < 6 else ""
    return [f"a small study ({seeds} seed{'s' * (seeds != 1)} a condition, {train} training episodes; the paper trains "
            f"for 500): verdicts say little{few}"]


def _uneven(conditions: Conditions) -> list[str]:
    """Seeds that a condition lacks which others of the same settings have."""
    found = []
    for stratum in conditions.strata:
        seeds = {c: set(conditions.runs(c, stratum).runs) for c in conditions.curiosities}
        every = set().union(*seeds.values())
        for curiosity, has in seeds.items():
            missing = sorted(every - has)
            if has and missing:
                where = f" ({conditions.stratum_name(stratum)})" if stratum else ""
                found.append(f"{conditions.name(curiosity)}{where} has no complete run of seed "
                             f"{', '.join(map(str, missing[:20]))}; pairs need both")
    return found[:12]


def commands(study: Study, files: Sequence[str]) -> Section:
    """What to type to make runs and page again: the commands that asked for them. ``files``: tables beside the page."""
    lines = list(dict.fromkeys(" ".join(["python -m attnlab", *map(shlex.quote, command["typed"])])
                               for command in study.file.commands)) or _from_runs(study)
    lines.append(f"python -m attnlab.report outputs/{shlex.quote(study.name)}")
    links = " ".join(f'<a href="{escape(name)}">{escape(name)}</a>' for name in files)
    return Section("again", "Make it again", f"<pre>{escape(chr(10).join(lines))}</pre>"
                   "<p class=small>Runs that are complete already are not run again.</p>"
                   f"<p class=files>All numbers of this page: {links}</p>")


def _from_runs(study: Study) -> list[str]:
    """The commands of a study that has none on file: one for each condition, from the overrides of its runs."""
    seeds: dict[str, list[int]] = {}
    for run in study.named():
        words = [str(o) for o in study.about(run).get("overrides") or [] if not str(o).startswith("seed=")]
        seeds.setdefault(" ".join(map(shlex.quote, words)), []).append(study.seed(run))
    lines = [" ".join(filter(None, ["python -m attnlab", words, f"seed={compact(sorted(of))}"]))
             for words, of in seeds.items()]
    return lines[:MOST_LINES] + [f"# and {len(lines) - MOST_LINES} more"] * (len(lines) > MOST_LINES)


def block(study: Study, conditions: Conditions, claims: Claims) -> str:
    """The part of the page that may differ between two builds of the same data."""
    about = [study.about(run) for run in conditions.configs]
    versions = Counter(", ".join(f"{k} {v}" for k, v in (a.get("versions") or {}).items()) for a in about)
    cpu = sum(a.get("cpu_s") or 0 for a in about)
    cycles = sum(a.get("cycles") or 0 for a in about)
    rows = [("page made", datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC")), ("page made by", f"attnlab {__version__}"),
            ("study", str(study.path)), ("claims file", f"{claims.path.name}, sha256 {claims.sha256}"),
            *((f"{count} runs made by", text) for text, count in sorted(versions.items())),
            ("machine cycles simulated", f"{cycles:,}"), ("processor time of the runs", f"{cpu:,.0f} s")]
    runs = [(name, *(str(a.get(what)) for what in ("seed", "key", "wall_s")))
            for name, a in zip(conditions.configs, about, strict=True)]
    return table(("", ""), rows) + "<details><summary>All runs</summary>" + \
        table(("run", "seed", "key", "wall time, s"), runs, (1, 3)) + "</details>"

"""The page on which two studies stand side by side, and its numbers as CSV."""

from __future__ import annotations

from collections.abc import Mapping
from html import escape
from math import isfinite
from pathlib import Path

from attnlab.claims.files import Claims, load_claims
from attnlab.claims.judge import Verdict, judge
from attnlab.claims.roles import strata
from attnlab.errors import ConfigError
from attnlab.report.against import Compared, Facing, face
from attnlab.report.build import claims_of
from attnlab.report.page import Section, nothing_testable, plain_page, table
from attnlab.report.plates import chip
from attnlab.results.conditions import Conditions
from attnlab.results.load import Study, load
from attnlab.stats import mean_interval
from attnlab.tables.csvs import csv_bytes
from attnlab.tables.files import write_bytes

MOST = 60  # differences of settings that are listed


def build(study: str | Path, other: str | Path, claims_name: str | None, out: str | Path | None) -> Path:
    """Write ``against-OTHER.html`` and ``.csv`` to the study's report; the page. See :func:`attnlab.report.compare`."""
    one, two = (load(path) for path in (study, other))
    claims = load_claims(claims_name or claims_of(one))
    facing = face(one, two)
    target = Path(out) if out else one.path / "report"
    try:
        target.mkdir(parents=True, exist_ok=True)
    except OSError as cause:
        raise ConfigError("--out", f"{target} cannot be written ({cause.strerror or cause})") from None
    stem = f"against-{two.name}"
    sections = [_settings(facing), _measures(facing), _verdicts(facing, claims),
                Section("again", "Make it again", "<pre>" + escape(
                    f"python -m attnlab.report outputs/{one.name} --against outputs/{two.name}") +
                    f'</pre><p class=files>All numbers: <a href="{escape(stem)}.csv">{escape(stem)}.csv</a></p>')]
    text = plain_page(f"{one.name} against {two.name}", _lead(facing), _found(facing), sections)
    write_bytes(target / f"{stem}.csv", as_csv(facing.compared))
    write_bytes(target / f"{stem}.html", text.encode())
    return target / f"{stem}.html"


def _lead(facing: Facing) -> str:
    names = ", ".join(facing.differs)
    counts = [len(study.complete) for study in (facing.one, facing.other)]
    return (f"{counts[0]} complete runs of {facing.one.name}, {counts[1]} of {facing.other.name}; in both: {names}. "
            f"All differences are {facing.one.name} less {facing.other.name}.")


def _found(facing: Facing) -> str:
    """HTML: how many measures clearly differ, and which, condition by condition."""
    items = []
    for condition in facing.differs:
        mine = [of for of in facing.compared if of.condition == condition]
        clear = [of for of in mine if of.clear]
        told = "; ".join(f"{of.measure} {_signed(of)}" for of in clear) or "none of them clearly differs"
        how = "paired by seed" if any(of.paired for of in mine) else "as independent samples"
        items.append(f"<li><b>{escape(condition)}</b>: {len(clear)} of {len(mine)} measures differ clearly, {how}: "
                     f"{escape(told)}.</li>")
    return ('<h2 id="found">What was found</h2><p>Clearly: the 95 % interval of the difference leaves out 0; '
            f"not corrected for the number of measures.</p><ul>{''.join(items)}</ul>")


def _settings(facing: Facing) -> Section:
    everywhere = facing.everywhere
    rows = [("all conditions", name, *pair) for name, pair in everywhere.items()]
    rows += [(condition, name, *pair) for condition, of in facing.differs.items() for name, pair in of.items()
             if name not in everywhere]
    html = table(("condition", "setting", facing.one.name, facing.other.name), rows[:MOST]) if rows else \
        "<p>The conditions of the same name have the same settings in both.</p>"
    if len(rows) > MOST:
        html += f"<p class=small>The first {MOST} of {len(rows)}.</p>"
    for study, names in zip((facing.one, facing.other), facing.alone, strict=True):
        if names:
            html += f"<p>In {escape(study.name)} alone: {escape(', '.join(names[:20]))}.</p>"
    codes = [sorted({str((study.about(run).get("code") or {}).get("hash")) for run in study.complete})
             for study in (facing.one, facing.other)]
    if codes[0] != codes[1]:
        html += (f"<p>They were made by different code: {escape(', '.join(codes[0]))} and "
                 f"{escape(', '.join(codes[1]))}.</p>")
    return Section("settings", "What differs in their settings", html)


def _measures(facing: Facing) -> Section:
    rows = [(of.condition, f"{of.measure}, {of.unit}", _mean(of.one), _mean(of.other), _signed(of),
             f"paired, {len(of.seeds)}" if of.paired else f"independent, {len(of.one)} and {len(of.other)}",
             "yes" if of.clear else "no") for of in facing.compared]
    html = table(("condition", "measure", facing.one.name, facing.other.name, "difference [95 %]", "seeds",
                  "clear"), rows, (2, 3, 4))
    return Section("measures", "The same conditions side by side", html + (
        "<p class=small>Means over seeds. Differences with 95 % t intervals: paired by seed where seeds are shared and "
        "at most one thing was set otherwise (a part that is another one counts as one), else of independent samples "
        "(Welch). Survival in % of the episode; the rest over validation episodes, or training where there is none."
        "</p>"))


def _mean(values: Mapping[int, float]) -> str:
    return f"{mean_interval(list(values.values())).value:.4g}"


def _signed(of: Compared) -> str:
    value, low, high = of.difference
    ends = f" [{low:+.3g}, {high:+.3g}]" if isfinite(low) else " (no interval)"
    return f"{value:+.3g}{ends}".replace("-", "−")


def _verdicts(facing: Facing, claims: Claims) -> Section:
    names, judged = zip(*(_judge(claims, study) for study in (facing.one, facing.other)), strict=True)
    if all(nothing_testable(of) for of in judged):
        return Section("verdicts", "Verdicts", f"<p>No claim of <cite>{escape(claims.title)}</cite> can be tested in "
                       "either.</p>")
    same = sum(a.verdict == b.verdict for a, b in zip(*judged, strict=True))
    rows = "".join(f"<tr><td><b>{escape(a.id)}</b> {escape(a.claim.title)}</td><td>{chip(a.verdict, a.word)}</td>"
                   f"<td>{chip(b.verdict, b.word)}</td><td>{'same' if a.verdict == b.verdict else 'differs'}</td></tr>"
                   for a, b in zip(*judged, strict=True))
    chosen = "".join(f" {escape(study.name)} is judged for {escape(name)}, the first combination of its settings in "
                     "which a claim can be tested."
                     for study, name in zip((facing.one, facing.other), names, strict=True) if name)
    heads = "".join(f'<th scope="col">{escape(name)}</th>'
                    for name in ("claim", facing.one.name, facing.other.name, "verdict"))
    return Section("verdicts", "Verdicts side by side", (
        f"<p>{same} of {len(judged[0])} verdicts on <cite>{escape(claims.title)}</cite> are the same.{chosen}</p>"
        '<div class="scroll" tabindex="0" role="region" aria-label="verdicts"><table><thead><tr>'
        f"{heads}</tr></thead><tbody>{rows}</tbody></table></div>"))


def _judge(claims: Claims, study: Study) -> tuple[str, list[Verdict]]:
    """Verdicts under the first combination of the other settings in which a claim can be tested; its name, where there
    are more."""
    conditions = Conditions(study, claims.labels)
    found = {name: judge(claims, conditions, settings, {}) for name, settings in strata(claims, conditions).items()}
    name = next((name for name, of in found.items() if not nothing_testable(of)), next(iter(found)))
    return name if len(found) > 1 else "", found[name]


def as_csv(compared: list[Compared]) -> bytes:
    """A row a measure of a condition: means, difference with its interval, and how it was taken."""
    rows = list[list[object]]()
    for of in compared:
        numbers = (mean_interval(list(of.one.values())).value, mean_interval(list(of.other.values())).value,
                   *of.difference)
        rows.append([of.condition, of.measure, of.unit, *(f"{n:.6g}" if isfinite(n) else "" for n in numbers),
                     "yes" if of.paired else "no", len(of.one), len(of.other), len(of.seeds)])
    return csv_bytes(["condition", "measure", "unit", "one", "other", "difference", "low", "high", "paired",
                      "seeds_one", "seeds_other", "seeds_shared"], rows)

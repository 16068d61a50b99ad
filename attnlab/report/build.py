"""From a study to its page: figures, tables, verdicts, written to one folder."""

from __future__ import annotations

import warnings
from collections import Counter
from collections.abc import Callable, Collection
from pathlib import Path

from attnlab.audit.table import load_table
from attnlab.claims import DEFAULT
from attnlab.claims.files import Claims, load_claims
from attnlab.claims.judge import Cache, Verdict, judge
from attnlab.claims.roles import Combinations, strata
from attnlab.errors import ConfigError
from attnlab.figures.base import FigureContext, gallery
from attnlab.figures.style import drawing
from attnlab.report import (
    drawn,
    forest,
    glance,
    multiverse,
    plates,
    provenance,
    readings,
    seeds,
    spread,
    table5,
    toggles,
    verdicts,
)
from attnlab.report.captions import load_captions
from attnlab.report.curve_tables import combinations_csv
from attnlab.report.hands import side_by_side
from attnlab.report.multiverse import LEAST_READINGS
from attnlab.report.page import Section, headline, nothing_testable, page, table
from attnlab.results.conditions import Conditions
from attnlab.results.load import Study, load
from attnlab.tables.files import write_bytes
from attnlab.tables.schema import TABLES

MOST_SETTINGS = 6  # that the first sentence of a page names


def build(study_path: Study | str | Path, out: str | Path | None, claims_name: str | None, baselines: str | Path | None,
          quiet: bool, tell: Callable[[int, int], None] | None = None, only: Collection[str] | None = None,
          hands: int | None = None) -> Path:
    """See :func:`attnlab.report.build_report`; ``only`` names the figures to draw, all if left out; ``hands``: how many
    are drawn at a time, one a core if left out."""
    study = load(study_path)
    if not len(study.runs):
        raise ConfigError(str(study.path), "is no study: there are no runs in it", "Give a folder of outputs/")
    claims = load_claims(claims_name or claims_of(study))
    captions = load_captions(claims.path)
    conditions = Conditions(study, claims.labels)
    others = Conditions(load(baselines)) if baselines else None
    target = Path(out) if out else study.path / "report"
    try:
        (target / "figures").mkdir(parents=True, exist_ok=True)
    except OSError as cause:
        raise ConfigError("--out", f"{target} cannot be written ({cause.strerror or cause})") from None
    if tell is not None:
        tell(0, len(gallery()))  # what was given is in order: from here on it takes its time
    combinations = strata(claims, conditions)
    measured: dict[str, Cache] = {name: {} for name in combinations}

    def verdicts_of_all() -> dict[str, list[Verdict]]:
        return {name: judge(claims, conditions, settings, measured[name]) for name, settings in combinations.items()}
    judged = verdicts_of_all() if len(combinations) >= LEAST_READINGS else None
    many = judged is not None and sum(not nothing_testable(of) for of in judged.values()) >= LEAST_READINGS
    if many and only is None:
        only = ()  # figures of conditions: of a hundred readings nobody could read them
    drawer = drawn.Gallery(FigureContext(others), conditions, captions, target)
    wanted = [name for name in gallery() if conditions.strata and (only is None or name in only)]

    for name in TABLES if wanted else ():
        conditions.frame(name)  # read before hands are forked, once for all of them

    def done(count: int) -> None:
        if tell is not None:
            tell(count, len(wanted))
    with drawing(), drawer.begin(wanted, hands or side_by_side()) as figures:
        done(0)
        judged = judged or verdicts_of_all()  # while others draw
        telling = _telling(judged)
        told = judged[telling] if telling is not None else []
        first = told or next(iter(judged.values()), [])
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # as figures are drawn
            hiding = toggles.of_study(conditions)
            tables = _tables(claims, conditions, combinations, target)
            of_all = multiverse.analyse(claims, conditions, combinations, judged, measured) if many else None
            sections = _sections(study, judged, combinations, telling, tables, target, hiding) if of_all is None else \
                _of_readings(claims, conditions, combinations, judged, target)
            over = readings.Page(forest.first_screen(study, hiding.marks)) if of_all is None else \
                readings.of(of_all, study.path, target)
        shown = [drawer.shown(name, of, told) for name, of in zip(wanted, figures.answers(done), strict=True) if of]
    plates.choose(shown)
    if conditions.strata and not many:
        sections.append(seeds.section(study, target))
    sections.append(provenance.commands(study, sorted(file.name for file in target.glob("*.csv"))))
    notes = [*provenance.notes(study, conditions, claims), *over.notes]
    if not conditions.strata:
        notes.insert(0, "there is no complete run in this study, so there is nothing to draw or to judge")
    notes += [f"the figure '{figure.title}' is not drawn: {figure.failed}" for figure in shown if figure.failed]
    alone = len(judged) > 1
    said = spread.headline(of_all, claims) if of_all is not None else \
        headline(claims, first, telling if telling is not None and alone else "", len(judged) - 1)
    text = page(f"{study.path.resolve().name}: what was found", _lead(study, conditions), notes, said, first, shown,
                sections, provenance.block(study, conditions, claims), over.first_screen, over.sections, over.script,
                hiding.html() if of_all is None else "")
    write_bytes(target / "index.html", text.encode())
    if not quiet and of_all is not None:
        spread.print_table(of_all)
        _print(notes, None, [], None, target)
    elif not quiet:
        _print(notes, next((rows for name, rows in tables if name == telling), None), first, telling, target)
    return target / "index.html"


def claims_of(study: Study) -> str:
    """The claims file that most runs say they were started under."""
    marks = [study.about(run).get("claims") or {} for run in study.complete]
    names = Counter(str(mark["name"]) for mark in marks if mark.get("name"))
    return min(names, key=lambda name: (-names[name], name), default=DEFAULT)


def _tables(claims: Claims, conditions: Conditions, combinations: Combinations, target: Path
            ) -> list[tuple[str, list[table5.Row]]]:
    """Table 5 for each combination of the other settings in which a role of the claims file is a column of it."""
    paper = load_table()
    tables = []
    for name, within in combinations.items():
        roles = {role.label: conditions.matching(role.where, within)[0] for role in claims.roles.values()}
        if set(roles) & set(paper.conditions):
            tables.append((name, table5.rows(paper, roles)))
    write_bytes(target / "table5.csv", table5.as_csv(tables))
    return tables


def _telling(judged: dict[str, list[Verdict]]) -> str | None:
    """The first combination of settings in which a claim can be tested; None if there is none."""
    return next((name for name, of in judged.items() if not nothing_testable(of)), None)


def _sections(study: Study, judged: dict[str, list[Verdict]], combinations: Combinations, telling: str | None,
              tables: list[tuple[str, list[table5.Row]]], target: Path, hiding: toggles.Toggles) -> list[Section]:
    """Conditions, Table 5 and claims, in the page and as CSV; what a study of other things cannot say is left out of
    the page."""
    _write(combinations, judged, target)
    sections = []
    if judged:
        section, csv = glance.section(study, hiding.marks)
        write_bytes(target / "conditions.csv", csv)
        sections.append(section)
    if tables and telling is not None:
        html = "".join((f"<h3>{_escape(name)}</h3>" if name else "") + _table5(rows) for name, rows in tables[:4])
        html += ("<p class=small>Here: validation episodes that were survived, as all of the paper's were (its "
                 "deviations hold no penalty): mean over seeds ± deviation over the episodes of a seed, as the paper's "
                 "is over its episodes; in brackets that between seeds' means. All episodes: the others too, penalties "
                 "of eqs 7-9 in the rewards. † The paper's text does not tell which of two cells this is.</p>")
        sections.append(Section("table5", "Table 5, side by side", html))
    if len(judged) > 1 and telling is not None:
        sections.append(verdicts.matrix(judged))
    if telling is not None:
        sections.append(verdicts.section(judged[telling], telling if len(judged) > 1 else ""))
    return sections


def _of_readings(claims: Claims, conditions: Conditions, combinations: Combinations, judged: dict[str, list[Verdict]],
                 target: Path) -> list[Section]:
    """What stands there of many readings: no table of a single one."""
    _write(combinations, judged, target)
    section, csv = spread.conditions(claims, conditions, combinations)
    write_bytes(target / "conditions.csv", csv)
    return [section]


def _write(combinations: Combinations, judged: dict[str, list[Verdict]], target: Path) -> None:
    """The verdicts as CSV."""
    write_bytes(target / "verdicts.csv", verdicts.as_csv(judged))
    write_bytes(target / "seeds.csv", verdicts.seeds_csv(judged))
    if len(judged) > 1:
        write_bytes(target / "combinations.csv", combinations_csv(combinations, judged))


def _escape(text: str) -> str:
    from html import escape
    return escape(text)


def _table5(rows: list[table5.Row]) -> str:
    labels = list(dict.fromkeys(row.condition for row in rows))
    heads = ["", "unit", *(f"{label}, {what}" for label in labels
                           for what in ("paper", "here", "difference", "all episodes"))]
    body = []
    for quantity in dict.fromkeys(row.quantity for row in rows):
        mine = [row for row in rows if row.quantity == quantity]
        body.append([mine[0].name, mine[0].unit, *(text for row in mine for text in table5.texts(row))])
    return table(heads, body, range(2, len(heads)))


def _lead(study: Study, conditions: Conditions) -> str:
    """What was run, in a sentence or two, from the configs."""
    runs = len(conditions.configs)
    if not runs:
        return f"{len(study.runs)} run folders, none complete."
    seeds = sorted({s for c in conditions.curiosities for st in conditions.strata for s in conditions.runs(c, st).runs})
    names = ", ".join(conditions.name(c) + (f" (curiosity={c})" if conditions.name(c) != c else "")
                      for c in conditions.curiosities)
    parts = [f"{runs} complete run{'s' * (runs > 1)} of {names}", f"seed{'s' * (len(seeds) > 1)} {_span(seeds)}"]
    if len(conditions.settings) > MOST_SETTINGS:
        parts.append(f"{len(conditions.strata)} combinations of {len(conditions.settings)} settings")
    for setting in conditions.settings if len(conditions.settings) <= MOST_SETTINGS else ():
        values = list(dict.fromkeys(st[conditions.settings.index(setting)] for st in conditions.strata))
        parts.append(f"{setting} in {', '.join(values[:8])}" + (" …" if len(values) > 8 else ""))

    def of(name: str) -> str:
        found = list(dict.fromkeys(str((c.get(name) or {}).get("name", "?")) for c in conditions.configs.values()))
        return found[0] if len(found) == 1 else f"as set ({len(found)} of them)"
    config = next(iter(conditions.configs.values()))
    episodes = f"{config.get('train_episodes')} training and {config.get('validation_episodes')} validation episodes"
    same = [f"{name} {of(name)}" for name in ("simulator", "world", "learner", "exploration", "reading")
            if name not in conditions.settings]
    return f"{', '.join(parts)}; {episodes}. {', '.join(same).capitalize()}."


def _span(seeds: list[int]) -> str:
    return f"{seeds[0]} to {seeds[-1]}" if len(seeds) > 2 and seeds[-1] - seeds[0] == len(seeds) - 1 else \
        ", ".join(map(str, seeds[:20]))


def _print(notes: list[str], rows: list[table5.Row] | None, judged: list[Verdict], telling: str | None,
           target: Path) -> None:
    if rows:
        table5.print_table(rows, f"Table 5 side by side{f' ({telling})' if telling else ''}: paper, here, difference")
    if telling is not None:
        verdicts.print_table(judged, telling)
    for note in notes:
        print(f"mind     {note}")
    print(f"figures  {target / 'figures'}")
    print(f"tables   {', '.join(str(target / f'{name}.csv') for name in ('conditions', 'table5', 'verdicts'))}")
    print(f"page     {target / 'index.html'}")

"""From a study to its page: figures, tables, verdicts, written to one folder."""

from __future__ import annotations

import re
import warnings
from collections import Counter
from collections.abc import Callable, Collection
from dataclasses import dataclass
from pathlib import Path

from attnlab.audit.table import load_table
from attnlab.claims import DEFAULT
from attnlab.claims.files import Claims, load_claims
from attnlab.claims.judge import Verdict, judge
from attnlab.conditions import Conditions
from attnlab.errors import ConfigError
from attnlab.measures.rewards import Reward
from attnlab.report import curves, economics, episode, found, multiverse, policies, provenance, space, table5, verdicts
from attnlab.report.page import Section, Shown, page, table
from attnlab.report.style import drawing, png_bytes, svg_bytes
from attnlab.results.files import write_bytes
from attnlab.results.load import Study, load


@dataclass
class Figure:
    """A figure of the report: how it is drawn, what the paper shows there, how to say what was found."""
    key: str
    title: str
    paper: str
    draw: Callable
    say: Callable


def _rewards() -> list[tuple[str, Reward]]:
    return [("reward ", Reward(Reward.Params())), ("extrinsic part ", Reward(Reward.Params(extrinsic=True)))]


FIGURES = [
    Figure("fig06_survival", "Fig 6: survival", "NCR survives better until about episode 250 and starts above 90 %; CR "
           "reaches 100 % around episode 300, NCR not before 450.", curves.survival,
           found.start_and_end("survival", " %", 100)),
    Figure("fig07_rewards", "Fig 7: cumulative rewards", "CR's AVOID reward is unsatisfactory until about episode 200 "
           "and converges from 300; NCR's EAT and DRINK rewards end higher, CR's global reward ends higher and "
           "converges faster. CR is paid on another scale (eq 4), so its extrinsic part is drawn too.", curves.rewards,
           found.validation(_rewards(), " UoR an episode")),
    Figure("fig08a_needs", "Fig 8A: needs within an episode", "CR alternates eating and drinking in a rhythm; NCR "
           "waits until it is very hungry or very thirsty.", episode.needs, found.meals),
    Figure("fig08b_maximum_need", "Fig 8B: largest need of an episode", "NCR's largest need is on average always above "
           "CR's.", curves.maximum_need, found.start_and_end("hunger_max", " UoE hunger", block=10, digits=0)),
    Figure("fig09_safety", "Fig 9: safety", "CR is safer: 0.61 on average against 0.38.", curves.safety,
           found.start_and_end("safety_mean", "", block=10, digits=2)),
    Figure("fig10_energy", "Fig 10: energy", "CR keeps its energy above E_well, at a high and stable level.",
           curves.energy, found.start_and_end("energy_mean", " UoE", block=10, digits=0)),
    Figure("fig11_paths", "Fig 11: paths and coverage", "CR's traces of 500 episodes cover 50 % of the area, NCR's 44 "
           "%, and CR's path seems smoother. Shade: visits in training of the first seed (dark: often); line: its last "
           "recorded episode from the circle on; green: food, blue: water.", space.paths, found.coverage),
    Figure("policies", "Learned policies", "NCR DRINK learns 12 in bins 1-4 and 1 in bins 5-6; CR with low curiosity "
           "12 in 1-3 and 1 in 4-6; CR with high curiosity 1 or 2 (read 4) everywhere. Large: the period that most "
           "seeds learned; small: how many of the seeds that visited "
           "the bin; grey: never visited, or nothing learned.", policies.heat_maps,
           found.policies),
    Figure("attention_raster", "Who looked when", "Not in the paper. Each tick is an activation, its colour the period "
           "until the next look; hunger and thirst below on the same axis.", episode.raster, found.looks),
    Figure("attention_economics", "Attention economics", "The paper gives 443 activations of CR and 364 of NCR in "
           "about 1150 cycles (39 and 32 in 100). Large marks are means with 95 % intervals, small ones seeds; grey: "
           "baselines, if given.", economics.economics, found.costs),
]


def build(study_path: str | Path, out: str | Path | None, claims_name: str | None, baselines: str | Path | None,
          quiet: bool, only: Collection[str] | None = None) -> Path:
    """See :func:`attnlab.report.build_report`; ``only`` names the figures to draw, all if left out."""
    study = load(study_path)
    claims = load_claims(claims_name or _claims_of(study))
    conditions = Conditions(study, claims.labels)
    others = Conditions(load(baselines)) if baselines else None
    target = Path(out) if out else study.path / "report"
    try:
        (target / "figures").mkdir(parents=True, exist_ok=True)
    except OSError as cause:
        raise ConfigError("--out", f"{target} cannot be written ({cause.strerror or cause})") from None
    judged = {conditions.stratum_name(s): judge(claims, conditions, dict(zip(conditions.settings, s, strict=True)))
              for s in conditions.strata}
    first = next(iter(judged.values()), [])
    with drawing(), warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a glyph that the font lacks, a mean of nothing
        shown = [_draw(figure, conditions, others, first, target) for figure in FIGURES
                 if conditions.strata and (only is None or figure.key in only)]
        tables = _tables(claims, conditions, target)
        sections = _sections(conditions, judged, tables, target)
        if len(judged) >= multiverse.LEAST_READINGS:
            more, section = _multiverse(multiverse.analyse(conditions, judged), target)
            shown, sections = more + shown, [section, *sections]
    sections.append(provenance.commands(study, conditions))
    notes = provenance.notes(study, conditions, claims)
    if not conditions.strata:
        notes.insert(0, "there is no complete run in this study, so there is nothing to draw or to judge")
    text = page(f"{study.path.resolve().name}: what was found", _lead(study, conditions), notes, claims, first, shown,
                sections, provenance.block(study, conditions, claims))
    write_bytes(target / "index.html", text.encode())
    if not quiet:
        _print(notes, tables, first, target)
    return target / "index.html"


def _claims_of(study: Study) -> str:
    """The claims file that most runs say they were started under."""
    names = Counter((study.about(run).get("claims") or {}).get("name") for run in study.complete)
    names.pop(None, None)
    return min(names, key=lambda name: (-names[name], name), default=DEFAULT)


def _draw(figure: Figure, conditions: Conditions, others: Conditions | None, judged: list[Verdict],
          target: Path) -> Shown:
    extra = (others,) if figure.key == "attention_economics" else ()
    png = _save(figure.draw(conditions, *extra), figure.key, target)
    ids = [v.id for v in judged if _shows(figure, v)]
    return Shown(figure.key, figure.title, figure.paper, figure.say(conditions, *extra), png, ids)


def _save(drawn, key: str, target: Path) -> bytes:
    """Write a figure as PNG and SVG, close it, return the PNG."""
    import matplotlib.pyplot as plt
    png = png_bytes(drawn)
    write_bytes(target / "figures" / f"{key}.png", png)
    drawn.set_layout_engine("none")  # everything has its place now; laying it out again would take as long as drawing
    write_bytes(target / "figures" / f"{key}.svg", svg_bytes(drawn))
    plt.close(drawn)
    return png


def _shows(figure: Figure, verdict: Verdict) -> bool:
    """Does the figure show what a claim is about? By the place in the paper; policies by the measure."""
    names = [p.part.measure if isinstance(p.part.measure, str) else p.part.measure["name"] for p in verdict.parts]
    if any(name.startswith("policy") for name in names):
        return figure.key == "policies"
    number = re.match(r"Fig (\d+)", figure.title)
    return number is not None and re.search(rf"\bFig {number[1]}(?!\d)", verdict.claim.where) is not None


def _tables(claims: Claims, conditions: Conditions, target: Path) -> list[tuple[str, list[table5.Row]]]:
    """Table 5 for each combination of the other settings in which a role of the claims file is a column of it."""
    paper = load_table()
    tables = []
    for stratum in conditions.strata:
        within = dict(zip(conditions.settings, stratum, strict=True))
        roles = {role.label: conditions.matching(role.where, within)[0] for role in claims.roles.values()}
        if set(roles) & set(paper.conditions):
            tables.append((conditions.stratum_name(stratum), table5.rows(paper, conditions, roles)))
    write_bytes(target / "table5.csv", table5.as_csv(tables))
    return tables


def _sections(conditions: Conditions, judged: dict[str, list[Verdict]], tables: list[tuple[str, list[table5.Row]]],
              target: Path) -> list[Section]:
    """Table 5 and the claims, in the page and as CSV."""
    write_bytes(target / "verdicts.csv", verdicts.as_csv(judged))
    sections = []
    if tables:
        html = "".join((f"<h3>{_escape(name)}</h3>" if name else "") + _table5(rows) for name, rows in tables[:4])
        html += ("<p class=small>Mean ± standard deviation over validation episodes; here: mean over seeds, deviation "
                 "over the episodes of all seeds. † The paper's text does not tell which of two cells this is.</p>")
        sections.append(Section("table5", "Table 5, side by side", html))
    if len(judged) > 1:
        write_bytes(target / "combinations.csv", multiverse.combinations_csv(conditions, judged))
        sections.append(verdicts.matrix(judged))
    for name, of in list(judged.items())[:1]:
        sections.append(verdicts.section(of, name))
    return sections


def _multiverse(found: multiverse.Multiverse, target: Path) -> tuple[list[Shown], Section]:
    """The figures and the section of a study of many readings."""
    write_bytes(target / "effects.csv", multiverse.effects_csv(found))
    best = max(range(len(found.ids)), key=lambda i: (found.share(i)[0] if found.share(i)[3] else -1.0, -i))
    said = f"{found.ids[best]} ({found.titles[best]}) holds most often, in {100 * found.share(best)[0]:.0f} % of the " \
           "readings that can test it."
    clear = [e for e in found.effects if e.clear]
    moved = max(clear, key=lambda e: abs(e.difference), default=None)
    most = "No reading moves a claim clearly." if moved is None else \
        f"{moved.factor}={moved.level} moves {moved.claim} most, by {100 * moved.difference:+.0f} percent points."
    shown = []
    for key, title, draw, text in (
            ("multiverse_shares", "In how many readings each claim holds", multiverse.shares, said),
            ("multiverse_effects", "Which reading moves which claim", multiverse.effects_map, most)):
        drawn = draw(found)
        png = _save(drawn, key, target)
        shown.append(Shown(key, title, "Each open point of the text may be read in several ways; the paper ran one.",
                           text, png))
    return shown, multiverse.section(found)


def _escape(text: str) -> str:
    from html import escape
    return escape(text)


def _table5(rows: list[table5.Row]) -> str:
    labels = list(dict.fromkeys(row.condition for row in rows))
    heads = ["", "unit", *(f"{label}, {what}" for label in labels for what in ("paper", "here", "difference"))]
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
    for setting in conditions.settings:
        values = list(dict.fromkeys(st[conditions.settings.index(setting)] for st in conditions.strata))
        parts.append(f"{setting} in {', '.join(values[:8])}" + (" …" if len(values) > 8 else ""))

    def of(name: str) -> str:
        return next(iter(dict.fromkeys(str((c.get(name) or {}).get("name", "?")) for c in conditions.configs.values())))
    config = next(iter(conditions.configs.values()))
    episodes = f"{config.get('train_episodes')} training and {config.get('validation_episodes')} validation episodes"
    same = [f"{name} {of(name)}" for name in ("simulator", "world", "learner", "exploration", "reading")
            if name not in conditions.settings]
    return f"{', '.join(parts)}; {episodes}. {', '.join(same).capitalize()}."


def _span(seeds: list[int]) -> str:
    return f"{seeds[0]} to {seeds[-1]}" if len(seeds) > 2 and seeds[-1] - seeds[0] == len(seeds) - 1 else \
        ", ".join(map(str, seeds[:20]))


def _print(notes: list[str], tables: list, judged: list[Verdict], target: Path) -> None:
    if tables:
        name, rows = tables[0]
        table5.print_table(rows, f"Table 5 side by side{f' ({name})' if name else ''}: paper, here, difference")
    if judged:
        verdicts.print_table(judged)
    for note in notes:
        print(f"mind     {note}")
    print(f"figures  {target / 'figures'}")
    print(f"tables   {target / 'table5.csv'}, {target / 'verdicts.csv'}")
    print(f"page     {target / 'index.html'}")

"""The page of results and what the project's README says of them, from the tables of a folder."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from pathlib import Path

import deep
import found
import own
import truth
import universe
from found import Row
from studies import NCR, OWN, STUDIES, Study

from attnlab.claims.findings import Finding

BLOCK = re.compile(r"(<!-- found: [^>]*-->\n).*?(<!-- end -->)", re.DOTALL)
MINUTES = re.compile(r"(<!-- minutes: (\w+) -->).*?(<!-- end -->)")
OVER = 1.1  # processor time beside the runs' own: starting, drawing, judging
HEAD = """# What was found

Made by `python docs/results/make.py`: every number, and every word that hangs on one, is from the tables beside this
page."""
HOW = """Studies at full length (500 training and 100 validation episodes a run) on the shipped defaults, which were
fixed beforehand, by the design test on robots that learn nothing and by the soundness of the non-curious robot. The
claims and their rules ([conf/claims/dinocera2014.yaml](../../conf/claims/dinocera2014.yaml),
[docs/claims.md](../claims.md)) were written before these runs, version 2 after an audit of the first results.
Differences are paired by seed, with Student's t intervals (95 %) over seeds; "clearly" means that the interval leaves
out 0, uncorrected for the number of rows. Greedy validation was inferred from the activations of Table 5, so agreement
with those cells is no evidence."""
OLD = "**Made under older rules**, and not comparable with what `python docs/results/make.py` makes today."


def page(folder: Path) -> str:
    """The whole page."""
    sentences = "\n".join(f"{i}. {text}" for i, text in enumerate(found.sentences(folder), 1))
    parts = [HEAD, sentences, HOW, elsewhere(folder), studies(folder)]
    for study in STUDIES[:3]:
        parts += main_study(folder, study)
    parts += controls(folder)
    parts += summary(folder, "baselines", "Baselines", "Learned attention is NCR of the studies above.")
    parts += summary(folder, "generations", "Three generations of attention",
                     "The fitness of both evolved ones is ours, as are the hand-set functions.")
    parts += [contrasts(folder, "generations", found.VALID)]
    parts += summary(folder, "curiosities", "Every model of curiosity",
                     "All live in the same worlds from the same starts; no model was tuned for it. `surprise` is also "
                     "called `litman_itti`: one model, named once.")
    parts += [curious(folder), *summary(folder, "deep", "Deep networks", deep.text(folder)),
              *universe.section(folder), *truth.section(folder)]
    for study in OWN:
        parts += own_study(folder, study)
    return "\n\n".join(part for part in parts if part) + "\n"


def grid(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A Markdown table, the first column to the left."""
    lines = [list(heads), ["---", *["---:"] * (len(heads) - 1)], *map(list, rows)]
    return "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in line) + " |" for line in lines)


def elsewhere(folder: Path) -> str:
    """Results with a page of their own."""
    pages = {"arena": "every published way to decide when to look, in worlds and on logs of real robots",
             "toys": "the ways on the toys of their own papers"}
    there = [f"[{name}]({name}/README.md), {what}" for name, what in pages.items() if (folder / name).is_dir()]
    return f"Beside this page: {'; '.join(there)}." if there else ""


def old(folder: Path, study: str) -> str:
    """A warning where it is not known what a study was made with."""
    return "" if found.made(folder, study) else OLD


def studies(folder: Path) -> str:
    """What was made, by what command, with what code."""
    rows = []
    for study in STUDIES:
        with_ = found.made(folder, study.name)
        there = f"[{study.name}]({study.name})" if (folder / study.name).is_dir() else study.name
        runs = f"{with_['runs']} of {with_['asked_for']}" if with_ else "-"
        rows.append([there, f"`{study.command}`", study.what, runs, *_of_code(with_)])
    return grid(("study", "command", "what", "complete runs", "processor minutes", "code"), rows)


def _of_code(with_: dict) -> list[str]:
    if not with_:
        return ["-", "-"]
    return [f"{with_['cpu_s_of_runs'] / 60:.0f}", str(with_["code"]["hash"])]


def main_study(folder: Path, study: Study) -> list[str]:
    """A study of CR and NCR: its verdicts, its differences, Table 5."""
    rows = found.table(folder, study.name, "verdicts")
    if not rows:
        return []
    claims: dict[str, list[str]] = {finding: [] for finding in Finding}
    for claim, row in {row["claim"]: row for row in rows}.items():
        claims[Finding(row["verdict"])].append(f"{claim} {row['title']}")
    parts = [f"## {study.name}: {study.what}", old(folder, study.name)]
    parts += [f"**{word.capitalize()}** ({len(of)}): {'; '.join(of)}." for word, of in claims.items() if of]
    if study.name != STUDIES[0].name:
        both = (found.verdicts(folder, name) for name in (STUDIES[0].name, study.name))
        parts.append(f"Beside {STUDIES[0].name}, {found.agreement(*both)}.")
    if forms := [row for row in rows if row.get("forms")]:
        hang = dict.fromkeys(row["claim"] for row in forms for form in row["forms"].split("; ")
                             if form.rpartition(": ")[2] != row["part_verdict"])
        parts.append("Comparisons that come out otherwise in another form (penalties in or out, all episodes or those "
                     f"survived, the other scale of reward; verdicts.csv): {', '.join(hang) or 'none'}.")
    return [*parts, contrasts(folder, study.name), table5(folder, study.name)]


def contrasts(folder: Path, study: str, only: str = "") -> str:
    """Differences: of one pair with its levels, of several a column each; ``only`` one quantity, a row a pair."""
    rows = [row for row in found.table(folder, study, "contrasts") if only in ("", row["quantity"])]
    pairs = list(dict.fromkeys((row["treatment"], row["control"]) for row in rows))
    if not rows:
        return ""
    if only:
        return grid((only, "less that of", "difference"),
                    [[row["treatment"], row["control"], found.difference(row)] for row in rows])
    if len(pairs) == 1:
        return grid(("", *pairs[0], "difference"),
                    [[_name(row), *found.levels(row), found.difference(row)] for row in rows])
    by_quantity: dict[str, list[str]] = {}
    for row in rows:
        by_quantity.setdefault(_name(row), []).append(found.difference(row))
    return grid(("difference", *(f"{one} less {other}" for one, other in pairs)),
                [[name, *of] for name, of in by_quantity.items()])


def _name(row: Row) -> str:
    return row["quantity"] + (f" ({row['unit']})" if row["unit"] != "1" else "")


def table5(folder: Path, study: str) -> str:
    """Table 5: the paper, here on episodes that were survived, and on all of them with penalties."""
    rows = found.table(folder, study, "table5")
    if not rows or "all_mean" not in rows[0]:
        return ""
    cells: dict[str, dict[str, list[str]]] = {}
    for row in rows:
        unit = row["unit"].replace("0-1", "1")
        texts = [found.number(row[column], unit) for column in ("paper_mean", "here_mean", "all_mean")]
        cells.setdefault(row["quantity"].replace(".", " "), {})[row["condition"]] = texts
    labels = list(dict.fromkeys(row["condition"] for row in rows))
    return grid(("Table 5", *(f"{label}, {what}" for label in labels for what in ("paper", "survived", "all"))),
                [[name, *(text for label in labels for text in of.get(label, "---"))] for name, of in cells.items()])


def controls(folder: Path) -> list[str]:
    """CR, and both robots that it may be held against."""
    rows = contrasts(folder, "controls")
    note = "plain: the 24 states of 2012. same states: CR's 72 states, w = 0 in eq 4, as the paper's sentence says."
    return ["## controls: what CR is held against", old(folder, "controls"), note, rows] if rows else []


def summary(folder: Path, study: str, title: str, note: str) -> list[str]:
    """A study of many conditions at a glance."""
    rows = found.table(folder, study, "conditions")
    if not rows:
        return []
    shown = [[r["condition"], *(f"{100 * float(r[c]):.1f} %" for c in ("early", "late", "validation", "crashed")),
              *(f"{float(r[c]):.0f}" for c in ("hunger", "thirst")),
              f"{float(r['safety']):.2f}", ", ".join(r["activations"].split())] for r in rows]
    kept = f" The whole page: [report.html]({study}/report.html)." if (folder / study / "report.html").exists() else ""
    seeds = " to ".join(sorted({r["runs"] for r in rows}, key=int))
    return [f"## {title}", old(folder, study), f"Means over {seeds} seeds. {note}{kept}", grid(
        ("condition", "survival early", "late", "validation", "crashed", "hunger", "thirst", "safety", "activations"),
        shown)]


def curious(folder: Path) -> str:
    """Which models of curiosity differ clearly from NCR."""
    lines = []
    there = found.table(folder, "curiosities", "contrasts")
    for quantity in (found.VALID, "safety", "hunger", "thirst") if there else ():
        of: dict[str, list[str]] = {found.MORE: [], found.LESS: []}
        for condition, word in found.clearly(folder, "curiosities", NCR, quantity):
            of[word].append(condition)
        lines.append(f"- {quantity}: clearly more than NCR (plain) {', '.join(of[found.MORE]) or 'none'}; clearly less "
                     f"{', '.join(of[found.LESS]) or 'none'}.")
    return "\n".join(lines)


def own_study(folder: Path, study: Study) -> list[str]:
    """A study of our own question: its paragraph, its figure, how its claims fare."""
    if not (folder / study.name).is_dir():
        return []
    kept = f" The whole page: [report.html]({study.name}/report.html)." \
        if (folder / study.name / "report.html").exists() else ""
    figure, (heads, *rows) = study.figures[0], own.steps(study.name, folder)
    return [f"## {study.name}: {study.what}", own.text(study.name, folder) + kept,
            f"![{study.what}]({study.name}/{figure}.png)", grid(heads, rows),
            f"What we expected, by rules written before these runs ([conf/claims/{study.claims}.yaml]"
            f"(../../conf/claims/{study.claims}.yaml)):", own.verdicts(study.name, folder)]


def readme(text: str, folder: Path) -> str:
    """The project's README with its sentences on results, and the minutes that studies take on two cores."""
    said = "\n".join(f"{i}. {sentence}" for i, sentence in enumerate(found.sentences(folder), 1))
    text = BLOCK.sub(lambda m: f"{m[1]}{said}\n{m[2]}", text)
    return MINUTES.sub(lambda m: f"{m[1]}{minutes(folder, m[2])}{m[3]}", text)


def minutes(folder: Path, study: str) -> str:
    """How long a study takes, on two quiet cores to one, from the processor time of its runs and of its pilots."""
    with_ = found.made(folder, study)
    if not with_:
        return "minutes"
    spent = OVER * (with_["cpu_s_of_runs"] + (with_.get("pilots") or {}).get("cpu_s", 0)) / 60
    return f"{max(1, round(spent / 2))} to {max(2, round(spent))} min"

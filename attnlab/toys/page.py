"""What came of the toys, in words and tables that follow the table."""

from __future__ import annotations

from collections.abc import Sequence

from attnlab.claims.files import Claims
from attnlab.claims.judge import Verdict
from attnlab.claims.parts import PAIRED
from attnlab.claims.words import number

HEAD = """# The ways on their papers' toys

Every way to decide when to look that has a toy in its paper plays it here with the code that the robot's clock uses,
and the paper's claims (`conf/claims/toys`) are judged by the rules of all claims (`docs/claims.md`). They were written,
with their numbers, before anything was played; nothing was tuned afterwards."""
NOTES = {  # what is ours
    "temporl":
    "Played as in the authors' code, with `TempoTables` of `learner=tempo_rl`. Ours: a skip that would go on "
    "beyond the end is worth what it earned until there; in their code the last reward is earned again in each "
    "step that is left. The numbers are those of the authors' published runs.",
    "amrl":
    "Played as in the authors' code, with the model and the update of `learner=amrl`. The settings of the "
    "standard chain's runs are not public; those of the even-odd chain are taken for both. An episode's end is "
    "seen without a measurement. Ours: the margins.",
    "timing":
    "The process and its settings are those of the authors' code; one model of a step is the chain of "
    "`learner=timing`. Ours: that chain is estimated by expectation maximisation (theirs by gradients), what a "
    "state pays is known to both planners (theirs fit it), and a return is the mean of the last episodes (theirs "
    "of the last one). In their own table the one model is no higher than a model for each delay.",
    "values":
    "TaCoS (a pendulum and robots, by deep learners), self-triggering, Whittle's index and the regulations have "
    "no tabular toy that could be had; they, and the clocks made here of the others, are held against exact "
    "solutions on chains of six percepts. Emotional clocks and monitors learn nothing: their functions are held "
    "by hand in the tests."}


def page(told: dict[str, list[Verdict]], files: dict[str, Claims], command: str) -> str:
    """Markdown: a sentence and a table for every claims file."""
    parts = [HEAD, f"    {command}"]
    for name, verdicts in told.items():
        parts += [f"## {files[name].title}", f"{files[name].source}. {sentence(verdicts)} {NOTES[name]}",
                  rows(verdicts, files[name])]
    return "\n\n".join(parts) + "\n"


def sentence(verdicts: Sequence[Verdict]) -> str:
    """How many claims came out how."""
    words = [verdict.word for verdict in verdicts]
    said = [f"{words.count(word)} {word}" for word in dict.fromkeys(words)]
    return f"Of {len(verdicts)} claims: {', '.join(said)}."


def rows(verdicts: Sequence[Verdict], claims: Claims) -> str:
    """A row for every comparison: levels, difference with its interval, the paper's number, verdict."""
    lines = ["| claim | who | found | the paper | verdict |", "| --- | --- | ---: | ---: | --- |"]
    for verdict in verdicts:
        for of in verdict.parts:
            part = of.part
            unit = "" if part.unit == "1" else f" {part.unit}"
            ours = f"{claims.roles[part.role].label} {number(of.levels[part.role])}" if of.levels else ""
            who = f"{ours}, {claims.roles[part.against].label} {number(of.levels[part.against])}{unit}" \
                if of.levels and part.test in PAIRED else f"{ours}{unit}"
            found = f"{number(of.value.value)} [{number(of.value.low)}, {number(of.value.high)}]"
            paper = "" if part.number is None else \
                f"{number(part.number)} ± {number(part.known)}" if part.known is not None else number(part.number)
            if part.test == "not_lower" and part.margin is not None:
                paper = f"at least {number(-part.margin)}"
            if part.test == "level":
                paper = f"below {number(part.reference)}"
            told = verdict.word if part.counts else f"(beside it: {of.verdict})"
            lines.append(f"| {verdict.claim.title} | {who} | {found} | {paper} | {told} |")
    return "\n".join(lines)

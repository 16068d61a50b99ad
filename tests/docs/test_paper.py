"""paper.md is what the journal asks for, says nothing that the stored results do not, and builds at a push."""

import csv
import re

import yaml

from attnlab.claims.findings import Finding
from tests.docs.typed import ROOT

PAPER = (ROOT / "paper.md").read_text()
HEAD, BODY = yaml.safe_load(PAPER.split("---\n")[1]), PAPER.split("---\n", 2)[2]
WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))


def rows(name):
    return list(csv.DictReader((ROOT / "docs" / "results" / name).read_text().splitlines()))


def test_it_has_what_the_journal_asks_for():
    assert set(HEAD) >= {"title", "tags", "authors", "affiliations", "date", "bibliography"}
    assert re.findall(r"^# (.*)$", BODY, re.MULTILINE) == [
        "Summary", "Statement of need", "State of the field", "Software design", "Research impact statement",
        "AI usage disclosure", "Acknowledgements", "References"]
    assert 750 <= len(re.findall(r"[\w'-]+", re.sub(r"\[@[^\]]*\]", "", BODY))) <= 1750
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    assert [author["name"] for author in HEAD["authors"]] == [author["name"] for author in citation["authors"]]


def test_what_it_cites_is_in_its_bibliography():
    cited = set(re.findall(r"@(\w+)", BODY))
    known = re.findall(r"^@\w+\{(\w+),", (ROOT / HEAD["bibliography"]).read_text(), re.MULTILINE)
    assert cited == set(known) and len(known) == len(cited)


def test_it_has_no_number_and_its_words_hang_on_the_results():
    assert not re.findall(r"\d", re.sub(r"\[@[^\]]*\]", "", BODY))
    verdicts = {row["claim"]: Finding(row["verdict"]) for row in rows("cr_vs_ncr/verdicts.csv")}.values()
    assert sum(finding.holds for finding in verdicts) * 2 < len(verdicts)  # most do not hold
    assert sum(finding is Finding.CONTRADICTED for finding in verdicts) >= 3  # several
    assert all(int(row["hold"]) * 2 < len(verdicts) for row in rows("search/finalists.csv") if not row["not_sound"])
    early = {(row["treatment"], row["control"]): row for row in rows("bigger_table/contrasts.csv")
             if row["quantity"] == "survival, first half of training"}
    assert float(early["NCR, same states", "NCR, plain"]["high"]) < 0 < float(early["CR", "NCR, same states"]["low"])


def test_workflows_name_what_there_is():
    classifiers = (ROOT / "pyproject.toml").read_text()
    for file in WORKFLOWS:
        text = file.read_text()
        assert all(re.search(r"@[0-9a-f]{40}  # ", line) for line in text.splitlines() if "uses:" in line), file
        assert yaml.safe_load(text)["permissions"] == {}
    ci, publish = (yaml.safe_load(file.read_text()) for file in WORKFLOWS)
    pythons = ci["jobs"]["tests"]["strategy"]["matrix"]["python"]
    assert pythons == re.findall(r"Python :: (3\.\d+)", classifiers) and len(pythons) == 3
    [paper] = [step["with"]["paper-path"] for job in publish["jobs"].values() for step in job["steps"]
               if "journal" in step.get("with", {})]
    assert (ROOT / paper).is_file()

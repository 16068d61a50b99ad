"""The page of a planted multiverse: everything in its order, readable without its script, nothing run but that."""

from __future__ import annotations

import base64
import hashlib
import json
import re
from html import escape
from pathlib import Path

import numpy as np
import pytest

from attnlab.claims.files import load_claims
from attnlab.claims.findings import Finding
from attnlab.report import kept, readings, spread, statements_of, told
from attnlab.report.build import build
from attnlab.report.contrasts import Contrast, contrasts, in_words
from attnlab.report.multiverse import Multiverse, curves_of
from attnlab.report.page import page
from attnlab.tables.readings import Decided, Tried, write_decided
from tests.report.small_study import write_run

HOSTILE = "</script><img src=x onerror=\"document.title='owned'\">"
PROBE = """<!doctype html><meta charset="utf-8"><iframe id=page src="%s" style="width:390px;height:900px">
</iframe><pre id=told></pre><script>
document.getElementById('page').onload = function () {
  var page = this.contentDocument, by = page.querySelector('[name=by]'), found = [];
  function shown() { return page.querySelector('path[data-f="1"][data-l="0"]').getAttribute('d'); }
  found.push(shown()); by.value = '1'; by.onchange(); found.push(shown());
  document.getElementById('told').textContent = JSON.stringify({blocks: found, title: page.title,
    pick: page.querySelector('.pick').hidden, wide: page.documentElement.scrollWidth});
};</script>"""
CLAIMS = load_claims("dinocera2014")
DECIDED = Decided("mark", "plain survives more than 90 %", 9, [
    Tried("r0", {"crash": "contact", "need_k": "1"}, 97.0, 3, 2, taken=True),
    Tried("r1", {"crash": "distance", "need_k": "2"}, 95.0, 2, 2, taken=True),
    Tried("r2", {"crash": "contact", "need_k": "2"}, 81.0, 1, 0, "survives 81.00 %; nobody drinks"),
    Tried("r3", {"crash": "contact", "need_k": "2"}, 82.0, 1, 1, "survives 82.00 %"),
    Tried("r4", {"crash": "distance", "need_k": "<b>1</b>"}, 99.0, 4, 4)], {}, ("need_k", "crash", 1.0), 0.5)


def planted(name: str = "crash") -> Multiverse:
    """Twenty readings, ten seeds: a measure that is robust, one that hangs on a factor, and noise."""
    rng = np.random.default_rng(1)
    levels = {name: ["contact", "distance"] * 10, "need_k": [str(i % 3) for i in range(20)]}
    x = rng.standard_normal((20, 4, 10))
    x[:, 0] += 2.0
    x[::2, 1] += 2.5
    x[:5, 2] = np.nan
    wanted = [Contrast(f"C{m}", 0, f"measure {m}", "treatment", "control", "CR", "NCR", -1.0, f"m{m}", False)
              for m in range(4)]
    found = [[Finding.DIRECTION] * 15 + [Finding.NOT] * 3 + [Finding.UNTESTABLE] * 2,
             [Finding.CONTRADICTED] * 19 + [Finding.REPRODUCED]]
    return Multiverse({key: CLAIMS.claims[key] for key in ("C1", "C2")}, [f"r{i}" for i in range(20)], found, levels,
                      {factor: of[0] for factor, of in levels.items()}, [], curves_of(wanted, x, levels))


def write_page(found: Multiverse, study: Path) -> Path:
    """The page of a multiverse, with a file of readings, in a new folder."""
    from attnlab.figures.style import drawing
    (study / "figures").mkdir(parents=True)
    write_decided(study, DECIDED)
    with drawing():
        over = readings.of(found, study, study)
    html = page("many", "", over.notes, spread.headline(found, CLAIMS), [], [], [], "", over.first_screen,
                over.sections, over.script)
    (study / "index.html").write_text(html)
    return study / "index.html"


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """(the page's HTML, its folder) of a multiverse with a hostile factor and a file of readings."""
    written = write_page(planted(HOSTILE), tmp_path_factory.mktemp("multiverse") / "study")
    return written.read_text(), written.parent


def test_the_order_of_the_page(built):
    html, study = built
    titles = re.findall(r"<h[23][^>]*>(.*?)<", html)
    assert [title.split(":")[0].strip() for title in titles[:5]] == [
        "What was found", "Robust", "Hang on one factor", "Noise", "The specification curve"]
    assert titles[5:8] == ["Every comparison", "What moves each claim", "In how many readings each claim holds"]
    assert titles.index("Which readings are sound") > titles.index("What moves each claim")
    for name in ("curve", "joint", "shares", "effects"):
        assert (study / f"{name}.csv").is_file()
    assert (study / "figures" / "multiverse_dashboard.svg").is_file()


def test_all_statements_at_once(built):
    """A row a measure, those of which most can be said first, before any sentence."""
    table = built[0].partition("<table class=glance>")[2].partition("</table>")[0]
    assert built[0].index("class=glance") < built[0].index("<div class=kinds>")
    rows = [re.sub(r"<[^>]+>", "|", row).split("|") for row in table.split("<tr>")[2:]]
    said = {row[1].strip(): next(cell for cell in row[5:] if cell) for row in rows}
    assert said == {"measure 0": "lower in 20 of 20", "measure 1": escape(f"hangs on {HOSTILE}"), "measure 2": "noise",
                    "measure 3": "noise"}
    assert list(said)[:2] == ["measure 0", "measure 1"]
    assert "robust, as claimed 1</span>" in built[0] and "noise 2</span>" in built[0]
    assert statements_of(built[1] / "index.html") == "2 noise, 1 robust, 1 hangs on a factor, of 4 comparisons"
    assert statements_of(built[1] / "figures" / "index.html") == ""


def test_it_says_all_without_its_script(built):
    body = re.sub(r"<script.*?</script>", "", built[0], flags=re.S)
    assert "<b>measure 0</b> [C0] is lower in CR than in NCR in 20 of 20 readings, as claimed." in body
    assert "measure 2 [C2]; measure 3 [C3]." in body and "of 15</td>" in body  # five readings have no value
    assert body.count("<path data-f=") == 5 and 'class="dots claimed" d="M' in body
    assert "hidden>" in body  # what only a script can do is not shown


def test_no_reading_speaks_for_all(built):
    """Verdicts are shares of the readings that can test a claim, and each verdict's readings are counted."""
    verdicts = built[0].partition('<h2 id="verdicts">')[2].partition("<h2")[0]
    assert "2 claims of" in verdicts and "in each of 20 readings" in verdicts
    assert "holds in most</span> <a href=\"#claim-C1\">C1</a> NCR survives better at first (83 %)." in verdicts
    assert "holds in hardly any</span> <a href=\"#claim-C2\">C2</a>" in verdicts and "(5 %)" in verdicts
    (row,) = re.findall(r'<tr id="claim-C1">.*?</tr>', built[0], re.S)
    assert ">83 %<" in row and "15 direction only, 3 not reproduced, 2 untestable" in row
    assert 'class="v-not" x="15" width="3"' in row and escape(CLAIMS.claims["C1"].says) in row


def test_a_study_of_many_readings_shows_none_of_them(tmp_path, monkeypatch):
    """No verdict, condition or box is of a single reading; here two are many."""
    monkeypatch.setattr("attnlab.report.build.LEAST_READINGS", 2)
    study = tmp_path / "readings"
    for i in range(2):
        for curiosity in ("litman", "none"):
            swept = {"variant": f"r{i} {curiosity}", "reading.need_k": str(1 + i / 10)}
            for seed in range(6):
                write_run(study, curiosity, seed, train=4, validation=2, cycles=20, swept=swept, safety=0.3)
    text = build(study, tmp_path / "out", "dinocera2014", None, True, hands=1).read_text()
    assert "in each of 2 readings" in text and "Claims one by one" not in text and "Conditions shown" not in text
    table = text.partition("Conditions over all readings</h2>")[2].partition("</table>")[0]
    assert table.count("<tr>") == 3 and ">2</td>" in table  # a head and a row for CR and for NCR
    assert len((tmp_path / "out" / "conditions.csv").read_text().splitlines()) == 5


def test_nothing_runs_but_its_script(built):
    html = built[0]
    code = re.findall(r"<script>(.*?)</script>", html, re.S)
    mark = base64.b64encode(hashlib.sha256(code[0].encode()).digest()).decode()
    assert len(code) == 1 and f"script-src 'sha256-{mark}'" in html
    assert "<img" not in html and "<b>1</b>" not in html
    data = json.loads(re.search(r'id="spec-data">(.*?)</script>', html, re.S)[1])
    assert [len(of["d"]) for of in data["curves"]] == [20] * 4 and data["curves"][2]["d"][0] is None


def test_in_a_browser(built, browser):
    """The script draws without a word, in another order when asked, and the page is as narrow as a phone."""
    study = built[1]
    probe = study / "probe.html"
    probe.write_text(PROBE % (study / "index.html").as_uri())
    out, err = browser("--allow-file-access-from-files", "--enable-logging=stderr", "--v=0",
                       "--virtual-time-budget=5000", "--dump-dom", probe.as_uri())
    found = json.loads(re.search(r"<pre id=\"?told\"?>(.*?)</pre>", out, re.S)[1])
    assert found["blocks"][0].count("M") > 1 and found["blocks"][1].count("M") == 1  # sorted, a level is one block
    assert found["title"] == "many" and found["pick"] is False and found["wide"] <= 390
    assert "CONSOLE" not in err, [line for line in err.splitlines() if "CONSOLE" in line]


def test_casualties_and_balance(tmp_path):
    assert kept.section(tmp_path) == (None, "")
    write_decided(tmp_path, DECIDED)
    section, note = kept.section(tmp_path)
    assert not note and "5 of 9 readings were tried" in section.html
    assert "2 are not (survives too little: 2, nobody drinks: 1; some for two reasons); 2 make the study. 1 sound " \
           "ones were not needed." in section.html
    assert "survives 82.00 %" in section.html and "crash=contact" in section.html and "V = 1.00" in section.html


@pytest.mark.parametrize("text", ["", "{}", '{"tried": 3}', "\udcff"])
def test_a_decision_that_cannot_be_read_is_named(tmp_path, text):
    (tmp_path / "readings.json").write_bytes(text.encode(errors="surrogateescape"))
    section, note = kept.section(tmp_path)
    assert section is None and note.startswith("readings.json cannot be read")


def test_every_signed_comparison_against_every_control():
    found = contrasts(CLAIMS)
    own = {of.measure for of in found if of.whom == "NCR"}
    assert len(own) >= 12 and own == {of.measure for of in found if of.whom == "NCR with CR's states"}
    assert len({(of.node, of.whom, of.order) for of in found}) == len(found)
    eat = next(of for of in found if of.measure == "reward (eat, extrinsic)")
    assert (eat.claim, eat.sign, eat.told(1.0), eat.told(-1.0)) == ("C6", -1.0, "lower", "higher")
    convergence = next(of for of in found if of.order)
    assert convergence.told(1.0) == "earlier"
    assert in_words({"name": "episode", "column": "hunger_max", "phase": "train"}) == "hunger max (in training)"


def test_nothing_to_compare_is_said():
    found = planted()
    found.curves = None
    assert "nothing to compare" in told.first_screen(found) and told.sections(found) == []


def test_levels_that_hardly_any_reading_has_are_named():
    """Of ten readings with two levels each, an even share is five: one is a fifth of it, and not fewer."""
    taken = [Tried(f"r{i}", {"speed": "a", "turn": "b" if i else "c"}, 95.0, 1, 1, taken=True) for i in range(10)]
    counts = {"speed": {"a": 10, "b": 0}, "turn": {"b": 9, "c": 1}}
    of = Decided("mark", "", 20, taken, counts, ("speed", "turn", 0.0), 5.0)
    assert kept.pairs(of).startswith("Hardly any sound reading has speed=b (0): of these")
    of.counts["speed"] = {"a": 8, "b": 2}
    assert kept.pairs(of).startswith("Levels of two")

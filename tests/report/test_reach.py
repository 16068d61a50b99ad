"""What the pages must reach, measured in a real browser: sheets, bytes, and no serious fault of accessibility.

axe-core is not installed with anything here. ATTNLAB_AXE names its axe.min.js; without it those tests are skipped.
"""

import json
import os
import re
from html import escape, unescape
from pathlib import Path

import pytest

from attnlab.report import compare
from attnlab.report.build import build
from attnlab.report.shelf import build as shelve
from tests.replay.test_replay import live
from tests.report.small_study import write_study

pytestmark = pytest.mark.long
AXE = os.environ.get("ATTNLAB_AXE", "")
needs_axe = pytest.mark.skipif(not AXE, reason="ATTNLAB_AXE names no axe.min.js: npm install --prefix DIR axe-core")
PAGES = ("report", "index", "against", "many", "tune", "replay", "replay of two")
RUN = """<script>%s</script><script>axe.run(document, {resultTypes: ["violations"]}).then(function (found) {
  document.documentElement.dataset.axe = JSON.stringify(found.violations.map(function (of) {
    return [of.impact, of.id, of.nodes.map(function (node) { return node.html.slice(0, 200); })];
  }));
});</script>"""
PROBE = """<!doctype html><meta charset="utf-8"><title>probe</title>%s<pre id="told"></pre><script>
setInterval(function () {
  var told = Array.from(document.querySelectorAll("iframe")).map(function (of) {
    return of.contentDocument.documentElement.dataset.axe;
  });
  if (told.every(Boolean)) document.getElementById("told").textContent = JSON.stringify({
    dark: matchMedia("(prefers-color-scheme: dark)").matches, faults: told.map(JSON.parse)});
}, 200);
</script>"""
WIDTHS = (390, 768, 1280)


@pytest.fixture(scope="module")
def forty(tmp_path_factory) -> dict[str, Path]:
    """Studies of 40 runs as long as the paper's, with their reports: two conditions, and eight."""
    home = tmp_path_factory.mktemp("forty")
    length = {"train": 500, "validation": 100, "cycles": 1150}
    studies = [write_study(home / "two", 20, safety=0.3, **length),
               write_study(home / "eight", 5, ("litman", "none", *(f"rule{i}" for i in range(6))), **length)]
    return {study.name: build(study, None, None, None, True) for study in studies}


@pytest.fixture(scope="module")
def pages(forty, tmp_path_factory) -> dict[str, Path]:
    """A page of every kind."""
    from attnlab.replay.__main__ import main
    from attnlab.report.tuned import Seen, Trial, Tuned
    from attnlab.report.tuned import page as tuned_page
    from tests.report.test_multiverse_page import planted, write_page
    home = tmp_path_factory.mktemp("pages")
    runs = [live(home / curiosity, max_cycles=1500, curiosity=curiosity) for curiosity in ("litman", "none")]
    for name, more in (("replay", []), ("replay of two", ["--with", str(runs[1])])):
        assert main([str(runs[0]), *more, "--out", str(home / f"{name}.html")]) == 0
    trials = [Trial(i, {"a": str(i), "b": "xy"[i % 2]}, 90.0 + i, {0: 90.0 + i, 1: 90.0 + i}) for i in range(1, 12)]
    (home / "tune.html").write_text(tuned_page(Tuned(
        "tuning", "survival", "%", False, "0-1", 12, [Seen("a", (), 1, 20), Seen("b", ("x", "y"))],
        [*trials, Trial(12, {"a": "2", "b": "x"}, None, {}, "it failed")], {"a": 0.7, "b": 0.3}, "python",
        {trial.number: "python" for trial in trials})))
    return {"report": forty["eight"], "index": shelve(forty["two"].parents[2], None),
            "against": compare(forty["two"].parents[1], forty["eight"].parents[1]),
            "many": write_page(planted(), home / "many"), **{name: home / f"{name}.html" for name in PAGES[4:]}}


@pytest.mark.parametrize("study", ["two", "eight"])
def test_a_report_of_forty_runs(forty, browser, tmp_path, study):
    """Two megabytes at most, and ten sheets of A4."""
    page = forty[study]
    assert page.stat().st_size <= 2_000_000
    browser(f"--print-to-pdf={tmp_path / 'page.pdf'}", page.as_uri())
    pdf = (tmp_path / "page.pdf").read_bytes()
    sheets = re.findall(rb"/Type\s*/Page\b", pdf)
    boxes = {tuple(map(float, box.split())) for box in re.findall(rb"/MediaBox\s*\[([^\]]*)\]", pdf)}
    assert 1 <= len(sheets) <= 10 and all(abs(w - 595) < 2 and abs(h - 842) < 2 for _, _, w, h in boxes), (
        len(sheets), boxes)


def faults(page: str, browser, home: Path, dark: bool) -> list[list]:
    """What axe-core finds serious or critical on a page (HTML) on a phone, a tablet and a desk. The copy that it looks
    at has no policy, which would not let axe run."""
    text, policies = re.subn(r'<meta http-equiv="Content-Security-Policy"[^>]*>', "", page)
    script = Path(AXE).read_text().replace("</script", "<\\/script")
    (home / "page.html").write_text(text.replace("</body>", RUN % script + "</body>"))
    frames = "".join(f'<iframe title="{width}" src="{escape((home / "page.html").as_uri())}" '
                     f'style="width:{width}px;height:1500px"></iframe>' for width in WIDTHS)
    (home / "probe.html").write_text(PROBE % frames)
    out, _ = browser("--allow-file-access-from-files", "--virtual-time-budget=60000",
                     f"--blink-settings=preferredColorScheme={int(not dark)}", "--dump-dom",
                     (home / "probe.html").as_uri())
    told = json.loads(unescape(re.search(r'<pre id="told">(.*?)</pre>', out, re.S)[1]))
    assert policies == 1 and len(told["faults"]) == len(WIDTHS) and told["dark"] is dark
    return [fault for found in told["faults"] for fault in found if fault[0] in ("serious", "critical")]


@needs_axe
@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("name", PAGES)
def test_no_serious_fault_of_accessibility(pages, browser, tmp_path, name, scheme):
    assert faults(pages[name].read_text(), browser, tmp_path, scheme == "dark") == []


@needs_axe
def test_axe_would_notice(pages, browser, tmp_path):
    """A field without a name, a picture without words, letters that can hardly be seen."""
    page = pages["tune"].read_text().replace("</main>", '<p><input><img src="data:,"></p><p style="color:#777; '
                                             'background:#888">faint</p></main>')
    assert {fault[1] for fault in faults(page, browser, tmp_path, False)} == {"label", "image-alt", "color-contrast"}

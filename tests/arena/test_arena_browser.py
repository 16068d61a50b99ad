"""The page in a headless Chromium: any column sorts, and the slider scores the same runs again as Python does."""

import html
import json
import re
from pathlib import Path

from attnlab.arena.board import read_board
from attnlab.arena.summary import as_data, kept, order, standings
from attnlab.arena.words import percent

RESULTS = Path(__file__).resolve().parents[2] / "docs" / "results" / "arena"
PLACE, PRICE = "world paper", 1.5
PROBE = """<pre id="told"></pre><script>
slider.value = %s; slider.oninput();
const part = () => document.querySelector('[data-place="%s"]');
const rows = () => [...part().querySelector("table").querySelectorAll("tbody tr")].map(row => [...row.children].map(
  cell => cell.textContent));
const press = name => [...part().querySelectorAll("th button")].find(button => button.textContent === name).click();
const told = { said: part().querySelector("p").textContent, score: rows(), data: data.places["%s"] };
for (const name of ["harm %%", "looks %%", "way"]) {
  press(name);
  told[name] = rows();
  press(name);
  told[`${name} back`] = rows();
}
document.getElementById("told").textContent = JSON.stringify(told);
</script>"""


def test_columns_sort_and_the_slider_scores_the_same_runs_again(browser, tmp_path):
    page = (RESULTS / "report.html").read_text()
    (tmp_path / "p.html").write_text(page.replace("</body>", PROBE % (PRICE, PLACE, PLACE) + "</body>"))
    out, err = browser("--dump-dom", (tmp_path / "p.html").as_uri())
    match = re.search(r'<pre id="told">(.*?)</pre>', out, re.DOTALL)
    assert match, err
    told = json.loads(html.unescape(match[1]))
    found = standings([row for row in read_board(RESULTS / "leaderboard.jsonl") if row.place == PLACE])
    assert told["data"] == json.loads(json.dumps(as_data(found)))
    assert [row[0] for row in told["score"] if row[1]] == order(found, PRICE)
    assert [row[1] for row in told["score"] if row[1]] == [str(i + 1) for i in range(len(order(found, PRICE)))]
    shares = [f"{100 * kept(found, PRICE, other):.0f} %" for other in (PRICE / 2, PRICE * 2)]
    assert told["said"] == (f"First at this price: {order(found, PRICE)[0]}. Pairs of ways that keep their order at "
                            f"half the price: {shares[0]}; at twice: {shares[1]}.")
    for name, value in (("harm %", lambda s: s.harm[0]), ("looks %", lambda s: s.looks[0]), ("way", lambda s: s.way)):
        up = [s.way for s in sorted(found, key=lambda s: (value(s), s.way))]
        assert [row[0] for row in told[name]] == up
        assert {row[0] for row in told[f"{name} back"][:3]} <= set(up[-4:])
    assert percent(found[0].harm[0]) == told["harm %"][0][4].split()[0]

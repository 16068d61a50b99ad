"""The page in a real headless Chromium: no console messages, every image shown, nothing asked of the network."""

import re

PROBE = """
<!doctype html><meta charset="utf-8"><iframe id="page" src="%s" style="width:1100px;height:2000px"></iframe>
<pre id="told"></pre><script>
document.getElementById('page').onload = function () {
  var page = this.contentDocument, images = Array.from(page.images);
  var asked = this.contentWindow.performance.getEntriesByType('resource').map(e => e.name)
      .filter(n => !n.startsWith('data:'));
  document.getElementById('told').textContent = JSON.stringify({
    images: images.length, asked: asked, shown: images.filter(i => i.complete && i.naturalWidth > 200).length,
    wide: page.documentElement.scrollWidth, scripts: page.scripts.length});
};
</script>
"""


def test_no_console_errors_and_all_images(built, browser, tmp_path):
    import json
    (tmp_path / "probe.html").write_text(PROBE % (built / "index.html").as_uri())
    out, err = browser("--allow-file-access-from-files", "--enable-logging=stderr", "--v=0",
                       "--virtual-time-budget=10000", "--dump-dom", (tmp_path / "probe.html").as_uri())
    told = json.loads(re.search(r'<pre id="told">(.*?)</pre>', out, re.S)[1])
    assert told["images"] == told["shown"] == 10
    assert told["asked"] == [] and told["scripts"] == 1
    assert told["wide"] <= 1100  # nothing sticks out sideways
    assert "CONSOLE" not in err, [line for line in err.splitlines() if "CONSOLE" in line]


def test_the_probe_would_notice(browser, tmp_path):
    """A page with a script that is refused and a picture from the network does leave traces."""
    (tmp_path / "bad.html").write_text(
        "<meta http-equiv=Content-Security-Policy content=\"default-src 'none'; img-src data:\"><h1>x</h1>"
        "<img src='http://127.0.0.1:9/x.png'><script>alert(1)</script>")
    (tmp_path / "probe.html").write_text(PROBE % (tmp_path / "bad.html").as_uri())
    out, err = browser("--allow-file-access-from-files", "--enable-logging=stderr", "--v=0",
                       "--virtual-time-budget=5000", "--dump-dom", (tmp_path / "probe.html").as_uri())
    assert "CONSOLE" in err and '"shown":0' in out


def test_hostile_names_run_nothing(browser, tmp_path):
    from attnlab.report.build import build
    from tests.report.small_study import write_run
    hostile = "<img src=x onerror=\"document.title='owned'\"><script>document.title='owned'</script>"
    study = tmp_path / "study"
    write_run(study, "none", 0, labels={"none": hostile}, swept={"learner": hostile}, name="<svg onload=alert(1)>")
    page = build(study, None, "dinocera2014", None, True, only=())
    out, err = browser("--enable-logging=stderr", "--v=0", "--virtual-time-budget=3000", "--dump-dom", page.as_uri())
    assert re.search(r"<title>(.*?)</title>", out)[1] == "study: what was found"
    assert "<img" not in out and out.count("<script") == 1 and "CONSOLE" not in err


USED = """
<!doctype html><meta charset="utf-8"><iframe id="page" src="%s" style="width:1100px;height:2000px"></iframe>
<pre id="told"></pre><script>
document.getElementById('page').onload = function () {
  var page = this.contentDocument, view = this.contentWindow, told = {};
  var claims = page.querySelector('table.claims'), ids = () => Array.from(claims.tBodies[0].rows)
      .filter(r => r.getClientRects().length).map(r => r.id.slice(6));
  var sort = Array.from(claims.querySelectorAll('button.sort')).find(b => b.textContent === 'effect d');
  sort.click();
  told.up = ids().slice(0, 3);
  told.sorted = sort.parentNode.getAttribute('aria-sort');
  told.effects = Array.from(claims.tBodies[0].rows).map(r => r.cells[3].textContent);
  sort.click();
  told.down = Array.from(claims.tBodies[0].rows).map(r => r.cells[3].textContent);
  var field = claims.closest('.scroll').previousElementSibling.querySelector('input');
  field.value = 'safety minimum';
  field.dispatchEvent(new view.Event('input'));
  told.filtered = ids();
  var plot = page.querySelector('#fig06_survival .plot'), img = plot.querySelector('img');
  var at = JSON.parse(plot.dataset.values)[0].lines[0].at[2], box = img.getBoundingClientRect();
  function point() {
    plot.dispatchEvent(new view.PointerEvent('pointermove', {bubbles: true,
        clientX: box.left + at[0] / 1000 * box.width, clientY: box.top + at[1] / 1000 * box.height}));
    return plot.querySelector('.tip').innerText;
  }
  told.at = at;
  told.tip = point();
  var map = page.querySelector('#policies .plot'), cells = JSON.parse(map.dataset.values)[0].cells, area;
  area = map.querySelector('img').getBoundingClientRect();
  map.dispatchEvent(new view.PointerEvent('pointermove', {bubbles: true,
      clientX: area.left + (cells.across[2] + 2) / 1000 * area.width,
      clientY: area.top + (cells.up[1] + 2) / 1000 * area.height}));
  told.cell = map.querySelector('.tip').innerText;
  map.dispatchEvent(new view.KeyboardEvent('keydown', {key: 'ArrowRight', cancelable: true}));
  told.first = map.querySelector('.tip').innerText;
  var row = page.querySelector('.forest svg'), mark = row.querySelector('circle.seed');
  area = row.getBoundingClientRect();
  row.dispatchEvent(new view.PointerEvent('pointermove', {bubbles: true, clientY: area.top + 3,
      clientX: area.left + mark.getAttribute('cx') / row.viewBox.baseVal.width * area.width}));
  told.seed = [row.parentNode.querySelector('.tip').textContent, mark.textContent];
  var before = img.src, ncr = Array.from(page.querySelectorAll('#shown input'))[1];
  ncr.click();
  told.without = point();
  told.rows = Array.from(page.querySelectorAll('.forest tbody tr')).filter(r => r.getClientRects().length).length;
  told.redrawn = img.src !== before && decodeURIComponent(img.src).split('display="none"').length - 1;
  ncr.click();
  told.back = img.src === before;
  document.getElementById('told').textContent = JSON.stringify(told);
};
</script>
"""


def test_tables_and_figures_answer(built, browser, tmp_path):
    """Sorted, filtered, told at the pointer, hidden and back: on the page as it is, under its own policy."""
    import json
    (tmp_path / "probe.html").write_text(USED % (built / "index.html").as_uri())
    out, err = browser("--allow-file-access-from-files", "--enable-logging=stderr", "--v=0",
                       "--virtual-time-budget=10000", "--dump-dom", (tmp_path / "probe.html").as_uri())
    told = json.loads(re.search(r'<pre id="told">(.*?)</pre>', out, re.S)[1])
    numbers = [float(text.replace("∞", "inf").replace("−", "-")) for text in told["effects"] if text != "-"]
    assert told["sorted"] == "ascending" and len(numbers) > 5 and numbers == sorted(numbers)
    assert set(told["effects"][len(numbers):]) == set(told["down"][len(numbers):]) == {"-"}
    assert told["down"][:len(numbers)] == told["effects"][:len(numbers)][::-1] or len(set(numbers)) < len(numbers)
    assert told["filtered"] == ["C19"]
    assert told["tip"].startswith("training episodes") and f"CR {told['at'][3]}" in told["tip"] and "NCR" in told["tip"]
    assert "[" in told["tip"]  # with the ends of its band
    assert told["cell"].startswith("percept 3, CR, LH · AVOID") and "seeds that visited it" in told["cell"]
    assert told["first"].startswith("percept 1, CR, low · AVOID")  # by the keys, cell after cell
    assert told["seed"][0] == told["seed"][1] != ""
    assert "NCR" not in told["without"] and "CR" in told["without"] and told["rows"] == 1
    assert told["redrawn"] == 2 and told["back"] is True  # its line and its band
    assert "CONSOLE" not in err, [line for line in err.splitlines() if "CONSOLE" in line]

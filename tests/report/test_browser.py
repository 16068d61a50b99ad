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
    assert told["asked"] == [] and told["scripts"] == 0
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
    assert "<img" not in out and "<script" not in out and "CONSOLE" not in err

"""The page in a real headless Chromium: it lives episodes as Python does, moves fast, and its console stays empty."""

import json
import os
import re
import shutil
import subprocess
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import numpy as np
import pytest

from attnlab.replay.__main__ import main
from attnlab.replay.again import live_again
from attnlab.replay.page import HERE
from attnlab.replay.track import open_run, track_of
from attnlab.robot.episode import run_episode
from attnlab.robot.folder import run_to_folder
from attnlab.testing import config

FIXED = {"avoid": 12, "eat": 4, "drink": 8}
# Every branch of the page's copy: curious or not, both states of NCR, food that runs out, both crash rules, laws of
# speed and turning, who counts as active, energy that kills, is cut or carried over, needs that kill, turned boxes.
CASES = {
    "curious": {"max_cycles": 1150, "train_episodes": 12},
    "plain": {"curiosity": "none", "max_cycles": 1150, "seed": 3},
    "same_states": {"curiosity": "none", "how": {"non_curious": "same_states", "active": "released",
                                                 "speed_law": "proportional", "turn_rule": "sum"}, "seed": 5},
    "table4": {"max_cycles": 1500, "how": {"crash": "safety_distance", "percept_domain": "min_to_max", "need_k": 1.3,
                                           "novelty_counts_current": True, "need_start": 700.0}, "seed": 1},
    "hungry": {"how": {"food_supply": "depletion", "food_portions": 1, "need_start": 1200.0, "meal_interval_cycles": 3,
                       "needs_floored": True, "energy_clipped": True}, "seed": 2, "max_cycles": 1150},
    "tired": {"how": {"food_supply": "respawn", "food_portions": 1, "food_respawn_cycles": 60, "energy_death": True,
                      "energy_start": 1500.0, "energy_carry_over": True, "novelty_persists": True,
                      "need_start": 800.0}, "seed": 7, "max_cycles": 1150, "learner": "double_q"},
    "wandering": {"learner": "fixed_4", "max_cycles": 1150, "seed": 6, "world": {
        "name": "layout", "sources": {"supply": "wandering", "portions": 1},
        "boxes": [{"kind": "food", "x_m": 0.4, "y_m": 1.0}, {"kind": "food", "x_m": 3.0, "y_m": 3.4},
                  {"kind": "water", "x_m": 3.0, "y_m": 1.0}, {"kind": "water", "x_m": 0.4, "y_m": 3.0}]}},
    "fixed": {"learner": {"name": "fixed", "periods": FIXED}, "max_cycles": 1150, "seed": 4,
              "world": {"name": "layout", "boxes": [{"kind": "obstacle", "x_m": 1.4, "y_m": 2.5, "yaw_rad": 0.5},
                                                    {"kind": "food", "x_m": 0.4, "y_m": 1.0, "yaw_rad": 0.2},
                                                    {"kind": "water", "x_m": 3.0, "y_m": 2.0}]}},
}
LIVE = """<!doctype html><meta charset="utf-8"><pre id="told"></pre><script>%s</script><script>
const cases = %s;
document.getElementById("told").textContent = JSON.stringify(Object.fromEntries(Object.entries(cases).map(
  ([name, [track, world, changes]]) => {
    const lived = liveEpisode(track.model, world.solids, changes);
    return [name, { ...lived, found: compare(lived, track) }];
  })));
</script>"""
BACK = """<script>fetch("/told", {method: "POST", body: document.getElementById("told").textContent});</script>"""
CODE = "".join((HERE / name).read_text() for name in ("plane.js", "live.js"))
FIREFOX = shutil.which("firefox-esr") or shutil.which("firefox")
PROBE = """<!doctype html><meta charset="utf-8"><iframe id="page" src="%s" style="width:%dpx;height:3000px"></iframe>
<pre id="told"></pre><script>
document.getElementById("page").onload = function () {
  const page = this.contentDocument, view = this.contentWindow, shown = page.getElementById("words").textContent;
  const first = view.performance.getEntriesByType("navigation")[0], times = [];
  for (let i = 0; i < 60; i++) {
    const start = performance.now();
    view.seek((i * 97) %% 1500);
    page.documentElement.getBoundingClientRect();  // styles and layout are worked out
    times.push(performance.now() - start);
  }
  const key = (key, more = {}) => page.body.dispatchEvent(
    new view.KeyboardEvent("keydown", { key, bubbles: true, ...more }));
  const at = () => Number(page.getElementById("scrub").value);
  view.seek(100); key("ArrowRight"); key("ArrowRight", { shiftKey: true });
  const arrows = at(); key("Home"); key("m"); const meal = at(); key("End"); const end = at(); key("M");
  const before = at(); view.seek(0); key("s"); const surprise = at(); key("d");
  const spoken = page.getElementById("words").textContent;
  view.checkItself();
  view.seek(50);
  page.getElementById("choice").value = "0";
  page.getElementById("choice").dispatchEvent(new view.Event("change"));
  page.getElementById("v").value = "12";
  page.getElementById("whatform").requestSubmit();
  const names = Array.from(page.querySelectorAll("button, input, select, [tabindex]")).filter(node =>
    !(node.textContent.trim() || node.getAttribute("aria-label") || node.closest("label")));
  document.getElementById("told").textContent = JSON.stringify({ shown, times, arrows, meal, end, before, surprise,
    spoken, frame: first.domComplete || performance.now(), wide: page.documentElement.scrollWidth,
    asked: view.performance.getEntriesByType("resource").map(e => e.name).filter(n => !n.startsWith("data:")),
    check: page.getElementById("check").textContent, changes: page.getElementById("changes").textContent,
    panes: page.querySelectorAll(".pane").length, nameless: names.map(node => node.outerHTML) });
};
</script>"""


def told(out):
    import html
    return json.loads(html.unescape(re.search(r'<pre id="told">(.*?)</pre>', out, re.S)[1]))


def live(folder, **settings):
    chosen = config(**{"train_episodes": 4, "validation_episodes": 2, "max_cycles": 600, "record": "last", **settings})
    assert run_to_folder(chosen, folder, {"run": folder.name, "key": "k", "overrides": [], "swept": {}})
    return folder


def python_track(folder):
    """(run, its last episode's track, that episode lived again)."""
    run = open_run(folder)
    lived = live_again(run.plan, folder, "validation", 1)
    track = track_of(run, "validation", 1, lived.cycles, lived, notes := [])
    assert track["model"] and not notes, (track["why"], notes)
    return run, track, lived


def world(run):
    from attnlab.replay.page import world_of
    from attnlab.simulators.robot import SONARS
    return world_of(run.plan.layout, SONARS)


def chromium(browser, page):
    return browser("--allow-file-access-from-files", "--enable-logging=stderr", "--v=0", "--dump-dom", page.as_uri())


def lived_by_python(home):
    """(runs, cases that a page is to live, the cycles of the pinned one)."""
    runs = {name: python_track(live(home / name, **settings)) for name, settings in CASES.items()}
    cases = {name: [track, world(run), []] for name, (run, track, _) in runs.items()}
    # one change that Python can make too: another period for everybody, from the first cycle on
    run, track, _ = runs["curious"]
    cases["pinned"] = [track, world(run), [{"at": 0, "what": "period", "behaviour": name, "period": period}
                                           for name, period in FIXED.items()]]
    return runs, LIVE % (CODE, json.dumps(cases)), pinned(run)


def agree(found, runs, poses):
    """Poses within 1e-9 m over whole episodes, and the same clocks, percepts, levels, periods, meals and ends."""
    for name, (_, _, lived) in runs.items():
        mine, cycles = found[name], lived.cycles
        assert mine["n"] == len(cycles) and mine["death"] == lived.death and mine["found"]["same"], name
        for short, column, within in (("x", "x_m", 1e-9), ("y", "y_m", 1e-9), ("h", "heading_rad", 1e-8),
                                      ("energy", "energy", 1e-6), ("safety", "safety", 1e-8),
                                      ("held", "safety_held", 1e-8), ("wanting", "wanting", 1e-9)):
            assert np.abs(np.array(mine[short]) - cycles[column].to_numpy()).max() < within, (name, column)
        for i, need in enumerate(("hunger", "thirst")):
            assert np.allclose(mine["needs"][i], cycles[need], atol=1e-6), (name, need)
    assert len(runs["curious"][2].cycles) >= 1000
    deaths = {name: track["death"] for name, (_, track, _) in runs.items()}
    assert len(set(deaths.values())) >= 3 and sum(len(track["meals"]) for _, track, _ in runs.values()) > 10, deaths
    assert found["pinned"]["n"] == len(poses) != 0 and found["pinned"]["found"]["same"] is False
    assert np.abs(np.array(found["pinned"]["x"]) - poses[:, 0]).max() < 1e-9


def test_the_page_lives_episodes_as_python_does(browser, tmp_path):
    runs, page, poses = lived_by_python(tmp_path)
    (tmp_path / "live.html").write_text(page)
    out, err = chromium(browser, tmp_path / "live.html")
    assert "CONSOLE" not in err, err
    agree(told(out), runs, poses)


@pytest.mark.long
@pytest.mark.skipif(FIREFOX is None, reason="firefox is not installed (Debian: apt-get install firefox-esr)")
def test_so_it_does_in_firefox(tmp_path):
    """A browser with arithmetic of its own: what its page says comes back to a server of this test."""
    runs, page, poses = lived_by_python(tmp_path)
    came, said = threading.Event(), []

    class Home(BaseHTTPRequestHandler):
        def do_GET(self):
            body = (page + BACK).encode() if self.path == "/" else b""
            self.send_response(200)
            self.send_header("Content-Type", "text/html; charset=utf-8")
            self.end_headers()
            self.wfile.write(body)

        def do_POST(self):
            said.append(self.rfile.read(int(self.headers["Content-Length"])))
            self.send_response(204)
            self.end_headers()
            came.set()

        def log_message(self, *_):
            pass
    server = ThreadingHTTPServer(("127.0.0.1", 0), Home)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    (tmp_path / "profile").mkdir()
    firefox = subprocess.Popen([FIREFOX, "--headless", "--no-remote", "--profile", str(tmp_path / "profile"),
                                f"http://127.0.0.1:{server.server_port}/"], env={**os.environ, "HOME": str(tmp_path)},
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        assert came.wait(240), "Firefox did not answer"
    finally:
        firefox.terminate()
        firefox.wait()
        server.shutdown()
        server.server_close()
    agree(json.loads(said[0]), runs, poses)


def pinned(run):
    """The poses of the run's last episode when all periods are fixed, from the same stream states."""
    before = live_again(run.plan, run.folder, "validation", 1).before
    with run.plan.simulator() as simulator:
        agent = run.plan.agent(simulator, {"name": "fixed", "periods": FIXED})
        for attention, state in zip(agent.attentions, before["behaviours"], strict=True):
            attention.behaviour.draw.setstate((3, tuple(state["stream"]), None))
        run_episode(agent, run.plan.exploration("validation"), run.plan.start_pose("validation", 1), False)
        return simulator.trace[1:simulator.cycle + 1].copy()


def test_the_copy_is_no_rubber_stamp(browser, tmp_path):
    """A page whose copy of AVOID differs by a hair does not live the same episode."""
    run, track, _ = python_track(live(tmp_path / "run"))
    wrong = CODE.replace("d < self.active_m", "d < self.active_m - 0.001")
    assert wrong != CODE
    (tmp_path / "live.html").write_text(LIVE % (wrong, json.dumps({"run": [track, world(run), []]})))
    found = told(chromium(browser, tmp_path / "live.html")[0])["run"]["found"]
    assert found["pose_m"] is None or found["pose_m"] > 1e-9  # infinite (null in JSON) if another number of cycles


@pytest.mark.parametrize("width", [390, 1280])
def test_the_page_moves_and_is_quiet(browser, tmp_path, width):
    run = live(tmp_path / "run", max_cycles=1500, how={"need_start": 800.0}, seed=0)
    assert main([str(run)]) == 0
    page = run / "replay.html"
    assert page.stat().st_size <= 2_000_000
    (tmp_path / "probe.html").write_text(PROBE % (page.as_uri(), width))
    out, err = chromium(browser, tmp_path / "probe.html")
    assert "CONSOLE" not in err, [line for line in err.splitlines() if "CONSOLE" in line]
    found = told(out)
    assert np.median(found["times"]) < 50 and found["frame"] < 5000  # ms; 1 s on a quiet machine, which CI is not
    assert found["asked"] == [] and found["wide"] <= width and found["nameless"] == []
    assert found["shown"] and (found["arrows"], found["end"]) == (111, 1500)
    assert 0 < found["meal"] <= found["before"] < 1500 and found["surprise"] > 0
    assert "lived the episode by itself" in found["check"] and found["panes"] == 2
    assert "avoid every 12 from cycle 50 on" in found["changes"]


def test_the_page_without_script_is_readable(tmp_path):
    """What a browser without script shows: a line that says so, the episode in words, its meals."""
    run = live(tmp_path / "run", how={"need_start": 800.0}, max_cycles=1150)
    main([str(run), "--quick"])
    words = re.search(r"<noscript>(.*?)</noscript>", (run / "replay.html").read_text(), re.S)[1]
    assert 'class="behind" points="' in words and words.count("<rect") == 9  # the floor, four walls, four boxes
    assert "runs no script" in words and "looks: avoid" in words and "<td>thirst</td>" in words

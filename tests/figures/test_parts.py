"""Figures are parts: one file adds one, and one that fails takes nothing else down."""

import re

import matplotlib.pyplot as plt
import pytest

from attnlab import registry
from attnlab.errors import ConfigError
from attnlab.figures.base import Figure, FigureContext, gallery, make
from attnlab.figures.style import own_colours
from attnlab.report import build_report
from attnlab.report.build import build
from attnlab.report.captions import load_captions
from attnlab.testing import checks
from attnlab.testing.study import conditions

PLUGIN = '''
"""Mine: a figure of somebody's own."""
from attnlab.figures.base import Figure
from attnlab.figures.curves import one_curve
from attnlab.registry import register


@register("figure", "mine")
class Mine(Figure):
    """The length of the path."""
    title, order = "my <own> figure", 65

    def draw(self, conditions):
        return one_curve(conditions, "Path", "path_m", 10, "m")

    def say(self, conditions):
        return "It is there."


@register("figure", "broken")
class Broken(Mine):
    """One that fails."""
    title, order = "broken figure", 66

    def draw(self, conditions):
        raise ValueError("no <such> thing")
'''


class Own(Figure):
    """An empty picture."""
    title = "own"

    def draw(self, conditions):
        return plt.figure()

    def say(self, conditions):
        return "Nothing."


@pytest.fixture
def registered(monkeypatch):
    def put(cls, name="own"):
        monkeypatch.setitem(registry.parts, ("figure", name), registry.Spec("figure", name, cls, {}, __file__))
    return put


@pytest.fixture(scope="module")
def folder():
    return conditions().study.path


def test_their_order_and_names():
    assert gallery()[:4] == ["steps", "budget_front", "phase_map", "held_levels"]  # of our own studies, each its own
    names = gallery()[4:]
    assert names == ["survival", "rewards", "needs", "maximum_need", "safety", "energy", "paths", "policies",
                     "attention_raster", "attention_economics"]
    figures = [make(name, FigureContext()) for name in names]
    assert [figure.key for figure in figures] == [
        "fig06_survival", "fig07_rewards", "fig08a_needs", "fig08b_maximum_need", "fig09_safety", "fig10_energy",
        "fig11_paths", "policies", "attention_raster", "attention_economics"]
    assert figures[2].heading == "Fig 8A: needs within an episode" and figures[7].heading == "Learned policies"


def test_a_plugin_adds_one_and_a_broken_one_is_named(attnlab, tmp_path, folder):
    (tmp_path / "plugins").mkdir()
    (tmp_path / "plugins" / "mine.py").write_text(PLUGIN)
    done = attnlab(str(folder), "--out", "out", module="attnlab.report")
    assert done.returncode == 0, done.stderr
    page = (tmp_path / "out" / "index.html").read_text()
    places = [page.index(f'id="{key}"') for key in ("fig06_survival", "mine", "broken", "fig07_rewards", "policies")]
    assert places == sorted(places) and "my &lt;own&gt; figure" in page
    assert (tmp_path / "out" / "figures" / "mine.png").is_file()
    assert not (tmp_path / "out" / "figures" / "broken.png").exists()
    assert "<b>Not drawn:</b> plugins/mine.py: ValueError: no &lt;such&gt; thing" in page
    assert "mind     the figure 'broken figure' is not drawn: plugins/mine.py: ValueError: no <such> thing" in \
        done.stdout


@pytest.mark.parametrize(("change", "why"), [
    ({"draw": lambda self, conditions: None}, "TypeError: draw() gave None, not a matplotlib figure"),
    ({"say": lambda self, conditions: 1 / 0}, "ZeroDivisionError"),
    ({"applies": lambda self, conditions: 1 / 0}, "ZeroDivisionError"),
    ({"__init__": lambda self, params, context: 1 / 0}, "ZeroDivisionError")])
def test_however_one_fails(registered, folder, tmp_path, change, why):
    registered(type("Failing", (Own,), change))
    page = build(folder, tmp_path / "out", None, None, True, only=("own", "safety")).read_text()
    assert re.search(rf"<b>Not drawn:</b> \S*test_parts.py: {re.escape(why)}", page)
    assert (tmp_path / "out" / "figures" / "fig09_safety.png").is_file()
    assert not (tmp_path / "out" / "figures" / "own.png").exists()


def test_one_that_does_not_apply_is_left_out(registered, folder, tmp_path):
    registered(type("Elsewhere", (Own,), {"applies": lambda self, conditions: len(conditions.curiosities) > 2}))
    page = build(folder, tmp_path / "out", None, None, True, only=("own", "safety")).read_text()
    assert 'id="own"' not in page and 'id="fig09_safety"' in page


def test_every_shipped_figure_is_drawn(folder, tmp_path):
    assert "Not drawn" not in build_report(folder, tmp_path / "out", quiet=True).read_text()


def test_baselines_reach_a_figure(registered, folder, tmp_path):
    registered(type("Asks", (Own,), {"say": lambda self, conditions: f"{self.context.baselines is not None}."}))
    for baselines, said in ((None, "False."), (folder, "True.")):
        page = build(folder, tmp_path / said, None, baselines, True, only=("own",)).read_text()
        assert f"<b>Here:</b> {said}" in page


@pytest.mark.parametrize(("change", "check"), [
    ({"title": " "}, "has_its_place"), ({"draw": lambda self, conditions: None}, "draws_any_study"),
    ({"draw": lambda self, conditions: plt.figure(figsize=(len(conditions.strata) and 3, 2))}, "draws_any_study"),
    ({"say": lambda self, conditions: "no sentence"}, "says_a_sentence"),
    ({"say": lambda self, conditions: ""}, "says_a_sentence"),
    ({"say": lambda self, conditions: f"{__import__('random').random()}."}, "same_bytes")])
def test_the_suite_finds_a_bad_figure(registered, change, check):
    registered(type("Bad", (Own,), change))
    with pytest.raises((AssertionError, ValueError)):
        checks("figure")[check]("own")


# captions

RULES = ("roles: {treatment: {where: {curiosity: none}}}\nclaims: {c: {title: t, where: w, says: s, parts: [{measure: "
         "survival, test: level, direction: higher, reference: 9, unit: '%'}]}}\n")


def test_captions_of_the_paper(folder, tmp_path):
    from attnlab.claims import claims_path
    captions = load_captions(claims_path("dinocera2014"))
    assert set(captions) == set(gallery()[4:]) - {"attention_raster"}  # the paper has nothing of these
    page = build(folder, tmp_path / "out", None, None, True, only=("paths",)).read_text()
    assert "<b>The paper says:</b> CR&#x27;s traces of 500 episodes cover 50 %" in page and "Shade: visits" in page


def test_a_claims_file_by_path_has_its_captions_beside_it(folder, tmp_path):
    claims = tmp_path / "dinocera2014.yaml"  # the name of another paper's file, in another place
    claims.write_text(RULES)
    page = build(folder, tmp_path / "bare", str(claims), None, True, only=("paths",)).read_text()
    assert "<b>The paper says:</b>" not in page and "Shade: visits" in page
    (tmp_path / "dinocera2014.captions.yaml").write_text("paths: A <map> of theirs.\n")
    page = build(folder, tmp_path / "told", str(claims), None, True, only=("paths",)).read_text()
    assert "<b>The paper says:</b> A &lt;map&gt; of theirs." in page


def test_captions_by_name_in_a_plugins_folder(folder, tmp_path, monkeypatch):
    for group in ("claims", "captions"):
        (tmp_path / group).mkdir()
    (tmp_path / "claims" / "theirs.yaml").write_text(RULES)
    (tmp_path / "captions" / "theirs.yaml").write_text("survival: They lived.\n")
    monkeypatch.setenv("ATTNLAB_PLUGINS", str(tmp_path))
    page = build(folder, tmp_path / "out", "theirs", None, True, only=("survival",)).read_text()
    assert "<b>The paper says:</b> They lived." in page


@pytest.mark.parametrize(("text", "problem"), [
    ("survivl: x\n", "Did you mean 'survival'"), ("survival: 3\n", "expected a text"), ("- a\n", "names no figures"),
    ("a: [\n", "no readable YAML")])
def test_wrong_captions_are_a_config_error_and_nothing_is_written(folder, tmp_path, text, problem):
    (tmp_path / "mine.yaml").write_text(RULES)
    (tmp_path / "mine.captions.yaml").write_text(text)
    with pytest.raises(ConfigError, match=problem):
        build(folder, tmp_path / "out", str(tmp_path / "mine.yaml"), None, True)
    assert not (tmp_path / "out").exists()


def test_a_name_keeps_its_colour():
    palette = ["a", "b", "c"]
    alone = own_colours(["charger"], palette)
    assert own_colours(["charger", "sofa"], palette)["charger"] in palette
    both = own_colours(["charger", "sofa", "plant"], palette)
    assert len(set(both.values())) == 3 and own_colours(["charger"], palette) == alone

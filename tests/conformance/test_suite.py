"""The suite itself: it passes what is right, fails what is wrong, and knows options that are yaml files."""

import pytest

from attnlab import registry
from attnlab.behaviours.base import Behaviour
from attnlab.errors import ConfigError
from attnlab.loading import load_all
from attnlab.testing import checks, conformance
from attnlab.testing.build import layout, node, reading


class Shy(Behaviour):
    """Backs off from what is near, more each time. It may not be commanded unless it is released. Draws nothing."""
    sigma_high = 5.0
    forgets = True

    def __init__(self, params, context):
        super().__init__(params, context)
        self._seen = 0

    def start(self):
        if self.forgets:
            self._seen = 0

    def percept(self, now):
        return min(self.sigma_high, *now.front_distances())

    def released(self, now, sigma):
        return sigma < 1.0

    def command(self, now, sigma):
        assert self.released(now, sigma), "commanded though it was not released"
        self._seen += 1
        return 0.0, 0.01 * self._seen

    def reward(self, sigma, period):
        return 0.5


class Brooding(Shy):
    """The same, but what it saw in one episode is still with it in the next."""
    forgets = False


@pytest.fixture
def both():
    """Both are registered while a test runs."""
    load_all()
    before = dict(registry.parts)
    for name, cls in (("shy", Shy), ("brooding", Brooding)):
        registry.register("behaviours", name)(cls)
    yield
    registry.parts.clear()
    registry.parts.update(before)


def test_a_behaviour_is_commanded_only_when_it_is_released(both):
    for check in checks("behaviours").values():
        check("shy")


def test_a_forgetful_start_is_found(both):
    with pytest.raises(AssertionError, match="brooding: the second episode differs"):
        checks("behaviours")["forgets"]("brooding")


test_paper = conformance("world", "paper")
test_cluttered = conformance("world", "cluttered")


def test_a_yaml_world_is_what_it_says():
    assert node("world", "cluttered")["width_m"] == 6.0 and layout(name="cluttered").width_m == 6.0
    assert sum(solid.kind == "obstacle" for solid in layout(name="cluttered").solids) == 6
    below, own = node("world", "layout"), node("world", "open")
    assert own["part"] == "layout" and own["start"] == below["start"] and len(own["boxes"]) == 2
    assert node("world", "open", width_m=5.0)["width_m"] == 5.0


def test_a_yaml_reading_is_on_top_of_its_defaults():
    literal, inferred = node("reading", "table4"), node("reading", "inferred")
    assert literal["name"] == "table4" and literal["max_cycles"] == 1500 != inferred["max_cycles"]
    assert literal["percept_bins"] == inferred["percept_bins"]
    assert reading(**{name: value for name, value in literal.items() if name != "name"}).max_cycles == 1500


def test_a_world_of_a_plugin_folder_is_checked(tmp_path, monkeypatch):
    (tmp_path / "plugins" / "world").mkdir(parents=True)
    file = tmp_path / "plugins" / "world" / "small.yaml"
    file.write_text("defaults: [paper]\nname: small\npart: layout\nboxes: []\n")
    monkeypatch.chdir(tmp_path)
    assert layout(name="small").width_m == 4.0 and len(layout(name="small").solids) == 4
    for check in checks("world").values():
        check("small")
    file.write_text("defaults: [paper]\nname: small\npart: layout\nwidth: 3\n")
    with pytest.raises(ConfigError, match="width"):
        checks("world")["typed"]("small")


def test_an_unknown_world_is_named():
    for wrong, right in (("layuot", "layout"), ("clutered", "cluttered")):
        with pytest.raises(ConfigError, match=f"Did you mean '{right}'"):
            node("world", wrong)

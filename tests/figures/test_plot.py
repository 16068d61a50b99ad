"""attnlab.plot: the report's figures in a notebook."""

import matplotlib.figure
import pytest

from attnlab import plot
from attnlab.errors import ConfigError
from attnlab.figures.base import gallery
from attnlab.figures.style import png_bytes
from attnlab.results import load
from attnlab.testing.study import conditions


@pytest.fixture(scope="module")
def study():
    return conditions().study


@pytest.mark.parametrize("name", gallery())
def test_every_figure_is_a_function(study, name):
    drawn = getattr(plot, name)(study)
    assert isinstance(drawn, matplotlib.figure.Figure) and drawn.axes
    assert name in dir(plot) and getattr(plot, name).__name__ == name


def test_a_study_its_path_and_its_conditions_are_the_same(study):
    pictures = {png_bytes(plot.survival(source)) for source in (study, study.path, str(study.path), load(study.path))}
    assert pictures == {png_bytes(plot.survival(conditions()))}


def test_baselines_are_drawn_in_grey(study):
    alone, both = plot.attention_economics(study), plot.attention_economics(study, baselines=study)
    assert len(both.axes[0].lines) == 2 * len(alone.axes[0].lines) > 0


def test_nothing_stays_open_and_no_setting_stays_changed(study):
    import matplotlib.pyplot as plt
    before, size = plt.get_fignums(), plt.rcParams["font.size"]
    plot.safety(study)
    assert plt.get_fignums() == before and plt.rcParams["font.size"] == size


def test_a_typo_gets_a_hint(study, tmp_path):
    with pytest.raises(AttributeError, match="Did you mean 'survival'"):
        plot.survivall(study)
    with pytest.raises(ConfigError, match="no such study"):
        plot.survival(tmp_path / "nothing")

"""docs/tables.md and docs/worlds.md say what is there."""

import re
from pathlib import Path

import pytest
import yaml

from attnlab import registry
from attnlab.tables.schema import COLUMNS

DOCS = Path(__file__).resolve().parents[2] / "docs"


@pytest.mark.parametrize("table", COLUMNS)
def test_every_column_is_explained(table):
    words = set(re.findall(r"`([a-z_0-9]+)`", (DOCS / "tables.md").read_text()))
    assert set(COLUMNS[table]) <= words


def test_the_world_of_the_page_stands():
    text = re.search(r"```yaml\n(.*?)```", (DOCS / "worlds.md").read_text(), re.DOTALL)[1]
    node = {key: value for key, value in yaml.safe_load(text).items() if key != "defaults"}
    layout = registry.make("world", node, None).build(0)
    assert [solid.kind for solid in layout.solids[4:]] == ["wall", "obstacle", "obstacle", "food", "water"]

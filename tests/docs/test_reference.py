"""docs/tables.md and docs/worlds.md say what is there."""

import importlib.util
import re
from pathlib import Path

import yaml

from attnlab import registry

DOCS = Path(__file__).resolve().parents[2] / "docs"


def test_the_page_of_tables_is_what_the_schema_says():
    """If not: python docs/make_tables.py."""
    spec = importlib.util.spec_from_file_location("make_tables", DOCS / "make_tables.py")
    make_tables = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(make_tables)
    assert (DOCS / "tables.md").read_text() == make_tables.page()


def test_the_world_of_the_page_stands():
    text = re.search(r"```yaml\n(.*?)```", (DOCS / "worlds.md").read_text(), re.DOTALL)[1]
    node = {key: value for key, value in yaml.safe_load(text).items() if key != "defaults"}
    layout = registry.make("world", node, None).build(0)
    assert [solid.kind for solid in layout.solids[4:]] == ["wall", "obstacle", "obstacle", "food", "water"]

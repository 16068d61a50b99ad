"""What docs/reliability.md and docs/clusters.md say in numbers is what was stored, and it is what was asked for."""

from __future__ import annotations

import pytest

from attnlab import registry
from benchmarks import reliability


def test_the_pages_are_those_of_the_stored_figures():
    assert reliability.PAGE.read_text() == reliability.page()
    text = reliability.CLUSTERS.read_text()
    assert text == reliability.clusters(text)
    for spec in registry.parts.values():
        if spec.group == "cluster" and spec.origin.startswith(str(reliability.ROOT / "attnlab")):
            assert f"| `{spec.name}` " in text


def test_nothing_was_lost_and_nothing_done_twice():
    kills = reliability.stored("kills")
    if kills is None:
        pytest.skip("python benchmarks/kills.py --publish")
    assert kills["differing_tables"] == kills["completed_twice"] == kills["unfinished_sweeps"] == 0
    assert kills["kills"] > 0 and kills["tables"] > 0


def test_no_byte_differs():
    table = reliability.stored("bytes")["table"]
    assert list(table) == ["3.11", "3.12", "3.13"]
    assert {said for of in table.values() for said in of.values()} == {"the same"}

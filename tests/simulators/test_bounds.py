"""Worlds and commands at the edge of what makes sense: each has a defined answer."""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import replace
from math import isfinite
from pathlib import Path

import pytest

from attnlab.errors import ConfigError
from attnlab.simulators.base import SimulatorContext
from attnlab.simulators.planar import Planar
from attnlab.simulators.pybullet import PyBullet
from attnlab.testing.build import layout
from attnlab.worlds.base import Layout, outer_walls
from attnlab.worlds.geometry import Solid

ROOT = Path(__file__).resolve().parents[2]
BOTH = pytest.mark.parametrize("kind", [Planar, PyBullet])


def simulator(kind, world: Layout, **params):
    return kind(kind.Params(**params), SimulatorContext(world, 0.1565, 100))


@BOTH
def test_a_world_without_anything(kind):
    with simulator(kind, Layout(4.0, 4.0, (), (0.0, 4.0, 0.0, 4.0), 0.3)) as void:
        void.place(2.0, 2.0, 0.0)
        assert void.sonar() == [5.0] * 16 and void.blobs() == []
        assert void.advance(0.4, 0.0, 50) == (50, False)


@BOTH
def test_a_world_of_five_hundred_boxes(kind):
    boxes = [Solid("obstacle", 1.0 + 1.2 * (i % 25), 1.0 + 1.2 * (i // 25), 0.5, 0.5) for i in range(500)]
    with simulator(kind, Layout(31.0, 25.0, (*outer_walls(31.0, 25.0), *boxes), (0.0, 31.0, 0.0, 25.0), 0.3)) as many:
        many.place(1.6, 1.6, 0.0)  # between the first four, looking along a street 0.7 m wide
        ranges = many.sonar()
        assert ranges[0] == 5.0 and ranges[7] == pytest.approx(1.6 - 0.136)  # up the street, and down it to the wall
        assert {many.layout.solids[blob.solid].kind for blob in many.blobs()} == {"obstacle"}
        assert many.advance(0.4, 0.0, 20) == (20, False)
        assert many.advance(0.0, 1.0, 1) == (1, False)
        many.place(1.6, 1.6, 1.5707963267948966 / 2)
        assert many.advance(0.4, 0.0, 50)[1]  # along the diagonal there is a box


@BOTH
def test_inside_a_box(kind):
    with simulator(kind, layout()) as world:
        world.place(1.2, 2.8, 0.0)
        ranges = world.sonar()
        assert ranges[0] == pytest.approx(0.25 - 0.136) and ranges[8] == pytest.approx(0.25 - 0.136)  # its sides
        assert 4 not in [blob.solid for blob in world.blobs()]  # looked through
        assert world.advance(0.1, 0.0, 5) == (1, True)


@BOTH
def test_a_sonar_that_stands_out_of_the_footprint_into_a_wall(kind):
    with simulator(kind, layout()) as world:
        world.place(0.2505, 2.0, 0.0)  # no contact, but the rear sonars are 6 mm inside the wall
        assert world.advance(0.0, 0.0, 1) == (1, False)
        assert world.sonar()[11:13] == [0.1, 0.1]


@BOTH
def test_outside_of_the_arena(kind):
    with simulator(kind, layout()) as world:
        world.place(-2.0, 2.0, 0.0)
        assert world.sonar()[3] == pytest.approx((1.9 - 0.166) / 0.984807753012208)  # the wall's outer face
        world.place(60.0, -40.0, 0.0)
        assert world.sonar() == [5.0] * 16 and world.blobs() == []
        assert world.advance(0.4, 1.0, 5) == (5, False)


@BOTH
def test_standing_still(kind):
    with simulator(kind, layout()) as world:
        world.place(2.0, 2.0, 1.0)
        before = world.pose()
        assert world.advance(0.0, 0.0, 12) == (12, False)
        assert world.pose() == before and world.cycle == 12
        assert world.advance(0.3, 0.3, 0) == (0, False)
        assert world.pose() == before and world.cycle == 12


@BOTH
def test_more_cycles_than_an_episode_has(kind):
    with simulator(kind, layout()) as world:
        world.place(2.0, 2.0, 1.0)
        with pytest.raises(IndexError):
            world.advance(0.0, 0.1, 101)


@BOTH
def test_a_heading_of_many_turns(kind):
    with simulator(kind, layout()) as world:
        world.place(2.0, 2.0, 3.0)
        world.advance(0.0, 1.5, 10)
        assert -3.1415926535897936 <= world.pose()[2] < 3.1415926535897936 and isfinite(world.pose()[2])


def test_solids_of_another_height_are_refused():
    world = layout()
    low = replace(world, solids=(*world.solids, Solid("obstacle", 2.0, 2.0, 0.3, 0.3, 0.0, 0.1)))
    with pytest.raises(ConfigError, match="0.1 m high.*pybullet"):
        simulator(Planar, low)


PROGRAM = """
from attnlab.simulators.base import SimulatorContext
from attnlab.simulators.planar import Planar
from attnlab.testing.build import layout
for _ in range(2):
    world = Planar(Planar.Params(), SimulatorContext(layout(), 0.1565, 100))
world.place(2.0, 2.0, 0.3)
for i in range(20):
    world.advance(0.3, 0.9 - 0.1 * i, 3)
    print([x.hex() for x in (*world.pose(), *world.sonar())], world.blobs())
"""


def outcome(cache: str) -> subprocess.CompletedProcess:
    return subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, check=True, timeout=120,
                          env={**os.environ, "PYTHONPATH": str(ROOT), **({"NUMBA_CACHE_DIR": cache} if cache else {})})


def test_cold_warm_and_no_cache_give_the_same_bits(tmp_path):
    cold = outcome(str(tmp_path))
    assert any(tmp_path.rglob("*.nbc")) and cold.stderr == ""
    warm = outcome(str(tmp_path))
    assert warm.stdout == cold.stdout and warm.stderr == "" and cold.stdout.count("\n") == 20


def test_without_a_writable_cache_folder_it_says_so_once(tmp_path):
    (tmp_path / "file").write_text("")
    blocked = PROGRAM.replace("from attnlab.simulators.planar", NO_FOLDER + "from attnlab.simulators.planar", 1)
    result = subprocess.run([sys.executable, "-c", blocked], capture_output=True, text=True, check=True, timeout=120,
                            env={**os.environ, "PYTHONPATH": str(ROOT), "NUMBA_CACHE_DIR": str(tmp_path / "file")})
    assert result.stderr.count("cache folder is not writable") == 1 and result.stderr.count("\n") == 1
    assert result.stdout == outcome("").stdout


# A user that may write anywhere (root, in a container) needs help to find no folder.
NO_FOLDER = """
from numba.core import caching
def refuse(self):
    raise OSError("read-only file system")
for locator in ("UserProvidedCacheLocator", "InTreeCacheLocator", "UserWideCacheLocator"):
    getattr(caching, locator).ensure_cache_path = refuse
"""

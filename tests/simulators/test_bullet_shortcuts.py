"""What pybullet does not do, because its outcome is known, changes nothing: half of the image, most questions for
contact."""

from random import Random

import pytest

pytest.importorskip("pybullet")

from attnlab.loading import load_all
from attnlab.registry import make
from attnlab.simulators.base import SimulatorContext
from attnlab.simulators.bullet_camera import Segmentation
from attnlab.simulators.pybullet import PyBullet

load_all()
LAYOUT = make("world", {"name": "random"}, None).build(4)


@pytest.fixture
def robot():
    with PyBullet(PyBullet.Params(), SimulatorContext(LAYOUT, 0.12, 4000)) as found:
        yield found


def test_the_lower_half_of_an_image_is_the_upper_one(robot):
    whole = Segmentation(robot._p, robot._client, robot.camera, 20.0, mirrored=False)
    half = Segmentation(robot._p, robot._client, robot.camera, 20.0, mirrored=True)
    draw, seen = Random(1), 0
    for _ in range(300):
        pose = LAYOUT.random_start(draw)
        columns = whole.look(*pose, robot._robot, list(robot._cubes))
        assert half.look(*pose, robot._robot, list(robot._cubes)) == columns
        seen += len(columns)
    assert seen > 100 and half._rows == 12 and whole._rows == 24


def test_contact_is_found_where_it_would_be_if_it_were_always_asked_for(robot):
    draw, moved, crashes = Random(2), 0, 0
    for _ in range(12):
        start, turn = LAYOUT.random_start(draw), draw.uniform(-0.3, 0.3)
        found = []
        for shortcut in (True, False):
            robot.place(*start)
            clearance = robot._clearance
            if not shortcut:
                robot._clearance = lambda x, y: 0.0
            cycles, crashed = robot.advance(0.4, turn, 200)
            robot._clearance = clearance
            found.append((cycles, crashed, robot.pose()))
        assert found[0] == found[1]
        moved, crashes = moved + cycles, crashes + crashed
    assert moved > 100 and crashes > 5

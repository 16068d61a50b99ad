"""Bodies of the pybullet simulator: floor, walls, cubes, and a Pioneer 3-DX of our own primitives."""

from __future__ import annotations

from math import cos, sin
from types import ModuleType

from attnlab.simulators.robot import RADIUS_M, SONARS, WHEEL_BASE_M, WHEEL_RADIUS_M
from attnlab.worlds.base import Layout

COLOURS = {"food": (0.1, 0.7, 0.2, 1), "water": (0.1, 0.3, 0.9, 1), "obstacle": (0.05, 0.05, 0.05, 1),
           "wall": (0.7, 0.7, 0.7, 1)}
OUTER_WALLS = 4
# Bullet lets two bodies meet if either one's mask holds the other's group; it puts rays in group 1.
RAY, WORLD_GROUP, ROBOT_GROUP, RAY_GROUP = 1, 2, 4, 8  # a ray, what the robot touches, the robot, what rays meet
CLEAR_M = 0.05  # the base hangs this far above the floor


def add_floor(p: ModuleType, client: int) -> int:
    """An endless floor for the wheels; the base never touches it."""
    plane = p.createCollisionShape(p.GEOM_PLANE, physicsClientId=client)
    floor: int = p.createMultiBody(0, plane, physicsClientId=client)
    hide(p, client, floor)
    p.setCollisionFilterGroupMask(floor, -1, WORLD_GROUP, ROBOT_GROUP, physicsClientId=client)
    return floor


def add_solids(p: ModuleType, client: int, layout: Layout, draw_all: bool) -> tuple[dict[int, int], dict[int, int]]:
    """All solids as static boxes, each with a surface for rays around it.

    Returns body -> index in ``layout.solids`` of the boxes that make blobs, and surface -> body of the same.
    """
    seen, surfaces = {}, {}
    inner_walls = sum(solid.kind == "wall" for solid in layout.solids) > OUTER_WALLS
    for index, solid in enumerate(layout.solids):
        half = (solid.length_m / 2, solid.width_m / 2, solid.height_m / 2)
        place = (solid.x_m, solid.y_m, solid.height_m / 2)
        turn = (0, 0, sin(solid.yaw_rad / 2), cos(solid.yaw_rad / 2))
        shape = p.createCollisionShape(p.GEOM_BOX, halfExtents=half, physicsClientId=client)
        drawn = draw_all or solid.kind != "wall" or (inner_walls and index >= OUTER_WALLS)
        look = p.createVisualShape(p.GEOM_BOX, halfExtents=half, rgbaColor=COLOURS.get(solid.kind, (0.8, 0.4, 0.1, 1)),
                                   physicsClientId=client) if drawn else -1
        body = p.createMultiBody(0, shape, look, place, turn, physicsClientId=client)
        p.setCollisionFilterGroupMask(body, -1, WORLD_GROUP, ROBOT_GROUP, physicsClientId=client)
        if not drawn:
            hide(p, client, body)
        surface = p.createMultiBody(0, _surface(p, client, half), -1, place, turn, physicsClientId=client)
        p.setCollisionFilterGroupMask(surface, -1, RAY_GROUP, RAY, physicsClientId=client)
        hide(p, client, surface)
        if solid.kind != "wall":
            seen[body], surfaces[surface] = index, body
    return seen, surfaces


def _surface(p: ModuleType, client: int, half: tuple[float, float, float]) -> int:
    """The four sides as triangles: Bullet's ray is exact for them, and up to 1.4 mm short of a box."""
    x, y, z = half
    corners = [(i * x, j * y, k * z) for k in (-1, 1) for i, j in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
    sides = [triangle for a, b in ((0, 1), (1, 2), (2, 3), (3, 0)) for triangle in (a, b, b + 4, a, b + 4, a + 4)]
    shape: int = p.createCollisionShape(p.GEOM_MESH, vertices=corners, indices=sides,
                                        flags=p.GEOM_FORCE_CONCAVE_TRIMESH, physicsClientId=client)
    return shape


def hide(p: ModuleType, client: int, body: int) -> None:
    """Keep a body out of the image: without a visual shape of its own Bullet draws its collision shape."""
    for link in range(-1, p.getNumJoints(body, physicsClientId=client)):
        p.changeVisualShape(body, link, rgbaColor=(0, 0, 0, 0), physicsClientId=client)


def add_robot(p: ModuleType, client: int, wheels: bool, visible: bool) -> tuple[int, float, tuple[int, ...]]:
    """The robot at the origin; (body id, height of its base's centre in m, wheel joints: left, right).

    Kinematic: the footprint as one cylinder. On wheels: a 9 kg base on two driven wheels and two frictionless casters.
    """
    height = 0.15
    base_z = CLEAR_M + height / 2
    base = p.createCollisionShape(p.GEOM_CYLINDER, radius=RADIUS_M, height=height, physicsClientId=client)
    # What is nearer than 0.2 m is cut off in the camera image: a narrower look does not get into it.
    look = p.createVisualShape(p.GEOM_CYLINDER, radius=0.19, length=height, rgbaColor=(0.75, 0.1, 0.1, 1),
                               physicsClientId=client) if visible else -1
    if not wheels:
        body = p.createMultiBody(1, base, look, (0, 0, base_z), physicsClientId=client)
        p.setCollisionFilterGroupMask(body, -1, ROBOT_GROUP, WORLD_GROUP, physicsClientId=client)
        if not visible:
            hide(p, client, body)
        return body, base_z, ()
    wheel = p.createCollisionShape(p.GEOM_CYLINDER, radius=WHEEL_RADIUS_M, height=0.04, physicsClientId=client)
    ball = p.createCollisionShape(p.GEOM_SPHERE, radius=0.03, physicsClientId=client)
    side, lift = WHEEL_BASE_M / 2, WHEEL_RADIUS_M - base_z
    upright = (0.7071067811865476, 0, 0, 0.7071067811865476)  # the cylinder's axis across the robot
    places = [(0, side, lift), (0, -side, lift), (0.18, 0, 0.03 - base_z), (-0.18, 0, 0.03 - base_z)]
    body = p.createMultiBody(
        9.0, base, look, (0, 0, base_z), linkMasses=[0.75, 0.75, 0.2, 0.2],
        linkCollisionShapeIndices=[wheel, wheel, ball, ball], linkVisualShapeIndices=[-1] * 4, linkPositions=places,
        linkOrientations=[upright, upright, (0, 0, 0, 1), (0, 0, 0, 1)], linkInertialFramePositions=[(0, 0, 0)] * 4,
        linkInertialFrameOrientations=[(0, 0, 0, 1)] * 4, linkParentIndices=[0] * 4,
        linkJointTypes=[p.JOINT_REVOLUTE, p.JOINT_REVOLUTE, p.JOINT_FIXED, p.JOINT_FIXED],
        linkJointAxis=[(0, 0, -1), (0, 0, -1), (0, 0, 1), (0, 0, 1)], physicsClientId=client)
    for link, friction in enumerate((1.0, 1.0, 0.0, 0.0)):
        p.changeDynamics(body, link, lateralFriction=friction, physicsClientId=client)
    for link in range(-1, 4):
        p.setCollisionFilterGroupMask(body, link, ROBOT_GROUP, WORLD_GROUP, physicsClientId=client)
    p.changeDynamics(body, -1, linearDamping=0, angularDamping=0, physicsClientId=client)
    if not visible:
        hide(p, client, body)
    return body, base_z, (0, 1)


def look_at(p: ModuleType, client: int, layout: Layout) -> None:
    """Bullet's window shows the whole arena, from the south and above, and nothing else."""
    p.configureDebugVisualizer(p.COV_ENABLE_GUI, 0, physicsClientId=client)
    p.resetDebugVisualizerCamera(1.1 * max(layout.width_m, layout.depth_m), 0.0, -55.0,
                                 (layout.width_m / 2, layout.depth_m / 2, 0.0), physicsClientId=client)


def draw_beams(p: ModuleType, client: int, robot: int, ranges: list[float], lines: list[int]) -> list[int]:
    """Beams of these ranges (m, from the ring) into Bullet's window, fixed to the robot, in place of ``lines``; their
    numbers."""
    drawn = []
    for i, ((x, y, angle), reach) in enumerate(zip(SONARS, ranges, strict=False)):
        more = {"replaceItemUniqueId": lines[i]} if i < len(lines) else {}
        drawn.append(p.addUserDebugLine((x, y, 0.1), (x + reach * cos(angle), y + reach * sin(angle), 0.1), (1, 0.6, 0),
                                        lifeTime=0.5, parentObjectUniqueId=robot, physicsClientId=client, **more))
    return drawn + lines[len(drawn):]

"""Planning scenes: what collides, how deep, and why a state cannot be."""

import math

import arms
import numpy as np
import pytest

from gazelle.description import (
    Box,
    Capsule,
    Cone,
    Cylinder,
    Ellipsoid,
    Plane,
    Pose,
    Sphere,
)
from gazelle.errors import PlanningError
from gazelle.formats import MeshData, Octree, load_model_string
from gazelle.kinematics import RobotModel
from gazelle.planning import (
    OCTOMAP,
    AllowedCollisionMatrix,
    PlanningScene,
    octree_object,
    voxel_boxes,
)

RADIUS = 0.04
"""Of the spheres on the iiwa's links."""


def cube(edge):
    """Return a mesh of twelve triangles."""
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float) - 0.5
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = [tri for a, b, c, d in quads for tri in ((a, b, c), (a, c, d))]
    return MeshData(corners * edge, np.array(faces, np.int32))


def alone():
    """Return the iiwa, of which only the sphere of its fourth link is checked."""
    scene = PlanningScene(arms.arm("iiwa"))
    acm = AllowedCollisionMatrix()
    for link in scene.robot.links:
        if link != "iiwa_link4":
            acm.set_default(link, allowed=True)
    for first in scene.robot.links:
        for second in scene.robot.links:
            acm.set_pair(first, second, allowed=True)
    scene.allowed = acm
    return scene


SHAPES = {
    "box": (Box((0.2, 0.3, 0.4)), (0.1, 0.15, 0.2)),
    "sphere": (Sphere(0.1), (0.1, 0.1, 0.1)),
    "cylinder": (Cylinder(0.1, 0.4), (0.1, 0.1, 0.2)),
    "capsule": (Capsule(0.1, 0.2), (0.1, 0.1, 0.2)),
    "ellipsoid": (Ellipsoid((0.1, 0.2, 0.3)), (0.1, 0.2, 0.3)),
    "mesh": (cube(0.2), (0.1, 0.1, 0.1)),
    "voxels": (voxel_boxes([[-0.05, 0, 0], [0.05, 0, 0]], [0.1, 0.1]), (0.1, 0.05, 0.05)),
}


@pytest.mark.parametrize("depth", [-0.002, 0.002, 0.02])
@pytest.mark.parametrize("name", SHAPES)
def test_a_shape_touches_where_it_is(name, depth):
    """Along each axis of the shape, turned: as deep as its half length says."""
    scene = alone()
    shape, halves = SHAPES[name]
    ball = scene.pose_of("iiwa_link4")
    for axis, half in enumerate(halves):
        way = [0.0, 0.0, 0.0]
        way[axis] = -(half + RADIUS - depth)
        turned = Pose.from_quaternion(ball.position, Pose(roll=0.3, pitch=-1.0, yaw=2.0).quaternion)
        scene.add("thing", shape, turned * Pose(*way))
        found = scene.contacts()
        assert scene.in_collision(scene.state) == (depth > 0.0)
        assert bool(found) == (depth > 0.0)
        for contact in found:
            assert {contact.first, contact.second} == {"iiwa_link4", "thing"}
            assert contact.depth == pytest.approx(depth, abs=1e-4)


def test_a_cone_has_its_apex_up():
    scene = alone()
    ball = scene.pose_of("iiwa_link4")
    up = Pose.from_quaternion(ball.position)
    height = 0.3
    scene.add("cone", Cone(0.1, height), up * Pose(z=-(height / 2 + RADIUS - 0.004)))
    (contact,) = scene.contacts()
    assert contact.depth == pytest.approx(0.004, abs=5e-4)
    beside = 0.09 + RADIUS
    scene.move("cone", up * Pose(x=beside, z=-height / 2))
    assert not scene.contacts()  # here the cone is thin
    scene.move("cone", up * Pose(x=beside, z=height / 2))
    assert scene.contacts()


def test_a_plane_is_endless_and_has_one_free_side():
    scene = alone()
    ball = scene.pose_of("iiwa_link4")
    scene.add("floor", Plane(), Pose(100.0, -50.0, ball.z - RADIUS + 0.003))
    (contact,) = scene.contacts()
    assert contact.depth == pytest.approx(0.003, abs=1e-6)
    scene.move("floor", Pose(0, 0, ball.z - RADIUS - 0.003))
    assert not scene.contacts()
    scene.add("floor", Plane((1.0, 0.0, 0.0)), Pose(ball.x - RADIUS + 0.01))
    assert scene.contacts()[0].depth == pytest.approx(0.01, abs=1e-6)


def test_an_octree_collides_under_its_name():
    scene = alone()
    ball = scene.pose_of("iiwa_link4")
    # Its one occupied leaf is the eighth of it with the greatest x, y and z: a cube of 3.2768 m at its origin.
    octree = Octree(1e-4, (2 << 14).to_bytes(2, "little"))
    scene.add_object(octree_object(octree, Pose(ball.x + RADIUS - 0.003, ball.y - 1, ball.z - 1)))
    (contact,) = scene.contacts()
    assert {contact.first, contact.second} == {"iiwa_link4", OCTOMAP}
    assert contact.depth == pytest.approx(0.003, abs=1e-6)
    scene.move(OCTOMAP, Pose(ball.x + RADIUS + 0.003, ball.y - 1, ball.z - 1))
    assert not scene.contacts()
    scene.add_object(octree_object(Octree(0.1, b"\0\0"), name="nothing"))
    assert not scene.contacts()


def test_an_octree_of_too_many_boxes_is_refused(monkeypatch):
    octree = Octree(0.1, (0b1000000000100000).to_bytes(2, "little"))  # two leaves apart
    assert len(octree_object(octree).shapes) == 2
    monkeypatch.setattr("gazelle.planning.octomaps._MOST_BOXES", 1)
    with pytest.raises(PlanningError, match="has 2 boxes, more than 1"):
        octree_object(octree)


def test_several_shapes_make_one_thing():
    scene = alone()
    ball = scene.pose_of("iiwa_link4")
    parts = [(Sphere(0.02), Pose(0.5)), (Sphere(0.02), Pose(-0.5))]
    scene.add("dumbbell", parts, Pose(ball.x, ball.y, ball.z))
    assert not scene.contacts()
    scene.move("dumbbell", Pose(ball.x - 0.5, ball.y, ball.z))
    assert [contact.second for contact in scene.contacts()] == ["dumbbell"]


def test_padding_counts_towards_obstacles_only():
    scene = alone()
    ball = scene.pose_of("iiwa_link4")
    scene.add("wall", Box((0.1, 1, 1)), Pose(ball.x + 0.05 + RADIUS + 0.01, ball.y, ball.z))
    assert not scene.contacts()
    scene.set_padding({"iiwa_link4": 0.012})
    assert scene.in_collision(scene.state)
    assert scene.contacts()[0].depth == pytest.approx(0.002, abs=1e-6)
    scene.set_padding({"iiwa_link4": 0.008})
    assert not scene.in_collision(scene.state)
    own = PlanningScene(arms.arm("fetch"))
    own.set_padding(dict.fromkeys(own.robot.links, 0.2))
    assert not own.contacts()


def test_scale():
    scene = alone()
    ball = scene.pose_of("iiwa_link4")
    scene.add("wall", Box((0.1, 1, 1)), Pose(ball.x + 0.05 + 0.048, ball.y, ball.z))
    assert not scene.contacts()
    scene.set_scale({"iiwa_link4": 1.3})
    assert scene.contacts()[0].depth == pytest.approx(0.004, abs=1e-6)


def tucked():
    robot, group = arms.arm_group("fetch")
    scene = PlanningScene(robot)
    scene.state[group.columns] = group.positions(group.named("ready"), np.zeros(7))
    return scene, group


def test_a_robot_collides_with_itself():
    scene, group = tucked()
    assert scene.why_invalid() == []
    state = scene.state.copy()
    state[group.columns] = [0.0, 1.5, 0.0, 1.5, 0.0, 0.0, 0.0]
    pairs = {frozenset((each.first, each.second)) for each in scene.contacts(state)}
    assert frozenset(("base_link", "wrist_flex_link")) in pairs
    assert all({"base_link", "torso_lift_link"} & pair for pair in pairs)
    assert "collide," in scene.why_invalid(state)[0]
    for pair in pairs:
        scene.allow(*pair)
    assert not scene.contacts(state)


def test_lumped_links_collide_under_their_own_names():
    scene, _ = tucked()
    hand = scene.pose_of("gripper_link")
    scene.add("post", Sphere(0.02), hand * Pose(-0.05, 0.07, 0.0))
    (contact,) = scene.contacts()
    assert {contact.first, contact.second} == {"gripper_link", "post"}


def test_what_is_held_moves_along_and_may_touch_what_holds_it():
    scene, group = tucked()
    hand = scene.pose_of("gripper_link")
    scene.add("stick", Box((0.5, 0.02, 0.02)), hand * Pose(0.2))
    touching = {frozenset((each.first, each.second)) for each in scene.contacts()}
    assert frozenset(("gripper_link", "stick")) in touching
    scene.attach("stick", "gripper_link", ["l_gripper_finger_link", "r_gripper_finger_link"])
    assert not scene.contacts()
    assert scene.pose_of("stick").is_close(hand * Pose(0.2), position=1e-9, angle=1e-9)
    state = scene.state.copy()
    state[group.columns[0]] = 1.0
    there = scene.pose_of("stick", state)
    assert there.is_close(scene.pose_of("gripper_link", state) * Pose(0.2), angle=1e-7)
    scene.add("wall", Box((0.02, 0.02, 0.02)), there * Pose(0.2))
    assert not scene.contacts()
    assert {each.first for each in scene.contacts(state)} == {"stick"}
    scene.state = state
    scene.detach("stick")
    assert scene.objects["stick"].pose.is_close(there, angle=1e-7)
    scene.clear()
    assert not scene.contacts()


def test_fingers_do_not_touch_what_is_held_unless_told():
    scene, _ = tucked()
    hand = scene.pose_of("gripper_link")
    scene.add("block", Box((0.04, 0.08, 0.02)), hand)
    scene.attach("block", "gripper_link")
    assert {each.second for each in scene.contacts()} | {
        each.first for each in scene.contacts()
    } == {"block", "l_gripper_finger_link", "r_gripper_finger_link"}


def test_only_pairs_that_a_group_moves():
    scene, group = tucked()
    base = scene.pose_of("base_link")
    scene.add("pallet", Box((1.0, 1.0, 0.1)), base * Pose(z=0.05))
    assert scene.contacts()
    assert not scene.contacts(group=group)
    assert not scene.in_collision(scene.state, group)


def test_limits_are_reasons():
    scene, group = tucked()
    state = scene.state.copy()
    state[scene.robot.column("elbow_flex_joint")] = 3.0
    (reason,) = [text for text in scene.why_invalid(state) if "limits" in text]
    assert "'elbow_flex_joint' at 3.0000 is beyond its limits [-2.2510, 2.2510]" in reason
    assert reason in scene.why_invalid(state, group)


def test_a_copy_is_its_own():
    scene, _ = tucked()
    scene.add("a", Sphere(0.1), Pose(2.0))
    scene.contacts()
    other = scene.copy()
    other.add("b", Sphere(0.1), other.pose_of("gripper_link"))
    other.allow("a", "gripper_link")
    assert not scene.contacts()
    assert other.contacts()
    assert "b" not in scene.objects
    assert not scene.allowed.allows("a", "gripper_link")


def test_frames_of_objects():
    scene, _ = tucked()
    made = scene.add("mug", Cylinder(0.04, 0.1), Pose(1.0, yaw=math.pi / 2))
    scene.add_object(type(made)(made.name, made.shapes, made.pose, frames=(("rim", Pose(0.1)),)))
    assert scene.pose_of("mug/rim").is_close(Pose(1.0, 0.1, yaw=math.pi / 2))
    with pytest.raises(PlanningError, match="no frame 'handle'"):
        scene.pose_of("mug/handle")


def test_without_an_srdf_links_of_one_joint_may_touch():
    fetch = arms.arm("fetch")
    scene = PlanningScene(RobotModel(fetch.model))
    assert scene.allowed.allows("torso_lift_link", "base_link")
    assert not scene.allowed.allows("base_link", "head_pan_link")


def test_a_link_may_be_named_world():
    text = (arms.DATA / "fetch_arm.urdf").read_text()
    held = (
        '<link name="world"/><joint name="foot" type="fixed"><parent link="world"/>'
        '<child link="base_link"/><origin xyz="0 0 1"/></joint></robot>'
    )
    robot = RobotModel(load_model_string(text.replace("</robot>", held)))
    scene = PlanningScene(robot)
    scene.add("ball", Sphere(0.1), Pose(0.0, 0.0, 1.2))
    assert {each.second for each in scene.contacts()} | {
        each.first for each in scene.contacts()
    } == {"ball", "base_link"}


def test_defaults_of_names():
    acm = AllowedCollisionMatrix()
    acm.set_default("a", allowed=True)
    acm.set_default("b", allowed=False)
    acm.set_pair("a", "c", allowed=False)
    assert acm.allows("a", "d")
    assert not acm.allows("a", "b")
    assert not acm.allows("c", "a")
    assert not acm.allows("c", "d")
    assert acm.allowed_among("abcd") == [("d", "a")]
    other = acm.copy()
    assert other == acm
    other.forget("a")
    assert not other.allows("a", "d")
    assert other != acm


@pytest.mark.parametrize(
    ("ask", "words"),
    [
        (lambda scene: scene.add("x", Box((0.0, 1, 1))), "lengths of a box"),
        (lambda scene: scene.add("", Sphere(1.0)), "needs a name"),
        (lambda scene: scene.add("x", []), "no shape"),
        (lambda scene: scene.add("x", [("ball", Pose())]), "shapes are those"),
        (lambda scene: scene.add("base_link", Sphere(1.0)), "a link named 'base_link'"),
        (lambda scene: scene.remove("x"), "no object 'x'"),
        (lambda scene: scene.detach("x"), "holds no 'x'"),
        (lambda scene: scene.attach("x", "base_link"), "no object 'x'"),
        (lambda scene: scene.set_padding({"base_lnk": 0.1}), "did you mean 'base_link'"),
        (lambda scene: scene.set_padding({"base_link": -0.1}), "must be a length"),
        (lambda scene: scene.set_scale({"base_link": 0.0}), "above zero"),
        (lambda scene: scene.pose_of("nowhere"), "no frame 'nowhere'"),
    ],
)
def test_what_cannot_be_is_said(ask, words):
    with pytest.raises(PlanningError, match=words):
        ask(PlanningScene(arms.arm("fetch")))

"""The planning scene of ``move_group``: topics and services that change it and show it."""

import math

import numpy as np
import pytest
from bridges.moveit.moveit_graph import message, moveit_graph
from ros.graph import until

from gazelle.bridges.conversions import pose_message, pose_of_message
from gazelle.bridges.moveit.object_messages import object_message, object_of_message
from gazelle.bridges.moveit.scene_messages import matrix_message, matrix_of_message
from gazelle.description import Box, Cone, Cylinder, Plane, Pose, Sphere
from gazelle.errors import PlanningError
from gazelle.formats import MeshData
from gazelle.planning import AllowedCollisionMatrix
from gazelle.planning.scene_objects import object_of
from gazelle_ros import load_message

ADD, REMOVE, APPEND, MOVE = 0, 1, 2, 3
TIP = "gripper_link"
TETRAHEDRON = MeshData(
    np.array([[0, 0, 0], [0.1, 0, 0], [0, 0.1, 0], [0, 0, 0.1]], float),
    np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]),
)


@pytest.fixture
def fetch():
    with moveit_graph() as client:
        yield client


def box(name="box", pose=None, size=(0.1, 0.2, 0.3), frame="base_link", operation=ADD):
    made = message("CollisionObject", id=name, operation=operation)
    made.header.frame_id, made.pose = frame, pose_message(pose or Pose(0.6, 0.0, 1.0))
    if operation in (ADD, APPEND):
        shape = load_message("shape_msgs/SolidPrimitive")(type=1, dimensions=list(size))
        made.primitives, made.primitive_poses = [shape], [pose_message(Pose())]
    return made


def apply(client, *objects, held=(), **fields):
    scene = message("PlanningScene", is_diff=True, **fields)
    scene.robot_state.is_diff = True
    scene.world.collision_objects = [*objects]
    scene.robot_state.attached_collision_objects = [*held]
    return client.call("apply_planning_scene", "ApplyPlanningScene", scene=scene).success


def shown(client, parts=0):
    components = message("PlanningSceneComponents", components=parts)
    return client.call("get_planning_scene", "GetPlanningScene", components=components).scene


def things(client):
    return {each.id: each for each in shown(client, 8 | 16).world.collision_objects}


def held(client):
    found = shown(client, 4).robot_state.attached_collision_objects
    return {each.object.id: each for each in found}


def valid(client):
    return client.call("check_state_validity", "GetStateValidity", group_name="arm").valid


def tip(client):
    context = client.group.context
    return context.robot.pose(context.monitor.current(), TIP)


@pytest.mark.parametrize(
    "shape",
    [Box((0.1, 0.2, 0.3)), Sphere(0.2), Cylinder(radius=0.1, length=0.4),
     Cone(radius=0.1, length=0.4), Plane((0.0, 0.6, 0.8)), TETRAHEDRON],
    ids=lambda shape: type(shape).__name__,
)  # fmt: skip
def test_shapes_survive_the_way(shape):
    thing = object_of("t", [(shape, Pose(0.1, 0.2, 0.3, 0.4, 0.5, 0.6))], Pose(1.0, yaw=1.0))
    made = object_of_message(object_message(thing, "base_link"), Pose())
    ((back, pose),) = made.shapes
    assert type(back) is type(shape)
    if isinstance(shape, MeshData):
        np.testing.assert_array_equal(back.vertices, shape.vertices)
        np.testing.assert_array_equal(back.faces, shape.faces)
    else:
        assert repr(back) == repr(shape)
    assert pose.is_close(thing.shapes[0][1])
    assert made.pose.is_close(thing.pose)


def test_planes_are_where_their_equation_says():
    made = message("CollisionObject", id="floor")
    made.planes = [load_message("shape_msgs/Plane")(coef=[0.0, 0.0, 2.0, -1.0])]
    made.plane_poses = [pose_message(Pose())]
    thing = object_of_message(made, Pose())
    assert (thing.pose * thing.shapes[0][1]).position == pytest.approx((0.0, 0.0, 0.5))


def test_an_object_without_a_pose_is_where_its_one_shape_is():
    made = box()
    made.pose = load_message("geometry_msgs/Pose")()
    made.primitive_poses = [pose_message(Pose(1.0, 2.0, 3.0))]
    thing = object_of_message(made, Pose(1.0))
    assert thing.pose.position == pytest.approx((2.0, 2.0, 3.0))
    assert thing.shapes[0][1].position == pytest.approx((0.0, 0.0, 0.0))


@pytest.mark.parametrize(("kind", "lengths"), [(9, [1.0]), (1, [1.0]), (2, [-1.0]), (3, [])])
def test_shapes_that_cannot_be_are_refused(kind, lengths):
    made = box()
    made.primitives[0].type, made.primitives[0].dimensions = kind, lengths
    with pytest.raises(PlanningError):
        object_of_message(made, Pose())


def test_poses_and_triangles_that_cannot_be_are_refused():
    made = box(pose=Pose(1.0))
    made.pose.position.x = math.nan
    with pytest.raises(PlanningError, match="finite"):
        object_of_message(made, Pose())
    made = object_message(object_of("t", TETRAHEDRON, Pose()), "base_link")
    made.meshes[0].triangles[0].vertex_indices = [0, 1, 9]
    with pytest.raises(PlanningError, match="triangle"):
        object_of_message(made, Pose())


def test_rules_of_collisions_survive_the_way():
    matrix = AllowedCollisionMatrix()
    matrix.set_pair("a", "b", allowed=True)
    matrix.set_pair("a", "c", allowed=False)
    matrix.set_default("d", allowed=True)
    back = matrix_of_message(matrix_message(matrix))
    for first in "abcde":
        for second in "abcde":
            if first != second:
                assert back.allows(first, second) == matrix.allows(first, second)


def test_things_come_and_go(fetch):
    assert apply(fetch, box(), box("other", Pose(0.0, 2.0)))
    found = things(fetch)
    assert {*found} == {"box", "other"}
    assert list(found["box"].primitives[0].dimensions) == [0.1, 0.2, 0.3]
    assert pose_of_message(found["box"].pose).position == pytest.approx((0.6, 0.0, 1.0))
    assert shown(fetch, 8).world.collision_objects[0].primitives == []
    assert apply(fetch, box(pose=Pose(0.0, 3.0), operation=MOVE))
    assert pose_of_message(things(fetch)["box"].pose).position == pytest.approx((0.0, 3.0, 0.0))
    assert apply(fetch, box(pose=Pose(0.0, 3.0, 1.0), operation=APPEND))
    poses = [pose_of_message(each).position for each in things(fetch)["box"].primitive_poses]
    assert poses == [pytest.approx((0.0, 0.0, 0.0)), pytest.approx((0.0, 0.0, 1.0))]
    assert apply(fetch, box(operation=REMOVE))
    assert {*things(fetch)} == {"other"}
    assert apply(fetch, box("", operation=REMOVE))
    assert things(fetch) == {}


def test_what_cannot_be_done_is_said_and_the_rest_is_done(fetch):
    assert not apply(fetch, box(frame="moon"), box("other"))
    assert not apply(fetch, box("nobody", operation=REMOVE))
    assert not apply(fetch, box(TIP))
    assert not apply(fetch, box(operation=7))
    assert {*things(fetch)} == {"other"}


def test_poses_are_in_frames_of_the_robot(fetch):
    assert apply(fetch, box(pose=Pose(0.1), frame=TIP))
    assert pose_of_message(things(fetch)["box"].pose).is_close(tip(fetch) * Pose(0.1))


def test_states_and_plans_know_what_stands_there(fetch):
    assert valid(fetch)
    assert apply(fetch, box(pose=tip(fetch)))
    assert not valid(fetch)
    matrix = message("AllowedCollisionMatrix", default_entry_names=["box"],
                     default_entry_values=[True])  # fmt: skip
    known = shown(fetch, 128).allowed_collision_matrix
    matrix.entry_names, matrix.entry_values = known.entry_names, known.entry_values
    assert apply(fetch, allowed_collision_matrix=matrix)
    assert valid(fetch)
    assert "box" in shown(fetch, 128).allowed_collision_matrix.default_entry_names


def attached(name="box", operation=ADD, shapes=True, **fields):
    made = box(name, Pose(0.1), frame=TIP, operation=operation)
    if not shapes:
        made.primitives, made.primitive_poses = [], []
    return message("AttachedCollisionObject", link_name=TIP, object=made, **fields)


def test_links_hold_things(fetch):
    fingers = ["l_gripper_finger_link", "r_gripper_finger_link"]
    assert apply(fetch, held=[attached(touch_links=fingers)])
    found = held(fetch)["box"]
    assert found.link_name == found.object.header.frame_id == TIP
    assert sorted(found.touch_links) == fingers
    assert pose_of_message(found.object.pose).is_close(Pose(0.1))
    assert things(fetch) == {}
    # It is left where it is, and taken again as it stands there.
    assert apply(fetch, held=[attached(operation=REMOVE)])
    assert held(fetch) == {}
    assert pose_of_message(things(fetch)["box"].pose).is_close(tip(fetch) * Pose(0.1))
    assert apply(fetch, held=[attached(shapes=False)])
    assert things(fetch) == {}
    assert pose_of_message(held(fetch)["box"].object.pose).is_close(Pose(0.1))
    assert apply(fetch, held=[attached("", operation=REMOVE)])
    assert {*things(fetch)} == {"box"}
    assert not apply(fetch, held=[attached("nothing", shapes=False)])
    wrong = attached()
    wrong.link_name = "nose"
    assert not apply(fetch, held=[wrong])


def test_a_whole_scene_takes_the_place_of_the_one_before(fetch):
    assert apply(fetch, box(), held=[attached("tool")])
    whole = message("PlanningScene", is_diff=False)
    whole.world.collision_objects = [box("new")]
    assert fetch.call("apply_planning_scene", "ApplyPlanningScene", scene=whole).success
    assert {*things(fetch)} == {"new"}
    assert held(fetch) == {}


def test_topics_change_the_scene(fetch):
    node = fetch.node
    for topic, kind, sent, asked in (
        ("planning_scene_world", "PlanningSceneWorld",
         message("PlanningSceneWorld", collision_objects=[box("b")]), things),
        ("collision_object", "CollisionObject", box("a"), things),
        ("attached_collision_object", "AttachedCollisionObject", attached("c"), held),
    ):  # fmt: skip
        sender = node.advertise(topic, load_message(f"moveit_msgs/{kind}"), latch=True)
        sender.publish(sent)
        name = {"collision_object": "a", "planning_scene_world": "b"}.get(topic, "c")
        until(lambda asked=asked, name=name: name in asked(fetch), 60.0)
    scene = message("PlanningScene", is_diff=True)
    scene.world.collision_objects = [box("a", operation=REMOVE)]
    node.advertise("planning_scene", load_message("moveit_msgs/PlanningScene"), latch=True).publish(
        scene
    )
    until(lambda: "a" not in things(fetch), 60.0)


def test_the_scene_is_shown(fetch):
    seen = []
    fetch.node.subscribe(
        "move_group/monitored_planning_scene",
        load_message("moveit_msgs/PlanningScene"),
        lambda each: seen.append({thing.id for thing in each.world.collision_objects}),
    )
    assert apply(fetch, box())
    until(lambda: seen and seen[-1] == {"box"}, 60.0)


def test_parts_are_those_that_are_asked_for(fetch):
    apply(fetch, box(), held=[attached("tool")])
    whole = shown(fetch)
    assert whole.robot_model_name == "fetch"
    assert "elbow_flex_joint" in whole.robot_state.joint_state.name
    assert whole.link_padding
    assert whole.allowed_collision_matrix.entry_names
    assert len(whole.robot_state.attached_collision_objects) == 1
    state = shown(fetch, 2)
    assert state.robot_state.joint_state.name
    assert not state.world.collision_objects
    assert not state.link_padding
    padding = message("LinkPadding", link_name=TIP, padding=0.05)
    assert apply(fetch, link_padding=[padding])
    found = {each.link_name: each.padding for each in shown(fetch, 256).link_padding}
    assert found[TIP] == pytest.approx(0.05)


def colors(client):
    found = shown(client, 512).object_colors
    return {each.id: (each.color.r, each.color.g, each.color.b, each.color.a) for each in found}


def test_colours_are_kept_and_told(fetch):
    made = message("ObjectColor", id="box")
    made.color.r, made.color.a = 0.5, 1.0
    assert apply(fetch, box(), box("other"), object_colors=[made])
    assert colors(fetch) == {"box": (0.5, 0.0, 0.0, 1.0)}
    made.color.g = 0.25
    assert apply(fetch, object_colors=[made])
    assert colors(fetch) == {"box": (0.5, 0.25, 0.0, 1.0)}
    assert not shown(fetch, 8).object_colors
    assert apply(fetch, box("other", operation=REMOVE))
    assert {*colors(fetch)} == {"box"}
    assert apply(fetch, box(operation=REMOVE))
    assert colors(fetch) == {}
    made.id = TIP
    assert apply(fetch, object_colors=[made])
    whole = message("PlanningScene", is_diff=False)
    assert fetch.call("apply_planning_scene", "ApplyPlanningScene", scene=whole).success
    assert colors(fetch) == {}

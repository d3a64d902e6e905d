"""Octomaps of planning scenes: what they occupy cannot be passed, and they come back as they went."""

import struct

import numpy as np
import pytest
from bridges.moveit.moveit_graph import message, moveit_graph
from bridges.moveit.test_move_group_scene import apply, box, shown, things, tip, valid
from ros.graph import until

from gazelle.bridges.conversions import pose_message, pose_of_message
from gazelle.description import Pose
from gazelle.planning import OCTOMAP
from gazelle_ros import load_message, load_service

LEVELS, EDGE = 13, 0.1
TIP = "gripper_link"


@pytest.fixture(scope="module")
def graph():
    with moveit_graph() as client:
        yield client


@pytest.fixture
def fetch(graph):
    """Yield the same node for all, with an empty scene."""
    whole = message(
        "PlanningScene", allowed_collision_matrix=shown(graph, 128).allowed_collision_matrix
    )
    yield graph
    assert graph.call("apply_planning_scene", "ApplyPlanningScene", scene=whole).success
    assert not shown(graph, 32).world.octomap.octomap.data


def octomap(origin, frame="base_link", **fields):
    """Return one occupied cube, its lower corner at the origin, three levels up.

    The first step down is to the greater x, y and z, all others to the smaller.
    """
    down = (3 << 14).to_bytes(2, "little") + b"\x03\x00" * (LEVELS - 2) + b"\x02\x00"
    made = load_message("octomap_msgs/OctomapWithPose")(origin=pose_message(origin))
    made.header.frame_id = frame
    values = {"id": "OcTree", "binary": True, "resolution": EDGE / 8,
              "data": np.frombuffer(down, np.int8).tolist()} | fields  # fmt: skip
    for name, value in values.items():
        setattr(made.octomap, name, value)
    return made


def apply_map(client, made, **fields):
    world = message("PlanningSceneWorld", octomap=made)
    scene = message("PlanningScene", is_diff=True, world=world, **fields)
    scene.robot_state.is_diff = True
    return client.call("apply_planning_scene", "ApplyPlanningScene", scene=scene).success


def contacts(client):
    found = client.call("check_state_validity", "GetStateValidity", group_name="arm").contacts
    return {(each.contact_body_1, each.contact_body_2) for each in found}


def clear_octomap(client):
    kind = load_service("std_srvs/Empty")
    client.node.client("clear_octomap", kind).call(kind._request_class(), timeout=60)
    return True


def around(pose):
    """Return the origin that puts the cube's middle at a pose."""
    return pose * Pose(-EDGE / 2, -EDGE / 2, -EDGE / 2)


def test_what_is_occupied_cannot_be_passed(fetch):
    assert valid(fetch)
    assert apply_map(fetch, octomap(around(tip(fetch))))
    assert not valid(fetch)
    assert (TIP, OCTOMAP) in contacts(fetch)
    # Beside it, half an edge farther than the hand is long, there is nothing.
    assert apply_map(fetch, octomap(tip(fetch) * Pose(0.3)))
    assert valid(fetch)


def test_its_frame_counts(fetch):
    assert apply_map(fetch, octomap(around(Pose()), frame=TIP))
    assert not valid(fetch)
    found = shown(fetch, 32).world.octomap
    assert found.header.frame_id == "base_link"
    assert pose_of_message(found.origin).is_close(around(tip(fetch)))
    assert not apply_map(fetch, octomap(Pose(), frame="moon"))


def test_it_comes_back_as_it_went_and_only_if_asked_for(fetch):
    sent = octomap(Pose(2.0, 1.0, 0.5, yaw=0.3))
    assert apply_map(fetch, sent)
    found = shown(fetch, 32).world.octomap
    assert list(found.octomap.data) == sent.octomap.data
    assert (found.octomap.id, found.octomap.binary) == ("OcTree", True)
    assert found.octomap.resolution == EDGE / 8
    assert pose_of_message(found.origin).is_close(Pose(2.0, 1.0, 0.5, yaw=0.3))
    assert not shown(fetch, 8 | 16).world.octomap.octomap.data
    assert things(fetch) == {}  # it is no object


def test_full_octrees_are_taken(fetch):
    levels = [struct.pack("<fB", -3.5, 1 << 7)] + [struct.pack("<fB", -3.5, 1)] * (LEVELS - 1)
    data = b"".join(levels) + struct.pack("<fB", 0.85, 0)
    made = octomap(around(tip(fetch)), binary=False, data=np.frombuffer(data, np.int8).tolist())
    assert apply_map(fetch, made)
    assert (TIP, OCTOMAP) in contacts(fetch)
    assert shown(fetch, 32).world.octomap.octomap.binary is False


def test_it_is_replaced_and_cleared(fetch):
    blocked, beside = octomap(around(tip(fetch))), octomap(Pose(3.0))
    for clear in (
        lambda: apply_map(fetch, beside),
        lambda: apply_map(fetch, octomap(Pose(), id="cleared", data=[])),
        lambda: clear_octomap(fetch),
    ):
        assert apply_map(fetch, blocked)
        assert not valid(fetch)
        assert clear()
        assert valid(fetch)


def test_things_come_and_go_beside_it(fetch):
    assert apply_map(fetch, octomap(around(tip(fetch))))
    assert apply(fetch, box(pose=Pose(0.0, 3.0)))
    assert apply(fetch, box("", operation=1))
    assert things(fetch) == {}
    assert not valid(fetch)
    assert not apply(fetch, box(OCTOMAP))
    assert not apply(fetch, box(OCTOMAP, operation=1))
    held = message("AttachedCollisionObject", link_name=TIP, object=box(OCTOMAP))
    assert not apply(fetch, held=[held])


def test_it_may_be_touched_by_its_name(fetch):
    rules = shown(fetch, 128).allowed_collision_matrix
    assert apply_map(fetch, octomap(around(tip(fetch))))
    matrix = message("AllowedCollisionMatrix", entry_names=rules.entry_names, entry_values=rules.entry_values,
                     default_entry_names=[OCTOMAP], default_entry_values=[True])  # fmt: skip
    assert apply(fetch, allowed_collision_matrix=matrix)
    assert valid(fetch)
    assert apply(fetch, allowed_collision_matrix=rules)
    assert not valid(fetch)


def test_what_cannot_be_read_is_refused_and_the_one_before_stays(fetch):
    assert apply_map(fetch, octomap(around(tip(fetch))))
    bad = octomap(Pose())
    for change in (
        {"id": "Tree"},
        {"id": ""},
        {"resolution": -1.0},
        {"binary": False},
        {"data": [3]},
    ):
        for name, value in change.items():
            kept = getattr(bad.octomap, name)
            setattr(bad.octomap, name, value)
            assert not apply_map(fetch, bad)
            setattr(bad.octomap, name, kept)
    nowhere = octomap(Pose())
    nowhere.origin.position.x = float("inf")
    assert not apply_map(fetch, nowhere)
    assert not valid(fetch)


def test_a_world_of_the_topic_replaces_all(fetch):
    assert apply(fetch, box("before", Pose(0.0, 2.0)))
    world = message("PlanningSceneWorld", collision_objects=[box("after", Pose(0.0, 2.0))],
                    octomap=octomap(around(tip(fetch))))  # fmt: skip
    kind = load_message("moveit_msgs/PlanningSceneWorld")
    sender = fetch.node.advertise("planning_scene_world", kind, latch=True)
    sender.publish(world)
    until(lambda: {*things(fetch)} == {"after"}, 60.0)
    assert not valid(fetch)
    sender.publish(message("PlanningSceneWorld"))
    until(lambda: things(fetch) == {}, 60.0)
    assert valid(fetch)


def test_a_request_may_have_one_of_its_own(fetch):
    """What a goal's ``planning_scene_diff`` says counts for that plan alone."""
    services = fetch.group.scene
    difference = message("PlanningScene", is_diff=True)
    difference.world.octomap = octomap(around(tip(fetch)))
    scene = fetch.group.context.scene
    with fetch.group.context.lock, services.changed(difference):
        assert scene.contacts()
    assert not scene.contacts()

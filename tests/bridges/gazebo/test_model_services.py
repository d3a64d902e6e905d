"""Spawn, delete, state and configuration of models over ROS."""

import math

import numpy as np
import pytest
from graph_client import BALL, model_state, pose
from ros.graph import until

from gazelle_ros import load_message
from gazelle_ros.errors import ServiceError

ARM = """<?xml version="1.0"?><!-- a comment --><robot name="arm"><link name="base"><inertial><mass
value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link><link name="tip">
<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="elbow" type="continuous"><parent link="base"/><child link="tip"/><axis xyz="0 0 1"/></joint>
</robot>"""


def spawn(graph, text=BALL, name="ball", kind="sdf", **fields):
    return graph.client.call(
        f"spawn_{kind}_model", "SpawnModel", model_name=name, model_xml=text, **fields
    )


def test_a_spawned_model_is_there_where_it_was_wanted_when_the_call_returns(graph):
    answer = spawn(graph, initial_pose=pose(1.0, 0.5, 2.0, 1.0))
    assert answer.success
    assert answer.status_message == "SpawnModel: Successfully spawned entity"
    ball = graph.sim.robots["ball"].pose
    assert (ball.x, ball.y, ball.z, ball.yaw) == pytest.approx((1.0, 0.5, 2.0, 1.0))


def test_a_name_that_is_taken_is_refused(graph):
    spawn(graph)
    answer = spawn(graph)
    assert not answer.success
    assert answer.status_message == "SpawnModel: Failure - entity already exists."


def test_a_model_is_spawned_as_seen_from_a_frame(graph):
    graph.sim.robots["r1"].set_pose((1.0, 0.0, 0.0), yaw=math.pi / 2)
    spawn(graph, initial_pose=pose(0.5, 0.0, 1.0), reference_frame="r1")
    ball = graph.sim.robots["ball"].pose
    assert (ball.x, ball.y, ball.yaw) == pytest.approx((1.0, 0.5, math.pi / 2))
    answer = spawn(graph, name="other", reference_frame="nowhere")
    assert "reference_frame not found" in answer.status_message


def test_urdf_is_spawned_and_its_namespace_goes_before_its_topics(graph):
    assert spawn(graph, ARM, "arm", "urdf", initial_pose=pose(z=1.0)).success
    assert list(graph.sim.robots["arm"].joints) == ["elbow"]


def test_what_cannot_be_read_is_answered_with_the_place(graph):
    answer = spawn(graph, "<sdf version='1.6'><model name='ball'><link></model></sdf>")
    assert not answer.success
    assert answer.status_message.startswith("SpawnModel: Failure - model_xml of 'ball'")
    assert "ball" not in graph.sim.robots


@pytest.mark.parametrize("text", ["", "no XML", "<?xml version='1.0'?><!-- <sdf/> --><mujoco/>"])
def test_what_is_neither_sdf_nor_urdf_gets_gazebos_answer(graph, text):
    answer = spawn(graph, text)
    assert not answer.success
    assert answer.status_message == (
        "GazeboRosApiPlugin SpawnModel Failure: input model_xml not SDF or URDF, or cannot be "
        "converted to Gazebo compatible format."
    )


def test_what_is_no_urdf_fails_the_call_that_asks_for_one(graph):
    with pytest.raises(ServiceError, match="SpawnModel: Failure - entity format is invalid"):
        spawn(graph, BALL, "ball", "urdf")
    assert spawn(graph, ARM, "arm", "sdf").success


def test_a_light_is_spawned_listed_changed_and_deleted(graph):
    text = """<sdf version="1.6"><light type="point" name="lamp"><pose>0 0 3 0 0 0</pose>
    <diffuse>1 0 0 1</diffuse></light></sdf>"""
    assert spawn(graph, text, "lamp").success
    got = graph.client.call("get_light_properties", "GetLightProperties", light_name="lamp")
    assert (got.diffuse.r, got.diffuse.g) == (1.0, 0.0)
    colour = load_message("std_msgs/ColorRGBA")(0.0, 1.0, 0.0, 1.0)
    answer = graph.client.call(
        "set_light_properties", "SetLightProperties", light_name="lamp", diffuse=colour
    )
    assert answer.success
    got = graph.client.call("get_light_properties", "GetLightProperties", light_name="lamp")
    assert (got.diffuse.r, got.diffuse.g) == (0.0, 1.0)
    assert graph.client.call("delete_light", "DeleteLight", light_name="lamp").success
    assert not graph.client.call("delete_light", "DeleteLight", light_name="lamp").success


def test_a_deleted_model_and_its_topics_are_gone(graph):
    answer = graph.client.call("delete_model", "DeleteModel", model_name="r1")
    assert (answer.success, answer.status_message) == (
        True,
        "DeleteModel: successfully deleted model",
    )
    assert "r1" not in graph.sim.robots
    published = [name for name, _ in graph.client.node.master.published_topics()]
    assert "/odom" not in published
    answer = graph.client.call("delete_model", "DeleteModel", model_name="r1")
    assert answer.status_message == "DeleteModel: model does not exist"


def test_the_state_of_a_model_is_seen_from_any_frame_and_counted(graph):
    graph.sim.robots["r1"].set_pose((1.0, 0.5, 0.0), yaw=math.pi / 2)
    spawn(graph, initial_pose=pose(1.0, 1.5, 0.1))
    got = graph.client.call(
        "get_model_state", "GetModelState", model_name="ball", relative_entity_name="r1"
    )
    assert got.success
    assert (got.pose.position.x, got.pose.position.y) == pytest.approx((1.0, 0.0), abs=1e-6)
    assert (got.header.seq, got.header.frame_id) == (1, "r1")
    again = graph.client.call("get_model_state", "GetModelState", model_name="ball")
    assert (again.header.seq, again.header.frame_id) == (2, "")
    none = graph.client.call("get_model_state", "GetModelState", model_name="nobody")
    assert none.status_message == "GetModelState: model does not exist"


def test_the_state_of_a_model_is_set_by_service_and_by_topic(graph):
    spawn(graph, initial_pose=pose(z=5.0))
    wanted = model_state("ball", pose(1.0, 1.0, 5.0), linear=(1.0, 0.0, 0.0))
    answer = graph.client.call("set_model_state", "SetModelState", model_state=wanted)
    assert answer.status_message == "SetModelState: set model state done"
    graph.sim.step(100)
    ball = graph.sim.robots["ball"]
    assert ball.pose.x == pytest.approx(1.1, abs=1e-6)
    publisher = graph.client.node.advertise(
        "/gazebo/set_model_state", load_message("gazebo_msgs/ModelState")
    )
    until(lambda: publisher.num_connections == 1)
    publisher.publish(model_state("ball", pose(-1.0, 0.0, 2.0)))
    until(lambda: ball.pose.x == pytest.approx(-1.0))


def test_an_orientation_of_zeros_is_no_turn(graph):
    spawn(graph)
    wanted = model_state("ball", load_message("geometry_msgs/Pose")())
    assert graph.client.call("set_model_state", "SetModelState", model_state=wanted).success
    assert graph.sim.robots["ball"].pose.rpy == pytest.approx((0.0, 0.0, 0.0))


def test_joints_are_put_where_the_configuration_wants_them(graph):
    spawn(graph, ARM, "arm", "urdf", initial_pose=pose(z=1.0))
    answer = graph.client.call(
        "set_model_configuration",
        "SetModelConfiguration",
        model_name="arm",
        joint_names=["elbow"],
        joint_positions=[0.7],
    )
    assert answer.status_message == "SetModelConfiguration: success"
    assert graph.sim.robots["arm"].joints["elbow"].position == pytest.approx(0.7)
    answer = graph.client.call(
        "set_model_configuration", "SetModelConfiguration", model_name="arm", joint_names=["elbow"]
    )
    assert "different lengths" in answer.status_message


def test_the_properties_of_a_model_name_its_parts(graph):
    got = graph.client.call("get_model_properties", "GetModelProperties", model_name="r1")
    assert "wheel_left_link" in got.body_names
    assert "wheel_left_joint" in got.joint_names
    assert not got.is_static
    assert graph.client.call(
        "get_model_properties", "GetModelProperties", model_name="ground_plane"
    ).is_static


def test_a_model_that_was_moved_is_back_after_a_reset(graph):
    spawn(graph, initial_pose=pose(1.0, 0.0, 3.0))
    graph.sim.step(200)
    graph.client.call("reset_simulation", "std_srvs/Empty")
    assert graph.sim.time == 0.0
    assert graph.sim.robots["ball"].pose.z == pytest.approx(3.0)
    assert np.abs(graph.sim.robots["ball"].twist.linear).max() == 0.0


@pytest.mark.filterwarnings("ignore::gazelle.errors.FormatWarning")
def test_a_model_without_links_is_there_with_its_pose(graph):
    """A wrapper whose include is not found; the others must not suffer from it."""
    wrapper = (
        "<sdf version='1.6'><model name='wrap'><include><uri>model://nowhere</uri></include>"
        "</model></sdf>"
    )
    assert spawn(graph, wrapper, "wrap", initial_pose=pose(1.0, 2.0, 3.0)).success
    heard = graph.client.listen("/gazebo/model_states", "gazebo_msgs/ModelStates")
    links = graph.client.listen("/gazebo/link_states", "gazebo_msgs/LinkStates")
    graph.sim.run(seconds=0.05)

    def told():
        graph.sim.run(seconds=0.001)
        return bool(heard) and bool(links)

    until(told)
    states = heard[-1]
    place = states.pose[states.name.index("wrap")].position
    assert (place.x, place.y, place.z) == (1.0, 2.0, 3.0)
    assert "r1" in states.name
    answer = graph.client.call("get_model_state", "GetModelState", model_name="wrap")
    assert answer.success
    assert answer.pose.position.z == 3.0
    assert graph.client.call(
        "set_model_state", "SetModelState", model_state=model_state("wrap", pose(5.0))
    ).success
    assert graph.sim.robots["wrap"].pose.x == 5.0
    found = graph.client.call("get_model_properties", "GetModelProperties", model_name="wrap")
    assert (found.success, found.body_names) == (True, [])

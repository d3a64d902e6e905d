"""Answers of services to unusual calls, as of gazebo_ros_api_plugin."""

import math

import pytest
from graph_client import model_state
from odd_calls import ODD, kind_of

from gazelle_ros import load_message
from gazelle_ros.messages import load_service

POST = """<sdf version="1.6"><model name="post"><link name="foot"><inertial><mass>1</mass></inertial>
<collision name="sole"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision></link>
<link name="top"><inertial><mass>1</mass></inertial></link><joint name="weld" type="fixed">
<parent>foot</parent><child>top</child></joint><model name="lid"><link name="plate"><inertial><mass>1
</mass></inertial></link></model></model></sdf>"""


@pytest.mark.parametrize(("service", "fields", "text"), ODD)
def test_what_cannot_be_done_is_answered_as_by_gazebo(graph, service, fields, text):
    answer = graph.client.call(service, kind_of(service), **fields)
    assert (answer.success, answer.status_message) == (False, text)
    assert set(graph.client.call("get_world_properties", "GetWorldProperties").model_names) == set(
        graph.sim.robots
    )


@pytest.mark.parametrize(
    ("name", "frame", "text"),
    [
        ("no", "", "SetModelState: model does not exist"),
        ("no", "no", "SetModelState: model does not exist"),
        ("r1", "no", "SetModelState: specified reference frame entity does not exist"),
    ],
)
def test_a_state_of_nothing_is_not_set(graph, name, frame, text):
    state = model_state(name, load_message("geometry_msgs/Pose")(), frame)
    answer = graph.client.call("set_model_state", "SetModelState", model_state=state)
    assert (answer.success, answer.status_message) == (False, text)


@pytest.mark.parametrize(
    ("name", "frame", "text"),
    [
        ("no", "", "SetLinkState: link does not exist"),
        ("r1", "no", "SetLinkState: link does not exist"),
        ("r1::base_footprint", "no", "SetLinkState: failed"),
    ],
)
def test_a_state_of_no_link_is_not_set(graph, name, frame, text):
    state = load_message("gazebo_msgs/LinkState")(link_name=name, reference_frame=frame)
    answer = graph.client.call("set_link_state", "SetLinkState", link_state=state)
    assert (answer.success, answer.status_message) == (False, text)


@pytest.mark.parametrize(
    ("service", "field"),
    [("clear_joint_forces", "joint_name"), ("clear_body_wrenches", "body_name")],
)
def test_forces_on_nothing_are_cleared_without_a_word(graph, service, field):
    kind = {"joint_name": "JointRequest", "body_name": "BodyRequest"}[field]
    answer = graph.client.call(service, kind, **{field: "no"})
    assert answer == load_service(f"gazebo_msgs/{kind}")._response_class()


def test_a_refused_state_counts_and_says_when(graph):
    fields = {"model_name": "r1", "relative_entity_name": "no"}
    first = graph.client.call("get_model_state", "GetModelState", **fields)
    second = graph.client.call("get_model_state", "GetModelState", model_name="r1")
    assert (first.header.seq, first.header.frame_id) == (1, "no")
    assert (second.header.seq, second.success) == (2, True)


def test_a_fixed_joint_is_there_and_nothing_moves_it(graph):
    text = {"model_name": "post", "model_xml": POST}
    assert graph.client.call("spawn_sdf_model", "SpawnModel", **text).success
    for name in ("weld", "post::weld"):
        got = graph.client.call("get_joint_properties", "GetJointProperties", joint_name=name)
        assert (got.success, got.status_message) == (True, "GetJointProperties: got properties")
        assert (got.type, list(got.damping), list(got.rate)) == (0, [], [0.0])
        assert math.isnan(got.position[0])
    config = load_message("gazebo_msgs/ODEJointProperties")(damping=[0.7], fmax=[1.0], vel=[1.0])
    answer = graph.client.call(
        "set_joint_properties", "SetJointProperties", joint_name="weld", ode_joint_config=config
    )
    assert (answer.success, answer.status_message) == (True, "SetJointProperties: properties set")
    answer = graph.client.call(
        "apply_joint_effort", "ApplyJointEffort", joint_name="weld", effort=5.0
    )
    assert (answer.success, answer.status_message) == (True, "ApplyJointEffort: effort set")
    fields = {"model_name": "post", "joint_names": ["weld"], "joint_positions": [1.0]}
    answer = graph.client.call("set_model_configuration", "SetModelConfiguration", **fields)
    assert (answer.success, answer.status_message) == (True, "SetModelConfiguration: success")


def test_a_models_parts_are_its_own_and_its_children_are_named(graph):
    text = {"model_name": "post", "model_xml": POST}
    graph.client.call("spawn_sdf_model", "SpawnModel", **text)
    got = graph.client.call("get_model_properties", "GetModelProperties", model_name="post")
    assert (list(got.body_names), list(got.geom_names)) == (["foot", "top"], ["sole"])
    assert (list(got.joint_names), list(got.child_model_names)) == (["weld"], ["lid"])
    assert (got.parent_model_name, got.canonical_body_name, got.is_static) == ("", "", False)

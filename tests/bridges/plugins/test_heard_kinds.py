"""Every kind of value that ports and services take, from a message."""

import io
import random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from message_samples import random_message

import gazelle.bridges.binding  # noqa: F401  it teaches all kinds
from gazelle.bridges import conversions
from gazelle.bridges.conversions import decoder_of
from gazelle.navigation.values import GoalPose
from gazelle.simulation import Transforms
from gazelle.simulation.values import (
    Bias,
    DriveCommand,
    EmergencyStop,
    GeoReference,
    JointPath,
    LinkName,
    LinkPair,
    MotorPower,
    Number,
    PathRequest,
    Push,
    ServiceOutcome,
    Trigger,
    TurnCommand,
)
from gazelle_ros import load_message, load_service

DECODERS, SERVICES = conversions._DECODERS, conversions._SERVICES


def xyz(message):
    return [message.x, message.y, message.z]


def xyzw(message):
    return [*xyz(message), message.w]


def test_what_every_message_means_is_looked_at():
    assert set(HEARS) == set(DECODERS)
    assert set(ASKS) == set(SERVICES)


@pytest.mark.parametrize("kind", DECODERS, ids=lambda kind: kind.__name__)
@given(seed=st.integers(0, 2**32 - 1))
@settings(max_examples=25, deadline=None)
def test_a_message_becomes_a_value_that_says_the_same(kind, seed):
    decoder = decoder_of(kind)
    message = random_message(load_message(decoder.message), random.Random(seed))
    value = decoder.read(message)
    assert isinstance(value, kind)
    HEARS[kind](value, message)


def same_turn(value, message):
    told = np.array(xyzw(message))
    length = np.linalg.norm(told)
    with np.errstate(invalid="ignore"):
        wanted = told / length if length > 0.0 else [0.0, 0.0, 0.0, 1.0]
    return np.allclose(value, wanted, equal_nan=True)


def hears_data(value, message):
    assert value == message.data or (value != value and message.data != message.data)


def hears_number(value, message):
    hears_data(value.value, message)


def hears_goal(value, message):
    assert np.array_equal((value.x, value.y), xyz(message.pose.position)[:2], equal_nan=True)
    assert value.frame == message.header.frame_id
    assert (value.yaw is None) == (not any(xyzw(message.pose.orientation)))


def hears_path(value, message):
    count = len(message.joint_names)
    points = [each for each in message.points if len(each.positions) == count]
    assert value.names == tuple(message.joint_names)
    assert value.positions.shape == (len(points), count)
    assert list(value.times) == [each.time_from_start.to_sec() for each in points]
    assert value.start_ns == message.header.stamp.to_nsec()


def hears_turn(value, message):
    assert value.frame == message.header.frame_id
    assert same_turn(value.quaternion, message.quaternion)


def hears_push(value, message):
    told = (*value.force, *value.torque)
    assert np.array_equal(told, xyz(message.force) + xyz(message.torque), equal_nan=True)


def hears_power(value, message):
    assert value.on == bool(message.state)


def hears_transforms(value, message):
    assert len(value.transforms) == len(message.transforms)
    stamps = [each.header.stamp.to_nsec() for each in message.transforms]
    assert value.stamp == max(stamps, default=0)
    for one, each in zip(value.transforms, message.transforms, strict=True):
        assert (one.frame, one.child_frame) == (each.header.frame_id, each.child_frame_id)
        translation = xyz(each.transform.translation)
        assert np.array_equal(one.position, [translation], equal_nan=True)
        assert same_turn(one.quaternion[0], each.transform.rotation)


def hears_stop(value, message):
    assert value.on == bool(message.data)


def hears_drive(value, message):
    told = (value.left, value.right)
    assert np.array_equal(told, (message.left, message.right), equal_nan=True)


HEARS = {
    DriveCommand: hears_drive,
    EmergencyStop: hears_stop,
    GoalPose: hears_goal,
    JointPath: hears_path,
    Number: hears_number,
    TurnCommand: hears_turn,
    Push: hears_push,
    MotorPower: hears_power,
    Trigger: lambda value, _message: None,
    Transforms: hears_transforms,
    **dict.fromkeys((bool, int, float, str), hears_data),
}


@pytest.mark.parametrize("kinds", SERVICES, ids=lambda kinds: SERVICES[kinds].service)
@given(seed=st.integers(0, 2**32 - 1))
@settings(max_examples=25, deadline=None)
def test_a_service_is_asked_and_answers_in_its_messages(kinds, seed):
    codec = SERVICES[kinds]
    service = load_service(codec.service)
    request = random_message(service._request_class, random.Random(seed))
    question = codec.read(request)
    assert question is None if kinds[0] is None else isinstance(question, kinds[0])
    answers = {None: None, bool: True, ServiceOutcome: ServiceOutcome(success=True, text="done")}
    response = service._response_class(**codec.answer(answers[kinds[1]]))
    response.serialize(io.BytesIO())
    ASKS[kinds](question, request, response)


def asks_path(question, request, response):
    hears_path(question.path, request.joint_trajectory)
    assert (question.position is None) == (not request.set_model_pose)
    assert (response.success, response.status_message) == (True, "done")


def asks_pair(question, request, response):
    names = (question.model_1, question.link_1, question.model_2, question.link_2)
    assert names == (
        request.model_name_1,
        request.link_name_1,
        request.model_name_2,
        request.link_name_2,
    )
    assert response.ok


def asks_link(question, request, response):
    assert (question.model, question.link) == (request.model_name, request.link_name)
    assert response.ok


def asks_bias(question, request, _response):
    assert np.array_equal(question.values, xyz(request.bias), equal_nan=True)


def asks_reference(question, request, _response):
    place = request.geo_pose.position
    told = (question.latitude, question.longitude, question.altitude)
    assert np.array_equal(told, (place.latitude, place.longitude, place.altitude), equal_nan=True)


ASKS = {
    (None, None): lambda question, _request, _response: None,
    (PathRequest, ServiceOutcome): asks_path,
    (LinkPair, bool): asks_pair,
    (LinkName, bool): asks_link,
    (Bias, None): asks_bias,
    (GeoReference, None): asks_reference,
}


@pytest.mark.parametrize(("yaw", "heading"), [(0.0, 90.0), (90.0, 0.0), (-45.0, 135.0)])
def test_a_heading_counts_from_north_to_east(yaw, heading):
    service = load_service("hector_gazebo_plugins/SetReferenceGeoPose")
    request = service._request_class()
    turn = request.geo_pose.orientation
    turn.z, turn.w = np.sin(np.radians(yaw) / 2), np.cos(np.radians(yaw) / 2)
    question = SERVICES[GeoReference, None].read(request)
    assert np.degrees(question.heading) == pytest.approx(heading)


def test_a_path_without_joints_has_no_positions():
    message = load_message("trajectory_msgs/JointTrajectory")()
    message.points = [load_message("trajectory_msgs/JointTrajectoryPoint")(positions=[1.0])]
    assert decoder_of(JointPath).read(message).positions.shape == (0, 0)

"""The node marker_server of interactive_marker_twist_server."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from ros.graph import until

from gazelle_ros.base.errors import Error
from gazelle_ros.builtin.twist_marker_server import TwistMarkerSettings
from gazelle_ros.msgs import geometry_msgs, visualization_msgs

FEEDBACK = visualization_msgs.msg.InteractiveMarkerFeedback
CONTROL = visualization_msgs.msg.InteractiveMarkerControl
PLANE = {
    "linear_scale": {"x": 2.0, "y": 0.5},
    "max_positive_linear_velocity": {"x": 1.0, "y": 0.3},
    "max_negative_linear_velocity": {"x": -0.5, "y": -0.3},
}


def pose(x=0.0, y=0.0, yaw=0.0):
    made = geometry_msgs.msg.Pose()
    made.position.x, made.position.y = x, y
    made.orientation.z, made.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return made


def read(**values):
    return TwistMarkerSettings.read("/marker", values)


@given(st.floats(-3.0, 3.0), st.floats(-3.0, 3.0), st.floats(-3.0, 3.0))
def test_a_pull_is_a_velocity_within_limits(x, y, yaw):
    twist = read(**PLANE, angular_scale=1.5, max_angular_velocity=2.0).twist(pose(x, y, yaw))
    assert twist.linear.x == pytest.approx(min(max(2.0 * x, -0.5), 1.0))
    assert twist.linear.y == pytest.approx(min(max(0.5 * y, -0.3), 0.3))
    assert twist.linear.z == 0.0
    assert twist.angular.z == pytest.approx(min(max(1.5 * yaw, -2.0), 2.0), abs=1e-9)


def test_defaults_are_those_of_the_original():
    settings = read()
    assert settings.twist(pose(0.4, 0.7, 0.5)).linear == geometry_msgs.msg.Vector3(0.4, 0.0, 0.0)
    assert settings.twist(pose(yaw=0.5)).angular.z == pytest.approx(1.1)
    marker = settings.marker()
    assert (marker.name, marker.header.frame_id, marker.scale) == (
        "robot_twist_marker",
        "base_link",
        1.0,
    )
    modes = {each.name: each.interaction_mode for each in marker.controls}
    assert modes == {"move_x": CONTROL.MOVE_AXIS, "rotate_z": CONTROL.MOVE_ROTATE}


def test_a_marker_has_a_control_for_each_axis():
    by_axis = {name: {**each, "z": 1.0} for name, each in PLANE.items()}
    controls = read(**by_axis, robot_name="drone").marker().controls
    assert [each.name for each in controls] == ["move_x", "move_y", "move_z", "rotate_z"]
    assert controls[-1].interaction_mode == CONTROL.ROTATE_AXIS


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ({**PLANE, "linear_scale": {"w": 1.0}}, "'linear_scale' must be a mapping of x, y or z"),
        ({"linear_scale": {"x": 1.0}}, "'max_positive_linear_velocity' must be a mapping"),
        ({**PLANE, "max_positive_linear_velocity": {"x": 1.0}}, "are of the same axes"),
        ({"angular_scale": "fast"}, "'angular_scale' must be of type float"),
    ],
)
def test_wrong_parameters_are_refused(values, text):
    with pytest.raises(Error, match=text):
        read(**values)


def test_the_node_drives_while_its_marker_is_pulled(start, make_node, listen):
    start("interactive_marker_twist_server", "marker_server", "_robot_name:=husky", "_speed:=1")
    node = make_node("viewer")
    full = listen("/twist_marker_server/update_full", visualization_msgs.msg.InteractiveMarkerInit)
    moves = listen("/twist_marker_server/update", visualization_msgs.msg.InteractiveMarkerUpdate)
    speeds = listen("/twist_marker_server/cmd_vel", geometry_msgs.msg.Twist)
    until(lambda: any(each.markers for each in full))
    assert full[-1].markers[0].name == "husky_twist_marker"
    pull = node.advertise("/twist_marker_server/feedback", FEEDBACK)
    sent = FEEDBACK(
        marker_name="husky_twist_marker", client_id="me", event_type=FEEDBACK.POSE_UPDATE
    )
    sent.pose = pose(0.5, yaw=0.2)

    def driven():
        pull.publish(sent)
        return speeds and any(each.poses for each in moves)

    until(driven)
    assert (speeds[0].linear.x, speeds[0].angular.z) == pytest.approx((0.5, 0.44))
    back = next(each.poses[0].pose for each in moves if each.poses)
    assert (back.position.x, back.orientation.w) == (0.0, 1.0)

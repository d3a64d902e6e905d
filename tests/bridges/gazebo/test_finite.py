"""Numbers that are not finite are refused, and the world goes on."""

from __future__ import annotations

import math

import pytest
from ros.graph import until

from gazelle.bridges.gazebo.finite import not_finite
from gazelle_ros import load_message

NAN, INF = math.nan, math.inf


def state(**numbers):
    made = load_message("gazebo_msgs/ModelState")(model_name="r1")
    made.pose.orientation.w = 1.0
    for name, value in numbers.items():
        setattr(made.pose.position, name, value)
    return made


def test_the_first_number_that_is_not_finite_is_named():
    assert not_finite(state()) is None
    assert not_finite(state(y=-INF)) == "pose.position.y"
    assert not_finite(load_message("std_msgs/Float64MultiArray")(data=[0.0, NAN])) == "data[1]"


@pytest.mark.parametrize("bad", [NAN, INF])
def test_services_refuse_them(running, bad):
    client = running.client
    answer = client.call("set_model_state", "SetModelState", model_state=state(x=bad))
    assert not answer.success
    assert answer.status_message == "SetModelState: model_state.pose.position.x is not finite"
    effort = client.call(
        "apply_joint_effort", "ApplyJointEffort", joint_name="wheel_left_joint", effort=bad
    )
    assert not effort.success
    before = running.sim.time
    until(lambda: running.sim.time > before)


def test_topics_leave_them_out(running, caplog):
    kind = load_message("gazebo_msgs/ModelState")
    publisher = running.client.node.advertise("/gazebo/set_model_state", kind)
    until(lambda: publisher.num_connections == 1)
    publisher.publish(state(x=NAN))
    publisher.publish(state(x=0.5))
    until(lambda: abs(running.sim.robots["r1"].pose.position[0] - 0.5) < 0.05)
    assert "pose.position.x is not finite" in caplog.text

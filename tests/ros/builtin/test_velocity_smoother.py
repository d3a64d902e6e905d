"""The nodelet yocs_velocity_smoother: commands within limits of acceleration."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from ros.graph import Background, until

from gazelle_ros.base.errors import Error
from gazelle_ros.builtin.velocity_smoother import SmootherSettings, VelocitySmoother
from gazelle_ros.clock import SECOND, SimulatedClock
from gazelle_ros.msgs import dynamic_reconfigure, geometry_msgs, nav_msgs

TWIST = geometry_msgs.msg.Twist
LIMITS = {"speed_lim_v": 0.8, "speed_lim_w": 5.4, "accel_lim_v": 0.3, "accel_lim_w": 3.5}
SETTINGS = SmootherSettings(**LIMITS, decel_factor=2.0)
SPEEDS = st.tuples(st.floats(-0.8, 0.8), st.floats(-5.4, 5.4))


@given(SPEEDS, SPEEDS)
def test_a_step_goes_towards_the_target_as_fast_as_the_limits_allow(last, target):
    found = SETTINGS.next_command(last, target, (0.0, 0.0))
    steps = [there - here for here, there in zip(last, found, strict=True)]
    whole = [there - here for here, there in zip(last, target, strict=True)]
    limits = [
        accel / 20.0 * (1.0 if change * aim > 0.0 else 2.0)
        for accel, change, aim in zip((0.3, 3.5), whole, target, strict=True)
    ]
    for step, most in zip(steps, limits, strict=True):
        assert abs(step) <= most + 1e-12
    # The direction stays, and one of the two limits is used up, unless the target is reached.
    assert steps[0] * whole[1] == pytest.approx(steps[1] * whole[0], abs=1e-9)
    used = max(abs(step) / most for step, most in zip(steps, limits, strict=True))
    assert found == target or used == pytest.approx(1.0)


@given(SPEEDS)
def test_the_target_is_reached_in_the_time_that_the_limits_say(target):
    """From rest, the slower of the two decides: the time is a whole number of periods."""
    needed = max(abs(target[0]) / 0.3, abs(target[1]) / 3.5) * 20.0
    now, steps = (0.0, 0.0), 0
    while now != target:
        now = SETTINGS.next_command(now, target, (0.0, 0.0))
        steps += 1
    assert steps <= math.ceil(needed + 1e-6)
    assert steps >= math.floor(needed - 1e-6)


def test_a_robot_that_moves_against_the_target_brakes():
    by_odometry = SmootherSettings(**LIMITS, decel_factor=2.0, robot_feedback=1)
    ahead, back = (0.0, 0.0), (-0.5, 0.0)
    assert by_odometry.next_command(ahead, (0.8, 0.0), back)[0] == pytest.approx(0.03)
    assert SETTINGS.next_command(ahead, (0.8, 0.0), back)[0] == pytest.approx(0.015)


@pytest.fixture
def smoother(make_node):
    """Return a function that makes the node, whose clock a test sets."""

    def make(**parameters):
        clock = SimulatedClock()
        clock.set(SECOND)
        node = make_node("smoother", clock=clock)
        for name, value in (LIMITS | parameters).items():
            node.set_param(f"~{name}", value)
        return VelocitySmoother(node), clock

    return make


def command(made, clock, v, w=0.0, seconds=0.1):
    clock.set(clock.now() + round(seconds * SECOND))
    message = TWIST()
    message.linear.x, message.angular.z = v, w
    made.take(message)


def test_commands_are_repeated_while_others_come_and_then_stop(smoother, caplog):
    made, clock = smoother(accel_lim_v=10.0)
    assert made.step() is None
    for _ in range(4):
        command(made, clock, 2.0)  # beyond the limit of speed
    steps = [made.step() for _ in range(4)]
    assert [v for v, _ in steps] == pytest.approx([0.5, 0.8, 0.8, 0.8])
    clock.set(clock.now() + round(0.29 * SECOND))
    assert made.step() == (0.8, 0.0)
    clock.set(clock.now() + round(0.02 * SECOND))  # three periods without a command
    steps = [made.step() for _ in range(3)]
    assert steps[0][0] == pytest.approx(0.3)
    assert steps[1:] == [(0.0, 0.0), None]
    assert "commands ended with 0.8 m/s" in caplog.text


def test_a_robot_that_does_something_else_is_followed(smoother, caplog):
    made, clock = smoother(robot_feedback=2)
    command(made, clock, 0.5)
    made._take_robot(TWIST(linear=geometry_msgs.msg.Vector3(x=0.3)))
    assert made.step()[0] == pytest.approx(0.315)
    assert "unlike the commands" in caplog.text
    made._take_odometry(nav_msgs.msg.Odometry())  # is not the feedback that was chosen
    assert made._robot == (0.3, 0.0)


def test_the_node_publishes_on_its_private_topics(make_node, smoother, listen):
    made, clock = smoother()
    sender = make_node("sender").advertise("/smoother/raw_cmd_vel", TWIST)
    got = listen("/smoother/smooth_cmd_vel", TWIST)
    until(lambda: sender.num_connections and made._output.num_connections)
    message = TWIST()
    message.linear.x = 0.8
    sender.publish(message)
    until(lambda: made._target == (0.8, 0.0))
    kind = dynamic_reconfigure.srv.Reconfigure
    request = kind._request_class()
    request.config.doubles = [dynamic_reconfigure.msg.DoubleParameter("accel_lim_v", 1.0)]
    make_node("tuner").client("/smoother/set_parameters", kind).call(request)
    running = Background(made.run)
    until(lambda: got)
    assert got[0].linear.x == pytest.approx(0.05)
    clock.set(clock.now() + SECOND // 20)
    until(lambda: len(got) > 1)
    running.end()
    assert got[1].linear.x == pytest.approx(0.1)


@pytest.mark.parametrize(
    ("parameters", "words"),
    [
        ({"frequency": 0.0}, "frequency must be above 0"),
        ({"robot_feedback": 3}, "robot_feedback must be 0, 1 or 2"),
        ({"accel_lim_v": "fast"}, "'accel_lim_v' must be of type float"),
    ],
)
def test_a_wrong_parameter_is_an_error(smoother, parameters, words):
    with pytest.raises(Error, match=words):
        smoother(**parameters)


def test_a_missing_limit_is_named(make_node):
    with pytest.raises(Error, match="/smoother/speed_lim_v is not set"):
        VelocitySmoother(make_node("smoother"))

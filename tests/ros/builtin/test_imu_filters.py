"""The filters of imu_tools: orientation from gyroscope, gravity and north."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from ros.graph import until

from gazelle_ros import Time
from gazelle_ros.base.errors import Error
from gazelle_ros.base.rotations import conjugate, multiply, rotate
from gazelle_ros.builtin.imu.complementary import ComplementaryFilter, trust
from gazelle_ros.builtin.imu.madgwick import (
    WORLD_FRAMES,
    MadgwickFilter,
    gradient,
    measured_orientation,
)
from gazelle_ros.builtin.imu.node import ComplementaryNode, MadgwickNode
from gazelle_ros.builtin.imu.quaternions import unit, unit_quaternion
from gazelle_ros.clock import SECOND, SimulatedClock
from gazelle_ros.msgs import geometry_msgs, sensor_msgs, std_msgs, tf2_msgs

NUMBER = st.floats(-1.0, 1.0)
IMU, FIELD = sensor_msgs.msg.Imu, sensor_msgs.msg.MagneticField
UP = {"enu": (0.0, 0.0, 9.81), "nwu": (0.0, 0.0, 9.81), "ned": (0.0, 0.0, -9.81)}
# North, and 2 parts of it downwards.
MAGNET = {"enu": (0.0, 2e-5, -4e-5), "nwu": (2e-5, 0.0, -4e-5), "ned": (2e-5, 0.0, 4e-5)}


def drawn(parts):
    assume(sum(each**2 for each in parts) > 0.01)
    return unit_quaternion(parts)


ORIENTATIONS = st.tuples(NUMBER, NUMBER, NUMBER, NUMBER)


def seen(q, world):
    """Return what a sensor at rest measures: acceleration and field."""
    return rotate(conjugate(q), UP[world]), rotate(conjugate(q), MAGNET[world])


def angle(a, b):
    """Return the angle between two orientations [rad]."""
    x, y, z, w = multiply(conjugate(a), b)
    return 2.0 * math.atan2(math.sqrt(x * x + y * y + z * z), abs(w))


@given(ORIENTATIONS, st.tuples(NUMBER, NUMBER, NUMBER), st.tuples(NUMBER, NUMBER, NUMBER))
def test_the_gradient_is_that_of_the_squared_error(parts, direction, measured):
    q = drawn(parts)
    assume(unit(measured) is not None)

    def error(x, y, z, w):
        """Return half the squared error by equation 21, written as a matrix."""
        turn = np.array([
            [1 - 2 * y * y - 2 * z * z, 2 * (x * y - w * z), 2 * (w * y + x * z)],
            [2 * (x * y + w * z), 1 - 2 * x * x - 2 * z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (w * x + y * z), 1 - 2 * x * x - 2 * y * y],
        ])  # fmt: skip
        return 0.5 * float(((turn.T @ direction - measured) ** 2).sum())

    step = 1e-6
    for number, found in enumerate(gradient(q, direction, measured)):
        moved = [list(q), list(q)]
        moved[0][number] += step
        moved[1][number] -= step
        assert found == pytest.approx((error(*moved[0]) - error(*moved[1])) / (2 * step), abs=1e-6)


@given(ORIENTATIONS, st.sampled_from(WORLD_FRAMES))
def test_gravity_and_north_say_the_orientation(parts, world):
    q = drawn(parts)
    found = measured_orientation(world, *seen(q, world))
    assert angle(found, q) < 1e-6
    level = measured_orientation(world, seen(q, world)[0])  # any heading
    assert rotate(level, seen(q, world)[0]) == pytest.approx(UP[world], abs=1e-6)


def test_free_fall_and_the_magnetic_pole_say_none():
    assert measured_orientation("enu", (0.0, 0.0, 0.01)) is None
    assert measured_orientation("enu", (0.0, 0.0, 9.81), (0.0, 0.0, 1.0)) is None


@given(ORIENTATIONS, st.sampled_from(WORLD_FRAMES))
def test_a_resting_sensor_stays_at_its_true_orientation(parts, world):
    q = drawn(parts)
    made = MadgwickFilter(world, gain=0.1, orientation=q)
    for _ in range(5):
        made.update((0.0, 0.0, 0.0), *seen(q, world), 0.01)
    assert angle(made.orientation, q) < 0.002  # it moves by the gain at most, back and forth
    found = tuple(each / 9.80665 * 9.81 for each in made.gravity())
    assert found == pytest.approx(seen(made.orientation, world)[0], abs=1e-6)


@pytest.mark.parametrize("world", WORLD_FRAMES)
def test_madgwick_converges_from_a_wrong_orientation(world):
    q = unit_quaternion((0.3, -0.2, 0.4, 0.8))
    made = MadgwickFilter(world, gain=0.5)
    before = angle(made.orientation, q)
    for _ in range(600):
        made.update((0.0, 0.0, 0.0), *seen(q, world), 0.01)
    assert angle(made.orientation, q) < 0.02 < before


def turning(made, rate, seconds, steps):
    """Turn a sensor about its z axis, with gravity along it."""
    for _ in range(steps):
        made.update((0.0, 0.0, rate), (0.0, 0.0, 9.81), None, seconds / steps)
    return 2.0 * math.atan2(made.orientation[2], made.orientation[3])


@pytest.mark.parametrize("rate", [-1.5, -0.2, 0.0, 0.7])
def test_a_gyroscope_is_integrated(rate):
    first = ComplementaryFilter(do_bias_estimation=False)
    first.update((0.0, 0.0, 0.0), (0.0, 0.0, 9.81), None, 0.0)
    for made in (MadgwickFilter(gain=0.0), first):
        assert turning(made, rate, 2.0, 400) == pytest.approx(2.0 * rate, abs=1e-4)


def test_the_drift_of_a_gyroscope_is_found():
    made = MadgwickFilter(gain=0.3, zeta=0.05)
    for _ in range(10_000):
        made.update((0.0, 0.02, 0.03), *seen((0.0, 0.0, 0.0, 1.0), "enu"), 0.01)
    assert made.drift == pytest.approx((0.0, 0.02, 0.03), abs=0.01)


# The complementary filter -----------------------------------------------------------------


@given(ORIENTATIONS)
def test_the_first_measurement_is_taken_as_it_is(parts):
    q = drawn(parts)
    made = ComplementaryFilter()
    made.update((0.0, 0.0, 0.0), *seen(q, "nwu"), 0.01)
    assert angle(made.orientation, q) < 1e-6


def test_the_error_of_gravity_shrinks_by_the_gain():
    """After n steps of a resting sensor the tilt is about (1 - gain)^n of that at first."""
    tilt = 0.2
    start = unit_quaternion((math.sin(tilt / 2), 0.0, 0.0, math.cos(tilt / 2)))
    made = ComplementaryFilter(gain_acc=0.1, orientation=start)
    for _ in range(10):
        made.update((0.0, 0.0, 0.0), (0.0, 0.0, 9.81), None, 0.01)
    left = angle(made.orientation, (0.0, 0.0, 0.0, 1.0))
    assert left == pytest.approx(tilt * 0.9**10, rel=0.01)


def test_the_heading_is_corrected_by_the_field():
    made = ComplementaryFilter(gain_mag=0.1)
    made.orientation = unit_quaternion((0.0, 0.0, 0.1, 1.0))
    before = angle(made.orientation, (0.0, 0.0, 0.0, 1.0))
    for _ in range(10):
        made.update((0.0, 0.0, 0.0), (0.0, 0.0, 9.81), MAGNET["nwu"], 0.01)
    assert angle(made.orientation, (0.0, 0.0, 0.0, 1.0)) == pytest.approx(
        before * 0.9**10, rel=0.01
    )


def test_the_bias_of_a_resting_gyroscope_is_estimated():
    made = ComplementaryFilter(bias_alpha=0.1)
    for _ in range(21):
        made.update((0.05, 0.0, -0.1), (0.0, 0.0, 9.81), None, 0.01)
    # Not by the first one, which sets the orientation, nor the second, which differs from rest.
    left = 1.0 - 0.9**19
    assert made.bias == pytest.approx((0.05 * left, 0.0, -0.1 * left))
    assert made.is_steady
    made.update((0.05, 0.0, -0.2), (0.0, 0.0, 9.81), None, 0.01)
    assert not made.is_steady


@pytest.mark.parametrize(("error", "expected"), [(0.05, 1.0), (-0.1, 1.0), (0.15, 0.5), (0.3, 0.0)])
def test_acceleration_is_trusted_by_its_likeness_to_gravity(error, expected):
    assert trust((0.0, 0.0, 9.81 * (1.0 + error))) == pytest.approx(expected, abs=1e-9)


# The nodes --------------------------------------------------------------------------------

QUARTER = (0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5))


@pytest.fixture
def filtered(make_node, listen):
    """Return a function that makes a node, and one that sends it measurements at an orientation."""
    sender = make_node("sensor")
    imus, fields = sender.advertise("/imu/data_raw", IMU), sender.advertise("/imu/mag", FIELD)

    def make(kind, **parameters):
        clock = SimulatedClock()
        clock.set(SECOND)
        node = make_node("filter", clock=clock)
        for name, value in parameters.items():
            node.set_param(f"~{name}", value)
        made = kind(node)
        got, frames = listen("/imu/data", IMU), listen("/tf", tf2_msgs.msg.TFMessage)
        until(lambda: imus.num_connections and made._output.num_connections)
        until(lambda: not made.settings.use_mag or fields.num_connections)
        until(lambda: made._transforms.num_connections)

        def send(q, number, turn=0.0):
            acceleration, field = seen(q, getattr(made.settings, "world_frame", "nwu"))
            header = std_msgs.msg.Header(stamp=Time(nsecs=number * 10_000_000), frame_id="imu")
            vector = geometry_msgs.msg.Vector3
            imus.publish(
                IMU(header=header, linear_acceleration=vector(*acceleration),
                    angular_velocity=vector(z=turn))
            )  # fmt: skip
            if made.settings.use_mag:
                fields.publish(FIELD(header=header, magnetic_field=vector(*field)))
            until(lambda: len(got) >= number)
            return got[number - 1], frames

        return made, clock, send

    return make


def read(message):
    q = message.orientation
    return (q.x, q.y, q.z, q.w)


def test_madgwick_publishes_the_orientation_and_its_transform(filtered):
    _, _, send = filtered(MadgwickNode, orientation_stddev=0.1, remove_gravity_vector=True)
    message, frames = send(QUARTER, 1)
    assert angle(read(message), QUARTER) < 1e-6
    assert message.orientation_covariance[0] == pytest.approx(0.01)
    assert abs(message.linear_acceleration.z) < 0.01
    until(lambda: frames)
    (made,) = frames[0].transforms
    assert (made.header.frame_id, made.child_frame_id) == ("odom", "imu")
    assert made.transform.rotation.z == pytest.approx(message.orientation.z)


def test_yaw_is_shifted_in_the_message_only(filtered):
    _, _, send = filtered(MadgwickNode, yaw_offset=0.5, declination=0.2, reverse_tf=True)
    message, frames = send((0.0, 0.0, 0.0, 1.0), 1)
    assert message.orientation.z == pytest.approx(math.sin(0.15))
    until(lambda: frames)
    (made,) = frames[0].transforms
    assert (made.header.frame_id, made.child_frame_id) == ("imu", "odom")
    assert made.transform.rotation.z == pytest.approx(0.0)


def test_the_complementary_filter_subtracts_the_bias(filtered):
    made, _, send = filtered(ComplementaryNode, bias_alpha=0.5)
    for number in range(1, 6):
        message, frames = send(QUARTER, number, turn=0.1)
    assert message.angular_velocity.z == pytest.approx(0.1 - made.filter.bias[2])
    assert made.filter.bias[2] == pytest.approx(0.1 * (1 - 0.5**3))
    assert frames == []  # there is no transform by default


def test_a_jump_back_in_time_begins_anew(filtered, caplog):
    _, clock, send = filtered(ComplementaryNode)
    send(QUARTER, 1)
    clock.set(SECOND // 2)
    half = (0.0, math.sqrt(0.5), 0.0, math.sqrt(0.5))
    message, _ = send(half, 2)
    # The tilt is that of the new measurement at once.
    assert rotate(read(message), seen(half, "nwu")[0]) == pytest.approx(UP["nwu"], abs=1e-6)
    assert "time jumped back by 0.5 s" in caplog.text


@pytest.mark.parametrize(
    ("kind", "parameters", "words"),
    [
        (MadgwickNode, {"world_frame": "neu"}, "the world_frame is 'neu'; did you mean"),
        (MadgwickNode, {"constant_dt": -1.0}, "constant_dt must be at least 0"),
        (ComplementaryNode, {"gain_acc": 1.5}, "gain_acc must be 0 to 1"),
        (ComplementaryNode, {"use_mag": "yes"}, "'use_mag' must be of type bool"),
    ],
)
def test_a_wrong_parameter_is_an_error(make_node, kind, parameters, words):
    node = make_node("filter")
    for name, value in parameters.items():
        node.set_param(f"~{name}", value)
    with pytest.raises(Error, match=words):
        kind(node)

"""Every kind of value that ports publish, as a message."""

import io
import math

import numpy as np
import pytest
from control_samples import CONTROL_SAYS
from hypothesis import given, settings
from hypothesis import strategies as st
from picture_samples import PICTURES_SAY
from value_samples import FRAMES, MAKERS

import gazelle.bridges.binding
import gazelle.bridges.control  # noqa: F401  they teach all kinds
from gazelle.bridges import conversions
from gazelle.bridges.conversions import ConversionContext, encoder_of
from gazelle.engines import Motion, Placement
from gazelle.navigation.values import Path
from gazelle.sensors import ImuReading, LaserScan
from gazelle.simulation import JointStates, Odometry, Transforms, WrenchValue
from gazelle.simulation.values import (
    AltimeterValue,
    BumperValue,
    ChannelPoints,
    CliffValue,
    Fix,
    Flags,
    KobukiCore,
    LaserPoints,
    MagneticValue,
    PointValue,
    RangeValue,
    SonarValue,
    Touches,
    TruePose,
    UnsureImu,
    VectorValue,
)
from gazelle_ros import Time, load_message
from gazelle_ros.tf.naming import resolve_frame

ENCODERS = conversions._ENCODERS
OFFSET_NS = 5_000_000_000
# Gazebo's plugins of these publish their frame as it is written.
PLAIN = {
    ImuReading,
    UnsureImu,
    Fix,
    VectorValue,
    MagneticValue,
    PointValue,
    AltimeterValue,
    SonarValue,
    KobukiCore,
}
views = st.fixed_dictionaries(
    {
        "seed": st.integers(0, 2**32 - 1),
        "nworld": st.integers(1, 3),
        "stamp": st.integers(0, 10**13),
        "frame": st.sampled_from(["", *FRAMES]),
        "prefix": st.sampled_from(["", "r1", "/fleet/r1"]),
    }
)


def stamped(nanoseconds):
    total = nanoseconds + OFFSET_NS
    return Time(total // 10**9, total % 10**9)


def encoded(kind, case):
    """Return a value, its message after a way over the wire, the world it is of, and the view."""
    rng = np.random.default_rng(case["seed"])
    world = int(rng.integers(case["nworld"]))
    value = MAKERS[kind](rng, case["nworld"], case["stamp"])
    view = ConversionContext(case["frame"], world, stamped, case["prefix"])
    encoder = encoder_of(kind)
    message = load_message(encoder.message)()
    encoder.fill(message, value, view)
    buffer = io.BytesIO()
    message.serialize(buffer)
    back = type(message)()
    back.deserialize(buffer.getvalue())
    return value, back, world, view


def headers_of(message):
    """Return all headers in a message."""
    found = [message.header] if hasattr(message, "header") else []
    for name in ("transforms", "poses"):
        found += [each.header for each in getattr(message, name, ())]
    return found


def test_there_are_samples_of_every_kind_that_is_published():
    assert set(MAKERS) == set(ENCODERS)


def test_what_every_message_says_is_looked_at():
    assert set(SAYS) == set(ENCODERS)


@pytest.mark.parametrize("kind", ENCODERS, ids=lambda kind: kind.__name__)
@given(case=views)
@settings(max_examples=25, deadline=None)
def test_a_value_becomes_a_message_with_its_stamp_frame_and_contents(kind, case):
    value, message, world, view = encoded(kind, case)
    for header in headers_of(message):
        assert header.stamp == stamped(case["stamp"])
    if hasattr(message, "header"):
        own = getattr(value, "frame", case["frame"])
        plain = own if kind in PLAIN else resolve_frame(case["prefix"], own)
        assert message.header.frame_id == plain
    SAYS[kind](message, value, world, view)


def xyz(message):
    return [message.x, message.y, message.z]


def xyzw(message):
    return [*xyz(message), message.w]


def diagonal(values, size):
    return list(np.asarray(values).reshape(size, size).diagonal())


def says_odometry(message, value, world, view):
    assert message.child_frame_id == resolve_frame(view.prefix, value.child_frame)
    says_motion(message, value, world)


def says_true_pose(message, value, world, _view):
    assert message.child_frame_id == value.child_frame
    says_motion(message, value, world)


def says_motion(message, value, world):
    assert xyz(message.pose.pose.position) == list(value.position[world])
    assert xyzw(message.pose.pose.orientation) == list(value.quaternion[world])
    assert xyz(message.twist.twist.linear) == list(value.linear[world])
    assert xyz(message.twist.twist.angular) == list(value.angular[world])
    assert diagonal(message.pose.covariance, 6) == list(value.pose_variance)
    assert diagonal(message.twist.covariance, 6) == list(value.twist_variance)
    assert np.count_nonzero(message.pose.covariance) <= 6


def says_place(message, value, world, _view):
    assert xyz(message.position) == list(value.position[world])
    assert xyzw(message.orientation) == list(value.quaternion[world])


def says_speed(message, value, world, _view):
    assert xyz(message.linear) == list(value.linear[world])
    assert xyz(message.angular) == list(value.angular[world])


def says_joints(message, value, world, _view):
    assert message.name == list(value.names)
    assert list(message.position) == list(value.position[world])
    assert list(message.velocity) == list(value.velocity[world])
    effort = [] if value.effort is None else list(value.effort[world])
    assert list(message.effort) == effort


def says_transforms(message, value, world, view):
    assert len(message.transforms) == len(value.transforms)
    for one, each in zip(message.transforms, value.transforms, strict=True):
        names = (one.header.frame_id, one.child_frame_id)
        assert names == tuple(resolve_frame(view.prefix, n) for n in (each.frame, each.child_frame))
        assert xyz(one.transform.translation) == list(each.position[world])
        assert xyzw(one.transform.rotation) == list(each.quaternion[world])


def says_scan(message, value, world, _view):
    assert list(message.ranges) == pytest.approx(list(value.ranges[world]), rel=1e-6)
    assert len(message.intensities) == len(message.ranges)
    told = (message.angle_min, message.angle_max, message.angle_increment)
    assert told == pytest.approx((value.angle_min, value.angle_max, value.angle_increment))
    assert (message.range_min, message.range_max) == pytest.approx((0.1, 9.0))
    assert (message.time_increment, message.scan_time) == (0.0, 0.0)


def says_imu(message, value, world, _view):
    assert xyzw(message.orientation) == list(value.orientation[world])
    assert xyz(message.angular_velocity) == list(value.angular_velocity[world])
    assert xyz(message.linear_acceleration) == list(value.linear_acceleration[world])
    for covariance in (
        message.orientation_covariance,
        message.angular_velocity_covariance,
        message.linear_acceleration_covariance,
    ):
        assert np.array_equal(np.reshape(covariance, (3, 3)), value.variance * np.eye(3))


def says_unsure_imu(message, value, world, view):
    bare = ImuReading(
        value.reading.stamp,
        value.reading.orientation,
        value.reading.angular_velocity,
        value.reading.linear_acceleration,
    )
    parts = ("orientation", "angular_velocity", "linear_acceleration")
    variances = (value.orientation_variance, value.rate_variance, value.acceleration_variance)
    for part, variance in zip(parts, variances, strict=True):
        covariance = getattr(message, f"{part}_covariance")
        assert np.array_equal(np.reshape(covariance, (3, 3)), np.diag(variance))
        setattr(message, f"{part}_covariance", [0.0] * 9)
    says_imu(message, bare, world, view)


def says_wrench(message, value, world, _view):
    assert xyz(message.wrench.force) == list(value.force[world])
    assert xyz(message.wrench.torque) == list(value.torque[world])


def says_touches(message, value, world, _view):
    contacts = value.contacts[world]
    pairs = list(dict.fromkeys(zip(contacts.collisions, contacts.others, strict=True)))
    assert [(s.collision1_name, s.collision2_name) for s in message.states] == pairs
    for state in message.states:
        lengths = {
            len(each)
            for each in (
                state.wrenches,
                state.contact_positions,
                state.contact_normals,
                state.depths,
            )
        }
        assert len(lengths) == 1
        total = np.sum([xyz(wrench.force) for wrench in state.wrenches], axis=0)
        assert xyz(state.total_wrench.force) == pytest.approx(list(total))
    assert sum(len(state.depths) for state in message.states) == len(contacts)


def says_range(message, value, world, _view):
    assert message.range == pytest.approx(value.distance[world])
    assert (message.radiation_type == 0) == value.ultrasound
    limits = (message.min_range, message.max_range, message.field_of_view)
    assert limits == pytest.approx((value.least, value.most, value.field_of_view))


def says_path(message, value, world, _view):
    assert len(message.poses) == len(value.poses[world])
    for one, (x, y, yaw) in zip(message.poses, value.poses[world], strict=True):
        assert one.header.frame_id == message.header.frame_id
        assert xyz(one.pose.position) == [x, y, 0.0]
        turn = one.pose.orientation
        assert 2.0 * np.arctan2(turn.z, turn.w) == pytest.approx(yaw)


def says_cloud2(message, value, world, _view):
    kept = value.kept[world]
    assert (message.height, message.width, message.point_step) == (1, kept.sum(), 22)
    assert len(message.data) == message.row_step == 22 * kept.sum()
    fields = {"names": ["x", "y", "z", "ring"], "formats": ["<f4"] * 3 + ["<u2"]}
    layout = np.dtype({**fields, "offsets": [0, 4, 8, 16], "itemsize": 22})
    points = np.frombuffer(bytes(message.data), layout)
    assert np.allclose(
        np.stack([points[axis] for axis in "xyz"], axis=-1), value.points[world][kept], atol=1e-6
    )
    assert list(points["ring"]) == list(value.rings[kept])


def says_cloud(message, value, world, _view):
    kept = value.kept[world]
    told = np.array([xyz(point) for point in message.points]).reshape(-1, 3)
    assert np.allclose(told, value.points[world][kept], atol=1e-6)
    assert [channel.name for channel in message.channels] == ["intensities"]
    assert len(message.channels[0].values) == len(message.points)


def says_fix(message, value, world, _view):
    told = (message.latitude, message.longitude, message.altitude)
    assert told == (value.latitude[world], value.longitude[world], value.altitude[world])
    assert (message.status.status, message.status.service) == (value.status, value.service)
    assert np.array_equal(np.reshape(message.position_covariance, (3, 3)), np.diag(value.variance))
    assert message.position_covariance_type == 2


def says_vector(field):
    def look(message, value, world, _view):
        assert xyz(getattr(message, field)) == list(value.values[world])

    return look


def says_altimeter(message, value, world, _view):
    told = (message.altitude, message.pressure, message.qnh)
    wanted = (value.altitude[world], value.pressure[world], value.sea_level)
    assert told == pytest.approx(wanted, rel=1e-6)


def says_cliff(message, value, world, _view):
    assert (message.sensor, bool(message.state)) == (value.place, value.deep[world])
    assert message.bottom == int(value.reading[world])


def says_bump(message, value, world, _view):
    assert (message.bumper, bool(message.state)) == (value.place, value.pressed[world])


def says_core(message, value, world, _view):
    places = ("LEFT", "CENTRE", "RIGHT")
    for kind, flags in (("bumper", value.pressed), ("cliff", value.deep)):
        bits = [getattr(message, f"{kind.upper()}_{place}") for place in places]
        assert [bool(getattr(message, kind) & bit) for bit in bits] == flags[world].tolist()
    assert list(message.bottom) == value.floor[world, ::-1].astype(int).tolist()
    assert message.time_stamp == value.stamp // 10**6 % 2**16
    for ticks, angle in zip(
        (message.left_encoder, message.right_encoder), value.angles[world], strict=True
    ):
        turned = ticks * 0.002436916871363930
        assert abs(math.remainder(turned - angle, 2**16 * 0.002436916871363930)) < 0.0025
    assert message.charger == message.DISCHARGING


def says_data(message, value, _world, _view):
    assert message.data == value


def says_flag(message, value, world, _view):
    assert message.data == value.values[world]


SAYS = {
    **CONTROL_SAYS,
    **PICTURES_SAY,
    Odometry: says_odometry,
    TruePose: says_true_pose,
    Placement: says_place,
    Motion: says_speed,
    JointStates: says_joints,
    Transforms: says_transforms,
    LaserScan: says_scan,
    ImuReading: says_imu,
    UnsureImu: says_unsure_imu,
    WrenchValue: says_wrench,
    Touches: says_touches,
    RangeValue: says_range,
    SonarValue: says_range,
    Path: says_path,
    LaserPoints: says_cloud2,
    ChannelPoints: says_cloud,
    Fix: says_fix,
    VectorValue: says_vector("vector"),
    MagneticValue: says_vector("magnetic_field"),
    PointValue: says_vector("point"),
    AltimeterValue: says_altimeter,
    CliffValue: says_cliff,
    BumperValue: says_bump,
    KobukiCore: says_core,
    Flags: says_flag,
    **dict.fromkeys((bool, int, float, str), says_data),
}

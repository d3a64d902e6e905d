"""Measurements of sensors that are mounted anywhere, in the frames of the filter."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.description import Pose
from gazelle.engines.limits import NANOSECONDS
from gazelle.navigation.estimation import ExtendedPrediction, KalmanFilter, Measurement
from gazelle.navigation.estimation.sensors import (
    AccelerationSensor,
    FusionFrames,
    PoseSensor,
    VelocitySensor,
)
from gazelle.navigation.estimation.settings import SourceSettings

ANGLE = st.floats(-1.4, 1.4)
POSES = st.builds(Pose, *[st.floats(-3, 3)] * 3, ANGLE, ANGLE, ANGLE)
ALL = np.ones(15, bool)


def sensor(kind, source, transforms, used=ALL, state=None, *, flat=False, **more):
    """Return a sensor with transforms given as {(target, source): pose}."""

    def find(target, other, _stamp):
        return Pose() if target == other else transforms.get((target, other))

    elements = {
        PoseSensor: slice(0, 6),
        VelocitySensor: slice(6, 12),
        AccelerationSensor: slice(12, 15),
    }
    kalman = KalmanFilter(ExtendedPrediction(), initial_state=state)
    settings = SourceSettings(f"{source}0", source, "topic", used, **more)
    frames = FusionFrames("odom", "base", find, flat=flat)
    return kind(settings, frames, kalman, "part", elements[kind], 3.0)


def only(*elements):
    used = np.zeros(15, bool)
    used[list(elements)] = True
    return used


def pose_of(measurement: Measurement) -> Pose:
    return Pose(*measurement.values[:6])


@given(POSES, POSES)
def test_a_pose_is_moved_to_the_world(offset, pose):
    made = sensor(PoseSensor, "pose", {("odom", "map"): offset})
    found = made.measure("map", "base", 1, pose, np.eye(6))
    assert pose_of(found).is_close(offset * pose, angle=1e-6)
    assert found.used.sum() == 6
    np.testing.assert_allclose(found.covariance[:6, :6], np.eye(6), atol=1e-12)


@given(POSES, POSES)
def test_the_pose_of_a_child_is_that_of_the_robot_behind_it(mounted, pose):
    made = sensor(PoseSensor, "odom", {("camera", "base"): mounted.inverse()})
    found = made.measure("odom", "camera", 1, pose * mounted, np.eye(6))
    assert pose_of(found).is_close(pose, angle=1e-6)


@given(POSES, POSES)
def test_relative_poses_begin_at_zero(first, second):
    made = sensor(PoseSensor, "pose", {}, relative=True)
    assert pose_of(made.measure("odom", "base", 1, first, np.eye(6))).is_close(Pose())
    found = made.measure("odom", "base", 2, first * second, np.eye(6))
    assert pose_of(found).is_close(second, angle=1e-6)
    made.forget()
    assert pose_of(made.measure("odom", "base", 3, second, np.eye(6))).is_close(Pose())


def test_differences_of_poses_are_velocities_of_the_robot():
    made = sensor(PoseSensor, "odom", {}, used=only(0, 1, 5), differential=True)
    at = Pose(x=5.0, y=2.0, yaw=1.0)
    spread = 0.02 * np.eye(6)
    assert made.measure("elsewhere", "base", NANOSECONDS, at, spread) is None
    found = made.measure("elsewhere", "base", 2 * NANOSECONDS, at * Pose(x=0.3, yaw=0.2), spread)
    np.testing.assert_allclose(found.values[6:12], [0.3, 0, 0, 0, 0, 0.2], atol=1e-12)
    assert np.flatnonzero(found.used).tolist() == [6, 7, 11]
    assert found.covariance[6, 6] == pytest.approx(0.04)


@given(ANGLE, ANGLE)
def test_headings_of_a_turned_imu_are_those_of_the_robot(mounted, heading):
    imu = Pose(x=0.2, yaw=mounted)
    made = sensor(PoseSensor, "imu", {("base", "imu"): imu}, used=only(3, 4, 5))
    robot = Pose(roll=0.02, pitch=-0.01, yaw=heading)
    found = made.measure("imu", "base", 1, robot * Pose(yaw=mounted), np.eye(6))
    np.testing.assert_allclose(found.values[3:6], robot.rpy, atol=1e-9)


def test_an_axis_that_is_turned_onto_others_is_used_there():
    quarter = Pose(yaw=np.pi / 2)
    made = sensor(VelocitySensor, "twist", {("base", "side"): quarter}, used=only(6, 9))
    found = made.measure("side", 1, np.array([2.0, 0, 0, 0.5, 0, 0]), np.diag([4.0, 1, 1, 1, 1, 1]))
    assert np.flatnonzero(found.used).tolist() == [7, 10]
    np.testing.assert_allclose(found.values[[7, 10]], [2.0, 0.5])
    assert found.covariance[7, 7] == pytest.approx(4.0)


@given(POSES, st.lists(st.floats(-1, 1), min_size=6, max_size=6).map(np.array))
def test_velocities_beside_the_origin_are_those_of_the_robot(mounted, robot):
    """A point r of a body has v + w x r: from a sensor's own velocities the robot's come back."""
    state = np.zeros(15)
    state[9:12] = robot[3:]
    made = sensor(VelocitySensor, "twist", {("base", "side"): mounted}, state=state)
    back = mounted.inverse()
    there = robot[:3] + np.cross(robot[3:], mounted.position)
    seen = np.array([*back.rotate(there), *back.rotate(robot[3:])])
    found = made.measure("side", 1, seen, np.eye(6))
    np.testing.assert_allclose(found.values[6:12], robot, atol=1e-9)


@given(POSES, ANGLE, ANGLE, st.lists(st.floats(-1, 1), min_size=9, max_size=9).map(np.array))
def test_accelerations_beside_the_origin_are_those_of_the_robot(mounted, roll, pitch, motion):
    """A point r of a body has a + w' x r + w x (w x r), and an accelerometer feels it minus gravity."""
    robot = Pose(roll=roll, pitch=pitch)
    acceleration, turning, spin = motion.reshape(3, 3)
    state = np.zeros(15)
    state[3:6], state[9:12] = robot.rpy, turning
    made = sensor(
        AccelerationSensor, "imu", {("base", "imu"): mounted}, state=state, remove_gravity=True
    )
    made._frames.angular_acceleration = spin
    arm = np.array(mounted.position)
    there = acceleration + np.cross(spin, arm) + np.cross(turning, np.cross(turning, arm))
    felt = mounted.inverse().rotate(there + robot.inverse().rotate((0, 0, 9.80665)))
    for orientation in (None, robot * mounted):
        found = made.measure("imu", 1, np.array(felt), np.eye(3), orientation)
        np.testing.assert_allclose(found.values[12:], acceleration, atol=1e-9)


def test_a_flat_filter_pins_what_leaves_the_plane():
    made = sensor(VelocitySensor, "twist", {}, used=only(6), flat=True)
    found = made.measure("", 1, np.array([1.0, 0, 0.3, 0.2, 0.1, 0]), np.eye(6))
    assert np.flatnonzero(found.used).tolist() == [2, 3, 4, 6, 8, 9, 10, 14]
    assert found.values.tolist() == [0.0] * 6 + [1.0] + [0.0] * 8
    assert found.covariance[8, 8] == 1e-6


def test_nothing_is_measured_without_a_transform():
    for kind, rest in (
        (PoseSensor, ("base", 1, Pose(), np.eye(6))),
        (VelocitySensor, (1, np.zeros(6), np.eye(6))),
        (AccelerationSensor, (1, np.zeros(3), np.eye(3), None)),
    ):
        assert sensor(kind, "imu", {}).measure("unknown", *rest) is None

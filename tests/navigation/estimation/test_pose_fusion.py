"""Pose from changes of poses, as robot_pose_ekf has it."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.description import Pose
from gazelle.errors import Error
from gazelle.navigation.estimation.pose_fusion import PoseFusion, PoseFusionSettings

STEP = 100_000_000
ANGLE = st.floats(-3.0, 3.0)
PLANAR = st.builds(Pose, x=st.floats(-2, 2), y=st.floats(-2, 2), yaw=ANGLE)


def run(poses, start=None, covariances=None):
    """Return the estimate after poses of sensors, each {name: pose}, 0.1 s apart."""
    fusion = PoseFusion()
    fusion.begin(start or Pose(), STEP)
    for number, step in enumerate(poses, 2):
        for name, pose in step.items():
            size = 3 if name in ("imu", "gps") else 6
            spread = (covariances or {}).get(name, 1e-4) * np.eye(size)
            assert fusion.add(name, number * STEP, pose, spread)
        assert fusion.update(step, number * STEP)
    return fusion


@given(PLANAR, PLANAR, PLANAR)
def test_odometry_counts_by_its_change(start, first, change):
    """The first pose is where counting begins, so that the estimate keeps its own origin."""
    fusion = run([{"odom": first}, {"odom": first * change}], start)
    assert fusion.pose.is_close(start * change, position=1e-4, angle=1e-4)


def test_the_more_certain_heading_prevails():
    """Odometry turns by 0.5, the IMU by 0.2 rad; variances of 3 and 1 weigh them 1 to 3."""
    begin = {"odom": Pose(), "imu": Pose(yaw=2.0)}
    ahead = {"odom": Pose(x=0.3, yaw=0.5), "imu": Pose(yaw=2.2)}
    fusion = run([begin, ahead], covariances={"odom": 3e-4, "imu": 1e-4})
    assert fusion.pose.x == pytest.approx(0.3, abs=1e-6)
    assert fusion.pose.yaw == pytest.approx(0.25 * 0.5 + 0.75 * 0.2, abs=1e-6)
    # Covariances are scaled by the square of the time, 0.1 s, and add as information.
    assert fusion.covariance[5, 5] == pytest.approx(1e-2 / (1 / 3e-4 + 1 / 1e-4), rel=1e-3)
    assert fusion.covariance[0, 0] == pytest.approx(3e-6, rel=1e-3)


def test_the_tilt_of_an_imu_is_absolute():
    fusion = run([{"imu": Pose(yaw=1.0)}, {"imu": Pose(roll=0.1, pitch=-0.05, yaw=1.0)}])
    assert (fusion.pose.roll, fusion.pose.pitch) == pytest.approx((0.1, -0.05), abs=1e-6)


@given(PLANAR, st.builds(Pose, st.floats(-1, 1), st.floats(-1, 1), st.floats(-1, 1), yaw=ANGLE))
def test_visual_odometry_moves_in_space(start, change):
    fusion = run([{"vo": Pose(z=2.0)}, {"vo": Pose(z=2.0) * change}], start)
    assert fusion.pose.is_close(start * change, position=1e-4, angle=1e-4)


def test_gps_is_where_it_is():
    fusion = run([{"gps": Pose(x=9.0)}, {"gps": Pose(x=3.0, y=-2.0, z=1.0)}])
    assert fusion.pose.position == pytest.approx((3.0, -2.0, 1.0), abs=1e-6)


def test_a_sensor_that_comes_late_counts_from_its_second_update():
    fusion = run([
        {"odom": Pose()}, {"odom": Pose(x=1.0), "vo": Pose(x=7.0)},
        {"odom": Pose(x=2.0), "vo": Pose(x=8.0)},
    ])  # fmt: skip
    assert fusion.pose.x == pytest.approx(2.0, abs=1e-6)


def test_poses_between_messages_are_interpolated():
    fusion = PoseFusion()
    fusion.begin(Pose(), STEP)
    for number, x in ((3, 2.0), (1, 0.0)):  # in any order
        fusion.add("odom", number * STEP, Pose(x=x, yaw=x), 1e-4 * np.eye(6))
    assert fusion.update(["odom"], STEP + STEP // 2)
    assert fusion.update(["odom"], 2 * STEP)
    # From 0.5 m and 0.5 rad to twice that.
    assert fusion.pose.is_close(Pose(yaw=-0.5) * Pose(x=0.5, yaw=1.0), position=1e-6, angle=1e-6)
    assert not fusion.update(["odom"], 2 * STEP)
    assert not fusion.update(["odom"], 4 * STEP)
    assert not fusion.add("odom", 4 * STEP, Pose(), np.zeros((6, 6)))


def test_parameters(caplog):
    settings = PoseFusionSettings.read({"freq": 10, "vo_used": False, "imu_use": True})
    assert (settings.freq, settings.vo_used, settings.output_frame) == (
        10.0,
        False,
        "odom_combined",
    )
    assert "~/imu_use is an unknown parameter; did you mean 'imu_used'" in caplog.text
    with pytest.raises(Error, match="are both 'base_footprint'"):
        PoseFusionSettings.read({"output_frame": "base_footprint"})

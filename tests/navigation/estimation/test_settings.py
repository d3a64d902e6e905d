"""Parameters of the filters of robot_localization."""

from __future__ import annotations

import numpy as np
import pytest

from gazelle.errors import Error
from gazelle.navigation.estimation.settings import FilterSettings

CONFIG = [False] * 6 + [True] + [False] * 8


def test_names_and_defaults_are_the_originals():
    settings = FilterSettings.read({"odom0": "odom", "odom0_config": CONFIG})
    assert (settings.frequency, settings.sensor_timeout) == (30.0, pytest.approx(1 / 30))
    assert (settings.world_frame, settings.base_link_frame_output) == ("odom", "base_link")
    (source,) = settings.sources
    assert (source.name, source.topic, source.queue_size) == ("odom0", "odom", 1)
    assert np.flatnonzero(source.used).tolist() == [6]
    assert source.pose_threshold == np.inf


def test_thresholds_have_the_names_of_each_kind():
    names = {
        "odom0_pose_rejection_threshold": 5, "odom0_twist_rejection_threshold": 1,
        "pose0_rejection_threshold": 2.0, "twist0_rejection_threshold": 3.0,
        "imu0_pose_rejection_threshold": 0.8, "imu0_angular_velocity_rejection_threshold": 0.7,
        "imu0_linear_acceleration_rejection_threshold": 0.6,
    }  # fmt: skip
    kinds = ("odom0", "pose0", "twist0", "imu0")
    topics = dict.fromkeys(kinds, "topic") | {f"{name}_config": CONFIG for name in kinds}
    odom, pose, twist, imu = FilterSettings.read(topics | names).sources
    assert (odom.pose_threshold, odom.twist_threshold) == (5.0, 1.0)
    assert (pose.pose_threshold, twist.twist_threshold) == (2.0, 3.0)
    assert (imu.pose_threshold, imu.twist_threshold, imu.acceleration_threshold) == (0.8, 0.7, 0.6)


def test_control_uses_the_limits_of_acceleration_for_braking():
    settings = FilterSettings.read({
        "use_control": True, "control_config": [1, 0, 0, 0, 0, 1],
        "acceleration_limits": [1.3, 0, 0, 0, 0, 3.4], "deceleration_gains": [2.0] * 6,
    })  # fmt: skip
    control = settings.control
    assert control.deceleration_limits.tolist() == [1.3, 0, 0, 0, 0, 3.4]
    assert control.acceleration_gains.tolist() == [1.0] * 6
    assert control.deceleration_gains.tolist() == [2.0] * 6


def test_numbers_of_covariances_may_be_text():
    """YAML has ``1e-9``, without a point, as text."""
    diagonal = np.diag([1e-9] * 15).ravel().tolist()
    written = ["1e-9" if each else 0 for each in diagonal]
    settings = FilterSettings.read({"initial_estimate_covariance": written})
    np.testing.assert_array_equal(settings.initial_covariance, np.diag([1e-9] * 15))
    with pytest.raises(Error, match="a list of 225 numbers"):
        FilterSettings.read({"initial_estimate_covariance": ["nan"] * 225})


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ({"two_d_mod": True}, "~/two_d_mod is an unknown parameter; did you mean 'two_d_mode'"),
        (
            {"odom0": "odom", "odom0_config": CONFIG, "odom0_diferential": True},
            "~/odom0_diferential is an unknown parameter; did you mean 'odom0_differential'",
        ),
        (
            {"odom0": "o", "odom0_config": CONFIG, "odom2": "o", "odom2_config": CONFIG},
            "odom2 is ignored, as those after it: there is no odom1",
        ),
        ({"odom0": "odom", "odom0_config": [False] * 15}, "all of odom0_config is false"),
        (
            {"odom0": "odom", "odom0_config": CONFIG, "odom0_differential": True, "odom0_relative": True},
            "taken as differential",
        ),
        ({"debug": True}, "'debug' is not supported"),
    ],
)  # fmt: skip
def test_doubtful_parameters_are_logged(values, text, caplog):
    FilterSettings.read(values)
    assert text in caplog.text


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ({"odom0": "odom"}, "'odom0_config' must be a list of 15 bools, not None"),
        ({"odom0": "odom", "odom0_config": CONFIG[:-1]}, "a list of 15 bools"),
        ({"process_noise_covariance": [0.1] * 15}, "a list of 225 numbers"),
        ({"initial_state": [0.0] * 14 + ["x"]}, "a list of 15 numbers"),
        ({"frequency": 0.0}, "frequency must be above 0"),
        ({"history_length": -1.0}, "'history_length' must not be negative"),
        ({"odom_frame": "map"}, "are different frames"),
        ({"world_frame": "earth"}, "is the map_frame 'map' or the odom_frame 'odom'"),
        ({"frequency": "fast"}, "'frequency' must be of type float"),
    ],
)
def test_wrong_parameters_are_errors(values, text):
    with pytest.raises(Error, match=text):
        FilterSettings.read(values)

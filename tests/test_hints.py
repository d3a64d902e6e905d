"""A hint offers what is near, and nothing where all are far."""

import pytest

from gazelle.errors import closest_of, did_you_mean
from gazelle.simulation import registry


@pytest.mark.parametrize(
    ("meant", "offered"),
    [
        ("libgazebo_ros_dif_drive.so", "libgazebo_ros_diff_drive.so"),
        ("libgazebo_ros_diffdrive.so", "libgazebo_ros_diff_drive.so"),
        ("libgazebo_ros_imu_sensors.so", "libgazebo_ros_imu_sensor.so"),
        ("libgazebo_ros_skid_steer.so", "libgazebo_ros_skid_steer_drive.so"),
        ("libgazebo_ros_lasr.so", "libgazebo_ros_laser.so"),
        ("libWheelSlipPlugn.so", "libWheelSlipPlugin.so"),
    ],
)
def test_a_plugin_that_is_near_is_offered(meant, offered):
    assert did_you_mean(meant, registry.names()) == f"did you mean '{offered}'?"


@pytest.mark.parametrize(
    "name",
    [
        "libgazebo_ros_ackermann_drive.so",
        "libgazebo_ros_omni_drive.so",
        "libgazebo_ros_foo.so",
        "libgazebo_ros_wheel_sensor.so",
        "libgazebo_ros_trajectory_follower.so",
        "libgazebo_motor_model.so",
    ],
)
def test_a_plugin_that_only_has_the_usual_words_is_not(name):
    assert not did_you_mean(name, registry.names()).startswith("did you mean")


def test_short_lists_count_every_word():
    known = ["group", "group_state", "passive_joint", "virtual_joint", "joint_property"]
    assert did_you_mean("grup", known) == "did you mean 'group'?"
    assert did_you_mean("colision", ["collision", "visual"]) == "did you mean 'collision'?"
    assert did_you_mean("x", []) == "there are none"


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("burger", "turtlebot3_burger"),
        ("Burger", "turtlebot3_burger"),
        ("stage_1", "turtlebot3_stage_1"),
        ("fetch", "fetch_arm"),
        ("my_cartpole_v2", "cartpole"),
        ("house", None),
        ("bot", None),
        ("art", None),
    ],
)
def test_a_word_of_a_longer_name_is_close_to_it(name, meant):
    known = ["turtlebot3_burger", "turtlebot3_stage_1", "turtlebot3_stage_10", "fetch_arm"]
    known += ["turtlebot3_burger_for_autorace", "fetch_arm_and_base", "cartpole"]
    hint = closest_of(name, known)
    assert hint == (None if meant is None else f"did you mean '{meant}'?")


def test_a_name_of_the_same_letters_is_the_closest():
    names = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    assert closest_of("iyx", names) == "did you mean 'ixy'?"
    assert closest_of("izx", names) == "did you mean 'ixz'?"
    assert closest_of("izy", names) == "did you mean 'iyz'?"

"""The suites of ros_control and ros_controllers, against Python robots with Gazelle's controllers.

Debian has no package of either: their sources are checkouts of ros-controls/ros_control and
ros-controls/ros_controllers (noetic-devel), and of ros-controls/realtime_tools for its headers.
"""

from __future__ import annotations

from rossuites.catalogue import Suite
from rossuites.compiling import Client

_ALONE = frozenset({"alone"})
_MANAGER = {"dummy_app": "dummy_app.py"}
_ARM = {"rrbot": "rrbot.py", "rrbot_wrapping": "rrbot_wrapping.py"}
_PARTIAL = "joint_partial_trajectory_controller_test"
_BASE = {
    "bad_urdf": 1,
    "controller": 3,
    "controller_limits": 5,
    "controller_nan": 2,
    "default_cmd_vel_out": 1,
    "default_odom_frame": 2,
    "default_wheel_joint_controller_state": 1,
    "dyn_reconf": 2,
    "get_wheel_radius_fail": 1,
    "left_right_multipliers": 3,
    "multiple_cmd_vel_publishers": 1,
    "multipliers": 3,
    "odom_frame": 3,
    "odom_tf": 1,
    "open_loop": 3,
    "pub_cmd_vel_out": 1,
    "publish_wheel_joint_controller_state": 1,
    "radius_param": 3,
    "radius_param_fail": 1,
    "radius_sphere": 3,
    "separation_param": 3,
    "timeout": 1,
    "wrong": 1,
}
_CAR = {
    "": 3,
    "_default_odom_frame": 2,
    "_limits": 6,
    "_nan": 1,
    "_no_steer": 1,
    "_no_wheel": 1,
    "_odom_frame": 3,
    "_odom_tf": 1,
    "_open_loop": 3,
    "_radius_param": 3,
    "_radius_param_fail": 1,
    "_separation_param": 3,
    "_timeout": 1,
}


def _car(name: str) -> str:
    """Return the folder of a test file: in ackermann_steering_controller each has its own."""
    stem = f"ackermann_steering_controller{name}"
    return f"test/{stem}_test/{stem}.test"


CONTROL = (
    Suite(
        "controller_manager",
        "controller_manager_tests",
        {
            "test/cm_test.test": 7,
            "test/cm_msgs_utils_rostest.test": 5,
            "test/controller_manager_interface_test.test": 1,
            "test/controller_manager_scripts.test": 1,
        },
        only=_ALONE,
        robots=_MANAGER,
        compiled=True,
    ),
    Suite(
        "combined_robot_hw",
        "combined_robot_hw_tests",
        {"test/cm_test.test": 6},
        only=_ALONE,
        robots={"combined_robot_hw_dummy_app": "combined_dummy_app.py"},
        compiled=True,
    ),
    Suite(
        "joint_trajectory_controller",
        "joint_trajectory_controller",
        {
            "test/joint_trajectory_controller.test": 27,
            "test/joint_trajectory_controller_vel.test": 28,
            "test/joint_trajectory_controller_stopramp.test": 27,
            "test/joint_trajectory_controller_wrapping.test": 1,
        },
        only=_ALONE,
        robots=_ARM,
        compiled=True,
    ),
    Suite(
        "joint_trajectory_controller, partial",
        "joint_trajectory_controller",
        # ros_controllers does not build this one: nine of its twelve send two values for one joint,
        # which its own check of messages refuses.
        {"test/joint_partial_trajectory_controller.test": 3},
        only=_ALONE,
        robots=_ARM,
        compiled=True,
        clients=(Client(_PARTIAL, (f"test/{_PARTIAL}.cpp",)),),
    ),
    Suite(
        "diff_drive_controller",
        "diff_drive_controller",
        {f"test/diff_drive_{name}.test": count for name, count in _BASE.items()}
        | {"test/skid_steer_controller.test": 3, "test/skid_steer_no_wheels.test": 1},
        only=_ALONE,
        robots={"diffbot": "diffbot.py 2", "skidsteerbot": "diffbot.py 6"},
        compiled=True,
    ),
    Suite(
        "ackermann_steering_controller",
        "ackermann_steering_controller",
        {_car(name): count for name, count in _CAR.items()}
        | {
            "test/ackermann_steering_controller_fail_test/ackermann_steering_controller_wrong.test": 1
        },
        only=_ALONE,
        robots={
            "ackermann_steering_controller_ackermann_steering_bot": "ackermann_steering_bot.py"
        },
        compiled=True,
    ),
    Suite(
        "four_wheel_steering_controller",
        "four_wheel_steering_controller",
        {
            "test/four_wheel_steering_controller_4ws_cmd.test": 5,
            "test/four_wheel_steering_controller_twist_cmd.test": 3,
            "test/four_wheel_steering_wrong_config.test": 1,
        },
        only=_ALONE,
        robots={"four_wheel_steering": "four_wheel_steering.py"},
        compiled=True,
    ),
    Suite(
        "effort_controllers",
        "effort_controllers",
        {"test/effort_position_controller.test": 1},
        only=_ALONE,
        robots={"simple_bot_hw": "simple_bot_hw.py"},
        compiled=True,
    ),
)

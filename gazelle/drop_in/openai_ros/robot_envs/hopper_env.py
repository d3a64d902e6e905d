"""The monoped on a graph."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, ClassVar

from gazelle.drop_in.openai_ros.gazebo_connection import WORLD
from gazelle.drop_in.openai_ros.robot_envs.topic_robot_env import RobotTopic, TopicRobotEnv
from gazelle_ros.msgs import std_msgs

_SPACE = "monoped"
_JOINTS = ("haa", "hfe", "kfe")
_LONGEST_S = 2.0


class HopperEnv(TopicRobotEnv):
    """A leg with three joints; time continues in a reset."""

    package: ClassVar[str] = "legged_robots_sims"
    sensors = (
        RobotTopic("odom", "/odom", "nav_msgs/Odometry"),
        RobotTopic("imu", f"/{_SPACE}/imu/data", "sensor_msgs/Imu"),
        RobotTopic(
            "lowerleg_contactsensor_state",
            "/lowerleg_contactsensor_state",
            "gazebo_msgs/ContactsState",
        ),
        RobotTopic("joint_states", f"/{_SPACE}/joint_states", "sensor_msgs/JointState"),
    )
    robot_name_space = _SPACE
    controllers_list = (
        "joint_state_controller",
        *(f"{name}_joint_position_controller" for name in _JOINTS),
    )
    reset_kind: ClassVar[str] = WORLD
    odom: Any
    imu: Any
    lowerleg_contactsensor_state: Any
    joint_states: Any

    def _open_publishers(self) -> None:
        super()._open_publishers()
        self._haa_joint_pub, self._hfe_joint_pub, self._kfe_joint_pub = (
            self._publisher(
                f"/{_SPACE}/{name}_joint_position_controller/command", "std_msgs/Float64"
            )
            for name in _JOINTS
        )

    def move_joints(
        self,
        joints_array: Sequence[float],
        epsilon: float = 0.05,
        update_rate: float = 10,
        time_sleep: float = 0.05,
        check_position: bool = True,  # noqa: FBT001, FBT002  # openai_ros' interface
    ) -> None:
        """Command the joints haa, hfe and kfe.

        Args:
            joints_array: Positions [rad].
            epsilon: Tolerance [rad].
            update_rate: Rate of the checks [Hz].
            time_sleep: Time to wait otherwise [s].
            check_position: Wait until they are there, for 2 simulated seconds at most.
        """
        number = std_msgs.msg.Float64
        for publisher, position in zip(self.publishers_array, joints_array, strict=True):
            publisher.publish(number(float(position)))
        if check_position:
            self.wait_time_for_execute_movement(joints_array, epsilon, update_rate)
        else:
            self.simulated_time.wait(time_sleep)

    def wait_time_for_execute_movement(
        self, joints_array: Sequence[float], epsilon: float, update_rate: float
    ) -> None:
        """Wait until the joints are where they shall be, for 2 simulated seconds at most."""
        for _ in range(math.ceil(_LONGEST_S * update_rate)):
            states = self._check_sensor_ready("joint_states")
            if self.check_array_similar(joints_array, states.position[:3], epsilon):
                return
            self.simulated_time.wait(1.0 / update_rate)

"""The cube moved by a wheel in its face, on a graph."""

from __future__ import annotations

from typing import Any, ClassVar

from gazelle.drop_in.openai_ros.robot_envs.topic_robot_env import RobotTopic, TopicRobotEnv
from gazelle_ros.msgs import std_msgs

_SPACE = "moving_cube"
_WHEEL = "inertia_wheel_roll_joint"
_NEAR = 0.1  # to a velocity that is waited for [rad/s]
_LONGEST_S = 2.0
_LOOK_S = 0.1


class CubeSingleDiskEnv(TopicRobotEnv):
    """A cube with one wheel; its controllers are reset with every episode, and time too."""

    package: ClassVar[str] = "moving_cube_description"
    sensors = (
        RobotTopic("joints", f"/{_SPACE}/joint_states", "sensor_msgs/JointState"),
        RobotTopic("odom", f"/{_SPACE}/odom", "nav_msgs/Odometry"),
    )
    robot_name_space = _SPACE
    controllers_list = ("joint_state_controller", f"{_WHEEL}_velocity_controller")
    reset_controls = True
    set_physics: ClassVar[bool] = True
    joints: Any
    odom: Any

    def _open_publishers(self) -> None:
        super()._open_publishers()
        topic = f"/{_SPACE}/{_WHEEL}_velocity_controller/command"
        self._roll_vel_pub = self._publisher(topic, "std_msgs/Float64")

    def move_joints(self, roll_speed: float) -> None:
        """Command the wheel [rad/s], and wait until it has that speed."""
        self._roll_vel_pub.publish(std_msgs.msg.Float64(float(roll_speed)))
        self.wait_until_roll_is_in_vel(float(roll_speed))

    def wait_until_roll_is_in_vel(self, velocity: float) -> None:
        """Wait until the wheel is within 0.1 rad/s of a velocity, for 2 simulated seconds at most.

        openai_ros waits without end, and so for ever where the motor is too weak.
        """
        for _ in range(round(_LONGEST_S / _LOOK_S)):
            joints = self._check_sensor_ready("joints")
            if abs(joints.velocity[0] - velocity) <= _NEAR:
                return
            self.simulated_time.wait(_LOOK_S)

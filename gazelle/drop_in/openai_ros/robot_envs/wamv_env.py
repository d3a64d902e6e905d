"""The WAM-V on a graph."""

from __future__ import annotations

from typing import Any, ClassVar

from gazelle.drop_in.openai_ros.gazebo_connection import WORLD
from gazelle.drop_in.openai_ros.robot_envs.topic_robot_env import RobotTopic, TopicRobotEnv
from gazelle_ros.msgs import usv_msgs


class WamvEnv(TopicRobotEnv):
    """A catamaran with ``/wamv/odom`` and two propellers; time continues in a reset."""

    package: ClassVar[str] = "robotx_gazebo"
    launch_file: ClassVar[str] = "put_wamv_in_world.launch"
    sensors = (RobotTopic("odom", "/wamv/odom", "nav_msgs/Odometry"),)
    reset_kind: ClassVar[str] = WORLD
    odom: Any

    def _open_publishers(self) -> None:
        super()._open_publishers()
        self._cmd_drive_pub = self._publisher("/cmd_drive", "usv_msgs/UsvDrive")

    def set_propellers_speed(
        self, right_propeller_speed: float, left_propeller_speed: float, time_sleep: float = 1.0
    ) -> None:
        """Command both propellers, and let them act.

        Args:
            right_propeller_speed: From -1 (full astern) to 1 (full ahead).
            left_propeller_speed: Likewise.
            time_sleep: Duration [s of simulated time].
        """
        drive = usv_msgs.msg.UsvDrive
        for publisher in self.publishers_array:
            publisher.publish(drive(left=left_propeller_speed, right=right_propeller_speed))
        self.wait_time_for_execute_movement(time_sleep)

    def wait_time_for_execute_movement(self, time_sleep: float) -> None:
        """Wait while a command acts."""
        self.simulated_time.wait(time_sleep)

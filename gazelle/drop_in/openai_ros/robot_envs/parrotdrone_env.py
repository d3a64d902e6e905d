"""The Parrot drone on a graph."""

from __future__ import annotations

import math
from typing import Any, ClassVar

from gazelle.drop_in.openai_ros.gazebo_connection import WORLD
from gazelle.drop_in.openai_ros.robot_envs.topic_robot_env import RobotTopic, TopicRobotEnv
from gazelle_ros.compat import rospy
from gazelle_ros.msgs import geometry_msgs, std_msgs

_HOLD_S = 1.0
"""Time that a velocity acts before a step continues [s of simulated time]."""
_UP, _DOWN = 0.8, 0.6
"""Heights above which it has taken off, and below which it has landed [m]."""
_LONGEST_S = 10.0


class ParrotDroneEnv(TopicRobotEnv):
    """A drone with two cameras, an IMU and a sonar; time continues in a reset."""

    package: ClassVar[str] = "drone_construct"
    launch_file: ClassVar[str] = "put_drone_in_world.launch"
    sensors = (
        RobotTopic(
            "down_camera_rgb_image_raw", "/drone/down_camera/image_raw", "sensor_msgs/Image"
        ),
        RobotTopic(
            "front_camera_rgb_image_raw", "/drone/front_camera/image_raw", "sensor_msgs/Image"
        ),
        RobotTopic("imu", "/drone/imu", "sensor_msgs/Imu"),
        RobotTopic("sonar", "/drone/sonar", "sensor_msgs/Range"),
        RobotTopic("gt_pose", "/drone/gt_pose", "geometry_msgs/Pose"),
        RobotTopic("gt_vel", "/drone/gt_vel", "geometry_msgs/Twist"),
    )
    reset_kind: ClassVar[str] = WORLD
    sonar: Any
    gt_pose: Any
    gt_vel: Any

    def _open_publishers(self) -> None:
        super()._open_publishers()
        self._cmd_vel_pub = self._publisher("/cmd_vel", "geometry_msgs/Twist")
        self._takeoff_pub = self._publisher("/drone/takeoff", "std_msgs/Empty")
        self._land_pub = self._publisher("/drone/land", "std_msgs/Empty")

    def takeoff(self) -> None:
        """Take off, with time advancing until the drone is 0.8 m high."""
        self._go(self._takeoff_pub, _UP, smaller_than=False)

    def land(self) -> None:
        """Land, with time advancing until the drone is 0.6 m high."""
        self._go(self._land_pub, _DOWN, smaller_than=True)

    def _go(self, publisher: Any, height: float, *, smaller_than: bool) -> None:
        self.gazebo.unpauseSim()
        self._check_publishers_connection()
        publisher.publish(std_msgs.msg.Empty())
        self.wait_for_height(height, smaller_than, epsilon=0.05, update_rate=10)
        self.gazebo.pauseSim()

    def wait_for_height(
        self,
        heigh_value_to_check: float,
        smaller_than: bool,  # noqa: FBT001  # openai_ros' interface
        epsilon: float,
        update_rate: float,
    ) -> None:
        """Wait until the drone is as high, or as low, for ten simulated seconds at most.

        Args:
            heigh_value_to_check: Height [m].
            smaller_than: Whether it shall be below that.
            epsilon: Taken, as openai_ros has it, and without effect [m].
            update_rate: Rate of the checks [Hz of simulated time].
        """
        del epsilon
        for _ in range(math.ceil(_LONGEST_S * update_rate)):
            height = self._check_sensor_ready("gt_pose").position.z
            there = (
                height <= heigh_value_to_check if smaller_than else height >= heigh_value_to_check
            )
            if there:
                return
            self.simulated_time.wait(1.0 / update_rate)
        rospy.logwarn(f"the drone is not at {heigh_value_to_check} m after {_LONGEST_S:g} s")

    def move_base(
        self,
        linear_speed_vector: geometry_msgs.msg.Vector3,
        angular_speed: float,
        epsilon: float = 0.05,
        update_rate: float = 10,
    ) -> None:
        """Command a velocity, and let it act for a second.

        Args:
            linear_speed_vector: In the drone's heading, a ``geometry_msgs/Vector3`` [m/s].
            angular_speed: To the left [rad/s].
            epsilon: Taken, as openai_ros has it, and without effect.
            update_rate: Likewise.
        """
        del epsilon, update_rate
        self._check_publishers_connection()
        twist = geometry_msgs.msg.Twist()
        linear = twist.linear
        linear.x, linear.y = linear_speed_vector.x, linear_speed_vector.y
        linear.z, twist.angular.z = linear_speed_vector.z, angular_speed
        self._cmd_vel_pub.publish(twist)
        self.wait_time_for_execute_movement()

    def wait_time_for_execute_movement(self) -> None:
        """Wait while a velocity acts."""
        self.simulated_time.wait(_HOLD_S)

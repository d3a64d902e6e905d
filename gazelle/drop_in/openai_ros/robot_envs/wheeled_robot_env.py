"""Common base of robots on wheels: a topic for velocities."""

from __future__ import annotations

import math

from gazelle.drop_in.openai_ros.robot_envs.topic_robot_env import TopicRobotEnv
from gazelle_ros.msgs import geometry_msgs

_HOLD_S = 0.2
"""Time that a velocity acts before a step continues [s of simulated time]."""


class WheeledRobotEnv(TopicRobotEnv):
    """A robot that takes a ``geometry_msgs/Twist`` on ``/cmd_vel``."""

    def _open_publishers(self) -> None:
        super()._open_publishers()
        self._cmd_vel_pub = self._publisher("/cmd_vel", "geometry_msgs/Twist")

    def move_base(
        self,
        linear_speed: float,
        angular_speed: float,
        epsilon: float = 0.05,
        update_rate: float = 10,
        min_laser_distance: float = -1.0,
    ) -> None:
        """Command a velocity, and let it act for 0.2 s.

        Args:
            linear_speed: Forward [m/s].
            angular_speed: To the left [rad/s].
            epsilon: Tolerance of the odometry's velocity, where that is waited for [m/s].
            update_rate: Rate of the checks [Hz].
            min_laser_distance: Taken, as openai_ros has it, and without effect [m].
        """
        del min_laser_distance
        self._check_publishers_connection()
        twist = geometry_msgs.msg.Twist()
        twist.linear.x, twist.angular.z = linear_speed, angular_speed
        self._cmd_vel_pub.publish(twist)
        self._let_act(twist, epsilon, update_rate)

    def _let_act(self, twist: geometry_msgs.msg.Twist, epsilon: float, update_rate: float) -> None:
        """Wait while a velocity acts."""
        del twist, epsilon, update_rate
        self.simulated_time.wait(_HOLD_S)

    def wait_until_twist_achieved(
        self, cmd_vel_value: geometry_msgs.msg.Twist, epsilon: float, update_rate: float
    ) -> None:
        """Wait until the odometry shows a velocity, for ten simulated seconds at most.

        Args:
            cmd_vel_value: A ``geometry_msgs/Twist``; only how fast it goes forward is compared.
            epsilon: Tolerance [m/s].
            update_rate: Rate of the checks [Hz of simulated time].
        """
        target = cmd_vel_value.linear.x
        for _ in range(math.ceil(10.0 * update_rate)):
            odom = self._check_sensor_ready("odom")
            if abs(odom.twist.twist.linear.x - target) <= epsilon:
                return
            self.simulated_time.wait(1.0 / update_rate)

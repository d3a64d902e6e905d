"""Husarion's ROSbot on a graph."""

from __future__ import annotations

from typing import Any, ClassVar

from gazelle.drop_in.openai_ros.gazebo_connection import WORLD
from gazelle.drop_in.openai_ros.robot_envs.topic_robot_env import RobotTopic
from gazelle.drop_in.openai_ros.robot_envs.wheeled_robot_env import WheeledRobotEnv
from gazelle_ros.msgs import geometry_msgs


class HusarionEnv(WheeledRobotEnv):
    """A ROSbot with ``/odom``, ``/scan``, a depth camera and ``/cmd_vel``; resets keep the time."""

    package: ClassVar[str] = "rosbot_gazebo"
    sensors = (
        RobotTopic("odom", "/odom", "nav_msgs/Odometry"),
        RobotTopic("camera_depth_image_raw", "/camera/depth/image_raw", "sensor_msgs/Image"),
        RobotTopic("camera_depth_points", "/camera/depth/points", "sensor_msgs/PointCloud2"),
        RobotTopic("camera_rgb_image_raw", "/camera/rgb/image_raw", "sensor_msgs/Image"),
        RobotTopic("laser_scan", "/scan", "sensor_msgs/LaserScan"),
    )
    reset_kind: ClassVar[str] = WORLD
    odom: Any
    laser_scan: Any

    def _let_act(self, twist: geometry_msgs.msg.Twist, epsilon: float, update_rate: float) -> None:
        self.wait_until_twist_achieved(twist, epsilon, update_rate)

"""TurtleBot3 on a graph."""

from __future__ import annotations

from typing import Any, ClassVar

from gazelle.drop_in.openai_ros.robot_envs.topic_robot_env import RobotTopic
from gazelle.drop_in.openai_ros.robot_envs.wheeled_robot_env import WheeledRobotEnv


class TurtleBot3Env(WheeledRobotEnv):
    """A TurtleBot3 with ``/odom``, ``/imu``, ``/scan`` and ``/cmd_vel``; a reset puts time back too."""

    package: ClassVar[str] = "turtlebot3_gazebo"
    sensors = (
        RobotTopic("odom", "/odom", "nav_msgs/Odometry"),
        RobotTopic("imu", "/imu", "sensor_msgs/Imu"),
        RobotTopic("laser_scan", "/scan", "sensor_msgs/LaserScan"),
    )
    controllers_list = ("imu",)
    odom: Any
    imu: Any
    laser_scan: Any

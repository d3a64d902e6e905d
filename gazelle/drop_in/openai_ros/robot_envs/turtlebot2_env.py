"""TurtleBot2 on a graph."""

from __future__ import annotations

from typing import Any, ClassVar

from gazelle.drop_in.openai_ros.gazebo_connection import WORLD
from gazelle.drop_in.openai_ros.robot_envs.topic_robot_env import RobotTopic
from gazelle.drop_in.openai_ros.robot_envs.wheeled_robot_env import WheeledRobotEnv


class TurtleBot2Env(WheeledRobotEnv):
    """A TurtleBot2 with ``/odom``, ``/kobuki/laser/scan`` and ``/cmd_vel``; resets keep the time."""

    package: ClassVar[str] = "turtlebot_gazebo"
    sensors = (
        RobotTopic("odom", "/odom", "nav_msgs/Odometry"),
        RobotTopic("laser_scan", "/kobuki/laser/scan", "sensor_msgs/LaserScan"),
    )
    reset_kind: ClassVar[str] = WORLD
    odom: Any
    laser_scan: Any

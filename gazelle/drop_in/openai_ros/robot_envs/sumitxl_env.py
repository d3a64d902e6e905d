"""Robotnik's Summit XL on a graph."""

from __future__ import annotations

from typing import Any, ClassVar

from gazelle.drop_in.openai_ros.gazebo_connection import WORLD
from gazelle.drop_in.openai_ros.robot_envs.topic_robot_env import RobotTopic
from gazelle.drop_in.openai_ros.robot_envs.wheeled_robot_env import WheeledRobotEnv

_CAMERA = "/orbbec_astra"


class SumitXlEnv(WheeledRobotEnv):
    """A Summit XL with odometry, IMU, GPS, laser, a depth camera and ``/cmd_vel``."""

    package: ClassVar[str] = "summit_xl_gazebo"
    sensors = (
        RobotTopic("gps_fix", "/gps/fix", "sensor_msgs/NavSatFix"),
        RobotTopic("gps_fix_velocity", "/gps/fix_velocity", "geometry_msgs/Vector3Stamped"),
        RobotTopic("camera_depth_image_raw", f"{_CAMERA}/depth/image_raw", "sensor_msgs/Image"),
        RobotTopic("camera_depth_points", f"{_CAMERA}/depth/points", "sensor_msgs/PointCloud2"),
        RobotTopic("camera_rgb_image_raw", f"{_CAMERA}/rgb/image_raw", "sensor_msgs/Image"),
        RobotTopic("laser_scan", "/hokuyo_base/scan", "sensor_msgs/LaserScan"),
        RobotTopic("imu", "/imu/data", "sensor_msgs/Imu"),
        RobotTopic("odom", "/summit_xl/odom", "nav_msgs/Odometry"),
    )
    robot_name_space = "summit_xl"
    controllers_list = (
        "joint_read_state_controller",
        "joint_blw_velocity_controller",
        "joint_brw_velocity_controller",
        "joint_flw_velocity_controller",
        "joint_frw_velocity_controller",
    )
    reset_kind: ClassVar[str] = WORLD
    odom: Any
    imu: Any
    laser_scan: Any

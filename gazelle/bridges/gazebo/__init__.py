"""ROS interface of gazebo_ros_pkgs: services, topics, parameters, the clock."""

from gazelle.bridges.gazebo.interface import GazeboInterface

__all__ = ["GazeboInterface"]

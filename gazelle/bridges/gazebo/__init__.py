"""ROS interface of gazebo_ros_pkgs: services, topics, parameters, the clock."""

from gazelle.bridges.gazebo.door import GazeboDoor

__all__ = ["GazeboDoor"]

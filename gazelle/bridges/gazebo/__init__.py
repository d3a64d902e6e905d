"""What gazebo_ros_pkgs puts on a ROS graph: services, topics, parameters, the clock."""

from gazelle.bridges.gazebo.door import GazeboDoor

__all__ = ["GazeboDoor"]

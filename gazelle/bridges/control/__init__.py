"""ROS interface of controllers: the topics, services and actions of ros_control."""

from gazelle.bridges.control.binding import ManagerBinding
from gazelle.bridges.control.hardware_loop import HardwareLoop

__all__ = ["HardwareLoop", "ManagerBinding"]

"""Controllers of robots on a ROS graph, as ros_control puts them there."""

from gazelle.bridges.control.binding import ManagerBinding
from gazelle.bridges.control.hardware_loop import HardwareLoop

__all__ = ["HardwareLoop", "ManagerBinding"]

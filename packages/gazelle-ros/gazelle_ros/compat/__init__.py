"""ROS 1's Python modules (``rospy``, ``tf``, ``std_msgs.msg`` and the rest) without ROS.

After `install`, a script written for ROS 1 runs as it is. An installed ROS is neither needed nor
touched; while ours are installed, ours are imported.
"""

from gazelle_ros.compat.finder import Installed, install, uninstall

__all__ = ["Installed", "install", "uninstall"]

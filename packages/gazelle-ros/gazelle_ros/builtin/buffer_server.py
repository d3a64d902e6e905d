"""``buffer_server`` of tf2_ros: a buffer with an action of the node's name."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from gazelle_ros.compat import rospy
from gazelle_ros.compat.rospy.rostime import Duration
from gazelle_ros.compat.tf2_ros import Buffer, BufferServer, TransformListener

_FREQUENCY_HZ = 100.0


def main(arguments: Sequence[str]) -> int:
    """Serve until the node ends; returns the exit code."""
    sys.argv = ["buffer_server", *arguments]
    rospy.init_node("tf_buffer")
    frequency = float(rospy.get_param("~check_frequency", _FREQUENCY_HZ))
    kept = float(rospy.get_param("~buffer_size", 120.0))
    buffer = Buffer(Duration.from_sec(kept))
    listener = TransformListener(buffer)
    BufferServer(buffer, rospy.get_name(), check_period=1.0 / frequency)
    rospy.spin()
    listener.unregister()
    return 0

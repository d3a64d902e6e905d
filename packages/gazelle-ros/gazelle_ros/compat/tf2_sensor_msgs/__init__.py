"""tf2_sensor_msgs's interface: clouds in other frames."""

from gazelle_ros.compat.tf2_sensor_msgs.tf2_sensor_msgs import (
    do_transform_cloud,
    from_msg_msg,
    to_msg_msg,
    transform_to_kdl,
)

__all__ = ["do_transform_cloud", "from_msg_msg", "to_msg_msg", "transform_to_kdl"]

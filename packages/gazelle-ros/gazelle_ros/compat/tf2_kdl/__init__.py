"""tf2_kdl's interface: PyKDL's values in other frames."""

from gazelle_ros.compat.tf2_kdl.tf2_kdl import (
    convert_vector,
    do_transform_frame,
    do_transform_twist,
    do_transform_vector,
    do_transform_wrench,
    from_msg_vector,
    to_msg_vector,
    transform_to_kdl,
)

__all__ = [
    "convert_vector",
    "do_transform_frame",
    "do_transform_twist",
    "do_transform_vector",
    "do_transform_wrench",
    "from_msg_vector",
    "to_msg_vector",
    "transform_to_kdl",
]

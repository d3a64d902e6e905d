"""From messages of tf to a tree of frames."""

from __future__ import annotations

from gazelle_ros.msgs import tf2_msgs
from gazelle_ros.tf.core import FrameTree


def take_transforms(
    tree: FrameTree, message: tf2_msgs.msg.TFMessage, *, authority: str = "", static: bool = False
) -> None:
    """Add all transforms of a ``tf2_msgs/TFMessage``.

    Args:
        tree: Takes them.
        message: Of ``/tf`` or ``/tf_static``.
        authority: The sender, for the log.
        static: Whether they hold at all times.
    """
    for each in message.transforms:
        place, turn = each.transform.translation, each.transform.rotation
        tree.place(
            each.header.frame_id,
            each.child_frame_id,
            each.header.stamp.to_nsec(),
            (place.x, place.y, place.z),
            (turn.x, turn.y, turn.z, turn.w),
            authority=authority,
            static=static,
        )

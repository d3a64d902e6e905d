"""Goals of other frames than the odometry's, such as ``map``, through tf."""

from __future__ import annotations

from functools import partial
from typing import Any

from gazelle.training.deploy.goals import GoalPlace
from gazelle_ros import Node
from gazelle_ros.msgs import tf2_msgs
from gazelle_ros.tf import FrameTree, TransformException, take_transforms


class GoalFrames:
    """Knows where goals are in the frame of the odometry; subscribes to ``/tf`` once it has to.

    Args:
        node: Listens.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._tree: FrameTree | None = None

    def place(self, goal: GoalPlace, frame: str) -> tuple[float, float] | None:
        """Return the position of a goal now [m], or None if no transform is available.

        Args:
            goal: In its own frame.
            frame: Of the odometry.
        """
        if goal.frame in {"", frame}:
            return goal.x, goal.y
        if self._tree is None:
            self._tree = self._listen(FrameTree())
        try:
            found = self._tree.lookup(frame, goal.frame)
        except TransformException:
            return None
        return _moved(goal, found)

    def _listen(self, tree: FrameTree) -> FrameTree:
        kind = tf2_msgs.msg.TFMessage
        for topic, static in (("/tf", False), ("/tf_static", True)):
            self._node.subscribe(
                topic, kind, partial(take_transforms, tree, authority="deploy", static=static)
            )
        return tree


def _moved(goal: GoalPlace, found: Any) -> tuple[float, float]:
    """Return a place on the ground, turned and shifted by a transform."""
    x, y, z, w = found.rotation
    cos, sin = 1.0 - 2.0 * (y * y + z * z), 2.0 * (w * z + x * y)
    other_cos, other_sin = 1.0 - 2.0 * (x * x + z * z), 2.0 * (x * y - w * z)
    return (
        found.translation[0] + cos * goal.x + other_sin * goal.y,
        found.translation[1] + sin * goal.x + other_cos * goal.y,
    )

"""The node ``image_proc``: colours of raw images, and both without the lens's distortion (http://wiki.ros.org/image_proc)."""

from __future__ import annotations

import threading
from collections.abc import Sequence

from gazelle_ros.builtin.arguments import CallbackWork, run_node
from gazelle_ros.builtin.images.debayer import Debayer
from gazelle_ros.builtin.images.rectify import Rectify
from gazelle_ros.builtin.nodelets.node import NodeletNode
from gazelle_ros.node import Node


class ImageProc(CallbackWork):
    """Topics ``image_mono``, ``image_color``, ``image_rect`` and ``image_rect_color`` of ``image_raw``.

    As in the original these are the work of three nodelets, whose parameters are below their names:
    the node's, with ``_debayer``, ``_rectify_mono`` or ``_rectify_color`` after it. ``~queue_size`` is
    that of all.

    Args:
        node: On the graph.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        super().__init__(node)
        self._parts: list[Node] = []
        self.works = (
            Debayer(self._part("debayer")),
            Rectify(self._part("rectify_mono"), "image_mono", "image_rect"),
            Rectify(self._part("rectify_color"), "image_color", "image_rect_color"),
        )

    def run(self, stop: threading.Event) -> None:
        """Process images until shutdown."""
        super().run(stop)
        for each in self._parts:
            each.close()

    def _part(self, name: str) -> Node:
        part = NodeletNode(f"{self.node.name}_{name}", self.node, {})
        self._parts.append(part)
        shared = self.node.get_param("~queue_size", None)
        if shared is not None:
            part.set_param("~queue_size", shared)
        return part


def main(arguments: Sequence[str]) -> int:
    """Process images until shutdown; returns the exit code."""
    return run_node(arguments, "image_proc", ImageProc)

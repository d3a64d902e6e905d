"""Nodes started one by one from a script."""

from __future__ import annotations

from gazelle_ros.compat.roslaunch.core import Node, RLException
from gazelle_ros.compat.roslaunch.parent import ROSLaunchParent
from gazelle_ros.compat.roslaunch.pmon import Process
from gazelle_ros.compat.roslaunch.rlutil import get_or_generate_uuid

__all__ = ["Node", "ROSLaunch"]


class ROSLaunch:
    """Starts nodes from a script; a master must run."""

    def __init__(self) -> None:
        self.parent = ROSLaunchParent(
            get_or_generate_uuid(None, True), [], is_core=False
        )  # the interface
        self.started = False

    def start(self) -> None:
        """Start to accept nodes.

        Raises:
            RLException: It cannot be started.
        """
        self.parent.start(auto_terminate=False)
        self.started = True

    def launch(self, node: Node) -> Process:
        """Start a node.

        Raises:
            RLException: `start` was not called, or the node cannot be started.
            ValueError: `node` is no `Node`.
        """
        if not self.started or self.parent.runner is None:
            raise RLException("please start ROSLaunch first")
        if not isinstance(node, Node):
            raise ValueError("arg must be of type Node")  # noqa: TRY004  # roslaunch's class
        process, success = self.parent.runner.launch_node(node)
        if not success or process is None:
            raise RLException(f"failed to launch {node.package}/{node.type}")
        return process

    def spin(self) -> None:
        """Wait until it was stopped."""
        self.parent.spin()

    def spin_once(self) -> None:
        """Check all nodes once."""
        self.parent.spin_once()

    def stop(self) -> None:
        """Stop all nodes."""
        self.parent.shutdown()

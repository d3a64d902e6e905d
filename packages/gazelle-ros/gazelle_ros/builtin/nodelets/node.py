"""A node in the process of a nodelet manager."""

from __future__ import annotations

from collections.abc import Mapping

from gazelle_ros import names
from gazelle_ros.node import Node


class NodeletNode(Node):
    """Node of one nodelet, which resolves names as if it were called as the nodelet.

    The name itself belongs to the program that loads the nodelet, and a graph has each name once.
    So the node is called as its manager and the nodelet: ``/manager/nodelet``.

    Args:
        nodelet: Global name of the nodelet.
        manager: Node of the manager; the nodelet shares its master, host and clock.
        remappings: Of the nodelet, from global names to global names; those of the manager hold, too.
    """

    def __init__(self, nodelet: str, manager: Node, remappings: Mapping[str, str]) -> None:
        self._nodelet = nodelet
        super().__init__(
            manager.name + nodelet,
            master_uri=manager.master_uri,
            host=manager.host,
            remappings={**manager.remappings, **remappings},
            clock=manager.clock,
            limits=manager.limits,
        )
        self.namespace = names.namespace_of(nodelet)

    def resolve(self, name: str) -> str:
        """Return the global name of `name` for the nodelet, remapped."""
        return names.resolve(name, self._nodelet, self.remappings)

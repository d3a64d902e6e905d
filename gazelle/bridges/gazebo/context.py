"""Common context of all parts of the Gazebo interface."""

from __future__ import annotations

from typing import Any

from gazelle.bridges.gazebo.entities import Entities
from gazelle.bridges.graph import Graph
from gazelle.simulation import Simulation
from gazelle_ros import Node, load_service


class GazeboContext(Graph):
    """A graph, and what is in the world that it sees; arguments are those of ``Graph``.

    Attributes:
        entities: Finds what requests name.
    """

    def __init__(
        self, simulation: Simulation, node: Node, world: int = 0, *, monotonic: bool = False
    ) -> None:
        super().__init__(simulation, node, world, monotonic=monotonic)
        self.entities = Entities(simulation, world)

    def response(self, service: str) -> Any:
        """Return an empty response of one of ``gazebo_msgs``' services."""
        return load_service(f"gazebo_msgs/{service}")._response_class()

"""Join and part links by service: what ``libgazebo_ros_link_attacher.so`` does."""

from __future__ import annotations

from gazelle.array_types import Worlds
from gazelle.description import Parameters
from gazelle.errors import Error
from gazelle.simulation import LinkHandle, Service, Simulation, WorldPlugin
from gazelle.simulation.values import LinkPair


class LinkAttacher(WorldPlugin):
    """Answers ``attach`` and ``detach``: whether it could be done."""

    def load(self, simulation: Simulation, parameters: Parameters) -> None:  # noqa: ARG002  it has no tags
        """Open the services."""
        self._simulation = simulation
        for name, answer in (("attach", self._attach), ("detach", self._detach)):
            simulation.ports.services[name] = Service(
                f"/link_attacher_node/{name}", LinkPair, bool, answer
            )

    def _attach(self, pair: LinkPair, worlds: Worlds | None) -> bool:
        try:
            parent, child = self._links(pair)
            self._simulation.engine.attach(parent.name, child.name, worlds)
        except Error:
            return False
        return True

    def _detach(self, pair: LinkPair, worlds: Worlds | None) -> bool:
        try:
            parent, child = self._links(pair)
            self._simulation.engine.detach(parent.name, child.name, worlds)
        except Error:
            return False
        return True

    def _links(self, pair: LinkPair) -> tuple[LinkHandle, LinkHandle]:
        robots = self._simulation.robots
        return (
            robots[pair.model_1].frame(pair.link_1)[0],
            robots[pair.model_2].frame(pair.link_2)[0],
        )

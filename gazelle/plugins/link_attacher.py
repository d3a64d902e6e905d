"""Join and part links by service: what ``libgazebo_ros_link_attacher.so`` does."""

from __future__ import annotations

from collections.abc import Iterator

from gazelle.array_types import Worlds
from gazelle.description import Parameters
from gazelle.errors import Error
from gazelle.simulation import LinkHandle, Robot, Service, Simulation, WorldPlugin
from gazelle.simulation.values import LinkName, LinkPair


class LinkAttacher(WorldPlugin):
    """Services ``attach``, ``detach`` and ``setstatic`` of links; each returns whether it succeeded.

    ``setstatic`` is that of a fork (UR5-Pick-and-Place-Simulation). Whatever its flag says, the model
    loses its weight, its motion, and all contacts: others pass through it.
    """

    def load(self, simulation: Simulation, parameters: Parameters) -> None:  # noqa: ARG002  it has no tags
        """Open the services."""
        self._simulation = simulation
        for name, answer in (("attach", self._attach), ("detach", self._detach)):
            simulation.ports.services[name] = Service(
                f"/link_attacher_node/{name}", LinkPair, bool, answer
            )
        simulation.ports.services["setstatic"] = Service(
            "/link_attacher_node/setstatic", LinkName, bool, self._lay_to_rest
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

    def _lay_to_rest(self, name: LinkName, worlds: Worlds | None) -> bool:
        try:
            robot = self._simulation.robots[name.model]
            robot.frame(name.link)
            for collision in _collisions(robot):
                self._simulation.engine.set_parameter("collision_contact", collision, 0.0, worlds)
            if not robot.description.static:
                for link in robot.links.values():
                    link.set_properties(gravity=0.0, worlds=worlds)
                robot.set_twist((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), worlds)
        except Error:
            return False
        return True

    def _links(self, pair: LinkPair) -> tuple[LinkHandle, LinkHandle]:
        robots = self._simulation.robots
        return (
            robots[pair.model_1].frame(pair.link_1)[0],
            robots[pair.model_2].frame(pair.link_2)[0],
        )


def _collisions(robot: Robot) -> Iterator[str]:
    """Yield the scoped names of a robot's collisions."""
    for placed in robot.description.walk():
        scope = robot.name + placed.scope.removeprefix(robot.description.name)
        for link in placed.model.links:
            for collision in link.collisions:
                yield f"{scope}::{link.name}::{collision.name}"

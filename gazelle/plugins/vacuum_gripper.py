"""A suction cup: what ``libgazebo_ros_vacuum_gripper.so`` does."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.description import Parameters
from gazelle.simulation import (
    LinkHandle,
    ModelPlugin,
    Output,
    Robot,
    Service,
    absolute,
    namespace_of,
)
from gazelle.simulation.values import Flags

# How near a link's origin must be to be sucked, and to be held in place [m].
_REACH, _HOLD = 0.05, 0.01
# The force is the inverse of the distance in metres, up to this [N].
_MOST_FORCE = 20.0


class VacuumGripper(ModelPlugin):
    """Draws links of other models with origins near its body, while it is on.

    What is drawn moves as the body does, and what is very near is put in place.
    """

    update_rate = 0.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the body, open topic and services."""
        self._robot, self._simulation = robot, robot.simulation
        self._link, _ = robot.frame(parameters.require("bodyName", str))
        topic = parameters.require("topicName", str)
        nworld = robot.simulation.nworld
        self._on, self._grasping = np.zeros((2, nworld), np.bool_)
        self._drawn: set[str] = set()
        namespace = namespace_of(robot, parameters)
        self._output = robot.outputs[topic.strip("/")] = Output(
            absolute(namespace, topic), Flags, lambda: Flags(self._grasping.copy())
        )
        for name, on in (("on", True), ("off", False)):
            robot.services[name] = Service(
                absolute(namespace, name), None, None, self._switch_to(on=on)
            )

    def _switch_to(self, *, on: bool) -> Callable[[None, Worlds | None], None]:
        def switch(_request: None, worlds: Worlds | None) -> None:
            self._on[slice(None) if worlds is None else worlds] = on

        return switch

    @property
    def active(self) -> bool:
        """True if it is on, holds anything, or has subscribers."""
        return bool(self._on.any()) or bool(self._drawn) or self._output.has_subscribers

    def on_update(self, time: float) -> None:  # noqa: ARG002  it acts at every step
        """Attract near links, and publish whether there are any."""
        self._grasping[:] = False
        drawn: set[str] = set()
        if self._on.any():
            centre, motion = self._link.placement().position, self._link.motion()
            for link in self._others():
                place = link.placement()
                apart = centre - place.position
                distance = np.linalg.norm(apart, axis=1)
                near = self._on & (distance < _REACH)
                if not near.any():
                    continue
                worlds = np.flatnonzero(near)
                link.set_twist(motion.linear[worlds], motion.angular[worlds], worlds)
                held = np.flatnonzero(near & (distance < _HOLD))
                if held.size:
                    link.set_pose(centre[held], place.quaternion[held], worlds=held)
                direction = apart / np.maximum(distance, 1e-9)[:, None]
                size = np.minimum(1.0 / np.maximum(distance, 1e-9), _MOST_FORCE)
                self._hold(link.name, np.where(near[:, None], direction * size[:, None], 0.0))
                drawn.add(link.name)
                self._grasping |= near
        for name in self._drawn - drawn:
            self._hold(name, np.zeros((len(self._on), 3)))
        self._drawn = drawn
        self._output.publish()

    def _others(self) -> Iterator[LinkHandle]:
        """Yield links of other dynamic models."""
        for robot in self._simulation.robots.values():
            if robot is not self._robot and not robot.description.static:
                yield from robot.links.values()

    def _hold(self, link: str, force: NDArray[np.float64]) -> None:
        if link in self._simulation.engine.links.names:
            name = f"vacuum_gripper {self._link.name}"
            self._simulation.applied_wrenches.hold(name, link, force, np.zeros_like(force))

    def reset(self, worlds: Worlds | None) -> None:
        """Switch the gripper off."""
        self._on[slice(None) if worlds is None else worlds] = False

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return whether it is on, and the objects it attracts."""
        return {
            "on": self._on.copy(),
            "grasping": self._grasping.copy(),
            "drawn": np.asarray(sorted(self._drawn), np.str_),
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._on[:], self._grasping[:] = state["on"], state["grasping"]
        self._drawn = {str(name) for name in state["drawn"]}

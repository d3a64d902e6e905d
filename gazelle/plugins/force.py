"""A force on command: what ``libgazebo_ros_force.so`` does."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.description import Parameters
from gazelle.simulation import Input, ModelPlugin, Robot, absolute, namespace_of
from gazelle.simulation.values import Push


class Force(ModelPlugin):
    """Pushes a body at its centre of mass, as the last command says, until the next."""

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the body, open the port."""
        self._link, _ = robot.frame(parameters.require("bodyName", str))
        topic = parameters.require("topicName", str)
        self._applied_wrenches = robot.simulation.applied_wrenches
        self._name = f"force {topic}"
        self._force, self._torque = np.zeros((2, robot.simulation.nworld, 3))
        robot.inputs[topic.strip("/")] = Input(
            absolute(namespace_of(robot, parameters), topic),
            Push,
            self._push,
            forget=self.reset,
            queue_size=1,
        )

    def _push(self, push: Push, worlds: Worlds | None) -> None:
        rows = slice(None) if worlds is None else worlds
        self._force[rows], self._torque[rows] = push.force, push.torque
        self._applied_wrenches.hold(self._name, self._link.name, self._force, self._torque)

    def reset(self, worlds: Worlds | None) -> None:
        """Remove the force."""
        self._push(Push(np.zeros(3), np.zeros(3)), worlds)

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return the acting force and torque."""
        return {"force": self._force.copy(), "torque": self._torque.copy()}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned; that it acts is in the simulation's state."""
        self._force[:], self._torque[:] = state["force"], state["torque"]

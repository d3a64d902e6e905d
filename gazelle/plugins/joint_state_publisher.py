"""Joints as they are: what ``libgazebo_ros_joint_state_publisher.so`` does."""

from __future__ import annotations

import numpy as np

from gazelle.description import Parameters
from gazelle.plugins.publishing import Publishing
from gazelle.simulation import JointStates, Output, Robot, absolute, namespace_of


class JointStatePublisher(Publishing):
    """Publishes positions and velocities of some joints."""

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the joints, open the port."""
        given = parameters.require("jointName", str)
        own = f"{robot.name}::"
        names = (name.strip().removeprefix(own) for name in given.split(","))
        self._names = tuple(name for name in names if name)
        self._joints = [robot.joints[name] for name in self._names]
        self._clock = robot.simulation.clock
        self.update_rate = parameters.get("updateRate", 100.0)
        namespace = namespace_of(robot, parameters, robot.name)
        robot.outputs["joint_states"] = Output(
            absolute(namespace, "joint_states"), JointStates, self._measure, queue_size=1000
        )
        self._published.append(robot.outputs["joint_states"])

    def _measure(self) -> JointStates:
        positions = [joint.positions()[:, :1] for joint in self._joints]
        velocities = [joint.velocities()[:, :1] for joint in self._joints]
        return JointStates(
            self._clock.now_ns,
            self._names,
            np.concatenate(positions, axis=1),
            np.concatenate(velocities, axis=1),
        )

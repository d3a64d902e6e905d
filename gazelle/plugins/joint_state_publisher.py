"""Joints as they are: what ``libgazebo_ros_joint_state_publisher.so`` does."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import Parameters
from gazelle.plugins.publishing import Publishing
from gazelle.simulation import (
    JointArray,
    JointHandle,
    JointStates,
    Output,
    PublisherSystem,
    Robot,
    absolute,
    namespace_of,
)

_WITHOUT_AXIS = frozenset({"ball", "floating"})


class JointStatePublisher(Publishing):
    """Publishes positions and velocities of some joints.

    Attributes:
        joints: Those.
    """

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the joints, open the port."""
        given = parameters.require("jointName", str)
        own = f"{robot.name}::"
        names = (name.strip().removeprefix(own) for name in given.split(","))
        self._names = tuple(name for name in names if name)
        self.joints: list[JointHandle] = [robot.joints[name] for name in self._names]
        kinds = {robot.joint_description(name).type for name in self._names}
        if kinds and not kinds & _WITHOUT_AXIS:
            self.system = JointStateSystem
        self._simulation = robot.simulation
        self.update_rate = parameters.get("updateRate", 100.0)
        namespace = namespace_of(robot, parameters, robot.name)
        self.output = robot.outputs["joint_states"] = Output(
            absolute(namespace, "joint_states"), JointStates, self._measure, queue_size=1000
        )
        self.published.append(self.output)

    def _measure(self) -> JointStates:
        positions = [joint.positions()[:, :1] for joint in self.joints]
        velocities = [joint.velocities()[:, :1] for joint in self.joints]
        return self.states(np.concatenate(positions, axis=1), np.concatenate(velocities, axis=1))

    def states(self, positions: Floats, velocities: Floats) -> JointStates:
        """Return the states of its joints by name."""
        return JointStates(self._simulation.clock.now_ns, self._names, positions, velocities)


class JointStateSystem(PublisherSystem[JointStatePublisher]):
    """Publishers with joints read in one batch."""

    def measure(self, plugins: Sequence[JointStatePublisher]) -> list[JointStates]:
        """Return the joint states of each plugin."""
        group = JointArray([joint for each in plugins for joint in each.joints])
        positions, velocities = group.positions(), group.velocities()
        ends = accumulate(len(each.joints) for each in plugins)
        parts = [
            slice(end - len(each.joints), end) for end, each in zip(ends, plugins, strict=True)
        ]
        return [
            each.states(positions[:, part], velocities[:, part])
            for each, part in zip(plugins, parts, strict=True)
        ]

    def publish(self, plugin: JointStatePublisher, measured: JointStates) -> None:
        """Publish the measured joints of one plugin."""
        plugin.output.publish_computed(measured)

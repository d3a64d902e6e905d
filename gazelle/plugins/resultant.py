"""The force on a body: what ``libgazebo_ros_f3d.so`` does.

The original reads from ODE the force on the body after a step, when ODE has forgotten it; this
one gives what all forces on the body come to, by Newton's and Euler's laws.
"""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import Parameters
from gazelle.plugins.publishing import Publishing
from gazelle.rotations import conjugate, cross, rotate
from gazelle.simulation import FramePrefix, Output, Robot, WrenchValue, absolute, namespace_of


class ResultantForce(Publishing):
    """Publishes the sum of all forces on a body, weight included, in the world frame.

    The torque is about the centre of mass.
    """

    update_rate = 0.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the body, open the port."""
        self._link, _ = robot.frame(parameters.require("bodyName", str))
        topic = parameters.require("topicName", str)
        self._engine, self._clock = robot.simulation.engine, robot.simulation.clock
        namespace = namespace_of(robot, parameters)
        output = robot.outputs[topic.strip("/")] = Output(
            absolute(namespace, topic),
            WrenchValue,
            self._measure,
            frame=parameters.get("frameName", "world"),
            namespace=namespace,
            prefix=FramePrefix.OWN,
        )
        self.published.append(output)

    def _measure(self) -> WrenchValue:
        name = self._link.name
        place, motion = self._link.placement(), self._link.motion()
        change = self._engine.links[name].acceleration()
        arm = self._engine.links[name].centre() - place.position
        swing = cross(motion.angular, cross(motion.angular, arm))
        acceleration = change.linear + cross(change.angular, arm) + swing
        force = self._engine.parameter("link_mass", name) * acceleration
        turned = self._spun(place.quaternion, change.angular)
        torque = turned + cross(motion.angular, self._spun(place.quaternion, motion.angular))
        return WrenchValue(self._clock.now_ns, force, torque)

    def _spun(self, quaternion: Floats, vector: Floats) -> Floats:
        """Return the inertia about the centre of mass times a vector, all in the world frame."""
        inertia = self._engine.parameter("link_inertia", self._link.name)
        rows = inertia[:, [0, 3, 4, 3, 1, 5, 4, 5, 2]].reshape(-1, 3, 3)
        inner = rotate(conjugate(quaternion), vector)
        return rotate(quaternion, np.einsum("nij,nj->ni", rows, inner))

"""Force and torque in a joint: ``libgazebo_ros_ft_sensor.so``."""

from __future__ import annotations

import numpy as np

from gazelle.description import Noise, Parameters
from gazelle.plugins.publishing import Publishing
from gazelle.plugins.stateful import Noisy
from gazelle.rotations import conjugate, rotate
from gazelle.sensors import NoiseModel
from gazelle.simulation import FramePrefix, Output, Robot, WrenchValue, absolute, namespace_of


class ForceTorqueSensor(Noisy, Publishing):
    """Publishes force and torque in a joint, on its child and in the child's axes."""

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the joint, open the port."""
        joint = parameters.require("jointName", str).removeprefix(f"{robot.name}::")
        topic = parameters.require("topicName", str)
        child = robot.joint_description(joint).child
        simulation = robot.simulation
        self._engine, self._clock = simulation.engine, simulation.clock
        self._joint = f"{robot.name}::{joint}"
        self._link = robot.links[child]
        noise = Noise("gaussian", stddev=parameters.get("gaussianNoise", 0.0))
        self._noise = NoiseModel(
            noise, simulation.seed, f"{self._joint}::ft_sensor", simulation.nworld, 6
        )
        self._noises = {"noise": self._noise}
        self.update_rate = parameters.get("updateRate", 0.0)
        namespace = namespace_of(robot, parameters)
        output = robot.outputs[topic.strip("/")] = Output(
            absolute(namespace, topic),
            WrenchValue,
            self._measure,
            frame=child,
            namespace=namespace,
            prefix=FramePrefix.OWN,
        )
        self.published.append(output)

    def _measure(self) -> WrenchValue:
        wrench = self._engine.joints[self._joint].wrench()
        back = conjugate(self._link.placement().quaternion)
        # The engine gives what the child exerts on the parent; the original what it bears.
        measured = np.concatenate(
            (rotate(back, -wrench.force), rotate(back, -wrench.torque)), axis=1
        )
        measured = self._noise.apply(measured, 0.0)
        return WrenchValue(self._clock.now_ns, measured[:, :3], measured[:, 3:])

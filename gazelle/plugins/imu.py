"""A model's IMU: what ``libgazebo_ros_imu.so`` does, with the acceleration mended.

The original multiplies world-frame rates by the orientation instead of its inverse and
leaves gravity out. This one reports what an IMU on the body measures, gravity included.
"""

from __future__ import annotations

import numpy as np

from gazelle.description import Imu, Noise, Parameters, Pose
from gazelle.plugins.publishing import Publishing
from gazelle.plugins.stateful import Noisy
from gazelle.sensors import ImuModel, ImuReading
from gazelle.simulation import Output, Robot, Service, absolute, namespace_of


class ImuPlugin(Noisy, Publishing):
    """Opens an output of IMU readings of one body."""

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the body, open the port."""
        body = parameters.require("bodyName", str)
        link, frame = robot.frame(body)
        offset = parameters.numbers("xyzOffset", (0.0, 0.0, 0.0))
        turn = parameters.numbers("rpyOffset", (0.0, 0.0, 0.0))
        noise = Noise("gaussian", stddev=parameters.get("gaussianNoise", 0.0))
        imu = Imu((noise,) * 3, (noise,) * 3)
        simulation = robot.simulation
        name = f"{robot.name}::{body}::imu_plugin"
        self._model = ImuModel(
            imu, simulation.engine, link.name, frame * Pose(*offset, *turn), simulation.seed, name
        )
        self._noises = {"imu": self._model}
        self._clock = simulation.clock
        self.update_rate = parameters.get("updateRate", 0.0)
        namespace = namespace_of(robot, parameters)
        robot.outputs["imu"] = Output(
            absolute(namespace, parameters.get("topicName", "/default_imu")),
            ImuReading,
            self._measure,
            frame=parameters.get("frameName", body),
        )
        self._published.append(robot.outputs["imu"])
        # The original offers a calibration that does nothing.
        robot.services["imu"] = Service(
            absolute(namespace, parameters.get("serviceName", "/default_imu")),
            None,
            None,
            lambda _request, _worlds: None,
        )

    def _measure(self) -> ImuReading:
        values = self._model.measure()
        return self._model.reading(np.asarray(values), self._clock.now_ns)

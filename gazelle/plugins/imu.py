"""A model's IMU: what ``libgazebo_ros_imu.so`` does, with the acceleration mended.

The original multiplies world-frame rates by the orientation instead of its inverse and
leaves gravity out. This one reports what an IMU on the body measures, gravity included.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.description import Imu, Noise, Parameters, Pose
from gazelle.sensors import ImuModel, ImuReading
from gazelle.simulation import ModelPlugin, Output, Robot, Service, absolute, namespace_of

Worlds = NDArray[np.intp]


class ImuPlugin(ModelPlugin):
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
        self._simulation = simulation
        self.update_rate = parameters.get("updateRate", 0.0)
        namespace = namespace_of(robot, parameters)
        self._output = robot.outputs["imu"] = Output(
            absolute(namespace, parameters.get("topicName", "/default_imu")),
            ImuReading,
            self._measure,
            frame=parameters.get("frameName", body),
        )
        # The original offers a calibration that does nothing.
        robot.services["imu"] = Service(
            absolute(namespace, parameters.get("serviceName", "/default_imu")),
            None,
            None,
            lambda _request, _worlds: None,
        )

    @property
    def active(self) -> bool:
        """Whether anybody listens."""
        return self._output.wanted

    def on_update(self, time: float) -> None:  # noqa: ARG002  the port stamps its values
        """Publish."""
        self._output.publish()

    def reseed(self, seed: int, worlds: Worlds | None) -> None:
        """Use the random numbers of another seed."""
        self._model.reseed(seed, worlds)

    def reset(self, worlds: Worlds | None) -> None:
        """Forget drifts of noise."""
        self._model.reset(worlds)

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """The noise."""
        return self._model.state()

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave."""
        self._model.restore(dict(state))

    def _measure(self) -> ImuReading:
        values = self._model.measure()
        return self._model.reading(np.asarray(values), self._simulation.clock.now_ns)

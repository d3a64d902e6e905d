"""A model's IMU: what ``libgazebo_ros_imu.so`` does, with the acceleration mended.

The original multiplies world-frame rates by the orientation instead of its inverse and
leaves gravity out. This one reports what an IMU on the body measures, gravity included.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import Imu, Noise, Parameters, Pose
from gazelle.plugins.gyros import ImuArray
from gazelle.plugins.publishing import Publishing
from gazelle.plugins.stateful import Noisy
from gazelle.sensors import ImuModel, ImuReading
from gazelle.simulation import Output, PublisherSystem, Robot, Service, absolute, namespace_of


class ImuPlugin(Noisy, Publishing):
    """Publisher of IMU readings of one body."""

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the body, open the port."""
        self.system = ImuSystem
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
        self._output = robot.outputs["imu"] = Output(
            absolute(namespace, parameters.get("topicName", "/default_imu")),
            ImuReading,
            self._measure,
            frame=parameters.get("frameName", body),
        )
        self.published.append(self._output)
        # The original offers a calibration that does nothing.
        robot.services["imu"] = Service(
            absolute(namespace, parameters.get("serviceName", "/default_imu")),
            None,
            None,
            lambda _request, _worlds: None,
        )

    @property
    def model(self) -> ImuModel:
        """Model that measures it."""
        return self._model

    @property
    def output(self) -> Output[ImuReading]:
        """Output that it publishes."""
        return self._output

    def _measure(self) -> ImuReading:
        return self.reading(self._model.measure())

    def reading(self, values: Floats) -> ImuReading:
        """Return a measurement by name."""
        return self._model.reading(np.asarray(values), self._clock.now_ns)


class ImuSystem(PublisherSystem[ImuPlugin]):
    """Publishers of IMUs, for which the coming step is made once.

    Args:
        plugins: The publishers.
    """

    def __init__(self, plugins: Sequence[ImuPlugin]) -> None:
        super().__init__(plugins)
        self._array: ImuArray | None = None

    def measure(self, plugins: Sequence[ImuPlugin]) -> list[ImuReading]:
        """Return the reading of each plugin."""
        models = [each.model for each in plugins]
        if self._array is None or self._array.models != models:
            self._array = ImuArray(models, [0.0] * len(models))
        values = self._array.measure()
        return [each.reading(values[:, i]) for i, each in enumerate(plugins)]

    def publish(self, plugin: ImuPlugin, measured: ImuReading) -> None:
        """Publish the reading of one IMU."""
        plugin.output.publish_computed(measured)

"""A model's IMU: what ``libgazebo_ros_imu.so`` does, with the acceleration mended.

The original multiplies world-frame rates by the orientation instead of its inverse and
leaves gravity out. This one reports what an IMU on the body measures, gravity included.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import Imu, Noise, Parameters, Pose
from gazelle.plugins.publishing import Publishing
from gazelle.plugins.stateful import Noisy
from gazelle.sensors import ImuModel, ImuReading
from gazelle.sensors.imu import ImuGroup
from gazelle.simulation import Output, Robot, Service, absolute, namespace_of


class ImuPlugin(Noisy, Publishing):
    """Opens an output of IMU readings of one body.

    Attributes:
        group: What measured it together with others last.
    """

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
        self.group: ImuGroup | None = None
        self._output = robot.outputs["imu"] = Output(
            absolute(namespace, parameters.get("topicName", "/default_imu")),
            ImuReading,
            self._measure,
            frame=parameters.get("frameName", body),
        )
        self._published.append(self._output)
        # The original offers a calibration that does nothing.
        robot.services["imu"] = Service(
            absolute(namespace, parameters.get("serviceName", "/default_imu")),
            None,
            None,
            lambda _request, _worlds: None,
        )

    def kind(self) -> Hashable | None:
        """All of the same noise, where the engine looks at many links at once."""
        return self._model.kind()

    @classmethod
    def measure_together(cls, plugins: Sequence[ImuPlugin]) -> list[Floats]:
        """What the IMUs of all feel, for which the coming step is made once."""
        group, models = plugins[0].group, [each.model for each in plugins]
        if group is None or not group.is_of(models) or any(p.group is not group for p in plugins):
            group = ImuModel.together(models)  # noise moves: older groups hold no more
            for each in plugins:
                each.group = group
        values = group.measure_all(0.0)
        return [values[:, i] for i in range(len(plugins))]

    def publish_measured(self, measured: Floats | None) -> None:
        """Publish what was measured."""
        if self._output.wanted:
            self._output.hand(
                self._reading(self._model.measure() if measured is None else measured)
            )

    @property
    def model(self) -> ImuModel:
        """What measures it."""
        return self._model

    def _measure(self) -> ImuReading:
        return self._reading(self._model.measure())

    def _reading(self, values: Floats) -> ImuReading:
        return self._model.reading(np.asarray(values), self._clock.now_ns)

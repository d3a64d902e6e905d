"""Hector's barometer: what ``libhector_gazebo_ros_baro.so`` does."""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import Parameters
from gazelle.plugins.frames import placed
from gazelle.plugins.hector_body import SampledOnBody, SampleSystem
from gazelle.plugins.hector_imu import rate_of
from gazelle.simulation import Output, Robot
from gazelle.simulation.values import AltimeterValue, PointValue

# The international barometric formula: height where it ends [m], and its exponent.
_TOP, _EXPONENT = 44330.0, 5.263157


class HectorBarometer(SampledOnBody):
    """Publishes the height of a body as a place, and its altitude with the air's pressure."""

    system = SampleSystem

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the body, open the ports."""
        body = self.hold(robot, parameters, "hector_baro")
        self._error = self.errors(parameters, "", 1)
        self._elevation = parameters.get("elevation", 0.0)
        self._sea_level = parameters.get("qnh", 1013.25)
        self.update_rate = rate_of(parameters, 0.0)
        topic = parameters.get("heightTopicName", parameters.get("topicName", "pressure_height"))
        altimeter = parameters.get("altimeterTopicName", "altimeter")
        frame = parameters.get("frameId", body)
        height = Output("", PointValue, self._place, frame=frame, queue_size=10)
        self.open_output(parameters, topic, height)
        altitude = Output("", AltimeterValue, self._altitude, frame=frame, queue_size=10)
        self.open_output(parameters, altimeter, altitude)

    def measure(self) -> Floats:
        """Return the height [m], shape (nworld, 1)."""
        interval = self._interval.since(self._simulation.clock.now_ns)
        return self._error.apply(placed(self._frame).position[:, 2:], interval)

    def _height(self) -> Floats:
        return self.measure() if self.sample is None else self.sample

    def _place(self) -> PointValue:
        height = self._height()
        place = np.zeros((len(height), 3))
        place[:, 2:] = height
        return PointValue(self._simulation.clock.now_ns, place)

    def _altitude(self) -> AltimeterValue:
        altitude = self._height()[:, 0] + self._elevation
        pressure = self._sea_level * np.maximum(1.0 - altitude / _TOP, 0.0) ** _EXPONENT
        return AltimeterValue(self._simulation.clock.now_ns, altitude, pressure, self._sea_level)

"""Sensors of SJTU's quadrotor: ``libplugin_ros_imu.so`` and ``libplugin_ros_sonar.so``."""

from __future__ import annotations

from gazelle.description import Parameters
from gazelle.plugins.sensor_kinds import model_of
from gazelle.sensors import ImuModel, ImuReading, SonarModel
from gazelle.simulation import SensorOutput, SensorPlugin, SensorUnit, absolute, namespace_of
from gazelle.simulation.values import SonarValue

_FRAME = "drone_link"


class DroneImu(SensorPlugin):
    """Publishes an IMU sensor's readings as they are."""

    def load(self, sensor: SensorUnit, parameters: Parameters) -> None:
        """Open the port."""
        model_of(sensor, ImuModel, parameters)
        topic = absolute(namespace_of(sensor.robot, parameters), "drone/imu")
        sensor.robot.outputs["imu"] = SensorOutput(sensor, topic, ImuReading, frame=_FRAME)


class DroneSonar(SensorPlugin):
    """Publishes a sonar's distance."""

    def load(self, sensor: SensorUnit, parameters: Parameters) -> None:
        """Open the port."""
        self._sensor, self._clock = sensor, sensor.robot.simulation.clock
        self._sonar = model_of(sensor, SonarModel, parameters).settings
        sensor.robot.outputs["sonar"] = SensorOutput(
            sensor,
            absolute(namespace_of(sensor.robot, parameters), "drone/sonar"),
            SonarValue,
            frame=_FRAME,
            read=self._read,
        )

    def _read(self) -> SonarValue:
        sonar = self._sonar
        return SonarValue(
            self._clock.now_ns,
            self._sensor.current()[:, 0],
            sonar.range_min,
            sonar.range_max,
            sonar.field_of_view,
            ultrasound=True,
        )

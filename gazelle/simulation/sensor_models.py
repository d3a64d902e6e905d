"""Selection of the model that measures each sensor of a file."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from gazelle.description import Imu, Joint, Link, Pose, Sensor
from gazelle.engines import Engine
from gazelle.errors import EngineError, SimulationWarning
from gazelle.rendering import LiveScene
from gazelle.sensors import (
    AirPressure,
    AirPressureModel,
    Altimeter,
    AltimeterModel,
    CameraModel,
    ContactModel,
    ForceTorque,
    ForceTorqueModel,
    Gps,
    GpsModel,
    ImuModel,
    LidarModel,
    Magnetometer,
    MagnetometerModel,
    SensorModel,
    Sonar,
    SonarModel,
)
from gazelle.sensors.limits import check_sensor

if TYPE_CHECKING:
    from gazelle.description import Model


@dataclass(frozen=True, slots=True)
class SensorMount:
    """A sensor and its link or joint.

    Attributes:
        engine: Of the simulation.
        scene: Draws what cameras see.
        sensor: Settings of the file.
        scope: Scoped name of the model that it is in.
        link: The link, or the child of the joint, that it moves with.
        joint: The joint that it is on, if it is on one.
        static: Whether its top-level model never moves.
        seed: The run's seed.
    """

    engine: Engine
    scene: LiveScene
    sensor: Sensor
    scope: str
    link: Link
    joint: Joint | None
    static: bool
    seed: int

    @property
    def link_name(self) -> str:
        """Scoped name of the link."""
        return f"{self.scope}::{self.link.name}"

    @property
    def name(self) -> str:
        """Scoped name of the sensor."""
        owner = self.link.name if self.joint is None else self.joint.name
        return f"{self.scope}::{owner}::{self.sensor.name}"


def mounts(engine: Engine, scene: LiveScene, model: Model, seed: int) -> Iterator[SensorMount]:
    """Yield all sensors of a model and its nested ones, on links and on joints."""
    for placed in model.walk():
        links = {link.name: link for link in placed.model.links}
        for link in placed.model.links:
            for sensor in link.sensors:
                yield SensorMount(
                    engine, scene, sensor, placed.scope, link, None, model.static, seed
                )
        for joint in placed.model.joints:
            for sensor in joint.sensors:
                child = links.get(joint.child) or Link(joint.child)
                yield SensorMount(
                    engine, scene, sensor, placed.scope, child, joint, model.static, seed
                )


def sensor_model(mount: SensorMount) -> SensorModel | None:
    """Return the measurement model of a sensor; None, with a warning, for unsupported ones.

    Raises:
        SimulationError: It has more rays or pixels than there is room for.
    """
    check_sensor(mount.sensor, mount.name, mount.engine.nworld)
    try:
        return _MODELS.get(mount.sensor.type, _unknown)(mount)
    except EngineError as error:
        warnings.warn(
            SimulationWarning(
                f"sensor '{mount.name}' of type '{mount.sensor.type}' is not measured yet: {error}"
            ),
            stacklevel=2,
        )
    return None


def _unknown(_: SensorMount) -> SensorModel:
    raise EngineError("there is no model of this type")


def _lidar(mount: SensorMount) -> SensorModel:
    if mount.sensor.lidar is None:
        raise EngineError("it has no <ray> or <lidar> element")
    return LidarModel(mount.sensor.lidar, *_on_link(mount))


def _camera(mount: SensorMount) -> SensorModel:
    return _camera_model(mount, depth=False)


def _depth_camera(mount: SensorMount) -> SensorModel:
    return _camera_model(mount, depth=True)


def _wide_camera(mount: SensorMount) -> SensorModel:
    return _camera_model(mount, depth=False, wide=True)


def _camera_model(mount: SensorMount, *, depth: bool, wide: bool = False) -> SensorModel:
    mode = mount.sensor.settings.find("camera/distortion/ignition:legacy_mode")
    legacy = mode is None or mode.text.strip().lower() not in ("false", "0")
    return CameraModel(
        mount.sensor.cameras, mount.scene, *_on_link(mount), depth=depth, wide=wide, legacy=legacy
    )


def _imu(mount: SensorMount) -> SensorModel:
    return ImuModel(mount.sensor.imu or Imu(), *_on_link(mount))


def _magnetometer(mount: SensorMount) -> SensorModel:
    return MagnetometerModel(Magnetometer.read(mount.sensor.settings), *_on_link(mount))


def _gps(mount: SensorMount) -> SensorModel:
    return GpsModel(Gps.read(mount.sensor.settings), *_on_link(mount))


def _altimeter(mount: SensorMount) -> SensorModel:
    return AltimeterModel(Altimeter.read(mount.sensor.settings), *_on_link(mount))


def _air_pressure(mount: SensorMount) -> SensorModel:
    return AirPressureModel(AirPressure.read(mount.sensor.settings), *_on_link(mount))


def _sonar(mount: SensorMount) -> SensorModel:
    return SonarModel(Sonar.read(mount.sensor.settings), *_on_link(mount))


def _force_torque(mount: SensorMount) -> SensorModel:
    joint, scope = mount.joint, mount.scope
    if joint is None:
        raise EngineError("it is on a link, not on a joint")
    if mount.static:
        raise EngineError("its model is static, so its joints carry no load")
    name = f"{scope}::{joint.name}"
    parent = "world" if joint.parent == "world" else f"{scope}::{joint.parent}"
    return ForceTorqueModel(
        ForceTorque.read(mount.sensor.settings),
        mount.engine,
        name,
        (parent, f"{scope}::{joint.child}"),
        mount.sensor.pose,
        mount.seed,
        mount.name,
    )


def _contact(mount: SensorMount) -> SensorModel:
    """Return the contact sensor of the named collisions, or of all of the link."""
    contact = mount.sensor.contact
    known = [collision.name for collision in mount.link.collisions]
    named = [] if contact is None else [name.rpartition("::")[2] for name in contact.collisions]
    lost = [name for name in named if name not in known]
    if lost:
        warnings.warn(
            SimulationWarning(
                f"contact sensor '{mount.name}' watches '{lost[0]}', which '{mount.link_name}' "
                f"does not have; it has: {', '.join(known) or 'none'}"
            ),
            stacklevel=2,
        )
    watched = [name for name in named if name in known] if named else known
    return ContactModel(mount.engine, [f"{mount.link_name}::{name}" for name in watched])


def _on_link(mount: SensorMount) -> tuple[Engine, str, Pose, int, str]:
    return mount.engine, mount.link_name, mount.sensor.pose, mount.seed, mount.name


_MODELS: dict[str, Callable[[SensorMount], SensorModel]] = {
    "air_pressure": _air_pressure,
    "altimeter": _altimeter,
    "camera": _camera,
    "contact": _contact,
    "depth": _depth_camera,
    "depth_camera": _depth_camera,
    "force_torque": _force_torque,
    "gps": _gps,
    "gpu_lidar": _lidar,
    "gpu_ray": _lidar,
    "imu": _imu,
    "lidar": _lidar,
    "magnetometer": _magnetometer,
    "multicamera": _camera,
    "navsat": _gps,
    "ray": _lidar,
    "rgbd_camera": _depth_camera,
    "sonar": _sonar,
    "wide_angle_camera": _wide_camera,
    "wideanglecamera": _wide_camera,
}

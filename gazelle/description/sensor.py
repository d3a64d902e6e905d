"""Sensors of links and joints. A sensor's x axis looks forward."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from gazelle.description.nan_refusal import refuses_nan
from gazelle.description.noise import Noise
from gazelle.description.parameters import Parameters
from gazelle.description.plugin import Plugin
from gazelle.description.pose import Pose, Vector3
from gazelle.description.source import Source


@refuses_nan
@dataclass(frozen=True, slots=True)
class Scan:
    """One fan of rays.

    Attributes:
        samples: Number of rays simulated.
        resolution: Factor: ``samples * resolution`` points are reported, interpolated.
        min_angle: Angle of the first ray [rad].
        max_angle: Angle of the last ray [rad].
    """

    samples: int = 640
    resolution: float = 1.0
    min_angle: float = 0.0
    max_angle: float = 0.0


@refuses_nan
@dataclass(frozen=True, slots=True)
class Lidar:
    """A laser range finder (SDF ``ray``, ``gpu_ray``, ``lidar``, ``gpu_lidar``).

    Attributes:
        horizontal: Rays about z, counter-clockwise.
        vertical: Rows of rays about y, upwards; one row at angle 0 for a planar scanner.
        range_min: Nearest distance measured [m].
        range_max: Farthest distance measured [m].
        range_resolution: Step of the distance by the file [m]; 0 for none. Gazebo
            classic reads it and does nothing with it.
        noise: On the distance [m].
        quantized: Whether distances are rounded to ``range_resolution``.
    """

    horizontal: Scan = field(default_factory=Scan)
    vertical: Scan = field(default_factory=lambda: Scan(samples=1))
    range_min: float = 0.0
    range_max: float = math.inf
    range_resolution: float = 0.0
    noise: Noise = field(default_factory=Noise)
    quantized: bool = False

    @property
    def quantum(self) -> float:
        """Resolution that distances are rounded to [m]; 0 for none."""
        return self.range_resolution if self.quantized else 0.0


@refuses_nan
@dataclass(frozen=True, slots=True)
class Imu:
    """An inertial measurement unit.

    Attributes:
        angular_velocity: Noise about x, y, z [rad/s].
        linear_acceleration: Noise along x, y, z [m/s²].
        localization: Orientation reference: CUSTOM, NED, ENU, NWU, GRAV_UP, GRAV_DOWN.
        custom_rpy: Reference frame for CUSTOM [rad].
        enable_orientation: Whether an orientation is reported.
    """

    angular_velocity: tuple[Noise, Noise, Noise] = (Noise(), Noise(), Noise())
    linear_acceleration: tuple[Noise, Noise, Noise] = (Noise(), Noise(), Noise())
    localization: str = "CUSTOM"
    custom_rpy: Vector3 = (0.0, 0.0, 0.0)
    enable_orientation: bool = True


@refuses_nan
@dataclass(frozen=True, slots=True)
class Camera:
    """A pinhole camera: x forward, y left, z up.

    Attributes:
        name: Name of the camera element (several in a multicamera).
        pose: In the sensor frame.
        horizontal_fov: Horizontal field of view [rad].
        width: [pixel].
        height: [pixel].
        format: Pixel format such as ``R8G8B8`` or ``L8``.
        near: Nearest distance seen [m].
        far: Farthest distance seen [m].
        depth_near: Nearest depth reported [m]; None when the file gives none.
        depth_far: Farthest depth reported [m]; None when the file gives none.
        noise: On each pixel value, 0 to 1.
        distortion: Brown's k1, k2, k3, p1, p2.
        distortion_center: Centre of the distortion, in fractions of the image.
        lens: The ``<lens>`` element kept whole, or None.
    """

    name: str = ""
    pose: Pose = field(default_factory=Pose)
    horizontal_fov: float = 1.047
    width: int = 320
    height: int = 240
    format: str = "R8G8B8"
    near: float = 0.1
    far: float = 100.0
    depth_near: float | None = None
    depth_far: float | None = None
    noise: Noise = field(default_factory=Noise)
    distortion: tuple[float, float, float, float, float] = (0.0, 0.0, 0.0, 0.0, 0.0)
    distortion_center: tuple[float, float] = (0.5, 0.5)
    lens: Parameters | None = None


@dataclass(frozen=True, slots=True)
class ContactSensor:
    """Reports what touches some collisions of its link.

    Attributes:
        collisions: Names of the collisions watched.
        topic: Gazebo topic, kept as written.
    """

    collisions: tuple[str, ...] = ()
    topic: str = ""


@refuses_nan
@dataclass(frozen=True, slots=True)
class Sensor:
    """A sensor on a link or joint.

    Attributes:
        name: Unique in its link.
        type: As SDF names it: ``ray``, ``imu``, ``camera``, ``contact``, ...
        pose: In the frame of its link, or of the joint's child link.
        update_rate: Measurements a second [Hz]; 0 means every step.
        always_on: Measure also without subscribers.
        visualize: Show its rays or frustum in a viewer.
        topic: Topic of the file, or empty.
        lidar: Set for the ray family.
        imu: Set for an IMU.
        cameras: Set for the camera family: one, or several of a multicamera.
        contact: Set for a contact sensor.
        settings: Parts of the ``<sensor>`` element without a field here; for types without
            fields of their own all that they add.
        plugins: In file order.
    """

    name: str
    type: str
    pose: Pose = field(default_factory=Pose)
    update_rate: float = 0.0
    always_on: bool = False
    visualize: bool = False
    topic: str = ""
    lidar: Lidar | None = None
    imu: Imu | None = None
    cameras: tuple[Camera, ...] = ()
    contact: ContactSensor | None = None
    settings: Parameters = field(default_factory=lambda: Parameters("sensor"), repr=False)
    plugins: tuple[Plugin, ...] = ()
    source: Source | None = field(default=None, compare=False, repr=False)

"""Values that sensor plugins publish."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.engines import Contacts
from gazelle.sensors import ImuReading


@dataclass(frozen=True, slots=True)
class Touches:
    """Contacts, in every world.

    Attributes:
        stamp: Simulated time [ns].
        contacts: One for each world.
    """

    stamp: int
    contacts: tuple[Contacts, ...]


@dataclass(frozen=True, slots=True)
class RangeValue:
    """One distance, in every world.

    Attributes:
        stamp: Simulated time [ns].
        distance: [m], shape (nworld,).
        least: Shortest that is measured [m].
        most: Longest that is measured [m].
        field_of_view: Angle of the cone [rad].
        ultrasound: Whether by sound; else by infrared light.
    """

    stamp: int
    distance: Floats
    least: float
    most: float
    field_of_view: float
    ultrasound: bool


class SonarValue(RangeValue):
    """The same, with the frame name as written."""

    __slots__ = ()


@dataclass(frozen=True, slots=True)
class Flags:
    """Yes or no, in every world.

    Attributes:
        values: Shape (nworld,).
    """

    values: NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class LaserPoints:
    """End points of a lidar's rays, in its own frame, in every world.

    Attributes:
        stamp: Simulated time [ns].
        points: [m], shape (nworld, rays, 3).
        intensities: Of the returns, shape (rays,).
        rings: Row of each ray, from the lowest, shape (rays,).
        kept: Mask of published rays, shape (nworld, rays).
    """

    stamp: int
    points: Floats
    intensities: Floats
    rings: NDArray[np.intp]
    kept: NDArray[np.bool_]


class ChannelPoints(LaserPoints):
    """The same, with each property in a channel of its own."""

    __slots__ = ()


@dataclass(frozen=True, slots=True)
class UnsureImu:
    """An IMU's reading and how sure each of its parts is.

    Attributes:
        reading: Of all worlds.
        orientation_variance: [rad²], three numbers.
        rate_variance: [rad²/s²], three numbers.
        acceleration_variance: [m²/s⁴], three numbers.
    """

    reading: ImuReading
    orientation_variance: Floats
    rate_variance: Floats
    acceleration_variance: Floats


@dataclass(frozen=True, slots=True)
class Fix:
    """Position of a receiver on Earth, in every world.

    Attributes:
        stamp: Simulated time [ns].
        latitude: [deg], shape (nworld,).
        longitude: [deg], shape (nworld,).
        altitude: [m], shape (nworld,).
        variance: Of east, north and up [m²], three numbers.
        status: As ``sensor_msgs/NavSatStatus`` counts.
        service: As ``sensor_msgs/NavSatStatus`` counts.
    """

    stamp: int
    latitude: Floats
    longitude: Floats
    altitude: Floats
    variance: Floats
    status: int = 0
    service: int = 0


@dataclass(frozen=True, slots=True)
class VectorValue:
    """A vector, in every world.

    Attributes:
        stamp: Simulated time [ns].
        values: Shape (nworld, 3).
    """

    stamp: int
    values: Floats


class MagneticValue(VectorValue):
    """A magnetic field [T]."""

    __slots__ = ()


class PointValue(VectorValue):
    """A place [m]."""

    __slots__ = ()


@dataclass(frozen=True, slots=True)
class AltimeterValue:
    """Altitude from a barometer's air pressure, in every world.

    Attributes:
        stamp: Simulated time [ns].
        altitude: Above the sea [m], shape (nworld,).
        pressure: Of the air [hPa], shape (nworld,).
        sea_level: The pressure there [hPa].
    """

    stamp: int
    altitude: Floats
    pressure: Floats
    sea_level: float


@dataclass(frozen=True, slots=True)
class CliffValue:
    """Reading of a cliff sensor.

    Attributes:
        place: 0 left, 1 in the middle, 2 right.
        deep: Whether the floor is farther than it should be, shape (nworld,).
        reading: Of the sensor's converter, shape (nworld,).
    """

    place: int
    deep: NDArray[np.bool_]
    reading: Floats


@dataclass(frozen=True, slots=True)
class BumperValue:
    """State of a bumper: pressed or not.

    Attributes:
        place: 0 left, 1 in the middle, 2 right.
        pressed: Shape (nworld,).
    """

    place: int
    pressed: NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class KobukiCore:
    """State of a Kobuki base's own sensors; places are left, in the middle and right.

    Attributes:
        stamp: Simulated time [ns].
        pressed: Whether a bumper is pressed, shape (nworld, 3).
        deep: Whether a sensor sees a cliff, shape (nworld, 3).
        floor: Readings of the cliff sensors' converters, shape (nworld, 3).
        angles: Of the left and the right wheel [rad], shape (nworld, 2).
    """

    stamp: int
    pressed: NDArray[np.bool_]
    deep: NDArray[np.bool_]
    floor: Floats
    angles: Floats

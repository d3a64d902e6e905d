"""Placement of satellite fixes in a robot's world: the laws of ``navsat_transform_node``."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import Pose, SphericalCoordinates
from gazelle.errors import Error
from gazelle.navigation.estimation.utm import UtmZone
from gazelle.sensors.geodesy import TangentPlane
from gazelle_ros.base.parameter_values import Values, fields_of, positive, value_of, warn_of_unknown
from gazelle_ros.base.real_numbers import finite

_OLD = {
    "broadcast_utm_transform": "broadcast_cartesian_transform",
    "broadcast_utm_transform_as_parent_frame": "broadcast_cartesian_transform_as_parent_frame",
}
_ELSEWHERE = ("datum", "cartesian_frame_id", "silent_tf_failure", "tf_prefix")


@dataclass(frozen=True, slots=True)
class GeographicPlace:
    """Place on the earth.

    Attributes:
        latitude: [degrees].
        longitude: [degrees].
        altitude: Above the ellipsoid [m].
    """

    latitude: float
    longitude: float
    altitude: float = 0.0


@dataclass(frozen=True, slots=True)
class NavsatSettings:
    """Parameters; names and defaults are those of ``navsat_transform_node``.

    Attributes:
        cartesian_frame_id: Of the grid; ``utm`` or ``local_enu`` by default.
        datum: Origin of the world, with its heading [rad]; None without ``wait_for_datum``.
    """

    frequency: float = 10.0
    delay: float = 0.0
    magnetic_declination_radians: float = 0.0
    yaw_offset: float = 0.0
    zero_altitude: bool = False
    publish_filtered_gps: bool = False
    use_odometry_yaw: bool = False
    wait_for_datum: bool = False
    use_local_cartesian: bool = False
    broadcast_cartesian_transform: bool = False
    broadcast_cartesian_transform_as_parent_frame: bool = False
    transform_timeout: float = 0.0
    cartesian_frame_id: str = ""
    datum: tuple[GeographicPlace, float] | None = None

    @classmethod
    def read(cls, values: Values) -> NavsatSettings:
        """Read the parameters; unknown ones are logged.

        Raises:
            Error: One is of the wrong kind.
        """
        plain = [each.name for each in fields(cls) if each.name not in _ELSEWHERE]
        warn_of_unknown("~", values, [*plain, *_OLD, *_ELSEWHERE])
        values = dict(values) | {new: values[old] for old, new in _OLD.items() if old in values}
        found = fields_of(cls, values, without=_ELSEWHERE)
        positive("frequency", found["frequency"])
        frame = "local_enu" if found["use_local_cartesian"] else "utm"
        found["cartesian_frame_id"] = value_of(values, "cartesian_frame_id", frame)
        if found["wait_for_datum"] and "datum" in values:
            found["datum"] = _datum(values["datum"])
        return cls(**found)


def _datum(given: Any) -> tuple[GeographicPlace, float]:
    """Return place and heading; what follows them, in old files, are names of frames."""
    numbers = [finite(each) for each in given[:3]] if isinstance(given, list) else []
    if len(numbers) != 3 or None in numbers:
        raise Error(f"'datum' is latitude and longitude [degrees] and yaw [rad], not {given!r:.60}")
    latitude, longitude, yaw = (each or 0.0 for each in numbers)
    return GeographicPlace(latitude, longitude), yaw


class EarthGrid:
    """Plane coordinates of places: in a UTM zone, or in a plane that touches the earth.

    Args:
        origin: Place whose zone it is, or where the plane touches.
        local: Use a plane.
        zone: Use this zone.

    Raises:
        Error: UTM does not cover the origin.

    Attributes:
        convergence: Bearing of the grid's north at the origin [rad].
    """

    def __init__(
        self, origin: GeographicPlace, *, local: bool = False, zone: UtmZone | None = None
    ) -> None:
        latitude, longitude = origin.latitude, origin.longitude
        self._plane: TangentPlane | None = None
        if local:
            self._plane = TangentPlane(
                SphericalCoordinates(
                    latitude=latitude, longitude=longitude, elevation=origin.altitude
                )
            )
        self._altitude = origin.altitude
        self._zone = zone or UtmZone(31, north=True)
        self.convergence = 0.0
        if not local:
            self._zone = zone or UtmZone.of(latitude, longitude)
            self.convergence = self._zone.convergence(latitude, longitude)

    def point(self, place: GeographicPlace) -> Floats:
        """Return east, north and altitude [m], shape (3,)."""
        latitude, longitude, altitude = place.latitude, place.longitude, place.altitude
        if self._plane is not None:
            where = np.array(latitude), np.array(longitude), np.array(altitude)
            east, north, _ = self._plane.positions(*where).tolist()
        else:
            east, north = self._zone.project(latitude, longitude)
        return np.array((east, north, altitude))

    def place(self, point: Floats) -> GeographicPlace:
        """Return the place of a point east and north at an altitude [m], shape (3,)."""
        east, north, altitude = point.tolist()
        if self._plane is not None:
            above = np.array((east, north, altitude - self._altitude))
            latitude, longitude, _ = (float(each) for each in self._plane.geodetic(above))
        else:
            latitude, longitude = self._zone.unproject(east, north)
        return GeographicPlace(latitude, longitude, altitude)


class WorldPlacement:
    """Pose of the earth's grid in a robot's world.

    Args:
        grid: Of the earth.
        world: Pose of the robot in its world; its roll and pitch do not count.
        place: Of the robot at the same time.
        yaw: Heading of the robot from east, on the ellipsoid [rad].
    """

    def __init__(self, grid: EarthGrid, world: Pose, place: Floats, yaw: float) -> None:
        self._grid = grid
        x, y, z = world.position
        upright = Pose(x, y, z, yaw=world.yaw)
        east, north, up = place.tolist()
        self.pose = upright * Pose(east, north, up, yaw=yaw + grid.convergence).inverse()
        """The transform from the grid to the world."""
        self._back = self.pose.inverse()

    def to_world(self, place: GeographicPlace) -> Floats:
        """Return the point of a place in the world [m], shape (3,)."""
        return np.array(self.pose.apply(self._grid.point(place).tolist()))

    def to_earth(self, point: Floats) -> GeographicPlace:
        """Return the place of a point of the world [m], shape (3,)."""
        return self._grid.place(np.array(self._back.apply(point.tolist())))

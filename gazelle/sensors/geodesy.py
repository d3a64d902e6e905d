"""Geodetic coordinates of a position in the world: WGS 84 and local tangent planes.

Figures of the ellipsoid: NIMA TR8350.2, "Department of Defense World Geodetic System 1984".
Formulas: Bowring, "Transformation from spatial to geographical coordinates", Survey Review
23 (1976), iterated until it no longer matters.
"""

from __future__ import annotations

import math

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.description import SphericalCoordinates
from gazelle.errors import SimulationError
from gazelle.rotations import apply_matrix

EQUATORIAL_RADIUS = 6378137.0
"""Semi-major axis [m]."""

FLATTENING = 1.0 / 298.257223563

_POLAR_RADIUS = EQUATORIAL_RADIUS * (1.0 - FLATTENING)
_E2 = FLATTENING * (2.0 - FLATTENING)  # first eccentricity squared
_EP2 = _E2 / (1.0 - _E2)  # second eccentricity squared
_ROUNDS = 3


def to_geocentric(latitude: Floats, longitude: Floats, altitude: Floats) -> Floats:
    """Return Earth-centred, Earth-fixed coordinates [m], shape (..., 3).

    Args:
        latitude: Geodetic [rad], shape (...).
        longitude: [rad], shape (...).
        altitude: Above the ellipsoid [m], shape (...).
    """
    sine = np.sin(latitude)
    curvature = EQUATORIAL_RADIUS / np.sqrt(1.0 - _E2 * sine * sine)
    across = (curvature + altitude) * np.cos(latitude)
    up = (curvature * (1.0 - _E2) + altitude) * sine
    return np.stack((across * np.cos(longitude), across * np.sin(longitude), up), axis=-1)


def to_geodetic(place: Floats) -> tuple[Floats, Floats, Floats]:
    """Return latitude [rad], longitude [rad] and altitude [m] of places, shape (..., 3)."""
    x, y, z = place[..., 0], place[..., 1], place[..., 2]
    across = np.hypot(x, y)
    reduced = np.arctan2(z * EQUATORIAL_RADIUS, across * _POLAR_RADIUS)
    latitude = reduced
    for _ in range(_ROUNDS):
        latitude = np.arctan2(
            z + _EP2 * _POLAR_RADIUS * np.sin(reduced) ** 3,
            across - _E2 * EQUATORIAL_RADIUS * np.cos(reduced) ** 3,
        )
        reduced = np.arctan2((1.0 - FLATTENING) * np.sin(latitude), np.cos(latitude))
    sine, cosine = np.sin(latitude), np.cos(latitude)
    root = np.sqrt(1.0 - _E2 * sine * sine)
    # across * cos + z * sin stays exact at the poles, where across / cos does not
    altitude = across * cosine + z * sine - EQUATORIAL_RADIUS * root
    return latitude, np.arctan2(y, x), altitude


@checked(SimulationError, after=True)
class TangentPlane:
    """The world's plane on Earth.

    ``heading`` turns the world's x axis from east towards north. Gazebo classic 7 to 11 turn
    positions by half a turn more, a known fault of theirs that is not kept.

    Args:
        origin: Place of the world's origin.
    """

    def __init__(self, origin: SphericalCoordinates) -> None:
        latitude, longitude = math.radians(origin.latitude), math.radians(origin.longitude)
        self._origin = to_geocentric(
            np.asarray(latitude), np.asarray(longitude), np.asarray(origin.elevation)
        )
        sin_lat, cos_lat = math.sin(latitude), math.cos(latitude)
        sin_lon, cos_lon = math.sin(longitude), math.cos(longitude)
        self._axes = np.array(  # rows: east, north, up
            [
                [-sin_lon, cos_lon, 0.0],
                [-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat],
                [cos_lat * cos_lon, cos_lat * sin_lon, sin_lat],
            ]
        )
        turn = math.radians(origin.heading)
        self._turn = np.array(
            [
                [math.cos(turn), -math.sin(turn), 0.0],
                [math.sin(turn), math.cos(turn), 0.0],
                [0.0, 0.0, 1.0],
            ]
        )

    def east_north_up(self, vectors: Floats) -> Floats:
        """Return vectors of the world along east, north and up at its origin, shape (..., 3)."""
        return apply_matrix(self._turn, vectors)

    def geodetic(self, positions: Floats) -> tuple[Floats, Floats, Floats]:
        """Return latitude [deg], longitude [deg], altitude [m] of positions in the world [m]."""
        place = self._origin + apply_matrix(self._axes.T, self.east_north_up(positions))
        latitude, longitude, altitude = to_geodetic(place)
        return np.degrees(latitude), np.degrees(longitude), altitude

    def positions(self, latitude: Floats, longitude: Floats, altitude: Floats) -> Floats:
        """Return positions in the world [m], shape (..., 3), of places [deg, deg, m], shape (...)."""
        place = to_geocentric(np.radians(latitude), np.radians(longitude), altitude)
        return apply_matrix(self._turn.T, apply_matrix(self._axes, place - self._origin))

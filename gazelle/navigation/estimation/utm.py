"""Universal Transverse Mercator coordinates on the ellipsoid WGS 84.

The series of Krueger in the third flattening n, to its sixth power, as Karney gives them: "Transverse
Mercator with an accuracy of a few nanometers", Journal of Geodesy 85 (2011), equations 7 to 12, 35 and 36.
Its error is below 5 nm within 3900 km of the central meridian.
"""

from __future__ import annotations

import cmath
import math
import re
from dataclasses import dataclass

from gazelle.errors import Error
from gazelle.sensors.geodesy import EQUATORIAL_RADIUS, FLATTENING

_N = FLATTENING / (2.0 - FLATTENING)
_E = math.sqrt(FLATTENING * (2.0 - FLATTENING))
_SCALE = 0.9996
_RADIUS = EQUATORIAL_RADIUS / (1.0 + _N) * (1.0 + _N**2 / 4.0 + _N**4 / 64.0 + _N**6 / 256.0)
"""Of the circle with the circumference of a meridian [m]."""
_EAST, _SOUTH = 500e3, 10000e3


def _series(*rows: tuple[float, ...]) -> tuple[float, ...]:
    """Return coefficients; row j begins with the factor of the power j of n."""
    return tuple(
        sum(factor * _N**power for power, factor in enumerate(row, start))
        for start, row in enumerate(rows, 1)
    )


_FORWARD = _series(
    (1 / 2, -2 / 3, 5 / 16, 41 / 180, -127 / 288, 7891 / 37800),
    (13 / 48, -3 / 5, 557 / 1440, 281 / 630, -1983433 / 1935360),
    (61 / 240, -103 / 140, 15061 / 26880, 167603 / 181440),
    (49561 / 161280, -179 / 168, 6601661 / 7257600),
    (34729 / 80640, -3418889 / 1995840),
    (212378941 / 319334400,),
)
_INVERSE = _series(
    (1 / 2, -2 / 3, 37 / 96, -1 / 360, -81 / 512, 96199 / 604800),
    (1 / 48, 1 / 15, -437 / 1440, 46 / 105, -1118711 / 3870720),
    (17 / 480, -37 / 840, -209 / 4480, 5569 / 90720),
    (4397 / 161280, -11 / 504, -830251 / 7257600),
    (4583 / 161280, -108847 / 3991680),
    (20648693 / 638668800,),
)


@dataclass(frozen=True, slots=True)
class UtmZone:
    """Zone of the grid.

    Attributes:
        number: 1 to 60.
        north: Whether northings count from the equator, not from 10,000 km south of it.

    Raises:
        Error: There is no such zone.
    """

    number: int
    north: bool

    def __post_init__(self) -> None:
        if not 1 <= self.number <= 60:
            raise Error(f"a UTM zone must be 1 to 60, not {self.number}")

    @classmethod
    def of(cls, latitude: float, longitude: float) -> UtmZone:
        """Return the zone of a place [degrees], with the exceptions of Norway and Svalbard.

        Raises:
            Error: The place is nearer to a pole than the grid goes.
        """
        if not -80.0 <= latitude < 84.0 or not math.isfinite(longitude):
            raise Error(f"UTM is for latitudes from -80 to 84 degrees, not {latitude}, {longitude}")
        longitude = math.remainder(longitude, 360.0)
        number = int((longitude + 180.0) // 6.0) % 60 + 1
        if 56.0 <= latitude < 64.0 and 3.0 <= longitude < 12.0:
            number = 32
        if latitude >= 72.0 and 0.0 <= longitude < 42.0:
            number = 31 + 2 * int((longitude + 3.0) // 12.0)
        return cls(number, latitude >= 0.0)

    @classmethod
    def named(cls, name: str) -> UtmZone:
        """Return a zone from its number and latitude band, such as 31U.

        Raises:
            Error: It is no such name.
        """
        match = re.fullmatch(r"(\d{1,2})([C-HJ-NP-X])", name.strip().upper())
        if match is None:
            raise Error(f"a UTM zone has a number and a band, such as 31U, not '{name}'")
        return cls(int(match[1]), match[2] >= "N")

    def project(self, latitude: float, longitude: float) -> tuple[float, float]:
        """Return easting and northing [m] of a place [degrees]."""
        point, _ = self._projected(latitude, longitude)
        return point

    def convergence(self, latitude: float, longitude: float) -> float:
        """Return the bearing of grid north from true north [rad], positive to the east."""
        _, angle = self._projected(latitude, longitude)
        return angle

    def unproject(self, easting: float, northing: float) -> tuple[float, float]:
        """Return latitude and longitude [degrees] of a point [m]."""
        origin = 0.0 if self.north else _SOUTH
        zeta = complex(northing - origin, easting - _EAST) / (_SCALE * _RADIUS)
        inner = zeta - sum(
            factor * cmath.sin(2.0 * j * zeta) for j, factor in enumerate(_INVERSE, 1)
        )
        sine, cosine = math.sinh(inner.imag), math.cos(inner.real)
        slope = math.sin(inner.real) / math.hypot(sine, cosine)
        latitude = math.degrees(math.atan(_geographic(slope)))
        longitude = self._meridian() + math.degrees(math.atan2(sine, cosine))
        return latitude, math.remainder(longitude, 360.0)

    def _meridian(self) -> float:
        return 6.0 * self.number - 183.0

    def _projected(self, latitude: float, longitude: float) -> tuple[tuple[float, float], float]:
        east = math.radians(math.remainder(longitude - self._meridian(), 360.0))
        slope = _conformal(math.tan(math.radians(latitude)))
        inner = complex(
            math.atan2(slope, math.cos(east)),
            math.asinh(math.sin(east) / math.hypot(slope, math.cos(east))),
        )
        zeta, change = inner, 1.0 + 0.0j
        for j, factor in enumerate(_FORWARD, 1):
            zeta += factor * cmath.sin(2.0 * j * inner)
            change += 2.0 * j * factor * cmath.cos(2.0 * j * inner)
        angle = math.atan2(slope * math.sin(east), math.hypot(1.0, slope) * math.cos(east))
        whole = _SCALE * _RADIUS
        origin = 0.0 if self.north else _SOUTH
        point = (_EAST + whole * zeta.imag, origin + whole * zeta.real)
        return point, angle - cmath.phase(change)


def _conformal(slope: float) -> float:
    """Return the tangent of the conformal latitude from that of the geographic one."""
    length = math.hypot(1.0, slope)
    stretch = math.sinh(_E * math.atanh(_E * slope / length))
    return slope * math.hypot(1.0, stretch) - stretch * length


def _geographic(slope: float) -> float:
    """Return the tangent of the geographic latitude from that of the conformal one, by Newton's method."""
    found = slope
    for _ in range(6):
        error = slope - _conformal(found)
        whole = 1.0 - _E * _E
        step = error * (1.0 + whole * found * found)
        found += step / (whole * math.hypot(1.0, slope) * math.hypot(1.0, found))
    return found

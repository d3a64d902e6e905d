"""UTM against published points, and against the laws that define them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.errors import Error
from gazelle.navigation.estimation.utm import UtmZone
from gazelle.sensors.geodesy import EQUATORIAL_RADIUS, FLATTENING

LATITUDES, OFFSETS = st.floats(-79.9, 83.9), st.floats(-4.0, 4.0)
E2 = FLATTENING * (2.0 - FLATTENING)


@pytest.mark.parametrize(
    ("latitude", "longitude", "zone", "easting", "northing", "convergence"),
    [
        # pyproj's own example, and the points of robot_localization's test.
        (34.36116666, -120.108, "10S", 765975.641, 3805993.134, None),
        (51.423964, 5.494271, "31U", 673409.989, 5699924.709, 1.950),
        (-43.530955, 172.636645, "59G", 632246.802, 5178919.718, -1.127),
        (0.0, 3.0, "31N", 500000.0, 0.0, 0.0),
    ],
)
def test_published_points(latitude, longitude, zone, easting, northing, convergence):
    found = UtmZone.of(latitude, longitude)
    assert found == UtmZone.named(zone)
    assert found.project(latitude, longitude) == pytest.approx((easting, northing), abs=6e-4)
    if convergence is not None:
        angle = math.degrees(found.convergence(latitude, longitude))
        assert angle == pytest.approx(convergence, abs=6e-4)


@given(LATITUDES)
def test_the_central_meridian_is_scaled_evenly(latitude):
    """Its arc from the equator is the integral of the radius of curvature."""
    nodes, weights = np.polynomial.legendre.leggauss(40)
    half = math.radians(latitude) / 2.0
    radii = EQUATORIAL_RADIUS * (1.0 - E2) / (1.0 - E2 * np.sin(half * (nodes + 1.0)) ** 2) ** 1.5
    arc = half * float(weights @ radii)
    easting, northing = UtmZone(31, north=True).project(latitude, 3.0)
    assert easting == 500000.0
    assert northing == pytest.approx(0.9996 * arc, abs=1e-6)


@given(LATITUDES, OFFSETS)
def test_the_map_is_conformal_and_turned_by_the_convergence(latitude, offset):
    """Steps of equal length north and east are equally long on the map, at right angles."""
    zone, h = UtmZone(31, north=latitude >= 0.0), 1e-4
    sine, cosine = math.sin(math.radians(latitude)), math.cos(math.radians(latitude))
    root = math.sqrt(1.0 - E2 * sine * sine)
    across, along = EQUATORIAL_RADIUS * cosine / root, EQUATORIAL_RADIUS * (1.0 - E2) / root**3

    def change(up, east, length):
        ahead = zone.project(latitude + h * up, 3.0 + offset + h * east)
        behind = zone.project(latitude - h * up, 3.0 + offset - h * east)
        return complex(ahead[0] - behind[0], ahead[1] - behind[1]) / (
            2.0 * length * math.radians(h)
        )

    north, east = change(1, 0, along), change(0, 1, across)
    assert abs(north - 1j * east) < 1e-6
    assert math.pi / 2 + zone.convergence(latitude, 3.0 + offset) == pytest.approx(
        math.atan2(north.imag, north.real), abs=1e-7
    )


@given(LATITUDES, OFFSETS, st.integers(1, 60))
def test_points_go_back_to_their_places(latitude, offset, number):
    zone = UtmZone(number, north=latitude >= 0.0)
    longitude = math.remainder(6.0 * number - 183.0 + offset, 360.0)
    found = zone.unproject(*zone.project(latitude, longitude))
    assert found[0] == pytest.approx(latitude, abs=1e-11)
    assert math.remainder(found[1] - longitude, 360.0) == pytest.approx(0.0, abs=1e-10)


@pytest.mark.parametrize(
    ("latitude", "longitude", "number"),
    [
        (60.0, 5.0, 32), (60.0, 2.9, 31), (64.0, 5.0, 31), (75.0, 8.9, 31), (75.0, 9.0, 33),
        (75.0, 41.9, 37), (75.0, 42.0, 38), (0.0, 180.0, 1), (0.0, -180.0, 1), (0.0, 179.9, 60),
    ],
)  # fmt: skip
def test_zones_with_their_exceptions(latitude, longitude, number):
    assert UtmZone.of(latitude, longitude).number == number


def test_there_is_no_grid_at_the_poles_and_no_other_zone():
    with pytest.raises(Error, match="latitudes from -80 to 84"):
        UtmZone.of(85.0, 0.0)
    with pytest.raises(Error, match="1 to 60, not 61"):
        UtmZone.named("61U")
    with pytest.raises(Error, match="a number and a band, such as 31U, not 'U31'"):
        UtmZone.named("U31")

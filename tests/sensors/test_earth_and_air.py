"""GPS, barometers, altimeters and magnetometers against closed forms."""

import math
from dataclasses import replace

import numpy as np
import pytest
import scenes
from hypothesis import given
from hypothesis import strategies as st

from gazelle.description import Atmosphere, Noise, Pose, SphericalCoordinates
from gazelle.engines import make_engine
from gazelle.rotations import from_yaw
from gazelle.sensors import (
    AirPressure,
    AirPressureModel,
    Altimeter,
    AltimeterModel,
    Gps,
    GpsModel,
    Magnetometer,
    MagnetometerModel,
    TangentPlane,
    air_pressure,
)
from gazelle.sensors.geodesy import EQUATORIAL_RADIUS, to_geocentric, to_geodetic

POLAR_RADIUS = 6356752.314245


def flying(engine_world=None, **changes):
    world = replace(engine_world or scenes.world(scenes.box(), gravity=(0, 0, 0)), **changes)
    return make_engine("mujoco", world)


# -- the ellipsoid -----------------------------------------------------------------------


@given(
    st.floats(-math.pi / 2, math.pi / 2),
    st.floats(-math.pi, math.pi),
    st.floats(-5000.0, 30000.0),
)
def test_places_come_back_from_geocentric_coordinates(latitude, longitude, altitude):
    place = to_geocentric(np.array(latitude), np.array(longitude), np.array(altitude))
    back = to_geodetic(place)
    assert back[0] == pytest.approx(latitude, abs=1e-11)
    assert back[2] == pytest.approx(altitude, abs=1e-6)
    if abs(latitude) < 1.57:
        assert math.cos(back[1] - longitude) == pytest.approx(1.0, abs=1e-12)


def test_the_axes_of_the_ellipsoid_are_the_published_ones():
    zero = np.array(0.0)
    np.testing.assert_allclose(to_geocentric(zero, zero, zero), [EQUATORIAL_RADIUS, 0, 0])
    pole = to_geocentric(np.array(math.pi / 2), zero, zero)
    np.testing.assert_allclose(pole, [0, 0, POLAR_RADIUS], atol=1e-5)


# Lengths of a degree on WGS 84 at a latitude, by the radii of curvature M and N.
def metres_a_degree(latitude):
    e2 = 1.0 - (POLAR_RADIUS / EQUATORIAL_RADIUS) ** 2
    root = math.sqrt(1.0 - e2 * math.sin(math.radians(latitude)) ** 2)
    north = EQUATORIAL_RADIUS * (1.0 - e2) / root**3
    east = EQUATORIAL_RADIUS / root * math.cos(math.radians(latitude))
    return math.radians(1.0) * north, math.radians(1.0) * east


@pytest.mark.parametrize("latitude", [-37.4, 0.0, 48.1])
def test_a_step_east_and_north_is_as_many_degrees_as_the_curvature_says(latitude):
    plane = TangentPlane(SphericalCoordinates(latitude=latitude, longitude=11.6, elevation=500.0))
    north, east = metres_a_degree(latitude)
    here = plane.geodetic(np.array([[30.0, 0.0, 0.0], [0.0, 30.0, 0.0], [0.0, 0.0, 2.0]]))
    assert here[1][0] - 11.6 == pytest.approx(30.0 / east, rel=2e-4)
    assert here[0][1] - latitude == pytest.approx(30.0 / north, rel=2e-4)
    assert here[2][2] == pytest.approx(502.0, abs=1e-6)
    assert here[0][0] == pytest.approx(latitude, abs=1e-8)


def test_heading_turns_x_from_east_to_north():
    plane = TangentPlane(SphericalCoordinates(heading=90.0))
    np.testing.assert_allclose(
        plane.east_north_up(np.array([[1.0, 0.0, 0.0]])), [[0.0, 1.0, 0.0]], atol=1e-12
    )
    latitude, longitude, _ = plane.geodetic(np.array([[1000.0, 0.0, 0.0]]))
    assert latitude[0] > 0.008
    assert abs(longitude[0]) < 1e-12


@pytest.mark.parametrize("latitude", [-37.4, 0.0, 80.0])
def test_places_on_earth_have_positions_in_the_world(latitude):
    origin = SphericalCoordinates(latitude=latitude, longitude=11.6, elevation=500.0, heading=30.0)
    plane = TangentPlane(origin)
    positions = np.array([[3e4, 0.0, 0.0], [-200.0, 5e4, 100.0], [0.0, 0.0, -50.0]])
    np.testing.assert_allclose(plane.positions(*plane.geodetic(positions)), positions, atol=1e-6)


# -- GPS ---------------------------------------------------------------------------------


def test_gps_reports_where_the_antenna_is_and_how_it_moves():
    place = SphericalCoordinates(latitude=49.9, longitude=8.9, elevation=144.0)
    engine = flying(spherical_coordinates=place)
    engine.models["box"].set_placement((100.0, 0.0, 3.0), from_yaw(np.array(math.pi / 2)))
    engine.models["box"].set_motion((2.0, 0.0, 0.5), (0.0, 0.0, 1.0))
    model = GpsModel(Gps(), engine, "box::link", Pose(x=1.0), 0, "gps")
    fix = model.reading(model.measure()[0], 5)
    north, east = metres_a_degree(49.9)
    assert fix.longitude - 8.9 == pytest.approx(100.0 / east, rel=1e-4)
    assert fix.latitude - 49.9 == pytest.approx(1.0 / north, rel=1e-3)
    assert fix.altitude == pytest.approx(147.0, abs=1e-2)
    # a metre ahead, which is north, turning left: one metre a second west
    np.testing.assert_allclose(fix.velocity, [1.0, 0.0, 0.5], atol=1e-9)


def test_gps_noise_is_in_metres():
    engine = flying()
    settings = Gps(horizontal=Noise("gaussian", stddev=3.0))
    model = GpsModel(settings, engine, "box::link", Pose(), 0, "gps")
    fixes = np.array([model.measure()[0] for _ in range(500)])
    north, east = metres_a_degree(0.0)
    assert fixes[:, 0].std() * north == pytest.approx(3.0, rel=0.1)
    assert fixes[:, 1].std() * east == pytest.approx(3.0, rel=0.1)
    assert fixes[:, 2].std() < 1e-4


# -- air ---------------------------------------------------------------------------------


# U.S. Standard Atmosphere, 1976, table I: pressure [Pa] at geopotential heights [m].
@pytest.mark.parametrize(
    ("height", "pressure"), [(0.0, 101325.0), (1000.0, 89874.6), (5000.0, 54019.9)]
)
def test_pressure_falls_as_the_standard_atmosphere_does(height, pressure):
    assert air_pressure(Atmosphere(), np.array(height)) == pytest.approx(pressure, rel=1e-4)


def test_without_a_gradient_pressure_falls_exponentially():
    even = Atmosphere(temperature_gradient=0.0)
    almost = Atmosphere(temperature_gradient=-1e-9)
    height = np.array(2000.0)
    assert air_pressure(even, height) == pytest.approx(
        float(air_pressure(almost, height)), rel=1e-6
    )
    assert air_pressure(even, height) < 101325.0


def test_a_barometer_adds_the_altitude_of_the_world():
    engine = flying()
    engine.models["box"].set_placement((0, 0, 200.0), (0, 0, 0, 1))
    model = AirPressureModel(AirPressure(800.0), engine, "box::link", Pose(), 0, "air")
    reading = model.reading(model.measure()[0], 0)
    assert reading.pressure == pytest.approx(89874.6, rel=1e-4)
    assert reading.variance == 0.0


def test_an_altimeter_counts_from_where_it_was_loaded():
    engine = flying(scenes.world(scenes.box(pose=Pose(z=2.0)), gravity=(0, 0, 0)))
    model = AltimeterModel(Altimeter(), engine, "box::link", Pose(z=0.5), 0, "alt")
    engine.models["box"].set_placement((0, 0, 3.25), (0, 0, 0, 1))
    engine.models["box"].set_motion((0, 0, -0.75), (0, 0, 0))
    reading = model.reading(model.measure()[0], 0)
    assert reading.height == pytest.approx(1.25)
    assert reading.velocity == pytest.approx(-0.75)
    assert reading.reference == pytest.approx(2.5)


# -- magnetism ---------------------------------------------------------------------------


def test_a_magnetometer_turns_against_the_field():
    engine = flying(magnetic_field=(2e-5, 0.0, -4e-5))
    engine.models["box"].set_placement((0, 0, 0), from_yaw(np.array(math.pi / 2)))
    model = MagnetometerModel(Magnetometer(), engine, "box::link", Pose(), 0, "mag")
    np.testing.assert_allclose(model.measure(), [[0.0, -2e-5, -4e-5]], atol=1e-12)
    engine.update_world(replace(engine.world, magnetic_field=(0.0, 1e-5, 0.0)))
    np.testing.assert_allclose(model.measure(), [[1e-5, 0.0, 0.0]], atol=1e-12)

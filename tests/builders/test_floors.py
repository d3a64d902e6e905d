"""Ground, floors, sun and lamps."""

import math

import pytest

from gazelle.builders import BuildError, floor, ground, lamp, sun
from gazelle.description import Plane


def test_the_ground_is_endless_and_rough():
    (link,) = ground().links
    assert isinstance(link.collisions[0].geometry, Plane)
    assert link.collisions[0].surface.friction.mu == 100.0


def test_a_floor_touches_nothing():
    (link,) = floor().links
    assert not link.collisions
    assert link.visuals


@pytest.mark.parametrize("azimuth", [0.0, 1.0, 4.0])
def test_the_sun_shines_from_where_it_stands(azimuth):
    light = sun(elevation=0.6, azimuth=azimuth)
    x, y, z = light.pose.position
    assert math.atan2(z, math.hypot(x, y)) == pytest.approx(0.6)
    assert math.atan2(y, x) % math.tau == pytest.approx(azimuth)
    # It shines at the origin.
    scale = math.hypot(x, y, z)
    assert light.direction == pytest.approx((-x / scale, -y / scale, -z / scale))


def test_impossible_lights_are_refused():
    with pytest.raises(BuildError, match="above the horizon"):
        sun(elevation=-0.1)
    with pytest.raises(BuildError, match="from 0 to 1"):
        lamp(brightness=2.0)
    with pytest.raises(BuildError, match="reach"):
        lamp(reach=0.0)
    with pytest.raises(BuildError, match="size of the ground"):
        ground(size=(0.0, 1.0))

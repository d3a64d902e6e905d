"""Small scenes are scanned by what faces the sensor: the ranges are those of the general way."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.engines.planar import (
    Body,
    Fan,
    Fleet,
    Mount,
    PlanarPart,
    Scanner,
    columns,
    scan_columns,
)
from gazelle.engines.planar.fans import Beams
from gazelle.engines.planar.small_scene import front_faces_of

SPOT = st.floats(-3.0, 3.0)
HEIGHT = st.sampled_from([0.2, 0.6])


def polygon(x, y, radius, corners, turn, high):
    angles = turn + 2.0 * math.pi * np.arange(corners) / corners
    points = tuple((x + radius * math.cos(a), y + radius * math.sin(a)) for a in angles)
    return PlanarPart(points, high=high)


POLYGONS = st.builds(
    polygon, SPOT, SPOT, st.floats(0.05, 2.0), st.integers(3, 6), st.floats(0.0, 6.0), HEIGHT
)
DISCS = st.builds(
    lambda x, y, r, z: PlanarPart(((x, y),), r, high=z), SPOT, SPOT, st.floats(0.05, 1.0), HEIGHT
)
PARTS = st.one_of(POLYGONS, DISCS)
PLACES = st.tuples(SPOT, SPOT, st.floats(-4.0, 4.0))
FANS = st.builds(
    lambda count, reach, begin: Fan(-math.pi, 2.0 * math.pi / count, count, reach, begin),
    st.sampled_from([1, 9, 24, 60]),
    st.sampled_from([1.0, 4.0, 20.0]),
    st.sampled_from([0.0, 0.1, 0.5]),
)


@given(st.lists(PARTS, max_size=8), st.lists(PLACES, min_size=1, max_size=3), FANS)
def test_ranges_are_those_of_the_general_way(statics, places, fan):
    shape = (PlanarPart.circle(0.1, 0.0, 0.2), polygon(0.0, 0.0, 0.25, 4, 0.3, 0.5))
    fleet = Fleet([Body(shape, place) for place in places], statics, nworld=2, threads=1)
    assert front_faces_of(fleet) is not None
    mounts = [Mount(0, 0.1, 0.0, 0.2, 0.3), Mount(0, z=0.1)]
    general = Scanner(fleet, fan, mounts, named=True)
    plain = Scanner(fleet, fan, mounts).scan()
    np.testing.assert_allclose(plain, general.scan(), rtol=1e-12)


@pytest.mark.parametrize("begin", [0.0, 0.2])
@pytest.mark.parametrize(
    "spot", [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (-1.0, 0.5), (0.99, 0.3), (1.1, 0.0), (0.4, -1.0)]
)
@pytest.mark.parametrize("yaw", [0.0, math.pi / 2.0, math.pi, 0.7])
def test_a_sensor_in_a_wall_or_on_it_sees_what_it_does_in_general(spot, yaw, begin):
    square = PlanarPart(((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)))
    fleet = Fleet([Body((), (*spot, yaw))], [square, PlanarPart.circle(3.0, 0.0, 0.5)], threads=1)
    fan = Fan(-math.pi, 2.0 * math.pi / 16, 16, 9.0, begin)
    general = Scanner(fleet, fan, [Mount(0)], named=True).scan()
    np.testing.assert_allclose(Scanner(fleet, fan, [Mount(0)]).scan(), general, rtol=1e-12)


def test_what_is_missing_and_what_is_met_from_inside_can_be_marked():
    square = PlanarPart(((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)))
    fleet = Fleet([Body((), (x, 0.0, 0.0)) for x in (0.0, -3.0, 5.0)], [square], threads=1)
    mounts = [Mount(0), Mount(1), Mount(2)]
    scanner = Scanner(fleet, Fan(0.0, 1.0, 1, 9.0), mounts, missing=math.inf, signed=True)
    np.testing.assert_allclose(scanner.scan()[0, :, 0], [-math.inf, 2.0, math.inf])


def test_scans_are_the_same_at_any_number_of_threads():
    walls = [
        PlanarPart(((-4.0, y), (4.0, y), (4.0, y + 0.1), (-4.0, y + 0.1))) for y in (-4.0, 4.0)
    ]
    bodies = [
        Body((PlanarPart.circle(0.0, 0.0, 0.3),), (x, 0.5 * x, 0.1 * x)) for x in (-2.0, 0.0, 2.0)
    ]
    found = []
    for threads in (1, 3):
        fleet = Fleet(bodies, walls, nworld=700, threads=threads)
        for body in range(3):
            shift = np.linspace(-1.0, 1.0, 700)
            fleet.place(body, np.stack((shift + 2.0 * body - 2.0, shift, shift), axis=1))
        fan = Fan(-math.pi, 2.0 * math.pi / 24, 24, 9.0, 0.1)
        found.append(Scanner(fleet, fan, [Mount(0), Mount(2)]).scan().tobytes())
        fleet.close()
    assert found[0] == found[1]


@pytest.mark.parametrize("module", [columns, scan_columns])
def test_compiled_code_knows_the_same_columns(module):
    text = Path(module.__file__).with_suffix(".pxd").read_text(encoding="utf-8")
    found = dict(re.findall(r"^    (\w+) = (-?\d+)$", text, re.MULTILINE))
    assert len(found) > 20
    assert {name: int(value) for name, value in found.items()} == {
        name: int(getattr(module, name)) for name in found
    }


def test_beams_are_spread_evenly():
    angles = np.linspace(-1.0, 1.0, 5)
    beams = Beams(angles, 0.5, 3.0, 0.0, 0.0)
    np.testing.assert_array_equal(np.arctan2(np.asarray(beams.dy), np.asarray(beams.dx)), angles)

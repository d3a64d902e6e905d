"""Maps that are made while driving agree with the true ones, though odometry is off."""

import math

import numpy as np
import pytest

from gazelle.description import Pose
from gazelle.description.occupancy import OccupancyMap
from gazelle.errors import Error
from gazelle.navigation.costmap.distances import squared_distances
from gazelle.navigation.localization.scan_likelihood import BeamModel
from gazelle.navigation.mapping import GmappingSettings, GridSlam
from gazelle.navigation.mapping.scan_matching import ScanMatcher
from gazelle.navigation.mapping.tiled_maps import TiledMaps
from gazelle.navigation.planners.planar import composed

ANGLES = np.radians(np.arange(0.0, 360.0, 2.0))
LASER = (-0.03, 0.0, 0.0)
TB3 = {
    "maxUrange": 3.0, "lsigma": 0.075, "srr": 0.1, "srt": 0.2, "str": 0.1, "stt": 0.2,
    "linearUpdate": 0.3, "angularUpdate": 0.2, "minimumScore": 50, "particles": 8, "xmin": -3, "ymin": -3,
    "xmax": 8, "ymax": 6,
}  # fmt: skip


def room():
    grid = np.zeros((100, 120), np.int8)
    grid[[0, 1, -2, -1]] = grid[:, [0, 1, -2, -1]] = 100
    grid[0:60, 56:59] = 100
    grid[30:36, 90:96] = 100
    grid[80:86, 20:50] = 100
    return OccupancyMap(grid, 0.05, Pose(-1.0, -1.0))


def way():
    """Return a path around the wall and back, in steps of 5 cm or 6 degrees."""
    ahead, left, right = (0.05, 0.0), (0.0, 0.105), (0.0, -0.105)
    return [*[ahead] * 36, *[left] * 15, *[ahead] * 58, *[right] * 15, *[ahead] * 40, *[right] * 15,
            *[ahead] * 50, *[left] * 15, *[left] * 15, *[ahead] * 45]  # fmt: skip


def wall_error(found, true):
    """Return distances from visible true walls to the nearest one of the map [cells]."""
    corner = np.array([found.origin.x, found.origin.y])
    near = np.sqrt(squared_distances((found.data == 100).view(np.uint8)))
    free = squared_distances((true.data == 0).view(np.uint8)) <= 1
    rows, columns = np.nonzero((true.data == 100) & free)
    places = np.stack((columns, rows), 1) * 0.05 + 0.025 + [true.origin.x, true.origin.y]
    cells = np.floor((places - corner) / 0.05).astype(int)
    # Only walls that were seen from their free side count.
    seen = squared_distances((found.data == 0).view(np.uint8))[cells[:, 1], cells[:, 0]] <= 4
    return near[cells[:, 1], cells[:, 0]][seen]


@pytest.mark.long
def test_a_map_agrees_with_the_truth_and_the_place_with_it():
    true, random = room(), np.random.default_rng(2)
    model = BeamModel((true.data != 0).view(np.uint8), (-1.0, -1.0), 0.05, np.ones(4), 0.2, 0.1)
    slam = GridSlam(GmappingSettings.read(TB3), seed=1)
    pose = odom = (0.0, 0.0, 0.0)
    for number, (forward, turn) in enumerate([(0.0, 0.0), *way()]):
        pose = composed(pose, (forward, 0.0, turn))
        slip = 1.0 + random.normal(0.04, 0.05)
        odom = composed(odom, (forward * slip, 0.0, turn * slip + random.normal(0.003, 0.002)))
        x, y, heading = composed(pose, LASER)
        ranges = np.array([model.range_at(x, y, heading + angle, 3.5) for angle in ANGLES])
        ranges = np.where(ranges >= 3.5, np.inf, ranges + random.normal(0.0, 0.01, len(ranges)))
        slam.update(0.1 * number, odom, ranges, ANGLES, 3.5, LASER)
    place = composed(slam.map_to_odom, odom)
    assert math.dist(odom[:2], pose[:2]) > 0.3, "odometry is too good for a test"
    assert math.dist(place[:2], pose[:2]) < 0.1
    error = wall_error(slam.map(), true)
    assert len(error) > 400
    assert np.mean(error <= 1.0) >= 0.95


def test_a_map_begins_where_odometry_does_and_keeps_its_frame_between_scans():
    slam = GridSlam(GmappingSettings.read(TB3), seed=1)
    ranges = np.full(len(ANGLES), 2.0)
    assert slam.update(0.0, (1.5, -0.5, 0.7), ranges, ANGLES, 3.5, LASER)
    assert slam.map_to_odom == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)
    before = slam.map_to_odom
    # Too little motion for a scan to be used: noise of particles that no scan has checked is kept inside.
    assert not slam.update(0.1, (1.6, -0.4, 0.8), ranges, ANGLES, 3.5, LASER)
    assert slam.map_to_odom == before


def maps(count=2):
    return TiledMaps(count, 4, 4, (-3.2, -3.2), 0.05)


def test_beams_free_what_they_pass_and_fill_where_they_end():
    tiles = maps()
    tiles.register(0, np.array([0.025, 0.025, 0.0]), np.array([[1.0, 0.0], [0.0, 5.0]]), 2.0)
    x, _, hits, visits = tiles.cells(0)
    assert np.argwhere(hits).tolist() == [[64, 84]]
    assert x[64, 84] == pytest.approx(1.025)
    assert visits[64, 64:85].tolist() == [2.0, *[1.0] * 20]
    # The other one was too long: it only freed.
    assert visits[64:104, 64].min() >= 1.0
    assert visits[105:, 64].max() == 0.0
    assert not tiles.cells(1)[3].any()


def test_particles_share_maps_until_one_writes():
    tiles = maps(3)
    for particle in range(3):
        heading = np.array([0.025, 0.025, particle * 1.5])
        tiles.register(particle, heading, np.array([[1.0, 0.0]]), 2.0)
    before = [tiles.cells(particle) for particle in range(3)]
    tiles.copy_particles(np.array([2, 2, 0]))
    assert np.array_equal(tiles.cells(0), before[2])
    assert np.array_equal(tiles.cells(1), before[2])
    assert np.array_equal(tiles.cells(2), before[0])
    tiles.register(0, np.array([0.025, 0.025, -1.0]), np.array([[1.0, 0.0]]), 2.0)
    assert not np.array_equal(tiles.cells(0), before[2])
    assert np.array_equal(tiles.cells(1), before[2])


def test_a_scan_is_moved_to_where_it_fits():
    tiles = maps()
    true = np.array([0.1, -0.2, 0.3])
    angles = np.radians(np.arange(0, 360, 3.0))
    cos, sin = np.cos(angles + 0.3), np.sin(angles + 0.3)
    far = np.minimum(
        np.where(
            np.abs(cos) > 1e-9,
            np.where(cos > 0, 1.5 - 0.1, 2.0 + 0.1) / np.maximum(np.abs(cos), 1e-9),
            99,
        ),
        np.where(
            np.abs(sin) > 1e-9,
            np.where(sin > 0, 1.0 + 0.2, 1.3 - 0.2) / np.maximum(np.abs(sin), 1e-9),
            99,
        ),
    )
    beams = np.stack((far * np.cos(angles), far * np.sin(angles)), 1)
    tiles.register(0, true, beams, 4.0)
    pose = true + np.array([0.07, -0.06, 0.05])
    score = ScanMatcher(tiles, 0.05, 0.075, 1).match(0, pose, beams, 0.05, 0.05, 5)
    assert pose == pytest.approx(true, abs=0.02)
    assert score > 0.95 * len(beams)


@pytest.mark.parametrize(
    "wrong", [{"delta": 0}, {"particles": 0}, {"xmin": 5, "xmax": 1}, {"sigma": "s"}]
)
def test_wrong_settings_are_named(wrong):
    with pytest.raises(Error):
        GmappingSettings.read(wrong)

"""Maps made while driving through simulated worlds agree with the true ones to a cell."""

import math

import numpy as np
import pytest
from mapping_drives import WORLD, Mapper, drive
from wall_errors import distances, drawn_walls, seen_walls

from gazelle.errors import Error
from gazelle.navigation.mapping import HectorSettings, HectorSlam, KartoSettings, KartoSlam
from gazelle.navigation.planners.planar import between, composed

ROOM = [(0.15, -1.4), (-2.2, -1.15), (-0.35, 1.35), (-0.1, 0.5), (1.8, -1.0), (0.15, -1.4)]


def check(world, start, goals, slip, least):
    mapper = Mapper(slip)
    true = drive(world, start, goals, mapper.take)
    found = mapper.slam.map()
    walls = seen_walls(true, mapper.ideal.map())
    assert len(walls) > least
    assert np.mean(distances(walls, found) <= 1.0) >= 0.95
    assert np.mean(distances(drawn_walls(found), true) <= 1.0) >= 0.95
    place, heading = np.array(mapper.errors).T
    assert place.mean() < 0.02
    assert heading.mean() < 0.005


@pytest.mark.long
def test_a_part_of_turtlebot3_world():
    check("turtlebot3_world", (-2.0, -0.5), WORLD[:3], 0.05, 150)


class Scans:
    """Keeps what a drive gives."""

    def __init__(self):
        self.kept = []

    def take(self, scan, odom, true):
        ranges = np.array(scan.ranges, np.float64).reshape(-1)
        self.kept.append((ranges, odom, true))
        self.angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))


LASER = (-0.032, 0.0, 0.0)


@pytest.fixture(scope="module")
def scans():
    found = Scans()
    drive("turtlebot3_world", (-2.0, -0.5), WORLD[:4], found.take)
    return found


@pytest.mark.long
def test_karto_mends_odometry_that_slips(scans):
    slam = KartoSlam(KartoSettings.read({"minimum_travel_distance": 0.12}))
    slip, errors = (0.02, 0.0, 0.01), []
    odom = last = scans.kept[0][1]
    for ranges, said, true in scans.kept:
        step = between(last, said)
        moved = math.hypot(step[0], step[1]) + abs(step[2])
        odom = composed(odom, tuple(a + moved * b for a, b in zip(step, slip, strict=True)))
        last = said
        if slam.update(odom, ranges, scans.angles, 3.5, LASER):
            errors.append(math.dist(composed(slam.map_to_odom, odom)[:2], true[:2]))
    assert math.dist(odom[:2], scans.kept[-1][2][:2]) > 0.1, "odometry is too good for a test"
    assert max(errors) < 0.05
    assert (slam.map().data == 100).sum() > 150


@pytest.mark.long
def test_hector_needs_no_odometry(scans):
    values = {
        "map_resolution": 0.05, "map_size": 256, "map_multi_res_levels": 2, "laser_min_dist": 0.12,
        "laser_max_dist": 3.5, "map_update_distance_thresh": 0.1, "map_update_angle_thresh": 0.04,
    }  # fmt: skip
    slam = HectorSlam(HectorSettings.read(values))
    start = scans.kept[0][2]
    for ranges, _, true in scans.kept:
        slam.update(ranges, scans.angles, LASER)
        assert math.dist(composed(start, slam.pose)[:2], true[:2]) < 0.06
    assert (slam.map().data == 100).sum() > 150
    slam.reset()
    assert (slam.map().data == -1).all()


@pytest.mark.parametrize(
    ("kind", "wrong"),
    [(HectorSettings, {"map_size": 0}), (HectorSettings, {"update_factor_free": 0.7}), (KartoSettings, {"resolution": 0})],
)  # fmt: skip
def test_maps_that_cannot_be_are_refused(kind, wrong):
    with pytest.raises(Error):
        kind.read(wrong)


@pytest.mark.slow
@pytest.mark.parametrize("slip", [0.0, 0.05])
def test_turtlebot3_world_with_wheels_that_slip(slip):
    check("turtlebot3_world", (-2.0, -0.5), WORLD, slip, 400)


@pytest.mark.slow
@pytest.mark.parametrize("slip", [0.0, 0.05])
def test_a_furnished_room(slip):
    check("furnished_room", (-0.5, 0.0), ROOM, slip, 300)

"""Fiducial and blob finders of Stage's robots."""

import math

import pytest
from stage_samples import draw, write

from gazelle import SimulationError
from gazelle.stage import Blob, StageSimulation

FINDER = 'position ( name "r" size [.2 .2 .2] fiducial ( {} ) )\n'
MARK = 'model ( name "m" size [.2 .2 1] fiducial_return 7 pose [2 1 0 90] {} )\n'


@pytest.fixture
def start(tmp_path):
    made = []

    def make(text):
        made.append(StageSimulation(write(tmp_path, text), threads=1))
        return made[-1]

    yield make
    for sim in made:
        sim.close()


def test_a_fiducial_is_told_with_where_it_is(start):
    (found,) = start(FINDER.format("") + MARK.format("")).fiducials("r")
    assert (found.name, found.id) == ("m", 7)
    assert found.distance == pytest.approx(math.hypot(2, 1))
    assert found.bearing == pytest.approx(math.atan2(1, 2))
    assert found.heading == pytest.approx(math.pi / 2)


@pytest.mark.parametrize(
    ("finder", "mark"),
    [
        ("range_max 2", ""),
        ("fov 40", ""),
        ("fiducial_key 1", ""),
        ("", "fiducial_return 0"),
        ("", "size [.2 .2 .1]"),
        ("", "noblocks 1"),
    ],
)
def test_what_a_finder_does_not_see(start, finder, mark):
    assert start(FINDER.format(finder) + MARK.format(mark)).fiducials("r") == []


def test_height_can_be_left_out(start):
    text = FINDER.format("ignore_zloc 1") + MARK.format("size [.2 .2 .1]")
    assert len(start(text).fiducials("r")) == 1


def test_leaving_out_height_does_not_look_through_walls(start):
    text = FINDER.format("ignore_zloc 1") + MARK.format("size [.2 .2 .1]")
    low, high = (f"model ( size [.1 .9 {z}] pose [1 .5 0 27] )" for z in (0.1, 1.0))
    behind = "model ( size [.1 .9 1] pose [4 2 0 27] )"
    assert len(start(text + low + behind).fiducials("r")) == 1
    assert start(text + high).fiducials("r") == []


def test_one_may_be_nearer_than_range_min_as_in_stage(start):
    assert len(start(FINDER.format("range_min 3") + MARK.format("")).fiducials("r")) == 1


def test_one_that_is_far_cannot_be_read(start):
    (found,) = start(FINDER.format("range_max_id 1") + MARK.format("")).fiducials("r")
    assert found.id == 0


def test_what_stands_before_it_hides_it(start, tmp_path):
    draw(tmp_path, ["#"])
    hidden = FINDER.format("") + MARK.format("")
    for wall in (
        "model ( size [.1 2 1] pose [1 0 0 0] )",
        'model ( size [.1 2 1] pose [1 0 0 0] bitmap "map.png" )',
        "position ( size [.1 2 1] pose [1 0 0 0] )",
    ):
        assert start(hidden + wall).fiducials("r") == []


def test_robots_see_each_other_where_they_are_now_but_not_themselves(start):
    sim = start(
        "define robot position ( size [.2 .2 .5] fiducial_return 3 fiducial ( ) )"
        'robot ( name "a" ) robot ( name "b" pose [2 0 0 180] )'
    )
    (found,) = sim.fiducials("a")
    assert (found.name, found.id) == ("b", 3)
    assert abs(found.heading) == pytest.approx(math.pi)
    sim.set_pose("b", (0.0, 3.0, 0.0))
    sim.set_pose("a", (0.0, 0.0, math.pi / 2))
    (found,) = sim.fiducials("a")
    assert (found.distance, found.bearing) == pytest.approx((3.0, 0.0))
    sim.set_pose("b", (-3.0, -3.0, 0.0))
    assert sim.fiducials("a") == []


BALLS = """
position ( name "r" size [.2 .2 .2] blobfinder ( image [100 60] fov 60 range 5 {} ) )
model ( size [.5 .5 1] pose [3 1 0 0] color "green" )
model ( size [.5 .5 1] pose [3 -1 0 0] color "blue" )
model ( size [.5 .5 1] pose [3 0 0 0] color "yellow" blob_return 0 )
model ( size [.5 .5 1] pose [9 0 0 0] color "red" )
"""
GREEN, BLUE = (0.0, 1.0, 0.0, 1.0), (0.0, 0.0, 1.0, 1.0)


def test_blobs_are_found_from_left_to_right(start):
    left, right = start(BALLS.format("")).blobs("r")
    assert (left.color, right.color) == (GREEN, BLUE)
    assert left.left < left.right < right.left < right.right
    assert left.left == 99 - right.right
    assert math.hypot(2.75, 0.75) < left.distance < math.hypot(3.25, 0.75)


def test_only_wanted_colours_are_found(start):
    (found,) = start(BALLS.format('colors_count 1 colors ["blue"]')).blobs("r")
    assert found.color == BLUE


def test_blobs_can_be_looked_for_aside(start):
    sim = start(BALLS.format("pan 90"))
    assert sim.blobs("r") == []
    sim.set_pose("r", (0.0, 0.0, -math.pi / 2))
    assert len(sim.blobs("r")) == 2


def test_a_blob_is_the_size_that_it_looks(start):
    sim = start(
        'position ( name "r" size [.2 .2 .2] blobfinder ( image [90 60] fov 90 ) )'
        'model ( size [.1 2 1] pose [1.05 0 0 0] color "green" )'
    )
    sides = [math.radians(45 - 90 * column / 89) for column in range(90)]
    mean = sum(1.0 / math.cos(side) for side in sides) / 90
    assert sim.blobs("r") == [Blob(GREEN, 0, 89, pytest.approx(mean, abs=1e-3))]


def test_blobs_are_seen_at_any_height(start):
    sim = start(
        'position ( name "r" size [.2 .2 1] blobfinder ( image [90 60] fov 40 ) )'
        'model ( size [.1 2 .1] pose [1.05 0 0 0] color "green" )'
    )
    assert [(b.left, b.right) for b in sim.blobs("r")] == [(0, 89)]


def test_a_robot_without_a_finder_says_so(start):
    sim = start('position ( name "r" )')
    with pytest.raises(SimulationError, match="has 0 StageFiducial"):
        sim.fiducials("r")
    with pytest.raises(SimulationError, match="has 0 StageBlobfinder"):
        sim.blobs("r")

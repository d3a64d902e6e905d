"""Bumpers, fiducials and blobs on the graph."""

import math

import pytest

BUMPER, FIDUCIALS, BLOBS = (f"gazelle_msgs/{kind}" for kind in ("Bumper", "Fiducials", "Blobs"))
STRIPS = "bumper ( noblocks 1 bcount 2 blength .4 bpose[0] [.2 0 0 0] bpose[1] [-.2 0 0 180] )"
ROBOT = f"robot ( {STRIPS} fiducial ( ) blobfinder ( ) )\n"
WALL = 'model ( name "w" size [1 4 2] pose [.71 0 0 0] color "red" fiducial_return 7 )\n'


def test_a_bumper_tells_what_each_strip_touches(stage):
    world = stage(ROBOT + WALL)
    message = world.step(world.listen("/bumper", BUMPER))
    assert message.touched == ["w", ""]
    assert message.header.frame_id == "base_link"
    assert message.header.stamp.nsecs == 100_000_000


def test_fiducials(stage):
    world = stage(ROBOT + WALL)
    (seen,) = world.step(world.listen("/fiducials", FIDUCIALS)).fiducials
    assert (seen.name, seen.id) == ("w", 7)
    assert seen.range == pytest.approx(0.71)


def test_blobs(stage):
    world = stage(ROBOT + WALL)
    message = world.step(world.listen("/blobs", BLOBS))
    (blob,) = message.blobs
    assert (message.width, blob.left, blob.right) == (80, 0, 79)
    assert (blob.color.r, blob.color.g, blob.color.b) == (1.0, 0.0, 0.0)
    sides = [math.radians(30 - 60 * column / 79) for column in range(80)]
    mean = sum(0.21 / math.cos(side) for side in sides) / 80
    assert blob.range == pytest.approx(mean, abs=1e-3)


def test_names_of_several(stage):
    topics = stage(f"robot ( {STRIPS} {STRIPS} )\n" + ROBOT).topics()
    assert {"/robot_0/bumper_0", "/robot_0/bumper_1", "/robot_1/bumper"} <= topics.keys()
    assert topics["/robot_1/blobs"] == BLOBS
    assert "/robot_0/blobs" not in topics

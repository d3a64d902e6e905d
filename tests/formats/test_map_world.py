"""Maps of map_server are worlds: a wall on each occupied cell, in the frame of the map."""

import math

import numpy as np
import pytest
from PIL import Image

import gazelle
from gazelle.description import Box, OccupancyMap, Pose
from gazelle.errors import FormatError
from gazelle.formats import map_world as maps
from gazelle.formats.map_world import map_world

YAML = "image: room.pgm\nresolution: {}\norigin: {}\nnegate: {}\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
PLAN = [
    "##########",
    "#........#",
    "#..##..?.#",
    "#........#",
    "##########",
]
SHADES = {"#": 0, ".": 254, "?": 205}


def write(folder, resolution=0.5, origin="[-2.0, -1.0, 0.0]", negate=0):
    pixels = np.array([[SHADES[mark] for mark in row] for row in PLAN], np.uint8)
    Image.fromarray(255 - pixels if negate else pixels).save(folder / "room.pgm")
    file = folder / "room.yaml"
    file.write_text(YAML.format(resolution, origin, negate))
    return file


def covered(world, x, y):
    """Return whether a point is in a wall."""
    (walls,) = [model for model in world.models if model.name == "walls"]
    for collision in walls.links[0].collisions:
        assert isinstance(collision.geometry, Box)
        px, py, _ = (walls.pose * collision.pose).inverse().apply((x, y, 0.5))
        w, d, _ = collision.geometry.size
        if abs(px) <= w / 2 and abs(py) <= d / 2:
            return True
    return False


@pytest.mark.parametrize("negate", [0, 1])
def test_walls_are_where_cells_are_occupied(tmp_path, negate):
    world = gazelle.load(write(tmp_path, negate=negate))
    assert world.name == "room"
    for row, marks in enumerate(reversed(PLAN)):  # the last row of the picture is the lowest
        for column, mark in enumerate(marks):
            x, y = -2.0 + 0.5 * (column + 0.5), -1.0 + 0.5 * (row + 0.5)
            assert covered(world, x, y) == (mark == "#")


def test_the_origin_turns_the_map(tmp_path):
    world = gazelle.load(write(tmp_path, origin=f"[1.0, 2.0, {math.pi / 2}]"))
    assert covered(world, 1.0 - 0.25, 2.0 + 0.25)
    assert not covered(world, 1.0 - 0.75, 2.0 + 0.75)
    assert not covered(world, 1.0 + 0.25, 2.0 + 0.25)


@pytest.mark.parametrize("engine", ["planar", "mujoco"])
def test_a_robot_sees_the_walls(tmp_path, engine):
    file = write(tmp_path)
    with gazelle.Simulation(file, engine) as sim:
        robot = sim.spawn("turtlebot3_burger", pose=gazelle.Pose(x=-1.0, y=0.25))
        sim.run(0.3)
        lidar = next(s for s in robot.sensors.values() if s.description.lidar is not None)
        ranges = lidar.measure()[0]
    # The lidar is 32 mm behind the robot's middle, and measures with noise.
    assert ranges[0] == pytest.approx(0.5 + 0.032, abs=0.05)
    assert ranges[180] == pytest.approx(0.5 - 0.032, abs=0.05)


def test_a_map_with_too_many_walls_is_refused(monkeypatch):
    monkeypatch.setattr(maps, "MAX_BOXES", 10)
    checks = (np.indices((9, 9)).sum(axis=0) % 2 * 100).astype(np.int8)
    with pytest.raises(FormatError, match="40 boxes"):
        map_world(OccupancyMap(checks, 0.1, Pose(), "checks"))


def test_a_map_that_is_broken_names_its_line(tmp_path):
    file = write(tmp_path)
    file.write_text(file.read_text().replace("0.5\n", "wide\n"))
    with pytest.raises(FormatError, match=r"room\.yaml:2: .*expected a number"):
        gazelle.load(file)

"""A robot on wheels drives through a door that is a hole in a mesh, and not through the frame."""

import numpy as np
import pytest
import scenes
import trimesh

from gazelle import Simulation
from gazelle.description import Mesh, Pose


@pytest.fixture(autouse=True)
def _own_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))


def wall_with_a_door(width=3.0, height=1.0, thick=0.1, door=0.5, top=0.6):
    """Return one closed mesh with a door at y = 0, cut out down to the floor."""
    left, right = -width / 2.0, width / 2.0
    rim = [(left, 0), (-door / 2, 0), (-door / 2, top), (door / 2, top)]
    rim += [(door / 2, 0), (right, 0), (right, height), (left, height)]
    points = [(x, y, z) for x in (-thick / 2, thick / 2) for y, z in rim]
    flat = [(0, 1, 2), (0, 2, 7), (2, 3, 6), (2, 6, 7), (3, 4, 5), (3, 5, 6)]
    faces = [(c, b, a) for a, b, c in flat] + [(a + 8, b + 8, c + 8) for a, b, c in flat]
    for i in range(8):
        j = (i + 1) % 8
        faces += [(i, j, j + 8), (i, j + 8, i + 8)]
    mesh = trimesh.Trimesh(points, faces)
    assert mesh.is_watertight
    assert mesh.volume == pytest.approx(thick * (width * height - door * top))
    return mesh


@pytest.mark.parametrize("static", [True, False], ids=["static", "heavy"])
@pytest.mark.parametrize(
    ("y", "passes"), [(0.0, True), (0.1, True), (-0.1, True), (0.4, False), (-0.8, False)]
)
def test_a_burger_drives_through_the_door_and_not_through_the_wall(tmp_path, y, passes, static):
    wall_with_a_door().export(tmp_path / "wall.stl")
    shape = Mesh("wall.stl", tmp_path / "wall.stl")
    wall = scenes.solid(
        "wall", shape, static=static, mass=2000.0, moments=(1000.0, 300.0, 1200.0),
        pose=Pose(x=1.0),
    )  # fmt: skip
    with Simulation(scenes.world(scenes.ground(), wall)) as sim:
        robot = sim.spawn("turtlebot3_burger", name="burger", pose=Pose(x=0.3, y=y))
        robot.inputs["cmd_vel"].send(linear=0.22, angular=0.0)
        sim.run(seconds=7.0)
        x = robot.pose.x
        if passes:
            assert x > 1.4  # 0.3 + 7 s of 0.22 m/s, but for the start
        else:
            assert 0.75 < x < 0.95 + 0.02  # its front is at the wall's face, at 0.95
        assert robot.pose.z == pytest.approx(0.0, abs=0.02)
        assert np.isfinite(x)

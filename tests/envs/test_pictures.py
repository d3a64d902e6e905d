"""Marks land where the camera sees the place."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.description import Box, Link, Model, Plane, Pose, Visual, World
from gazelle.envs.pictures import ground_points, mark_square
from gazelle.sensors import View, look_at
from gazelle.simulation import Simulation
from gazelle.simulation.scene_renderer import SceneRenderer


@given(st.floats(-3, 3), st.floats(-3, 3), st.floats(1, 9))
def test_the_middle_of_the_picture_sees_what_is_looked_at(x, y, height):
    view = View(look_at((0.0, 0.5, height), (x, y + 1e-6, 0.0)), width=41, height=31)
    assert ground_points(view)[0][15, 20].tolist() == pytest.approx([x, y], abs=1e-5)


def test_there_is_no_ground_above_the_horizon():
    view = View(Pose(z=1.0), width=4, height=4)
    points, away = ground_points(view)
    assert np.isnan(points[:2]).all()
    assert np.isnan(away[:2]).all()
    assert np.hypot(*points[2, 0]) ** 2 + 1.0 == pytest.approx(away[2, 0] ** 2)
    assert (points[2:, :, 0] > 0).all()
    assert (points[2:, 0, 1] > points[2:, 3, 1]).all()


def test_only_the_square_is_tinted():
    view = View(look_at((0.0, 0.0, 5.0), (1e-6, 0.0, 0.0)), width=100, height=100)
    black = np.zeros((100, 100, 3), dtype=np.uint8)
    marked = mark_square(black, view, np.full((100, 100), np.inf), (0.0, 0.0), 1.0)
    metre = 100 / (2 * 5 * np.tan(1.047 / 2))
    assert (marked[..., 0] > 0).sum() == pytest.approx(metre**2, rel=0.15)
    assert not black.any()


def still(name, shape, pose):
    link = Link("link", visuals=(Visual("visual", shape),))
    return Model(name, pose=pose, static=True, links=(link,))


def test_what_stands_before_the_square_or_on_it_hides_it():
    """A box on one half of the square, and a wall before another square."""
    view = View(look_at((-3.0, 0.0, 3.0), (0.0, 0.0, 0.0)), width=240, height=180, samples=1)
    wall = still("wall", Box((0.1, 4.0, 1.0)), Pose(1.0, 0.0, 0.5))
    box = still("box", Box((0.5, 0.5, 0.02)), Pose(0.0, 0.25, 0.01))
    ground = still("ground", Plane(), Pose())
    with Simulation(World(models=(ground, wall, box))) as simulation:
        renderer = SceneRenderer()
        picture = renderer.picture(simulation, view, 0)
        ranges = renderer.ranges(simulation, view, 0)
    places, _ = ground_points(view)

    def tinted(x, y):
        marked = mark_square(picture, view, ranges, (x, y), 0.5)
        return np.abs(marked.astype(int) - picture).any(axis=2), np.abs(places - (x, y)).max(axis=2)

    found, off = tinted(0.0, 0.0)
    free = (off < 0.24) & (places[..., 1] < -0.03)
    hidden = (off < 0.24) & (places[..., 1] > 0.03)
    assert free.sum() > 50
    assert found[free].all()
    assert not found[hidden].any()
    assert not tinted(1.4, 0.0)[0].any()
    assert tinted(4.0, 0.0)[0].any()

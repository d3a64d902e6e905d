"""Terrain is where it says, and carries what stands on it."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import gazelle
from gazelle.builders import BuildError, Disc, hills, sphere, terrain
from gazelle.description import Pose, World
from gazelle.engines.tracer import make_tracer


def seen_from_above(model, points):
    """Return heights [m] at points, by rays from above."""
    tracer = make_tracer(World(models=(model,)))
    origins = np.array([(x, y, 50.0) for x, y in points])
    down = np.tile((0.0, 0.0, -1.0), (len(points), 1))
    return 50.0 - tracer.trace(origins, down).distance


@settings(max_examples=20, deadline=None)
@given(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5), st.integers(0, 1000))
def test_a_slope_is_met_where_it_is(a, b, seed):
    x, y = np.meshgrid(np.arange(5.0) - 2.0, np.arange(4.0) - 1.5)
    land = terrain(a * x + b * y, cell=1.0)
    points = np.random.default_rng(seed).uniform((-1.9, -1.4), (1.9, 1.4), (20, 2))
    expected = points @ (a, b)
    assert seen_from_above(land.model(), points) == pytest.approx(expected, abs=1e-6)
    assert [land.height(*p) for p in points] == pytest.approx(expected, abs=1e-9)


def test_hills_are_met_within_a_quarter_of_their_twist():
    land = hills(3, length=20.0, width=16.0, cell=1.0, height=3.0, spacing=8.0)
    h = land.heights
    twist = float(np.abs(h[1:, 1:] + h[:-1, :-1] - h[1:, :-1] - h[:-1, 1:]).max())
    points = np.random.default_rng(0).uniform((-9.9, -7.9), (9.9, 7.9), (400, 2))
    seen = seen_from_above(land.model(), points)
    said = np.array([land.height(*p) for p in points])
    assert twist > 0.01
    assert np.abs(seen - said).max() < 0.5 * twist + 0.02


def test_a_seed_decides_and_flat_is_flat():
    assert (hills(1).heights == hills(1).heights).all()
    assert (hills(1).heights != hills(2).heights).any()
    land = hills(1, height=4.0, flat=[Disc(0.0, 0.0, 6.0)])
    assert land.height(0.0, 0.0) == 0.0
    assert land.height(-1.9, 1.9) == 0.0
    assert 1.0 < land.heights.max() <= 4.0
    assert land.heights.min() >= 0.0


def test_heights_have_their_corners():
    land = terrain([[0.0, 0.0], [1.0, 1.0]], cell=2.0)
    assert land.size == (2.0, 2.0)
    assert land.height(0.0, -1.0) == pytest.approx(0.0)
    assert land.height(0.0, 1.0) == pytest.approx(1.0)
    assert land.height(0.0, 9.0) == pytest.approx(1.0)


def test_flat_cells_can_be_left_out():
    land = terrain([[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]])
    assert len(land.model(above=0.0).links[0].collisions) == 2
    with pytest.raises(BuildError, match="no cell"):
        land.model(above=2.0)


def test_a_ball_lies_in_a_hollow():
    x, y = np.meshgrid(np.arange(9.0) - 4.0, np.arange(9.0) - 4.0)
    land = terrain(0.05 * (x * x + y * y), cell=1.0)
    ball = sphere("ball", 0.2, mass=1.0, pose=Pose(1.5, 0.5, land.height(1.5, 0.5) + 0.05))
    with gazelle.Simulation(World(models=(land.model(), ball))) as sim:
        sim.run(2.0)
        pose = sim.robots["ball"].pose
    assert abs(pose.x) < 2.0
    assert pose.z > -0.01


@pytest.mark.parametrize(
    "heights", [[1.0, 2.0], [[1.0]], [[0.0, np.nan], [0.0, 0.0]], np.zeros((200, 200))]
)
def test_impossible_heights_are_refused(heights):
    with pytest.raises(BuildError):
        terrain(heights)


def test_impossible_hills_are_refused():
    with pytest.raises(BuildError, match="spacing"):
        hills(spacing=0.0)
    with pytest.raises(BuildError, match="too many"):
        hills(cell=0.01)

"""Overlays of the page: what they draw, and that a browser shows it."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

pytest.importorskip("viser", reason="the extra 'web' is not installed")

from gazelle.description import Camera, Lidar, Scan
from gazelle.rotations import rotate
from gazelle.simulation import Simulation
from gazelle.viewer import LiveView
from gazelle.viewer.page.frustum_layer import camera_outline, lidar_outline
from gazelle.viewer.page.mass_layers import boxes_of_equal_inertia
from tests.ros.graph import until
from tests.viewer.browser import opened, pixels
from tests.viewer.lamp_world import LAMP_WORLD

LENGTHS = st.floats(0.01, 10.0)
TURNS = st.tuples(*[st.floats(-1.0, 1.0)] * 4).filter(lambda q: np.linalg.norm(q) > 0.1)


@given(st.tuples(LENGTHS, LENGTHS, LENGTHS), st.floats(0.01, 100.0), TURNS)
def test_the_box_of_an_inertia_has_that_inertia(size, mass, turn):
    turn = np.array(turn) / np.linalg.norm(turn)
    axes = rotate(turn[None], np.eye(3)).T
    squares = np.square(size)
    moments = mass * (squares.sum() - squares) / 12.0
    matrix = axes @ np.diag(moments) @ axes.T
    row = matrix[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    found, turned = boxes_of_equal_inertia(np.array([mass]), row[None])
    assert np.sort(found[0]) == pytest.approx(np.sort(size), rel=1e-3, abs=1e-3)
    again = rotate(turned, np.eye(3)).T
    squares = np.square(found[0])
    own = again @ np.diag(mass * (squares.sum() - squares) / 12.0) @ again.T
    assert own == pytest.approx(matrix, rel=1e-6, abs=1e-6 * moments.max())


def test_a_frustum_ends_at_the_edges_of_the_picture():
    camera = Camera(horizontal_fov=np.pi / 2.0, width=200, height=100, near=1.0, far=2.0)
    points = camera_outline(camera).reshape(-1, 3)
    assert set(points[:, 0]) == {1.0, 2.0}
    assert np.abs(points[:, 1]) == pytest.approx(points[:, 0])
    assert np.abs(points[:, 2]) == pytest.approx(points[:, 0] / 2.0)


def test_a_sector_lies_between_the_ranges_of_a_lidar():
    lidar = Lidar(Scan(samples=9, min_angle=-1.0, max_angle=1.0), range_min=0.5, range_max=3.0)
    points = lidar_outline(lidar).reshape(-1, 3)
    away = np.linalg.norm(points, axis=1)
    assert (np.isclose(away, 0.5) | np.isclose(away, 3.0)).all()
    angles = np.arctan2(points[:, 1], points[:, 0])
    assert (angles.min(), angles.max()) == (pytest.approx(-1.0), pytest.approx(1.0))


@pytest.fixture(scope="module")
def shown(tmp_path_factory):
    """Yield the open page of a simulation that stands, with things in contact."""
    file = tmp_path_factory.mktemp("worlds") / "room.world"
    file.write_text(LAMP_WORLD)
    with Simulation(file, threads=1) as simulation:
        simulation.run(0.1)
        with LiveView(simulation) as view, opened(view.url, (1300, 800)) as page:
            page.get_by_label("Shadows").click()
            until(lambda: count(page, RED) > 100)
            yield page


RED = lambda r, g, b: (r > 90) & (r > 2 * g) & (r > 2 * b)  # noqa: E731
COLORS = {
    "Names": lambda r, g, b: (r < 70) & (g < 70) & (b < 70),
    "Frames": lambda r, g, b: (b > 150) & (r < 90) & (g < 110),
    "Joint axes": lambda r, g, b: (r > b + 40) & (g > b + 30),
    "Masses": lambda r, g, b: (g > r + 50) & (g > b),
    "Inertias": lambda r, g, b: (b > g + 25) & (r > g + 10) & (b > r),
    "Contacts": lambda r, g, b: (b > r + 80) & (b > g + 50),
    "Forces": lambda r, g, b: (r > g + 80) & (abs(g - b) < 12) & (g > 30),
    "Lights": lambda r, g, b: (r > b + 90) & (g > b + 60),
    "Lidar rays": lambda r, g, b: (b > r + 60) & (g > r + 25),
    "Frusta": lambda r, g, b: (g > r + 60) & (b > r + 60),
    "Collisions": lambda r, g, b: (r > g + 40) & (g > b + 25),
}


def count(page, color):
    picture = pixels(page)
    r, g, b = (picture[:, picture.any(axis=(0, 2)), k] for k in range(3))
    return int(color(r, g, b).sum())


@pytest.mark.long
@pytest.mark.parametrize("label", COLORS)
def test_an_overlay_is_seen_and_goes(shown, label):
    before = count(shown, COLORS[label])
    shown.get_by_label(label, exact=True).click()
    until(lambda: count(shown, COLORS[label]) > before + 15)
    shown.get_by_label(label, exact=True).click()
    until(lambda: abs(count(shown, COLORS[label]) - before) < 12 + 0.02 * before)


@pytest.mark.long
@pytest.mark.parametrize("look", ["transparent", "wireframe"])
def test_surfaces_are_seen_through(shown, look):
    full = count(shown, RED)
    choose(shown, look)
    until(lambda: count(shown, RED) < 0.5 * full)
    choose(shown, "solid")
    until(lambda: abs(count(shown, RED) - full) < 0.05 * full)


def choose(page, look):
    page.get_by_label("Surfaces").click()
    page.get_by_role("option", name=look, exact=True).click()

"""Directions to look from, the grid, pictures and films, in a real browser."""

import io
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

pytest.importorskip("viser", reason="the extra 'web' is not installed")

from gazelle.simulation import Simulation
from gazelle.viewer import LiveView
from tests.ros.graph import until
from tests.viewer.browser import opened, pixels
from tests.viewer.lamp_world import LAMP_WORLD

pytestmark = pytest.mark.long


@pytest.fixture(scope="module")
def shown(tmp_path_factory):
    """Yield the view and the open page of a simulation that stands."""
    file = tmp_path_factory.mktemp("worlds") / "room.world"
    file.write_text(LAMP_WORLD)
    with (
        Simulation(file, threads=1) as simulation,
        LiveView(simulation) as view,
        opened(view.url, (1300, 800)) as page,
    ):
        until(lambda: red(pixels(page)).sum() > 100)
        yield view, page


def red(picture):
    return (picture[..., 0] > 90) & (picture[..., 0] > 2 * picture[..., 1])


def extent(picture):
    """Return width and height of what is red, and its share of the box around it."""
    rows, columns = np.nonzero(red(picture))
    size = np.ptp(columns) + 1, np.ptp(rows) + 1
    return size, len(rows) / (size[0] * size[1])


@pytest.mark.parametrize(
    ("name", "along"), [("top", (0, 0, 1)), ("front", (1, 0, 0)), ("side", (0, -1, 0))]
)
def test_a_box_is_seen_along_an_axis(shown, name, along):
    """As a square, but for the lamp before it, and the depth of its sides."""
    view, page = shown
    page.get_by_role("button", name="all", exact=True).click()
    until(lambda: extent(pixels(page))[1] < 0.85)
    page.get_by_role("button", name=name, exact=True).click()

    def square():
        (width, height), share = extent(pixels(page))
        return abs(width - height) < 0.25 * height and share > 0.85

    until(square)
    (client,) = view._server.viser.get_clients().values()
    eye = client.camera.position - client.camera.look_at
    assert eye / np.linalg.norm(eye) == pytest.approx(np.array(along, float), abs=0.01)


def test_a_grid_is_drawn_with_its_scale(shown):
    _, page = shown
    page.get_by_role("button", name="all", exact=True).click()
    until(lambda: extent(pixels(page))[1] < 0.85)
    page.get_by_label("Grid", exact=True).click()
    until(lambda: grey(pixels(page)) > 300)
    page.get_by_label("Grid", exact=True).click()
    until(lambda: grey(pixels(page)) < 100)


def grey(picture):
    """Return how many pixels beyond the ground have the colour of lines."""
    dark = (np.ptp(picture, axis=2) < 10) & (picture[..., 0] < 190) & (picture[..., 0] > 20)
    return int(dark[-150:].sum())


def test_a_picture_is_saved(shown):
    _, page = shown
    with page.expect_download() as download:
        page.get_by_role("button", name="picture", exact=True).click()
    assert download.value.suggested_filename == "gazelle.png"
    data = Path(download.value.path()).read_bytes()
    assert red(np.asarray(Image.open(io.BytesIO(data)).convert("RGB"), np.int16)).sum() > 100


def test_a_film_is_saved(shown):
    view, page = shown
    page.get_by_role("button", name="film", exact=True).click()
    stop = page.get_by_role("button", name="stop", exact=True)
    box = view._simulation.robots["box"]

    def filmed():
        """Move the box, as a film has pictures of what changes only."""
        box.set_pose((0.2 * np.random.default_rng().random(), 0.0, 0.5))
        page.wait_for_timeout(50)
        return page.evaluate("document.getElementById('gazelle-saving').size") > 1000

    until(filmed)
    with page.expect_download() as download:
        stop.click()
    assert download.value.suggested_filename == "gazelle.webm"
    data = Path(download.value.path()).read_bytes()
    assert data[:4] == b"\x1a\x45\xdf\xa3"  # of Matroska
    assert len(data) > 1000
    page.get_by_role("button", name="film", exact=True).wait_for()

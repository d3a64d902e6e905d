"""Cameras, joints, pushes, speed and copies of a world on the page, in a real browser."""

import numpy as np
import pytest

pytest.importorskip("viser", reason="the extra 'web' is not installed")

from gazelle.simulation import Simulation
from gazelle.viewer import LiveView
from tests.ros.graph import until
from tests.viewer.browser import opened, pixels
from tests.viewer.lamp_world import LAMP_WORLD

pytestmark = pytest.mark.long


@pytest.fixture(scope="module")
def shown(tmp_path_factory):
    """Yield four worlds that stand, their view, and the open page."""
    file = tmp_path_factory.mktemp("worlds") / "room.world"
    file.write_text(LAMP_WORLD)
    with (
        Simulation(file, nworld=4, threads=1) as simulation,
        LiveView(simulation) as view,
        opened(view.url, (1300, 800)) as page,
    ):
        page.get_by_label("Shadows").click()
        page.get_by_role("button", name="top", exact=True).click()
        until(lambda: len(boxes(page)) == 4)
        yield simulation, view, page


def boxes(page):
    """Return the middles of connected red areas [pixel]: rows of x and y."""
    from scipy.ndimage import center_of_mass, label

    picture = pixels(page)
    red = (picture[..., 0] > 90) & (picture[..., 0] > 2 * picture[..., 1])
    areas, count = label(red)
    large = [k for k in range(1, count + 1) if (areas == k).sum() > 100]
    return np.array([center_of_mass(areas == k)[::-1] for k in large])


def select(page, model):
    page.locator(f'[data-kind="model"][data-name="{model}"]').click()
    page.locator(f'[data-name="{model}"][aria-selected=true]').wait_for()


def test_each_copy_of_a_world_is_changed_by_itself(shown):
    simulation, _, page = shown
    middles = boxes(page)
    right = middles[np.argmax(middles[:, 0] - middles[:, 1])]  # right of those in the upper row
    page.mouse.click(*right)
    page.locator('[data-name="box"][aria-selected=true]').wait_for()
    page.get_by_label("Gizmo").click()
    page.get_by_role("button", name="lift", exact=True).click()
    until(lambda: simulation.robots["box"].position[:, 2].max() > 0.9)
    assert simulation.robots["box"].position[:, 2] == pytest.approx([0.5, 1.0, 0.5, 0.5])
    page.get_by_role("button", name="reset", exact=True).click()
    until(lambda: simulation.robots["box"].position[:, 2].max() < 0.6)


def test_a_joint_follows_its_slider(shown):
    simulation, _, page = shown
    select(page, "lamp")
    page.get_by_text("Joints", exact=True).click()
    slider = page.get_by_role("slider").first
    slider.focus()
    slider.press("End")
    hinge = simulation.robots["lamp"].joints["hinge"]
    until(lambda: hinge.positions().max() == pytest.approx(1.0, abs=0.01))
    assert (np.abs(hinge.positions()[:, 0]) > 0.5).sum() == 1  # in the selected world
    simulation.reset()


def test_a_camera_is_shown(shown):
    _, _, page = shown
    images = page.locator("img[src^='blob:'], img[src^='data:image']")
    before = images.count()
    page.get_by_label("Cameras", exact=True).click()
    until(lambda: images.count() > before)
    page.get_by_label("Cameras", exact=True).click()
    until(lambda: images.count() == before)


def test_the_speed_is_chosen(shown):
    simulation, _, page = shown
    page.get_by_role("combobox", name="Speed").or_(
        page.get_by_role("textbox", name="Speed")
    ).first.click()
    page.get_by_role("option", name="2", exact=True).click()
    until(lambda: simulation.physics.target_rate == pytest.approx(2.0))

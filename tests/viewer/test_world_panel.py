"""The tree of a world, the properties of its parts and the selection, in a real browser."""

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
    """Yield a simulation that stands, its view, and the open page."""
    file = tmp_path_factory.mktemp("worlds") / "room.world"
    file.write_text(LAMP_WORLD)
    with (
        Simulation(file, threads=1) as simulation,
        LiveView(simulation) as view,
        opened(view.url, (1200, 700)) as page,
    ):
        until(lambda: red(pixels(page)).any())
        page.get_by_label("Gizmo").click()
        yield simulation, view, page


def red(picture):
    """Return a mask of the red box."""
    return (picture[..., 0] > 90) & (picture[..., 0] > 2 * picture[..., 1])


def orange(picture):
    """Return a mask of the edges around a selection."""
    return (picture[..., 0] > 200) & (abs(picture[..., 1] - 140) < 50) & (picture[..., 2] < 80)


def resting(page):
    """Return the picture once the camera rests."""
    picture, before = pixels(page), None
    while before is None or (picture != before).any():
        picture, before = pixels(page), picture
    return picture


def row(page, kind, name):
    return page.locator(f'[data-kind="{kind}"][data-name="{name}"]')


def selected(page):
    return page.locator("#gazelle-tree [aria-selected=true]").get_attribute("data-name")


def enter(page, label, text):
    """Write a value into a field as a user does; returns the field."""
    field = page.get_by_label(label, exact=True)
    field.click(click_count=3)
    page.keyboard.type(text)
    field.press("Enter")
    return field


def test_a_click_in_the_tree_selects_in_the_scene(shown):
    _, view, page = shown
    assert not orange(pixels(page)).any()
    row(page, "model", "box").click()
    until(lambda: orange(pixels(page)).sum() > 50)
    assert view._context.selected == "box"
    picture = pixels(page)
    rows, columns = np.nonzero(orange(picture))
    inside_rows, inside_columns = np.nonzero(red(picture) & ~orange(picture))
    assert rows.min() <= inside_rows.min() + 3
    assert rows.max() >= inside_rows.max() - 3
    assert columns.min() <= inside_columns.min() + 3
    row(page, "world", "room").click()
    until(lambda: not orange(pixels(page)).any())


def test_a_model_is_followed(shown):
    simulation, view, page = shown
    row(page, "model", "box").click()
    page.get_by_label("Follow", exact=True).click()

    def middle():
        return np.argwhere(red(pixels(page))).mean(axis=0)

    until(lambda: np.any(view._context.heading))
    before = middle()
    simulation.robots["box"].set_pose((8.0, -5.0, 0.5))
    until(lambda: view._context.heading[0] == 8.0 and np.abs(middle() - before).max() < 4.0)
    simulation.robots["box"].set_pose((0.0, 0.0, 0.5))
    page.get_by_label("Follow", exact=True).click()
    until(lambda: not np.any(view._context.heading))


def test_a_click_in_the_scene_selects_in_the_tree(shown):
    _, _, page = shown
    rows, columns = np.nonzero(red(resting(page)))
    x, y = float(columns.mean()), float(rows.mean())
    page.mouse.click(x, y)
    until(lambda: selected(page) == "box")
    page.mouse.click(x, y)
    until(lambda: selected(page) == "box::l")
    assert row(page, "collision", "box::l::c").is_visible()


def test_all_kinds_of_parts_have_rows_and_properties(shown):
    _, _, page = shown
    row(page, "model", "lamp").click()
    for kind, name, text in (
        ("link", "lamp::arm", "Position [m]"),
        ("joint", "lamp::hinge", "revolute"),
        ("sensor", "lamp::arm::scan", "0.1 to 1.5 m"),
        ("sensor", "lamp::arm::eye", "64 x 48"),
        ("light", "bulb", "point"),
        ("world", "room", "mujoco"),
    ):
        row(page, kind, name).click()
        until(lambda text=text: text in page.locator("#gazelle-facts").inner_text())
        if kind == "sensor":
            assert row(page, "model", "lamp").is_visible()
        if kind == "light":
            row(page, "model", "lamp").wait_for()


@pytest.mark.parametrize(
    ("model", "kind", "name", "label", "value", "read"),
    [
        ("box", "link", "box::l", "Mass [kg]", 5.0, lambda sim: sim.parameters.link_mass["box::l"][0]),
        ("box", "collision", "box::l::c", "Friction", 0.25,
         lambda sim: sim.parameters.friction["box::l::c"][0]),
        ("box", "model", "box", "x [m]", 0.5, lambda sim: sim.robots["box"].pose.x),
        ("lamp", "joint", "lamp::hinge", "Damping", 0.75,
         lambda sim: sim.parameters.joint_damping["lamp::hinge"][0]),
        ("lamp", "light", "bulb", "Intensity", 2.0,
         lambda sim: next(each for each in sim.world.lights if each.name == "bulb").intensity),
        ("lamp", "world", "room", "Gravity z", -3.0, lambda sim: sim.parameters.gravity[0, 2]),
    ],
)  # fmt: skip
def test_a_property_is_changed_in_its_field(shown, model, kind, name, label, value, read):
    simulation, _, page = shown
    row(page, "model", model).click()
    if kind == "collision":
        row(page, "link", name.rpartition("::")[0]).click()
    row(page, kind, name).click()
    enter(page, label, f"{value:g}")
    until(lambda: read(simulation) == pytest.approx(value))


def test_a_wrong_value_is_said_and_changes_nothing(shown):
    simulation, _, page = shown
    row(page, "model", "box").click()
    row(page, "link", "box::l").click()
    before = simulation.parameters.link_mass["box::l"][0]
    field = enter(page, "Mass [kg]", "-1")
    page.get_by_text("This cannot be done").wait_for(state="attached")
    until(lambda: float(field.input_value()) == pytest.approx(before))
    assert simulation.parameters.link_mass["box::l"][0] == before


def test_pose_and_names_follow_the_simulation(shown):
    simulation, _, page = shown
    row(page, "model", "box").click()
    field = page.get_by_label("z [m]", exact=True)
    simulation.robots["box"].set_pose((0.0, 0.0, 0.875))
    until(lambda: field.input_value() == "0.875")
    simulation.spawn(simulation.robots["box"].description, name="twin", pose=None)
    row(page, "model", "twin").wait_for()
    simulation.delete("twin")
    until(lambda: row(page, "model", "twin").count() == 0)

"""Things are inserted under the cursor of a real browser, and the world is saved."""

import numpy as np
import pytest

pytest.importorskip("viser", reason="the extra 'web' is not installed")

from gazelle import formats
from gazelle.simulation import Simulation
from gazelle.viewer import LiveView
from tests.ros.graph import until
from tests.viewer.browser import opened, pixels
from tests.viewer.lamp_world import LAMP_WORLD

pytestmark = pytest.mark.long
SPOT = 0.6, -1.1  # free ground before the box


@pytest.fixture(scope="module")
def shown(tmp_path_factory):
    """Yield a simulation that stands, the open page, and a folder."""
    folder = tmp_path_factory.mktemp("worlds")
    (folder / "room.world").write_text(LAMP_WORLD)
    with (
        Simulation(folder / "room.world", threads=1) as simulation,
        LiveView(simulation) as view,
        opened(view.url, (1300, 800)) as page,
    ):
        page.get_by_role("button", name="top", exact=True).click()
        page.get_by_text("Spawn", exact=True).first.click()
        page.get_by_label("Shadows").click()
        page.get_by_label("Gizmo").click()
        until(lambda: abs(camera(view).wxyz[0]) < 0.1)
        yield simulation, view, page, folder


def camera(view):
    (client,) = view._server.viser.get_clients().values()
    return client.camera


def on_screen(view, page, point):
    """Return where a point of the world is on the screen [pixel]."""
    from gazelle.rotations import conjugate, rotate

    eye = camera(view)
    turned = conjugate(np.asarray(eye.wxyz)[[1, 2, 3, 0]])
    x, y, z = rotate(turned, np.array(point) - eye.position)
    high = np.tan(eye.fov / 2.0)
    scene = page.locator("canvas[data-engine]").bounding_box()
    across, down = x / z / high / eye.aspect, y / z / high
    return (
        scene["x"] + (across + 1.0) / 2.0 * scene["width"],
        scene["y"] + (down + 1.0) / 2.0 * scene["height"],
    )


def begin(page, what):
    """Choose a thing, and have its ghost at the cursor."""
    field = page.get_by_label("What", exact=True)
    field.click()
    field.fill(what)
    page.get_by_role("option", name=what, exact=True).click()
    page.get_by_role("button", name="Place by mouse").click()
    page.wait_for_function("window.gazelleGhost && !window.gazelleGhost.signal.aborted")


def blue(page):
    r, g, b = (pixels(page)[..., k] for k in range(3))
    return (b > r + 25) & (b > g + 5)


def test_a_ghost_follows_the_cursor_and_a_click_puts_the_thing_there(shown):
    simulation, view, page, _ = shown
    begin(page, "sphere")
    x, y = on_screen(view, page, (*SPOT, 0.0))
    page.mouse.move(x - 30, y)
    until(lambda: blue(page).sum() > 200)
    page.mouse.move(x, y)

    def below():
        rows, columns = np.nonzero(blue(page))
        return len(rows) > 200 and abs(columns.mean() - x) < 15 and abs(rows.mean() - y) < 25

    until(below)
    assert "sphere" not in simulation.robots
    page.mouse.down()
    page.mouse.up()
    until(lambda: view._context.selected == "sphere")
    pose = simulation.robots["sphere"].pose
    assert (pose.x, pose.y, pose.z) == (
        pytest.approx(SPOT[0], abs=0.05),
        pytest.approx(SPOT[1], abs=0.05),
        0.0,
    )
    names = view._context.scene._handle_from_node_name
    assert not any(name.startswith("/world/ghost") for name in names)


def test_a_thing_is_put_on_what_is_below_the_cursor(shown):
    simulation, view, page, _ = shown
    begin(page, "box")
    page.mouse.click(*on_screen(view, page, (0.2, 0.1, 1.0)))
    until(lambda: view._context.selected == "box_2")
    pose = simulation.robots["box_2"].pose
    assert (pose.x, pose.y) == (pytest.approx(0.2, abs=0.05), pytest.approx(0.1, abs=0.05))
    assert pose.z == pytest.approx(1.0, abs=1e-3)
    simulation.delete("box_2")


def test_escape_gives_it_up(shown):
    simulation, view, page, _ = shown
    before = set(simulation.robots)
    begin(page, "cylinder")
    page.mouse.move(*on_screen(view, page, (-0.5, -1.0, 0.0)))
    names = view._context.scene._handle_from_node_name
    until(lambda: "/world/ghost" in names)
    page.keyboard.press("Escape")
    until(lambda: "/world/ghost" not in names)
    assert set(simulation.robots) == before


def test_a_light_is_put_above_the_cursor(shown):
    simulation, view, page, _ = shown
    begin(page, "point light")
    page.mouse.click(*on_screen(view, page, (-0.5, -1.0, 0.0)))
    until(lambda: "lamp" in {each.name for each in simulation.world.lights})
    light = next(each for each in simulation.world.lights if each.name == "lamp")
    assert (light.pose.x, light.pose.z) == (pytest.approx(-0.5, abs=0.05), pytest.approx(2.5))
    page.locator('[data-kind="light"][data-name="lamp"][aria-selected=true]').wait_for()
    page.get_by_role("button", name="delete", exact=True).click()
    until(lambda: "lamp" not in {each.name for each in simulation.world.lights})


def test_the_world_is_saved_as_it_is(shown):
    simulation, _, page, folder = shown
    simulation.robots["box"].set_pose((0.1, 0.2, 0.5))
    field = page.locator("xpath=//*[text()='World file']/following::input[1]")
    field.fill(str(folder / "saved.world"))
    field.press("Enter")
    until(lambda: str(folder) in field.input_value())
    page.get_by_role("button", name="Save world").click()
    until((folder / "saved.world").is_file)
    models = {each.name: each for each in formats.load(folder / "saved.world").models}
    assert (models["box"].pose.x, models["box"].pose.y) == (pytest.approx(0.1), pytest.approx(0.2))

"""A robot is driven and friction is changed on the page of a simulation, by clicking only."""

import threading
from contextlib import contextmanager

import pytest

pytest.importorskip("viser", reason="the extra 'web' is not installed")

from gazelle.errors import SimulationError
from gazelle.simulation import Simulation
from gazelle.viewer import LiveView
from tests.ros.graph import until
from tests.viewer.browser import opened

pytestmark = pytest.mark.long


@contextmanager
def beside(work):
    """Call a function again and again on another thread."""
    over = threading.Event()

    def repeat():
        while not over.is_set():
            try:
                work()
            except SimulationError:  # paused, or closed
                over.wait(0.01)

    thread = threading.Thread(target=repeat, daemon=True)
    thread.start()
    try:
        yield
    finally:
        over.set()
        thread.join()


@pytest.fixture(scope="module")
def world():
    """Yield an empty world that runs in real time, and its page, with the folder Spawn open."""
    with (
        Simulation("empty", threads=1) as simulation,
        beside(lambda: simulation.run(0.05, rate=1.0)),
        LiveView(simulation) as view,
        opened(view.url, (1000, 900)) as page,
    ):
        page.get_by_text("Spawn", exact=True).first.click()
        page.get_by_role("button", name="Save world").click(trial=True)  # the folder is open
        page.locator("#gazelle-stick").scroll_into_view_if_needed()
        yield simulation, page


def fill(page, label, text):
    field = page.get_by_label(label, exact=True).first
    field.click(click_count=3)
    page.keyboard.type(text)
    field.press("Enter")


def spawn(page, what):
    """Spawn something, and wait until it is selected."""
    field = page.get_by_label("What", exact=True)
    field.click()
    field.fill(what)
    page.get_by_role("option", name=what, exact=True).click()
    page.get_by_role("button", name="Spawn", exact=True).click()
    page.locator(f'[data-name="{what}"][aria-selected=true]').wait_for()


def places(page):
    """Return where the folders of the right panel begin [pixel]."""
    titles = ("Run", "View", "Model", "Drive", "Joints", "Spawn", "Plot", "Show")
    return [page.get_by_text(title, exact=True).first.bounding_box()["y"] for title in titles]


def test_a_robot_is_spawned_and_driven(world):
    simulation, page = world
    before = places(page)
    spawn(page, "turtlebot3_burger")
    page.locator("strong", has_text="turtlebot3_burger").wait_for()
    assert places(page) == before  # nothing jumps
    robot = simulation.robots["turtlebot3_burger"]
    stick = page.locator("#gazelle-stick").bounding_box()
    x, y = stick["x"] + stick["width"] / 2.0, stick["y"] + stick["height"] / 2.0
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x, y - stick["height"] / 2.0, steps=3)
    until(lambda: robot.pose.x > 0.1)
    page.mouse.up()
    until(lambda: abs(robot.inputs["cmd_vel"].linear[0, 0]) == 0.0)


def test_a_box_slides_once_its_friction_is_changed(world):
    simulation, page = world
    fill(page, "x, y, yaw", "3")
    spawn(page, "box")
    box = simulation.robots["box"]
    fill(page, "Force [N]", "5")
    push = page.get_by_role("button", name="push", exact=True)
    push.click()
    begin = simulation.time
    until(lambda: simulation.time > begin + 0.5)
    assert box.pose.x == pytest.approx(3.0, abs=0.01)  # 5 N are less than the friction of 1 kg
    page.locator('[data-kind="link"][data-name="box::link"]').click()
    row = page.locator('[data-kind="collision"]')
    row.click()
    name = row.get_attribute("data-name")
    fill(page, "Friction", "0.05")
    until(lambda: simulation.parameters.friction[name][0] == pytest.approx(0.05))
    push.click()
    until(lambda: box.pose.x > 3.2)


def test_the_numbers_of_an_output_are_plotted(world):
    _, page = world
    page.get_by_text("Plot", exact=True).first.click()
    field = page.get_by_label("Output", exact=True)
    field.click()
    page.get_by_role("option", name="turtlebot3_burger: odom", exact=True).click()
    chart = page.locator(".uplot")
    chart.get_by_text("position", exact=False).first.wait_for()
    assert chart.locator("canvas").count() == 1


def test_the_page_is_dark_or_light(world):
    _, page = world
    scheme = "document.documentElement.dataset.mantineColorScheme == "
    page.get_by_label("Dark", exact=True).click()
    page.wait_for_function(f"{scheme}'dark'")
    page.get_by_label("Dark", exact=True).click()
    page.wait_for_function(f"{scheme}'light'")

"""The page in a real browser: a robot is seen to move; pause, drag, spawn, close."""

import threading

import numpy as np
import pytest

pytest.importorskip("viser", reason="the extra 'web' is not installed")

from gazelle import assets
from gazelle.errors import SimulationError
from gazelle.simulation import Simulation
from gazelle.viewer import LiveView
from tests.ros.graph import until
from tests.viewer.browser import opened, pixels

BOX = """
<sdf version="1.6"><world name="room">
<light name="sun" type="directional"><direction>-0.3 0.2 -1</direction></light>
<model name="ground"><static>true</static><link name="l">
 <collision name="c"><geometry><plane><normal>0 0 1</normal><size>9 9</size></plane></geometry></collision>
 <visual name="v"><geometry><plane><normal>0 0 1</normal><size>9 9</size></plane></geometry></visual></link></model>
<model name="box"><pose>0 0 0.5 0 0 0</pose><link name="l">
 <inertial><mass>2</mass></inertial>
 <collision name="c"><geometry><box><size>1 1 1</size></box></geometry></collision>
 <visual name="v"><geometry><box><size>1 1 1</size></box></geometry>
  <material><diffuse>0.9 0.1 0.1 1</diffuse></material></visual></link></model>
</world></sdf>
"""


@pytest.fixture
def running(tmp_path):
    """Run a simulation at about real time in a thread of its own."""
    file = tmp_path / "room.world"
    file.write_text(BOX)
    over = threading.Event()
    with Simulation(file, threads=1) as simulation:
        simulation.physics.update_rate = 1000.0

        def run():
            while not over.is_set():
                try:
                    simulation.run(0.02, rate=1.0)
                except SimulationError:  # paused
                    over.wait(0.01)

        runner = threading.Thread(target=run)
        runner.start()
        yield simulation
        over.set()
        runner.join()


def red(picture):
    """Return middle of all red pixels, (x, y), and how many there are."""
    found = (picture[..., 0] > 90) & (picture[..., 0] > 2 * picture[..., 1])
    rows, columns = np.nonzero(found)
    return (columns.mean(), rows.mean(), len(rows)) if len(rows) else (np.nan, np.nan, 0)


@pytest.mark.slow
def test_a_browser_sees_moves_pauses_drags_and_spawns(running):
    with LiveView(running) as view, opened(view.url) as page:
        until(lambda: red(pixels(page))[2] > 100)
        before = red(pixels(page))
        running.robots["box"].set_pose((1.5, -1.0, 0.5))
        until(lambda: np.hypot(*np.subtract(red(pixels(page))[:2], before[:2])) > 10)

        page.get_by_role("button", name="pause", exact=True).click()
        until(lambda: running.paused)
        stood = running.time
        page.get_by_role("button", name="step", exact=True).click()
        until(lambda: running.time == pytest.approx(stood + 0.001))
        page.get_by_role("button", name="run", exact=True).click()
        until(lambda: not running.paused and running.time > stood + 0.01)

        x, y, _ = red(pixels(page))
        page.mouse.click(x, y)
        until(lambda: view._context.selected == "box")
        page.get_by_label("Gizmo").click()
        start = running.robots["box"].pose
        page.keyboard.down("Shift")
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x + 60, y, steps=4)

        def dragged():
            now = running.robots["box"].pose
            return abs(now.x - start.x) + abs(now.y - start.y) > 0.2

        until(dragged)
        page.mouse.up()
        page.keyboard.up("Shift")

        page.get_by_text("Spawn", exact=True).first.click()
        page.get_by_role("button", name="Spawn", exact=True).click()
        until(lambda: len(running.robots) == 3)
    until(lambda: not view._thread.is_alive())


@pytest.mark.slow
def test_a_robot_in_the_plane_is_driven_by_keys():
    with Simulation(assets.world("turtlebot3_stage_1"), "planar", threads=1) as sim:
        robot = sim.spawn("turtlebot3_burger")
        with LiveView(sim) as view, opened(view.url) as page:
            view._context.select("turtlebot3_burger")
            stick = page.locator("#gazelle-stick")
            stick.wait_for()
            stick.focus()
            page.keyboard.down("w")
            until(lambda: robot.inputs["cmd_vel"].linear[0, 0] > 0.1)
            page.keyboard.up("w")
            until(lambda: robot.inputs["cmd_vel"].linear[0, 0] == 0.0)

"""A robot is sent to a goal and a broken transform is found on the page of a graph, by clicking only."""

import threading

import numpy as np
import pytest

pytest.importorskip("viser", reason="the extra 'web' is not installed")

from gazelle.bridges import serve_ros
from gazelle.simulation import Simulation
from gazelle_ros import Master
from tests.ros.graph import until
from tests.viewer.graph_page import graph_page

pytestmark = pytest.mark.long


@pytest.fixture(scope="module")
def office():
    """Yield a courier with navigation in an office, and the page of its graph."""
    with (
        Master("127.0.0.1", 0) as master,
        Simulation("office", "planar", threads=1) as simulation,
        serve_ros(simulation, master.uri) as server,
    ):
        robot = simulation.spawn("courier", namespace="/")
        simulation.physics.update_rate = 1.0 / simulation.physics.time_step
        thread = threading.Thread(target=server.run)
        thread.start()
        with graph_page(master_uri=master.uri) as graph:
            yield robot, graph
        server.stop()
        thread.join()


def test_a_robot_drives_to_a_goal(office):
    robot, graph = office
    until(lambda: graph.view._fitter._count > 0)
    begin = robot.position[0, :2].copy()
    graph.choose("Tool", "2D Nav Goal")
    graph.wait_text("and drag to where it")
    graph.drag((180, 300), (280, 300))
    graph.wait_text("Sent to /move_base_simple/goal")
    said = graph.view._tools._hint.content
    goal = np.array([float(each) for each in said.partition(": ")[2].split(" m")[0].split(", ")])
    away = np.linalg.norm(begin - goal)
    until(lambda: np.linalg.norm(robot.position[0, :2] - goal) < away / 2.0)


def test_a_broken_transform_is_found(office):
    _, graph = office
    graph.say("/lost", "geometry_msgs/PoseStamped", "nowhere")
    graph.wait_text("⚠ /lost: no transform from nowhere to")
    graph.page.get_by_text("⚠ /lost", exact=True).click()
    graph.wait_text("geometry_msgs/PoseStamped: no transform from nowhere to")
    graph.say_frames(nowhere=(0.0, 0.0))
    graph.choose("Open panel", "tf tree")
    graph.wait_text("2 trees that no transform connects")
    graph.click("Close")

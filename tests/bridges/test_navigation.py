"""A goal from a graph is driven to, and the way to it is on the graph."""

from __future__ import annotations

import threading
from types import SimpleNamespace

import numpy as np
import pytest
from ros.graph import until

import gazelle
from gazelle.bridges import serve_ros
from gazelle.bridges.conversions import ConversionContext, decoder_of, encoder_of
from gazelle.navigation import GoalPose, Path
from gazelle.rotations import from_yaw
from gazelle_ros import Master, Node, load_message
from gazelle_ros.time import Time

POSE = "geometry_msgs/PoseStamped"


def test_a_goal_is_read():
    message = load_message(POSE)()
    message.header.frame_id = "odom"
    message.pose.position.x, message.pose.position.y = 1.0, -2.0
    assert decoder_of(GoalPose).read(message) == GoalPose(1.0, -2.0, None, "odom")
    turned = message.pose.orientation
    turned.x, turned.y, turned.z, turned.w = from_yaw(np.array(1.2)).tolist()
    assert decoder_of(GoalPose).read(message).yaw == pytest.approx(1.2)


def test_a_path_is_written():
    encoder = encoder_of(Path)
    message = load_message(encoder.message)()
    value = Path(5, "odom", (np.zeros((0, 3)), np.array([[1.0, 2.0, 0.0], [1.5, 2.0, np.pi]])))
    encoder.fill(message, value, ConversionContext("", 1, lambda nanoseconds: Time(0, nanoseconds)))
    assert (message.header.frame_id, message.header.stamp) == ("odom", Time(0, 5))
    assert [(p.pose.position.x, p.pose.position.y) for p in message.poses] == [(1, 2), (1.5, 2)]
    assert message.poses[1].pose.orientation.z == pytest.approx(1.0)
    assert all(p.header.frame_id == "odom" for p in message.poses)


@pytest.fixture(params=["mujoco", "planar"])
def office(request):
    """Run a courier in an office as fast as it can, and a node beside it."""
    with Master(port=0, rosout=False) as master, gazelle.Simulation("office", request.param) as sim:
        robot = sim.spawn("courier", namespace="/")
        sim.physics.update_rate = 0.0
        with serve_ros(sim, master.uri) as server, Node("asker", master_uri=master.uri) as node:
            thread = threading.Thread(target=server.run)
            thread.start()
            yield SimpleNamespace(robot=robot, node=node)
            server.stop()
            thread.join()


@pytest.mark.long
def test_a_goal_on_the_graph_is_driven_to(office):
    paths, places = [], []
    office.node.subscribe("/path", load_message("nav_msgs/Path"), paths.append, 1)
    office.node.subscribe("/odom", load_message("nav_msgs/Odometry"), places.append, 1)
    goals = office.node.advertise("/move_base_simple/goal", load_message(POSE), 1)
    until(lambda: goals.num_connections and places)
    message = load_message(POSE)()
    message.header.frame_id = "map"
    message.pose.position.x = 0.8
    goals.publish(message)
    until(lambda: places[-1].pose.pose.position.x > 0.65)
    until(lambda: any(path.poses for path in paths))
    way = next(path for path in paths if path.poses)
    assert way.header.frame_id == "odom"
    assert way.poses[-1].pose.position.x == pytest.approx(0.8)

"""`gazelle run --ros` describes its robot, so that a viewer shows it."""

from __future__ import annotations

import pytest
from ros.graph import until

import gazelle
from gazelle.bridges import serve_ros
from gazelle.cli.description_publisher import publishing_descriptions
from gazelle_ros import Master, Node, load_message
from gazelle_ros.tf import FrameTree, take_transforms

BURGER = "turtlebot3_burger"


@pytest.fixture
def master():
    with Master(port=0, rosout=False) as running:
        yield running


@pytest.fixture
def node(master):
    with Node("looking", master_uri=master.uri) as made:
        yield made


def received_frames(node):
    tree, kind = FrameTree(), load_message("tf2_msgs/TFMessage")
    for topic, static in (("/tf", False), ("/tf_static", True)):
        node.subscribe(
            topic, kind, lambda said, static=static: take_transforms(tree, said, static=static), 100
        )
    return tree


@pytest.mark.parametrize("world", ["turtlebot3_stage_1", "turtlebot3_world"])
def test_the_frames_of_a_spawned_robot_hang_together(master, node, world):
    tree = received_frames(node)
    with gazelle.Simulation(world, "planar") as sim:
        sim.spawn(BURGER, pose=gazelle.Pose(-2.0, -0.5))
        with serve_ros(sim, master.uri) as server, publishing_descriptions(sim, server):
            assert node.get_param("/robot_description").startswith("<?xml")
            server.start()
            until(lambda: tree.has("base_scan") and tree.has("odom"))
            until(lambda: tree.lookup("odom", "base_scan").translation[2] > 0.1)


def test_a_description_that_is_there_is_left_alone(master, node):
    node.set_param("/robot_description", "<robot name='mine'/>")
    with gazelle.Simulation("empty", "planar") as sim:
        sim.spawn(BURGER)
        with serve_ros(sim, master.uri) as server, publishing_descriptions(sim, server):
            assert node.get_param("/robot_description") == "<robot name='mine'/>"
            topics = dict(node.master.published_topics())
            assert "/tf_static" not in topics


@pytest.mark.parametrize("world", ["turtlebot3_stage_4", "empty"])
def test_worlds_without_robots_of_urdf_files_have_no_description(master, node, world):
    with (
        gazelle.Simulation(world, "planar") as sim,
        serve_ros(sim, master.uri) as server,
        publishing_descriptions(sim, server),
    ):
        assert not node.has_param("/robot_description")


def test_a_second_robot_keeps_its_frames_to_itself(master, node):
    with gazelle.Simulation("empty", "planar") as sim:
        sim.spawn(BURGER)
        sim.spawn(BURGER, name="second", pose=gazelle.Pose(1.0), namespace="/second")
        with serve_ros(sim, master.uri) as server, publishing_descriptions(sim, server):
            assert node.has_param("/robot_description")
            assert not node.has_param("/second/robot_description")

"""The launch files of turtlebot3_slam, unchanged, map with each method."""

from __future__ import annotations

import numpy as np
import pytest
from launching import Launched
from ros.graph import until

from gazelle_ros import Master, Node, load_message
from gazelle_ros.tf import FrameTree, TransformException, take_transforms

pytestmark = [pytest.mark.corpus, pytest.mark.slow]

PATIENCE = 120.0


def connected(tree, parent, child):
    try:
        tree.lookup(parent, child, 0)
    except TransformException:
        return False
    return True


@pytest.mark.parametrize("method", ["gmapping", "karto", "hector"])
def test_a_map_grows_while_a_burger_drives(corpus, tmp_path, method):
    for name in ("world", "slam"):
        (tmp_path / name).mkdir()
    world = "turtlebot3_gazebo turtlebot3_world.launch model:=burger"
    slam = f"turtlebot3_slam turtlebot3_slam.launch model:=burger open_rviz:=false slam_methods:={method}"
    with (
        Master(port=0) as master,
        Launched(master.uri, corpus, tmp_path / "world", world) as launched,
    ):
        launched.wait_for(["turtlebot3_burger"], set(), set())
        with Launched(master.uri, corpus, tmp_path / "slam", slam, "/second") as mapping:
            node = Node("/driver", master_uri=master.uri)
            maps, tree = [], FrameTree()
            kind = load_message("tf2_msgs/TFMessage")
            for topic in ("/tf", "/tf_static"):
                node.subscribe(
                    topic, kind,
                    lambda message: take_transforms(tree, message, authority="test", static=False),
                )  # fmt: skip
            node.subscribe("/map", load_message("nav_msgs/OccupancyGrid"), maps.append)
            twist = load_message("geometry_msgs/Twist")
            drive = node.advertise("/cmd_vel", twist)
            command = twist()
            command.linear.x, command.angular.z = 0.1, 0.2

            def enough():
                drive.publish(command)
                cells = np.array(maps[-1].data if maps else [-1])
                return (cells == 100).sum() > 100 and (cells == 0).sum() > 2000

            try:
                until(enough, PATIENCE)
                assert maps[-1].header.frame_id == "map"
                until(lambda: connected(tree, "map", "base_footprint"), PATIENCE)
            finally:
                node.close()
            assert "Traceback" not in mapping.said, mapping.said

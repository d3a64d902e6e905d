"""turtlebot3_slam's and turtlebot3_navigation's launch files as they are, and explore_lite's node, make a whole map."""

from __future__ import annotations

from contextlib import ExitStack

import numpy as np
import pytest
from launching import Launched
from ros.graph import until
from travelling import FREE
from wall_errors import distances, drawn_walls, lit, seen_walls

import gazelle
from gazelle.bridges.navigation.map_messages import grid_of_message
from gazelle.navigation.true_map import true_map
from gazelle_ros import Master, Node, load_message

pytestmark = [pytest.mark.corpus, pytest.mark.slow, pytest.mark.timeout(3600)]

PATIENCE = 1800.0
STACK = (
    "turtlebot3_slam turtlebot3_slam.launch model:={model} open_rviz:=false slam_methods:=gmapping",
    "turtlebot3_navigation move_base.launch model:={model}",
    "explore_lite explore.launch",
)


@pytest.mark.parametrize("model", ["burger", "waffle"])
def test_turtlebot3_world_is_explored(corpus, tmp_path, model):
    maps, ended = [], []
    with ExitStack() as stack:
        master = stack.enter_context(Master(port=0))
        node = stack.enter_context(Node("/listener", master_uri=master.uri))
        node.subscribe("/move_base/cancel", load_message("actionlib_msgs/GoalID"), ended.append)
        node.subscribe("/map", load_message("nav_msgs/OccupancyGrid"), maps.append)
        said = []
        for number, file in enumerate(
            ("turtlebot3_gazebo turtlebot3_world.launch model:={model}", *STACK)
        ):
            folder = tmp_path / str(number)
            folder.mkdir()
            started = Launched(
                master.uri, corpus, folder, file.format(model=model), f"/watcher{number}"
            )
            said.append(stack.enter_context(started))
            if number == 0:
                said[0].wait_for([f"turtlebot3_{model}"], set(), set())
        until(lambda: ended, PATIENCE)
        assert not any("Traceback" in each.said for each in said)
    found = grid_of_message(maps[-1])
    true = true_map(gazelle.load("turtlebot3_world"), 0.18, margin=2.0)
    walls = seen_walls(true, lit(true, FREE))
    assert len(walls) > 400
    assert np.mean(distances(walls, found) <= 1.0) >= 0.95
    assert np.mean(distances(drawn_walls(found), true) <= 1.0) >= 0.95
    assert (found.data == 0).sum() > 0.95 * 7938
    print(model, len(walls), np.mean(distances(walls, found) <= 1.0))

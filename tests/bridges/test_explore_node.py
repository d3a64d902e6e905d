"""The node of explore_lite on a small graph: a map, a place, and a move_base that the test plays."""

from __future__ import annotations

import numpy as np
import pytest
from ros.graph import until

from gazelle.bridges.navigation.explore import ExploreNode
from gazelle.bridges.navigation.map_messages import grid_message
from gazelle.description import Pose
from gazelle.description.occupancy import OccupancyMap
from gazelle_ros import Master, Node, Time, load_message
from gazelle_ros.actions import SimpleActionServer
from gazelle_ros.clock import SimulatedClock

PARAMETERS = {"costmap_topic": "map", "costmap_updates_topic": "map_updates", "visualize": True,
              "min_frontier_size": 0.2, "progress_timeout": 30.0}  # fmt: skip


class Graph:
    """A move_base that keeps what it is sent, maps, and frames."""

    def __init__(self, uri):
        self.clock, self.goals = SimulatedClock(), []
        self.clock.set(1_000_000_000)
        self.node = Node("/graph", master_uri=uri)
        self.maps = self.node.advertise("/map", load_message("nav_msgs/OccupancyGrid"), latch=True)
        self.updates = self.node.advertise(
            "/map_updates", load_message("map_msgs/OccupancyGridUpdate"), latch=True
        )
        self._frames = self.node.advertise(
            "/tf_static", load_message("tf2_msgs/TFMessage"), latch=True
        )
        frame = load_message("geometry_msgs/TransformStamped")()
        frame.header.frame_id, frame.child_frame_id = "map", "base_link"
        frame.header.stamp = Time(nsecs=1)
        frame.transform.translation.x = frame.transform.translation.y = 1.0
        frame.transform.rotation.w = 1.0
        self._frames.publish(load_message("tf2_msgs/TFMessage")(transforms=[frame]))
        self.server = SimpleActionServer(
            self.node, "/move_base", load_message("move_base_msgs/MoveBaseAction"), auto_start=False
        )
        self.server.start()
        self.markers = []
        self.node.subscribe(
            "/explore/frontiers",
            load_message("visualization_msgs/MarkerArray"),
            self.markers.append,
        )

    def show(self, cells):
        self.maps.publish(grid_message(OccupancyMap(cells, 0.1, Pose()), "map", 1))

    def accept(self):
        """Accept the goal; return x and y; ``sent`` is its time on the graph [s]."""
        until(self.server.is_new_goal_available)
        goal = self.server.accept_new_goal().target_pose
        self.sent = goal.header.stamp.to_sec()
        return goal.pose.position.x, goal.pose.position.y


@pytest.fixture
def graph():
    with Master(port=0) as master:
        made = Graph(master.uri)
        try:
            yield made
        finally:
            made.node.close()


@pytest.fixture
def explore(graph):
    with Node("/explore", master_uri=graph.node.master.uri, clock=graph.clock) as node:
        for name, value in PARAMETERS.items():
            node.set_param(f"~{name}", value)
        yield ExploreNode(node)


def room():
    """Free ground of 2 m by 2 m that is open to the right, and less so above."""
    cells = np.full((40, 60), -1, np.int8)
    cells[:22, :22] = 100
    cells[1:21, 1:21] = 0
    cells[3:18, 21] = 0
    cells[21, 5:9] = 0
    return cells


def cycles(graph, explore, done):
    """Run cycles, a second of the graph's time each, until something holds."""

    def step():
        graph.clock.set(graph.clock.now() + 1_000_000_000)
        explore.cycle()
        return done()

    until(step)


def test_it_goes_for_frontiers_and_gives_up_what_cannot_be_reached(graph, explore):
    graph.show(room())
    cycles(graph, explore, graph.server.is_new_goal_available)
    assert graph.accept() == (pytest.approx(2.25), pytest.approx(1.05))
    until(lambda: graph.markers)
    kinds = {marker.ns for marker in graph.markers[-1].markers if marker.points}
    assert kinds == {"frontiers"}
    graph.server.set_aborted(None, "no path")
    cycles(graph, explore, graph.server.is_new_goal_available)
    assert graph.accept() == (pytest.approx(0.7), pytest.approx(2.25))
    # The rest of the map comes as an update, and there is nothing left.
    update = load_message("map_msgs/OccupancyGridUpdate")()
    update.x, update.y, update.width, update.height = 5, 22, 4, 1
    update.data = [100] * 4
    graph.updates.publish(update)
    cycles(graph, explore, lambda: explore.finished)
    until(graph.server.is_preempt_requested)


def test_one_that_makes_no_progress_goes_elsewhere(graph, explore):
    graph.show(room())
    cycles(graph, explore, graph.server.is_new_goal_available)
    first, begun = graph.accept(), graph.sent
    cycles(graph, explore, graph.server.is_new_goal_available)
    assert graph.accept() != first
    assert graph.sent - begun == PARAMETERS["progress_timeout"] + 1.0, "the next cycle after it"


def test_maps_and_updates_that_are_none_are_left_out(graph, explore):
    broken = grid_message(OccupancyMap(room(), 0.1, Pose()), "map", 1)
    broken.info.width = 7
    explore._take_map(broken)
    explore.cycle()
    assert not explore.finished
    explore._take_map(grid_message(OccupancyMap(room(), 0.1, Pose()), "map", 1))
    update = load_message("map_msgs/OccupancyGridUpdate")()
    update.x, update.y, update.width, update.height = 58, 0, 9, 1
    update.data = [0] * 9
    before = explore._costs.copy()
    explore._take_update(update)
    assert (explore._costs == before).all()

"""The launch files of turtlebot3_navigation, unchanged, take robots to goals."""

from __future__ import annotations

import math
import random
from contextlib import contextmanager

import pytest
from launching import Launched
from mapping_drives import WORLD, Mapper, drive
from ros.graph import until

import gazelle
from gazelle.formats import save_map
from gazelle.navigation.true_map import true_map
from gazelle.ros import Master, Node, Time, load_message
from gazelle.ros.actions import GoalStatus, SimpleActionClient

pytestmark = pytest.mark.corpus

PATIENCE = 120.0

FREE = [(-0.5, 0.0), (0.5, 0.0), (-1.6, -0.5), (-1.6, 0.5), (-0.5, -1.75), (0.5, 1.75), (0.55, 0.55),
        (1.7, 0.5), (0.0, 0.55), (0.0, -0.55), (-0.55, 0.55), (1.7, -0.5)]  # fmt: skip


class Traveller:
    """A client of move_base in turtlebot3_world, and the truth about its robot."""

    def __init__(self, uri, model):
        self.node = Node("/traveller", master_uri=uri)
        self._name = f"turtlebot3_{model}"
        self._states, self.located = [], []
        self.node.subscribe(
            "/gazebo/model_states", load_message("gazebo_msgs/ModelStates"), self._keep
        )
        kind = load_message("geometry_msgs/PoseWithCovarianceStamped")
        self._begin = self.node.advertise("/initialpose", kind, latch=True)
        self.node.subscribe("/amcl_pose", kind, self.located.append)
        action = load_message("move_base_msgs/MoveBaseAction")
        self._client = SimpleActionClient(self.node, "/move_base", action)

    def _keep(self, message):
        self._states = [message]

    @property
    def place(self):
        state = self._states[0]
        at = state.pose[state.name.index(self._name)].position
        return at.x, at.y

    def begin(self, x, y):
        until(lambda: self._states and self.located, PATIENCE)
        message = load_message("geometry_msgs/PoseWithCovarianceStamped")()
        message.header.frame_id = "map"
        message.header.stamp = Time(nsecs=self.node.clock.now())
        place = message.pose.pose
        place.position.x, place.position.y, place.orientation.w = x, y, 1.0
        message.pose.covariance = [0.0] * 36
        message.pose.covariance[0] = message.pose.covariance[7] = 0.25
        message.pose.covariance[35] = 0.06
        before = len(self.located)
        self._begin.publish(message)
        until(lambda: len(self.located) > before, PATIENCE)
        assert self._client.wait_for_server(PATIENCE)

    def go(self, x, y, yaw=0.0):
        goal = load_message("move_base_msgs/MoveBaseGoal")()
        goal.target_pose.header.frame_id = "map"
        place = goal.target_pose.pose
        place.position.x, place.position.y = x, y
        place.orientation.z, place.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
        self._client.send_goal(goal)
        assert self._client.wait_for_result(PATIENCE)
        return self._client.get_state(), self._client.get_goal_status_text()


@contextmanager
def navigating(corpus, folder, model, whole):
    for name in ("world", "stack"):
        (folder / name).mkdir()
    save_map(whole, folder / "map")
    arguments = f"model:={model} open_rviz:=false map_file:={folder}/map.yaml"
    world = f"turtlebot3_gazebo turtlebot3_world.launch model:={model}"
    stack = f"turtlebot3_navigation turtlebot3_navigation.launch {arguments}"
    with (
        Master(port=0) as master,
        Launched(master.uri, corpus, folder / "world", world) as launched,
    ):
        launched.wait_for([f"turtlebot3_{model}"], set(), set())
        with Launched(master.uri, corpus, folder / "stack", stack, "/second") as navigation:
            traveller = Traveller(master.uri, model)
            try:
                traveller.begin(-2.0, -0.5)
                yield traveller
            finally:
                traveller.node.close()
            assert "Traceback" not in navigation.said, navigation.said


def test_a_burger_reaches_a_goal(corpus, tmp_path):
    whole = true_map(gazelle.load("turtlebot3_world"), 0.18, margin=2.0)
    with navigating(corpus, tmp_path, "burger", whole) as traveller:
        state, text = traveller.go(-1.5, -0.5)
        assert (state, text) == (GoalStatus.SUCCEEDED, "Goal reached.")
        assert math.dist(traveller.place, (-1.5, -0.5)) < 0.25


@pytest.mark.slow
@pytest.mark.parametrize("model", ["burger", "waffle"])
def test_fifty_goals_of_fifty_are_reached_on_a_map_of_our_own(corpus, tmp_path, model):
    chosen, mapper = random.Random(7), Mapper(0.0)
    drive("turtlebot3_world", (-2.0, -0.5), WORLD, mapper.take)
    with navigating(corpus, tmp_path, model, mapper.slam.map()) as traveller:
        for _ in range(50):
            goal = chosen.choice([each for each in FREE if math.dist(each, traveller.place) > 0.3])
            state, text = traveller.go(*goal, chosen.uniform(-3.1, 3.1))
            assert (state, text) == (GoalStatus.SUCCEEDED, "Goal reached."), (goal, traveller.place)
            assert math.dist(traveller.place, goal) < 0.25

"""TurtleBot3's launch files as they are: a world, the navigation stack, and a client that sends goals."""

from __future__ import annotations

import math
import os
import random
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import touch_counter
from launching import Launched
from ros.graph import until

from gazelle.clients import Gazebo
from gazelle.formats import save_map
from gazelle_ros import Master, Node, Time, load_message
from gazelle_ros.actions import GoalStatus, SimpleActionClient

PATIENCE = 600.0
"""For anything to happen, on a machine that may be busy [s of wall time]."""

FREE = [(-0.5, 0.0), (0.5, 0.0), (-1.6, -0.5), (-1.6, 0.5), (-0.5, -1.75), (0.5, 1.75), (0.55, 0.55),
        (1.7, 0.5), (0.0, 0.55), (0.0, -0.55), (-0.55, 0.55), (1.7, -0.5)]  # fmt: skip


@dataclass(frozen=True)
class Trip:
    """How a goal went.

    Attributes:
        goal: x, y [m] and heading [rad].
        reached: Whether move_base said so.
        text: What it said.
        seconds: Of simulated time.
        off: From the goal, in truth [m].
        recoveries: Behaviours that were needed.
        touches: How often the robot ran into something on the way.
    """

    goal: tuple[float, float, float]
    reached: bool
    text: str
    seconds: float
    off: float
    recoveries: int
    touches: int


class Traveller:
    """A client of move_base in turtlebot3_world, and the truth about its robot."""

    def __init__(self, uri, model):
        self.node = Node("/traveller", master_uri=uri)
        self._name = f"turtlebot3_{model}"
        self._states, self.located, self._touches, self._recovered = [], [], [], []
        self.node.subscribe(
            "/gazebo/model_states", load_message("gazebo_msgs/ModelStates"), self._keep
        )
        kind = load_message("geometry_msgs/PoseWithCovarianceStamped")
        self._begin = self.node.advertise("/initialpose", kind, latch=True)
        self.node.subscribe("/amcl_pose", kind, self.located.append)
        self.node.subscribe("/touches", load_message("std_msgs/Int32"), self._touch)
        self.node.subscribe(
            "/move_base/recovery_status",
            load_message("move_base_msgs/RecoveryStatus"),
            self._recovered.append,
        )
        action = load_message("move_base_msgs/MoveBaseAction")
        self._client = SimpleActionClient(self.node, "/move_base", action)
        with Gazebo(master_uri=uri) as gazebo:
            gazebo.spawn_sdf("witness", touch_counter.WITNESS.format(model=self._name))
        until(lambda: self._touches, PATIENCE)

    def _keep(self, message):
        self._states = [message]

    def _touch(self, message):
        self._touches = [message.data]

    @property
    def place(self):
        state = self._states[0]
        at = state.pose[state.name.index(self._name)].position
        return at.x, at.y

    def begin(self, x, y):
        """Publish the robot's pose to amcl, and wait for move_base."""
        until(lambda: self._states and self.located, PATIENCE)
        before = len(self.located)
        self._begin.publish(pose_message(self.node.clock.now(), (x, y, 0.0)))
        until(lambda: len(self.located) > before, PATIENCE)
        assert self._client.wait_for_server(PATIENCE)

    def go(self, x, y, yaw=0.0):
        """Send a goal; return its outcome."""
        goal = load_message("move_base_msgs/MoveBaseGoal")()
        goal.target_pose.header.frame_id = "map"
        place = goal.target_pose.pose
        place.position.x, place.position.y = x, y
        place.orientation.z, place.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
        begun, touches, recovered = self.node.clock.now(), self._touches[0], len(self._recovered)
        self._client.send_goal(goal)
        assert self._client.wait_for_result(PATIENCE)
        return Trip(
            (x, y, yaw),
            self._client.get_state() == GoalStatus.SUCCEEDED,
            self._client.get_goal_status_text(),
            (self.node.clock.now() - begun) / 1e9,
            math.dist(self.place, (x, y)),
            len(self._recovered) - recovered,
            self._touches[0] - touches,
        )

    def tour(self, count, seed=7):
        """Drive to so many random places, one after another; yields the outcomes."""
        chosen = random.Random(seed)
        for _ in range(count):
            place = chosen.choice([each for each in FREE if math.dist(each, self.place) > 0.3])
            yield self.go(*place, chosen.uniform(-3.1, 3.1))


def pose_message(now, pose):
    """Return the message of a robot's pose in the map, as RViz gives it."""
    x, y, yaw = pose
    message = load_message("geometry_msgs/PoseWithCovarianceStamped")()
    message.header.frame_id = "map"
    message.header.stamp = Time(nsecs=now)
    place = message.pose.pose
    place.position.x, place.position.y = x, y
    place.orientation.z, place.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    message.pose.covariance = [0.0] * 36
    message.pose.covariance[0] = message.pose.covariance[7] = 0.25
    message.pose.covariance[35] = 0.06
    return message


@contextmanager
def navigating(corpus, folder, model, whole):
    """Run a `Traveller` in turtlebot3_world, with turtlebot3_navigation's launch and map."""
    for name in ("world", "stack"):
        (folder / name).mkdir()
    save_map(whole, folder / "map")
    arguments = f"model:={model} open_rviz:=false map_file:={folder}/map.yaml"
    world = f"turtlebot3_gazebo turtlebot3_world.launch model:={model}"
    stack = f"turtlebot3_navigation turtlebot3_navigation.launch {arguments}"
    paths = [str(Path(touch_counter.__file__).parent), os.environ.get("PYTHONPATH", "")]
    more = {"PYTHONPATH": os.pathsep.join(filter(None, paths))}
    with (
        Master(port=0) as master,
        Launched(master.uri, corpus, folder / "world", world, more=more) as launched,
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


def table(model, trips):
    """Return the outcomes of a tour, as lines."""
    reached = sum(trip.reached for trip in trips)
    touches, recoveries = (
        sum(each) for each in zip(*((t.touches, t.recoveries) for t in trips), strict=True)
    )
    seconds = sum(trip.seconds for trip in trips)
    lines = [
        f"{model}: {reached} of {len(trips)} goals, {touches} collisions, {recoveries} recoveries, {seconds:.0f} s"
    ]
    for number, trip in enumerate(trips, 1):
        x, y, yaw = trip.goal
        lines.append(
            f"{number:>3} ({x:5.2f}, {y:5.2f}, {yaw:5.2f}) {trip.seconds:6.1f} s, off by {trip.off:.3f} m, "
            f"{trip.recoveries} recoveries, {trip.touches} collisions: {trip.text}"
        )
    return "\n".join(lines)

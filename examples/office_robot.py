"""Send a robot about an office: goals as rviz's "2D Nav Goal" sends them, over ROS 1.

    python examples/office_robot.py
    python examples/office_robot.py --goal 0 -2.5 --goal 4.4 4 --rate 1

The simulator is a process of its own (``gazelle run office --ros --spawn courier``); the robot
plans on what its laser has seen, drives around what it meets, and publishes ``/path``.
"""

from __future__ import annotations

import argparse
import math
import sys
import time
from itertools import pairwise
from typing import Any

from gazelle.clients import SimulatorProcess
from gazelle_ros import Master, Node, load_message

GOALS = [(0.6, -1.2), (1.4, 0.4), (0.0, 0.0)]
NEAR = 0.15  # of a goal counts as there [m]
PATIENCE = 60.0  # for a goal [s of simulated time]


class OfficeRobot:
    """A robot on a graph that takes goals: where it is, its way, and whether it is there."""

    def __init__(self, node: Node) -> None:
        self.position: tuple[float, float] | None = None
        self.time = 0.0
        self.way: list[tuple[float, float]] = []
        self._goals = node.advertise(
            "/move_base_simple/goal", load_message("geometry_msgs/PoseStamped"), 1
        )
        self._message = load_message("geometry_msgs/PoseStamped")
        node.subscribe("/odom", load_message("nav_msgs/Odometry"), self._hear_odometry, 1)
        node.subscribe("/path", load_message("nav_msgs/Path"), self._hear_path, 1)

    def wait(self, timeout: float = 60.0) -> None:
        """Wait until it listens and its place is known [s of wall time]."""
        end = time.monotonic() + timeout
        while self.position is None or not self._goals.num_connections:
            if time.monotonic() > end:
                raise TimeoutError(f"no robot on the graph within {timeout:g} s")
            time.sleep(0.01)

    def send(self, x: float, y: float) -> None:
        """Send it to a place; its heading there does not matter."""
        goal: Any = self._message()
        goal.header.frame_id = "map"
        goal.pose.position.x, goal.pose.position.y = x, y
        self.way = []
        self._goals.publish(goal)

    def go(self, x: float, y: float) -> float:
        """Send it there and wait until it is; returns how long that took [simulated s]."""
        began, longest = self.time, 0.0
        self.send(x, y)
        while self.distance(x, y) > NEAR:
            if self.time - began > PATIENCE:
                raise TimeoutError(f"not at ({x:g}, {y:g}) after {PATIENCE:g} s")
            longest = max(longest, length(self.way))
            time.sleep(0.005)
        print(f"({x:g}, {y:g}): there after {self.time - began:.1f} s, {longest:.1f} m of path")
        return self.time - began

    def distance(self, x: float, y: float) -> float:
        """Return the distance from its present place [m]."""
        return math.inf if self.position is None else math.dist(self.position, (x, y))

    def _hear_odometry(self, message: Any) -> None:
        place = message.pose.pose.position
        self.position, self.time = (place.x, place.y), message.header.stamp.to_sec()

    def _hear_path(self, message: Any) -> None:
        self.way = [(each.pose.position.x, each.pose.position.y) for each in message.poses]


def length(way: list[tuple[float, float]]) -> float:
    """Return the length of a path [m]."""
    return sum(math.dist(a, b) for a, b in pairwise(way))


def main() -> int:
    """Start the simulator, visit the goals, end it."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--goal", nargs=2, type=float, action="append", metavar=("X", "Y"))
    parser.add_argument("--rate", type=float, help="real-time factor; by default as fast as it can")
    args = parser.parse_args()
    with (
        Master(port=0) as master,
        SimulatorProcess(
            "office", robots=["courier"], rate=args.rate, master_uri=master.uri
        ) as simulator,
    ):
        robot = OfficeRobot(simulator.gazebo.node)
        robot.wait()
        total = sum(robot.go(x, y) for x, y in args.goal or GOALS)
        print(f"all goals visited in {total:.1f} s of simulated time")
    return 0


if __name__ == "__main__":
    sys.exit(main())

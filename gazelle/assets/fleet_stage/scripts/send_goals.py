#!/usr/bin/env python3
"""Send AGVs to goals by the actions of their own move_base, all at once.

gazelle launch fleet_stage depot.launch goals:=true    # starts all, and this script
gazelle exec fleet_stage send_goals.py --rounds 3      # while depot.launch runs elsewhere
"""

import argparse
import sys
from typing import Any

from gazelle_ros import Node
from gazelle_ros.actions import GoalStatus, SimpleActionClient
from gazelle_ros.msgs import move_base_msgs

GOALS = [
    [(-1.0, 4.3), (5.5, 4.3), (-7.5, 4.3)],
    [(-1.0, -4.2), (-8.5, -3.0), (-4.0, -4.2)],
    [(8.0, 2.0), (-4.0, 0.0), (4.5, 0.5)],
    [(5.0, -4.0), (8.0, -3.0), (4.0, -3.5)],
]
"""Goals of each robot, in an aisle of its own: move_base does not know the plans of other robots, and
two that meet head-on in an aisle stop each other for good."""
PATIENCE = 600.0
"""Longest wait for a server or a result, by the wall clock [s]."""


def goal_at(x: float, y: float) -> Any:
    """Return a goal on the map."""
    goal = move_base_msgs.msg.MoveBaseGoal()
    goal.target_pose.header.frame_id = "map"
    goal.target_pose.pose.position.x, goal.target_pose.pose.position.y = x, y
    goal.target_pose.pose.orientation.w = 1.0
    return goal


def main() -> int:
    """Send them; the exit code is 0 if all goals were reached."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=1)
    options, _ = parser.parse_known_args()
    action, failed = move_base_msgs.msg.MoveBaseAction, 0
    with Node("/send_goals") as node:
        clients = [
            SimpleActionClient(node, f"/robot_{n}/move_base", action) for n in range(len(GOALS))
        ]
        for client in clients:
            if not client.wait_for_server(PATIENCE):
                sys.exit("a move_base does not come up")
        for number in range(options.rounds):
            goals = [places[number % len(places)] for places in GOALS]
            for client, goal in zip(clients, goals, strict=True):
                client.send_goal(goal_at(*goal))
            for n, (client, goal) in enumerate(zip(clients, goals, strict=True)):
                client.wait_for_result(PATIENCE)
                reached = client.get_state() == GoalStatus.SUCCEEDED
                failed += not reached
                print(f"robot_{n} to {goal}: {client.get_goal_status_text()}", flush=True)
    count = options.rounds * len(GOALS)
    print(f"{count - failed} of {count} goals reached", flush=True)
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())

"""The four actions of ``move_group``, and the topics that stop and attach."""

from __future__ import annotations

import threading
import time
from typing import Any

from gazelle.drop_in.moveit_client.session import LOG
from gazelle.planning import PlanOutcome
from gazelle_ros import names
from gazelle_ros.actions import GoalStatus, SimpleActionClient, TerminalState
from gazelle_ros.messages import Message, load_message, load_service
from gazelle_ros.msgs import moveit_msgs, std_msgs
from gazelle_ros.node import Node

_ACTIONS = {
    "move_group": "MoveGroup",
    "pickup": "Pickup",
    "place": "Place",
    "execute_trajectory": "ExecuteTrajectory",
}
_LOOK_S = 0.005


class MoveActions:
    """Sends goals, and waits for them.

    Args:
        node: On the graph.
        namespace: Of ``move_group``.
        wait: The longest wait for all its actions [s of the wall's clock]; for ever if 0.

    Raises:
        RuntimeError: An action is not there in time.
    """

    def __init__(self, node: Node, namespace: str, wait: float) -> None:
        self.node, self._namespace = node, namespace
        self._stops = node.advertise(
            self._name("trajectory_execution_event"), std_msgs.msg.String, queue_size=1
        )
        self._attaching = node.advertise(
            self._name("attached_collision_object"),
            moveit_msgs.msg.AttachedCollisionObject,
            queue_size=10,
        )
        self._clients = {
            name: SimpleActionClient(
                node, self._name(name), load_message(f"moveit_msgs/{kind}Action")
            )
            for name, kind in _ACTIONS.items()
        }
        until = time.monotonic() + wait if wait > 0.0 else float("inf")
        for name, client in self._clients.items():
            self._wait(name, client, until, wait)

    def _wait(self, name: str, client: SimpleActionClient, until: float, wait: float) -> None:
        pause = threading.Event()
        while not client.action_client.connected:
            if time.monotonic() > until or self.node.closed:
                raise RuntimeError(
                    f"Unable to connect to move_group action server '{name}' "
                    f"within allotted time ({wait:g}s)"
                )
            pause.wait(_LOOK_S)

    def _name(self, name: str) -> str:
        return names.join(self._namespace, name)

    def send(self, action: str, goal: Message) -> None:
        """Send a goal, and do not wait."""
        self._clients[action].send_goal(goal)

    def run(self, action: str, goal: Message) -> Any:
        """Send a goal and wait for its result; its error code is the outcome."""
        client = self._clients[action]
        client.send_goal(goal)
        client.wait_for_result()
        if client.get_state() != GoalStatus.SUCCEEDED:
            state = TerminalState.to_string(client.get_state())
            LOG.info("%s: %s: %s", action, state, client.get_goal_status_text())
        result = client.get_result()
        if result is None:  # recalled before it was begun, or the node ends
            none: Any = load_message(f"moveit_msgs/{_ACTIONS[action]}Result")()
            none.error_code.val = int(PlanOutcome.PREEMPTED)
            return none
        return result

    def call(self, service: str, kind: str, **fields: Any) -> Any:
        """Call a service of ``moveit_msgs``.

        Raises:
            RosError: It is not there, or has failed.
        """
        found = load_service(f"moveit_msgs/{kind}")
        client = self.node.client(self._name(service), found)
        return client.call(found._request_class(**fields))

    def stop(self) -> None:
        """Stop what is moving."""
        self._stops.publish(std_msgs.msg.String(data="stop"))

    def attach(self, message: moveit_msgs.msg.AttachedCollisionObject) -> None:
        """Publish an ``AttachedCollisionObject``."""
        self._attaching.publish(message)

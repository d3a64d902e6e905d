"""Common context of all services and actions of ``move_group``."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from typing import Any

from gazelle.array_types import Floats
from gazelle.bridges.moveit.capabilities import Capabilities
from gazelle.bridges.moveit.constraint_messages import constraints_of_message
from gazelle.bridges.moveit.description import margins_of_parameters, robot_of_parameters
from gazelle.bridges.moveit.error_codes import WithErrorCodeT
from gazelle.bridges.moveit.frames import PlanningFrames
from gazelle.bridges.moveit.held_objects import scene_in_state
from gazelle.bridges.moveit.robot_states import JointStateMonitor, state_of_message
from gazelle.errors import Error, PlanningError
from gazelle.kinematics import JointModelGroup, RobotModel
from gazelle.planning import ConstraintSet, NoPlanError, PlanningScene, PlanOutcome
from gazelle_ros.messages import ServiceDefinition
from gazelle_ros.msgs import moveit_msgs
from gazelle_ros.node import Node

LOG = logging.getLogger("gazelle.planning")


class PlanningContext:
    """A robot of the parameter server, its scene, and where it is.

    Args:
        node: On the graph.

    Attributes:
        scene: Planning scene; use it only while holding ``lock``.
        lock: Questions and changes come one at a time, and are short.
        planned: The scene that plans are made in, so that nothing waits for a plan; use it only while
            holding ``planning``, and have it follow ``scene`` before.
        planning: Plans come one at a time; take it before ``lock``.
        monitor: State of the joints.
        frames: Frames of messages.
        capabilities: Available services and actions.

    Raises:
        Error: There is no description of a robot, or it cannot be read.
    """

    def __init__(self, node: Node) -> None:
        self.node = node
        self.capabilities = Capabilities(node)
        self.robot: RobotModel = robot_of_parameters(node)
        padding, scale = margins_of_parameters(node, self.robot)
        self.scene = PlanningScene(self.robot, padding=padding, scale=scale)
        self.lock = threading.RLock()
        self.planned = self.scene.copy()
        self.planning = threading.Lock()
        self.monitor = JointStateMonitor(node, self.robot)
        self.frames = PlanningFrames(node, self.scene)

    def serve(self, name: str, kind: type[ServiceDefinition], act: Callable[[Any], Any]) -> None:
        """Advertise a service, if it is one of the capabilities."""
        if name in self.capabilities:
            self.node.serve(name, kind, act)

    def now(self) -> int:
        """Return the graph's time [ns]."""
        return self.node.clock.now()

    def refresh(self) -> None:
        """Wait until it is known where the robot is now, not where it was a moment ago.

        Do not hold ``lock`` meanwhile.
        """
        self.monitor.refresh(self.now())

    def current(self) -> Floats:
        """Return the robot's joint positions, shape (variables,), and store them in the scene."""
        state = self.monitor.current()
        self.scene.state = state.copy()
        return state

    def state(self, message: moveit_msgs.msg.RobotState) -> Floats:
        """Convert a ``moveit_msgs/RobotState``; missing values are the present ones.

        Raises:
            NoPlanError: It names what is not there.
        """
        return state_of_message(self.robot, message, self.current())

    def scene_in(self, message: moveit_msgs.msg.RobotState, state: Floats) -> PlanningScene:
        """Return the scene with attached objects of a ``moveit_msgs/RobotState``; hold ``lock``.

        Raises:
            NoPlanError: Something cannot be held.
        """
        return scene_in_state(self.scene, self.frames, message, state)

    def group(self, name: str) -> JointModelGroup:
        """Return a group.

        Raises:
            NoPlanError: There is none of that name.
        """
        try:
            return self.robot.group(name)
        except PlanningError as error:
            raise NoPlanError(error.message, PlanOutcome.INVALID_GROUP_NAME, error.hint) from None

    def constraints(self, message: moveit_msgs.msg.Constraints, state: Floats) -> ConstraintSet:
        """Convert a ``moveit_msgs/Constraints``; its links and joints must exist.

        Raises:
            NoPlanError: One is invalid.
        """
        made = constraints_of_message(message, self.frames, state)
        try:
            made.check(self.robot)
        except PlanningError as error:
            outcome = PlanOutcome.INVALID_GOAL_CONSTRAINTS
            raise NoPlanError(error.message, outcome, error.hint) from None
        return made

    def answer(
        self, response: WithErrorCodeT, act: Callable[[WithErrorCodeT], None], what: str
    ) -> WithErrorCodeT:
        """Fill a response that has an error code, holding ``lock``; see ``coded``."""

        def hold(response: WithErrorCodeT) -> None:
            with self.lock:
                act(response)

        return self.coded(response, hold, what)

    @staticmethod
    def coded(
        response: WithErrorCodeT, act: Callable[[WithErrorCodeT], None], what: str
    ) -> WithErrorCodeT:
        """Fill a response that has an error code; what goes wrong becomes that code.

        Args:
            response: Of a service, or a result of an action.
            act: Fills it.
            what: For the log.
        """
        try:
            response.error_code.val = int(PlanOutcome.SUCCESS)
            act(response)
        except NoPlanError as error:
            LOG.error("%s: %s", what, error)  # noqa: TRY400  a bad request needs no traceback
            response.error_code.val = int(error.outcome)
        except Error as error:
            LOG.error("%s: %s", what, error)  # noqa: TRY400
            response.error_code.val = int(PlanOutcome.FAILURE)
        return response

"""Controllers that move a robot: from the parameter ``controller_list``, or a controller manager."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from gazelle.errors import PlanningError, RosError
from gazelle_ros.msgs import controller_manager_msgs
from gazelle_ros.node import Node

_LOG = logging.getLogger("gazelle.planning")
TRAJECTORY, GRIPPER = "FollowJointTrajectory", "GripperCommand"
FAKE = ("interpolate", "via points", "last point")
"""Types of MoveIt's fake controllers."""
_TIMEOUT_S = 5.0
_ACTIONS = {
    "JointTrajectoryController": ("follow_joint_trajectory", TRAJECTORY),
    "GripperActionController": ("gripper_cmd", GRIPPER),
    "ParallelGripperController": ("gripper_action", GRIPPER),
}
"""Of types of controllers: their action, and what its goals are."""


@dataclass(frozen=True, slots=True)
class ActionController:
    """A controller that takes goals over an action.

    Attributes:
        name: Its name.
        action: Of the action.
        kind: ``FollowJointTrajectory``, ``GripperCommand``, or one of ``FAKE``, which has no action.
        joints: Joints that it moves.
        effort: Greatest one of a gripper, where a trajectory says none.
        commanded: Joints of a gripper whose positions, added up, are its goal: one, or both of a parallel one.
        may_fail: Whether a gripper that ends anywhere has done its work (``allow_failure``).
    """

    name: str
    action: str
    kind: str
    joints: tuple[str, ...]
    effort: float = 0.0
    commanded: tuple[str, ...] = ()
    may_fail: bool = False


def controllers_of(node: Node) -> dict[str, ActionController]:
    """Return controllers by name.

    Those of the node's own ``controller_list``, as MoveIt's simple controller manager has them; without
    one, controllers of trajectories and grippers that the ``controller_manager`` of the namespace says
    are running.

    Raises:
        PlanningError: The list is malformed.
    """
    entries = node.get_param("~controller_list", None)
    if entries is None:
        return _running(node)
    if not isinstance(entries, list) or not all(isinstance(each, Mapping) for each in entries):
        raise PlanningError("the parameter 'controller_list' must be a list of controllers")
    # As MoveIt's fake manager has it; the simple one wants a type.
    fake = "fake" in str(node.get_param("~moveit_controller_manager", "")).lower()
    found = {}
    for each in entries:
        try:
            made = _entry({"type": FAKE[0], **each} if fake else each)
        except PlanningError as error:
            _LOG.error("%s", error)  # the others may do
        else:
            found[made.name] = made
    return found


def _entry(entry: Mapping[str, Any]) -> ActionController:
    name, kind = str(entry.get("name", "")), str(entry.get("type", ""))
    joints, space = entry.get("joints"), str(entry.get("action_ns", ""))
    # A controller without a name has a global action, as in configurations of ROS-Industrial.
    action = f"{name}/{space}" if space else name
    if not action or not isinstance(joints, list) or kind not in (TRAJECTORY, GRIPPER, *FAKE):
        raise PlanningError(
            f"the controller '{name}' of 'controller_list' has the type '{kind}' and the joints "
            f"{joints!r}",
            hint=f"name, type ({', '.join((TRAJECTORY, GRIPPER, *FAKE))}), action_ns and joints are needed",
        )
    effort = float(entry.get("max_effort", 0.0))
    names = tuple(map(str, joints))
    commanded = names if entry.get("parallel") else names[:1]
    if entry.get("command_joint") is not None:
        commanded = (str(entry["command_joint"]),)
    return ActionController(
        name, action, kind, names, effort, commanded, bool(entry.get("allow_failure"))
    )


def _running(node: Node) -> dict[str, ActionController]:
    service = "controller_manager/list_controllers"
    listing = controller_manager_msgs.srv.ListControllers
    try:
        answer = node.client(service, listing).call(listing._request_class(), timeout=_TIMEOUT_S)
    except RosError as error:
        _LOG.warning("there is no 'controller_list', and no controller manager: %s", error)
        return {}
    found = {}
    for each in answer.controller:
        kind = next((end for end in _ACTIONS if each.type.endswith(end)), None)
        if each.state != "running" or kind is None:
            continue
        claims = [joint for claim in each.claimed_resources for joint in claim.resources]
        joints = tuple(dict.fromkeys(claims))
        action, goal = _ACTIONS[kind]
        commanded = joints if goal == GRIPPER else ()
        found[each.name] = ActionController(
            each.name, f"{each.name}/{action}", goal, joints, commanded=commanded
        )
    return found

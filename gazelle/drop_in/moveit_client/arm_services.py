"""The node ``fetch_moveit``: four services that move an arm through ``move_group``.

They are those of ``fetch_train``, which openai_ros' tasks of Fetch call.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from typing import Any

from gazelle.drop_in.moveit_client.session import session
from gazelle.drop_in.moveit_commander import (
    MoveGroupCommander,
    MoveItCommanderException,
)
from gazelle.errors import PlanningError
from gazelle.planning import PlanOutcome
from gazelle_ros.builtin.arguments import parse_arguments, spin
from gazelle_ros.messages import load_service
from gazelle_ros.msgs import fetch_train
from gazelle_ros.node import Node

_GOOD = "Everything went OK"
_GROUP = "arm"


def main(arguments: Sequence[str]) -> int:
    """Serve the arm until shutdown; returns the exit code."""
    found = parse_arguments(arguments, "fetch_moveit")
    with found.start() as node:
        session.use(node)
        ArmServices(node)
        return spin(node)


class ArmServices:
    """Moves a group to poses and joint values, and reports its state.

    Args:
        node: Serves; its parameter ``~group`` names the group, and ``~use_orientation`` sets whether
            ``ee_traj_srv`` takes the whole orientation it is given, and not only ``w``, as the original.
            ``~max_velocity_scaling_factor`` and ``~max_acceleration_scaling_factor`` are 1 unless set,
            as in the MoveIt of that time.

    Raises:
        RuntimeError: There is no robot or no such group. For ``move_group`` it waits.
    """

    def __init__(self, node: Node) -> None:
        self._whole = bool(node.get_param("~use_orientation", False))
        group = str(node.get_param("~group", _GROUP))
        self._group = MoveGroupCommander(group, wait_for_servers=0.0)
        self._group.set_max_velocity_scaling_factor(_factor(node, "velocity"))
        self._group.set_max_acceleration_scaling_factor(_factor(node, "acceleration"))
        self._one = threading.Lock()
        served: tuple[tuple[str, str, Callable[[Any], dict[str, Any]]], ...] = (
            ("ee_traj_srv", "EeTraj", self._go_to_pose),
            ("joint_traj_srv", "JointTraj", self._go_to_joints),
            ("ee_pose_srv", "EePose", self._pose),
            ("ee_rpy_srv", "EeRpy", self._rpy),
        )
        for name, kind, act in served:
            node.serve(name, load_service(f"fetch_train/{kind}"), act)

    def _go_to_pose(self, request: fetch_train.srv.EeTrajRequest) -> dict[str, Any]:
        place, turn = request.pose.position, request.pose.orientation
        rest = [turn.x, turn.y, turn.z] if self._whole else [0.0, 0.0, 0.0]
        with self._one:
            self._group.set_pose_target([place.x, place.y, place.z, *rest, turn.w])
            return self._go()

    def _go_to_joints(self, request: fetch_train.srv.JointTrajRequest) -> dict[str, Any]:
        names = self._group.get_variables()
        values = list(request.point.positions)[: len(names)]
        if len(values) < len(names):
            text = f"{len(values)} positions are given to {len(names)} joints: {', '.join(names)}"
            return {"success": False, "message": text}
        with self._one:
            try:
                self._group.set_joint_value_target(values)
            except MoveItCommanderException:
                return {"success": False, "message": "positions are beyond the joints' limits"}
            return self._go()

    def _go(self) -> dict[str, Any]:
        """Plan and go; how that went."""
        success, trajectory, _, error = self._group.plan()
        if not success:
            return {"success": False, "message": f"there is no plan: {_words(error.val)}"}
        if not self._group.execute(trajectory):
            return {"success": False, "message": "the plan was not carried out to its end"}
        return {"success": True, "message": _GOOD}

    def _pose(self, _request: fetch_train.srv.EePoseRequest) -> dict[str, Any]:
        self._needs_state()
        return {"pose": self._group.get_current_pose().pose}

    def _rpy(self, _request: fetch_train.srv.EeRpyRequest) -> dict[str, Any]:
        """Return roll, pitch and yaw; like the original, pitch as ``y`` and yaw as ``p``."""
        self._needs_state()
        roll, pitch, yaw = self._group.get_current_rpy()
        return {"r": roll, "p": yaw, "y": pitch}

    def _needs_state(self) -> None:
        """Raise an error unless the robot's state is known.

        Raises:
            PlanningError: It is not.
        """
        if not self._group.get_current_joint_values():
            raise PlanningError("no message on 'joint_states' has the positions of the joints")


def _factor(node: Node, kind: str) -> float:
    return float(node.get_param(f"~max_{kind}_scaling_factor", 1.0))


def _words(outcome: int) -> str:
    known = outcome in {each.value for each in PlanOutcome}
    return f"{PlanOutcome(outcome).name} ({outcome})" if known else str(outcome)

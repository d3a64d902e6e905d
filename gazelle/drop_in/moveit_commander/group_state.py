"""The queries of ``MoveGroupCommander``: names, states, limits."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import Pose
from gazelle.drop_in.moveit_client.group_target import GroupTarget
from gazelle.drop_in.moveit_client.move_actions import MoveActions
from gazelle.drop_in.moveit_client.pose_targets import PoseTargets
from gazelle.drop_in.moveit_client.request_settings import RequestSettings
from gazelle.drop_in.moveit_client.robot_access import shared_robot
from gazelle.drop_in.moveit_client.session import LOG, session
from gazelle.drop_in.moveit_commander import conversions
from gazelle.drop_in.moveit_commander.exception import MoveItCommanderException
from gazelle_ros.messages import DeserializationError
from gazelle_ros.msgs import geometry_msgs, moveit_msgs


class GroupState:
    """A group, and what is known of it without a plan.

    Args:
        name: Of the group.
        robot_description: Parameter of the robot; its semantics' begins with it.
        ns: Namespace of ``move_group`` and ``joint_states``.
        wait_for_servers: The longest wait for ``move_group``'s actions [s]; for ever if 0.

    Raises:
        RuntimeError: There is no robot, no such group, or no ``move_group``.
    """

    def __init__(
        self,
        name: str,
        robot_description: str = "robot_description",
        ns: str = "",
        wait_for_servers: float = 5.0,
    ) -> None:
        self._access = shared_robot(robot_description, ns)
        names = self._access.names
        if name not in names.groups:
            text = f"Group '{name}' was not found."
            LOG.critical("%s There are: %s", text, ", ".join(names.groups))
            raise RuntimeError(text)
        self._name = name
        self._settings = RequestSettings(session.node(), robot_description, ns, name)
        self._joints = GroupTarget(self._access, name, self._settings.tolerances["joint"])
        self._poses = PoseTargets(names.chain_tip(name), self._access.robot.frame)
        self._remembered: dict[str, list[float]] = {}
        self._actions = MoveActions(session.node(), ns, wait_for_servers)
        LOG.info("Ready to take commands for planning group %s.", name)

    # -- names ---------------------------------------------------------------------------

    def get_name(self) -> str:
        """Return the name of the group."""
        return self._name

    def get_planning_frame(self) -> str:
        """Return the frame that is planned in."""
        return self._access.robot.frame

    def get_joints(self) -> list[str]:
        """Return joints of the group, fixed ones and those that follow others too."""
        return [joint.name for joint in self._access.names.group_joints(self._name)]

    def get_active_joints(self) -> list[str]:
        """Return joints of the group that can be moved by themselves."""
        return self._access.names.group_active(self._name)

    def get_variables(self) -> list[str]:
        """Return names of the group's variables."""
        return list(self._joints.variables)

    def get_variable_count(self) -> int:
        """Return the number of its variables."""
        return len(self._joints.variables)

    def get_end_effector_link(self) -> str:
        """Return the link that poses are of; empty if there is none."""
        return self._poses.link

    def has_end_effector_link(self) -> bool:
        """Return whether there is a link that poses are of."""
        return bool(self._poses.link)

    def get_pose_reference_frame(self) -> str:
        """Return the frame of poses that name none."""
        return self._poses.frame

    def set_pose_reference_frame(self, frame: str) -> None:
        """Set the frame of poses that name none."""
        self._poses.frame = frame

    def get_interface_description(self) -> moveit_msgs.msg.PlannerInterfaceDescription:
        """Return a ``PlannerInterfaceDescription``: which planners there are."""
        answer = self._actions.call("query_planner_interface", "QueryPlannerInterfaces")
        kind = moveit_msgs.msg.PlannerInterfaceDescription
        return answer.planner_interfaces[0] if answer.planner_interfaces else kind()

    # -- named and remembered postures ---------------------------------------------------

    def get_named_targets(self) -> list[str]:
        """Return names of the group's states in the SRDF."""
        return self._access.names.states(self._name)

    def get_named_target_values(self, name: str) -> dict[str, float]:
        """Return values by variable of a remembered or named state; empty if there is none."""
        if name in self._remembered:
            return dict(zip(self._joints.variables, self._remembered[name], strict=False))
        return dict(self._joints.group.states.get(name, {}))

    def remember_joint_values(self, name: str, values: Sequence[float] | None = None) -> None:
        """Store values of all variables under a name; the present ones by default."""
        given = self.get_current_joint_values() if values is None else values
        self._remembered[name] = [float(value) for value in given]

    def get_remembered_joint_values(self) -> dict[str, list[float]]:
        """Return all remembered values by name."""
        return {name: list(values) for name, values in self._remembered.items()}

    def forget_joint_values(self, name: str) -> None:
        """Discard the values of a name."""
        self._remembered.pop(name, None)

    # -- where it is ---------------------------------------------------------------------

    def start_state_monitor(self, wait: float = 1.0) -> bool:
        """Wait for the positions of all joints, at most some time [s]."""
        self._access.known(wait)
        return True

    def get_current_joint_values(self) -> list[float]:
        """Return positions of the group's variables now; empty if unknown."""
        state = self._access.current()
        if state is None:
            return []
        values: list[float] = state[self._columns()].tolist()
        return values

    def get_random_joint_values(self) -> list[float]:
        """Return positions of the group's variables drawn between their limits."""
        return self._joints.random()

    def get_current_pose(self, end_effector_link: str = "") -> geometry_msgs.msg.PoseStamped:
        """Return a ``PoseStamped``: where a link is now, the end effector's by default."""
        self._needs_link(
            end_effector_link, "the group has no end effector whose pose this could be"
        )
        return self._stamped(self._current_pose(end_effector_link))

    def get_random_pose(self, end_effector_link: str = "") -> geometry_msgs.msg.PoseStamped:
        """Return a ``PoseStamped`` that the group can reach."""
        self._needs_link(
            end_effector_link, "the group has no end effector whose pose this could be"
        )
        return self._stamped(self._random_pose(end_effector_link))

    def get_current_rpy(self, end_effector_link: str = "") -> list[float]:
        """Return ``[roll, pitch, yaw]`` of a link now [rad]; empty if that is not known."""
        self._needs_link(
            end_effector_link, "the group has no end effector whose angles these could be"
        )
        return self._current_rpy(end_effector_link)

    def get_current_state(self) -> moveit_msgs.msg.RobotState:
        """Return a ``RobotState`` of the whole robot now; without joints if that is not known."""
        state = self._access.current()
        if state is None:
            return moveit_msgs.msg.RobotState()
        return self._access.message(state)

    def get_current_state_bounded(self) -> moveit_msgs.msg.RobotState:
        """Return a ``RobotState`` of now, joints within their limits."""
        made = moveit_msgs.msg.RobotState()
        positions = self._bounded_positions()
        made.joint_state.header.frame_id = self.get_planning_frame()
        made.joint_state.name, made.joint_state.position = [*positions], [*positions.values()]
        return made

    def enforce_bounds(
        self, robot_state_msg: moveit_msgs.msg.RobotState
    ) -> moveit_msgs.msg.RobotState | None:
        """Return a ``RobotState`` with joints moved to their limits.

        Raises:
            DeserializationError: It names no joints.
        """
        return self._access.message(self._access.bounded(self._read(robot_state_msg)))

    def get_jacobian_matrix(
        self, joint_values: Sequence[float], reference_point: Sequence[float] | None = None
    ) -> Floats:
        """Return the Jacobian of a point of the last link, shape (6, variables).

        Args:
            joint_values: Of all variables of the group.
            reference_point: In the link's frame [m]; its origin if None.

        Raises:
            ValueError: The point has not three coordinates, or the group is no chain.
        """
        point = [0.0, 0.0, 0.0] if reference_point is None else [float(p) for p in reference_point]
        if len(point) != 3:
            raise ValueError(f"reference point needs to have 3 elements, got {len(point)}")
        tip = self._access.names.chain_tip(self._name)
        if not tip:
            raise ValueError(f"the group '{self._name}' is no chain, and has no Jacobian")
        robot, state = self._access.robot, self._access.default()
        columns = self._columns()
        state[columns] = np.asarray(joint_values, np.float64)
        state = robot.complete(state)
        base = robot.forward(state, self._access.names.group_joints(self._name)[0].parent)[:3, :3]
        whole = robot.jacobian(state, tip, point)
        return np.vstack([base.T @ whole[:3], base.T @ whole[3:]])[:, columns]

    # -- inner ---------------------------------------------------------------------------

    def _columns(self) -> Any:
        return self._access.robot.columns(self._joints.variables)

    def _needs_link(self, link: str, words: str) -> None:
        if not link and not self.has_end_effector_link():
            raise MoveItCommanderException(words)

    def _stamped(self, pose: Sequence[float]) -> geometry_msgs.msg.PoseStamped:
        return conversions.list_to_pose_stamped(pose, self.get_planning_frame())

    # -- what MoveIt's C++ class gives -----------------------------------------------------

    def _current_pose(self, end_effector_link: str = "") -> list[float]:
        """Return where a link is now: x, y, z, qx, qy, qz, qw."""
        return self._pose_list(self._access.current(), end_effector_link)

    def _random_pose(self, end_effector_link: str = "") -> list[float]:
        """Return where a link would be with drawn positions."""
        state = self._access.current()
        if state is not None:
            state[self._columns()] = self._joints.random()
            state = self._access.robot.complete(state)
        return self._pose_list(state, end_effector_link)

    def _current_rpy(self, end_effector_link: str = "") -> list[float]:
        """Return roll, pitch and yaw of a link [rad]; empty if that is not known."""
        state, link = self._access.current(), end_effector_link or self._poses.link
        if state is None or link not in self._access.robot.links:
            return []
        return list(self._access.robot.pose(state, link).rpy)

    def _bounded_positions(self) -> dict[str, float]:
        """Return positions of the whole robot by joint, within their limits."""
        state = self._access.current()
        if state is None:
            return {}
        made = self._access.message(self._access.bounded(state)).joint_state
        return dict(zip(made.name, made.position, strict=True))

    def _read(self, message: moveit_msgs.msg.RobotState) -> Floats:
        """Return the state of a ``RobotState``.

        Raises:
            DeserializationError: It names no joints.
        """
        read = self._access.with_message(message, self._access.default())
        if read is None:
            raise DeserializationError("the state names no joints")
        return read

    def _pose_list(self, state: Floats | None, link: str) -> list[float]:
        """Return the pose of a link; the origin, as in MoveIt, where it is not known."""
        name = link or self._poses.link
        if not name:
            LOG.error("No end-effector specified")
        if state is None or name not in self._access.robot.links:
            return _listed(Pose())
        return _listed(self._access.robot.pose(state, name))


def _listed(pose: Pose) -> list[float]:
    return [*pose.position, *pose.quaternion]

"""The part of ``MoveGroupCommander`` that names, and says how to plan."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from gazelle.bridges.moveit.client.move_group_interface import MoveGroupInterface
from gazelle.bridges.moveit.client.session import packed, unpacked
from gazelle.bridges.moveit.modules.moveit_commander.delegation import PassedOn
from gazelle.bridges.moveit.modules.moveit_commander.exception import MoveItCommanderException

_same = partial(PassedOn, "_g", MoveGroupInterface)
_FLAT, _SOLID = 4, 6


class CommanderSettings:
    """State and settings of a commander, which are sent to ``move_group`` with each request."""

    _g: MoveGroupInterface

    get_name = _same()
    get_active_joints = _same()
    get_joints = _same()
    get_variable_count = _same()
    get_planning_frame = _same()
    get_end_effector_link = _same()
    get_pose_reference_frame = _same()
    set_pose_reference_frame = _same()
    get_current_joint_values = _same()
    get_random_joint_values = _same()
    get_jacobian_matrix = _same()
    get_joint_value_target = _same()
    set_random_target = _same()
    clear_pose_target = _same()
    clear_pose_targets = _same()
    set_start_state_to_current_state = _same()
    get_named_targets = _same()
    get_named_target_values = _same()
    remember_joint_values = _same()
    get_remembered_joint_values = _same()
    forget_joint_values = _same()
    get_goal_joint_tolerance = _same()
    get_goal_position_tolerance = _same()
    get_goal_orientation_tolerance = _same()
    set_goal_joint_tolerance = _same()
    set_goal_position_tolerance = _same()
    set_goal_orientation_tolerance = _same()
    set_goal_tolerance = _same()
    allow_looking = _same()
    allow_replanning = _same()
    get_known_constraints = _same()
    clear_path_constraints = _same()
    clear_trajectory_constraints = _same()
    set_constraints_database = _same()
    set_planning_time = _same()
    get_planning_time = _same()
    set_planning_pipeline_id = _same()
    get_planning_pipeline_id = _same()
    set_planner_id = _same()
    get_planner_id = _same()
    set_num_planning_attempts = _same()
    clear_max_cartesian_link_speed = _same()
    set_support_surface_name = _same()
    detach_object = _same()
    stop = _same()

    def has_end_effector_link(self) -> bool:
        """Return whether there is an end effector link."""
        return bool(self._g.get_end_effector_link())

    def set_end_effector_link(self, link_name: str) -> None:
        """Set the link that poses are of.

        Raises:
            MoveItCommanderException: The group is no chain, and has none.
        """
        if not self._g.set_end_effector_link(link_name):
            raise MoveItCommanderException(f"no link is called '{link_name}'")

    def get_interface_description(self) -> Any:
        """A ``PlannerInterfaceDescription``: which planners there are."""
        return unpacked(
            "moveit_msgs/PlannerInterfaceDescription", self._g.get_interface_description()
        )

    def construct_motion_plan_request(self) -> Any:
        """A ``MotionPlanRequest`` of all that is set."""
        return unpacked("moveit_msgs/MotionPlanRequest", self._g.construct_motion_plan_request())

    def set_start_state(self, msg: Any) -> None:
        """Let plans begin at a ``RobotState``."""
        self._g.set_start_state(packed(msg))

    def get_goal_tolerance(self) -> tuple[float, float, float]:
        """Tolerances of joints [m or rad], positions [m] and orientations [rad]."""
        return (
            self._g.get_goal_joint_tolerance(),
            self._g.get_goal_position_tolerance(),
            self._g.get_goal_orientation_tolerance(),
        )

    # -- constraints ---------------------------------------------------------------------

    def get_path_constraints(self) -> Any:
        """The ``Constraints`` that hold all along."""
        return unpacked("moveit_msgs/Constraints", self._g.get_path_constraints())

    def set_path_constraints(self, value: Any) -> None:
        """Set ``Constraints`` that hold all along, none, or those of a name in a database.

        Raises:
            MoveItCommanderException: There is none of that name.
        """
        if value is None:
            self._g.clear_path_constraints()
        elif not isinstance(value, str):
            self._g.set_path_constraints_from_msg(packed(value))
        elif not self._g.set_path_constraints(value):
            raise MoveItCommanderException(f"no path constraints are stored as {value}")

    def get_trajectory_constraints(self) -> Any:
        """The ``TrajectoryConstraints``."""
        return unpacked("moveit_msgs/TrajectoryConstraints", self._g.get_trajectory_constraints())

    def set_trajectory_constraints(self, value: Any) -> None:
        """Set ``TrajectoryConstraints``, or none."""
        if value is None:
            self._g.clear_trajectory_constraints()
        else:
            self._g.set_trajectory_constraints_from_msg(packed(value))

    # -- limits --------------------------------------------------------------------------

    def set_max_velocity_scaling_factor(self, value: float) -> None:
        """Set the factor of velocity limits, within (0, 1].

        Raises:
            MoveItCommanderException: It is not within.
        """
        self._g.set_max_velocity_scaling_factor(_factor(value))

    def set_max_acceleration_scaling_factor(self, value: float) -> None:
        """Set the factor of acceleration limits, within (0, 1]; see the one of velocity."""
        self._g.set_max_acceleration_scaling_factor(_factor(value))

    def limit_max_cartesian_link_speed(self, speed: float, link_name: str = "") -> None:
        """Set how fast a link may be [m/s].

        Raises:
            MoveItCommanderException: It is not above zero.
        """
        if not speed > 0.0:
            raise MoveItCommanderException(f"a speed is more than 0 m/s, not {speed}")
        self._g.limit_max_cartesian_link_speed(speed, link_name)

    def set_workspace(self, ws: Sequence[float]) -> None:
        """Set the box within which a robot that drives may be [m].

        Args:
            ws: Nothing, ``[minX, minY, maxX, maxY]`` or ``[minX, minY, minZ, maxX, maxY, maxZ]``.

        Raises:
            MoveItCommanderException: It is another number of values.
        """
        if len(ws) not in (0, _FLAT, _SOLID):
            raise MoveItCommanderException(
                f"a workspace has 4 or 6 numbers, or none, not {len(ws)}"
            )
        corners = [0.0] * _SOLID if not ws else list(ws)
        if len(corners) == _FLAT:
            corners = [*corners[:2], 0.0, *corners[2:], 0.0]
        a, b, c, d, e, f = corners
        self._g.set_workspace(a, b, c, d, e, f)

    # -- inner ---------------------------------------------------------------------------

    def _in_frame(self, frame: str | None, act: Callable[[], bool]) -> bool:
        """Do something with another reference frame; the one of now if None."""
        old = self._g.get_pose_reference_frame()
        if frame is not None:
            self._g.set_pose_reference_frame(frame)
        try:
            return act()
        finally:
            self._g.set_pose_reference_frame(old)


def _factor(value: float) -> float:
    if not 0.0 < value <= 1.0:
        raise MoveItCommanderException(f"a scaling factor is between 0 and 1, not {value}")
    return value

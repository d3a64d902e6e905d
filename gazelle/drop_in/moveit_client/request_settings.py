"""Settings of a client's planning requests besides the goal: times, factors, planners, constraints."""

from __future__ import annotations

from gazelle.bridges.moveit.description import DESCRIPTION, find_parameter
from gazelle.drop_in.moveit_client.session import LOG
from gazelle_ros import names
from gazelle_ros.base.real_numbers import real
from gazelle_ros.msgs import moveit_msgs
from gazelle_ros.node import Node

_FACTOR = 0.1
_TOLERANCES = {"joint": 1e-4, "position": 1e-4, "orientation": 1e-3}


class RequestSettings:
    """Settings that go into each request; at first those of the parameters of the group.

    Args:
        node: Reads the parameters.
        description: Parameter of the robot; theirs begin with it.
        namespace: Of ``move_group``.
        group: Name of the group.

    Attributes:
        tolerances: Of goals: ``joint`` [m or rad], ``position`` [m], ``orientation`` [rad].
        factors: Of the limits of ``velocity`` and ``acceleration``.
        time: To plan [s].
        attempts: Number of planning attempts; the best counts.
        pipeline: Of planners.
        planner: Its name.
        start: A ``RobotState``.
        workspace: ``WorkspaceParameters``.
        path, trajectory: ``Constraints`` along the path, and ``TrajectoryConstraints``.
        look, replan: Whether to look around, and to plan again while moving.
        support: The surface that objects are put on.
    """

    def __init__(self, node: Node, description: str, namespace: str, group: str) -> None:
        self._node, self._namespace, self.group = node, namespace, group
        # A robot is described in its namespace, its settings beside it.
        self._description = description.rpartition("/")[2] or DESCRIPTION
        self.tolerances = {
            kind: self._number(f"_kinematics/{group}/goal_{kind}_tolerance", default)
            for kind, default in _TOLERANCES.items()
        }
        self.factors = {kind: self._default(kind) for kind in ("velocity", "acceleration")}
        self.time, self.attempts = 5.0, 1
        self.pipeline = self.planner = self.support = ""
        self.start = here()
        self.workspace = moveit_msgs.msg.WorkspaceParameters()
        self.path: moveit_msgs.msg.Constraints | None = None
        self.trajectory: moveit_msgs.msg.TrajectoryConstraints | None = None
        self.look = self.replan = False
        self.fastest: tuple[str, float] = ("", 0.0)

    def _default(self, kind: str) -> float:
        return self._number(f"_planning/default_{kind}_scaling_factor", _FACTOR)

    def _number(self, name: str, default: float) -> float:
        full = names.join(self._namespace, f"{self._description}{name}")
        found = find_parameter(self._node, full, default)
        number = real(found)
        return default if number is None else number

    def set_factor(self, kind: str, value: float) -> None:
        """Set a factor: at most 1, and the default where it is not above zero."""
        if value > 1.0:
            LOG.warning("Limiting max_%s_scaling_factor (%.2f) to 1.0.", kind, value)
        if value < 0.0:
            LOG.warning("max_%s_scaling_factor < 0.0! Setting to default.", kind)
        self.factors[kind] = min(float(value), 1.0) if value > 0.0 else self._default(kind)

    def set_workspace(self, corners: tuple[float, ...], frame: str) -> None:
        """Set the box within which a robot that drives may be: three lower and three upper ends [m]."""
        self.workspace = moveit_msgs.msg.WorkspaceParameters()
        self.workspace.header.frame_id = frame
        for corner, values in (
            (self.workspace.min_corner, corners[:3]),
            (self.workspace.max_corner, corners[3:]),
        ):
            corner.x, corner.y, corner.z = values

    def request(
        self, goals: list[moveit_msgs.msg.Constraints]
    ) -> moveit_msgs.msg.MotionPlanRequest:
        """Return a ``moveit_msgs/MotionPlanRequest`` for any of some goals."""
        made = moveit_msgs.msg.MotionPlanRequest(
            group_name=self.group,
            num_planning_attempts=self.attempts,
            max_velocity_scaling_factor=self.factors["velocity"],
            max_acceleration_scaling_factor=self.factors["acceleration"],
            allowed_planning_time=self.time,
            pipeline_id=self.pipeline,
            planner_id=self.planner,
            workspace_parameters=self.workspace,
            start_state=self.start,
            goal_constraints=goals,
        )
        made.cartesian_speed_limited_link, made.max_cartesian_speed = self.fastest
        if self.path is not None:
            made.path_constraints = self.path
        if self.trajectory is not None:
            made.trajectory_constraints = self.trajectory
        return made

    def options(self, *, plan_only: bool) -> moveit_msgs.msg.PlanningOptions:
        """Return ``moveit_msgs/PlanningOptions`` that leave the scene unchanged."""
        made = moveit_msgs.msg.PlanningOptions(
            plan_only=plan_only,
            look_around=self.look,
            replan=self.replan,
            replan_delay=_REPLAN_DELAY_S,
        )
        made.planning_scene_diff.is_diff = made.planning_scene_diff.robot_state.is_diff = True
        return made


_REPLAN_DELAY_S = 2.0


def here() -> moveit_msgs.msg.RobotState:
    """Return the ``RobotState`` that stands for the robot's present state."""
    made = moveit_msgs.msg.RobotState()
    made.is_diff = True
    return made

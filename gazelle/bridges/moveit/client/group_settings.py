"""The part of ``MoveGroupInterface`` that says how to plan."""

from __future__ import annotations

from gazelle.bridges.moveit.client.group_targets import GroupTargets
from gazelle.bridges.moveit.client.session import LOG, packed, unpacked
from gazelle.ros.messages import load_message


class GroupSettings(GroupTargets):
    """Planning settings of a group: tolerances, times, factors, planners, constraints."""

    # -- tolerances ----------------------------------------------------------------------

    def get_goal_joint_tolerance(self) -> float:
        """Of joints [m or rad]."""
        return self._settings.tolerances["joint"]

    def get_goal_position_tolerance(self) -> float:
        """Of positions: radius of a sphere [m]."""
        return self._settings.tolerances["position"]

    def get_goal_orientation_tolerance(self) -> float:
        """About each axis [rad]."""
        return self._settings.tolerances["orientation"]

    def set_goal_joint_tolerance(self, value: float) -> None:
        """Set that of joints."""
        self._settings.tolerances["joint"] = float(value)

    def set_goal_position_tolerance(self, value: float) -> None:
        """Set that of positions."""
        self._settings.tolerances["position"] = float(value)

    def set_goal_orientation_tolerance(self, value: float) -> None:
        """Set that of orientations."""
        self._settings.tolerances["orientation"] = float(value)

    def set_goal_tolerance(self, value: float) -> None:
        """Set all three."""
        self._settings.tolerances = dict.fromkeys(self._settings.tolerances, float(value))

    # -- planning ------------------------------------------------------------------------

    def set_planning_time(self, seconds: float) -> None:
        """Set the time to plan; what is not above zero changes nothing."""
        if seconds > 0.0:
            self._settings.time = float(seconds)

    def get_planning_time(self) -> float:
        """The time to plan [s]."""
        return self._settings.time

    def set_num_planning_attempts(self, number: int) -> None:
        """Set how often to plan; the shortest counts."""
        self._settings.attempts = int(number)

    def set_planning_pipeline_id(self, name: str) -> None:
        """Set the pipeline; another one has other planners."""
        if name != self._settings.pipeline:
            self._settings.pipeline, self._settings.planner = name, ""

    def get_planning_pipeline_id(self) -> str:
        """The pipeline; empty for ``move_group``'s default."""
        return self._settings.pipeline

    def set_planner_id(self, name: str) -> None:
        """Set the planner."""
        self._settings.planner = name

    def get_planner_id(self) -> str:
        """The planner; empty for the group's default."""
        return self._settings.planner

    def set_max_velocity_scaling_factor(self, value: float) -> None:
        """Set the factor of velocity limits."""
        self._settings.set_factor("velocity", value)

    def set_max_acceleration_scaling_factor(self, value: float) -> None:
        """Set the factor of acceleration limits."""
        self._settings.set_factor("acceleration", value)

    def limit_max_cartesian_link_speed(self, speed: float, link_name: str = "") -> None:
        """Set how fast a link may be [m/s]."""
        self._settings.fastest = (link_name, float(speed))

    def clear_max_cartesian_link_speed(self) -> None:
        """Let links be as fast as joints are."""
        self._settings.fastest = ("", 0.0)

    def set_workspace(
        self, minx: float, miny: float, minz: float, maxx: float, maxy: float, maxz: float
    ) -> None:
        """Set the box within which a robot that drives may be [m]."""
        corners = (float(minx), float(miny), float(minz), float(maxx), float(maxy), float(maxz))
        self._settings.set_workspace(corners, self.get_planning_frame())

    def allow_looking(self, value: bool) -> None:  # noqa: FBT001  # MoveIt's interface
        """Set whether to look around."""
        self._settings.look = bool(value)

    def allow_replanning(self, value: bool) -> None:  # noqa: FBT001
        """Set whether to replan while moving."""
        self._settings.replan = bool(value)

    def set_support_surface_name(self, name: str) -> None:
        """Set what objects stand on that are picked or placed."""
        self._settings.support = name

    # -- constraints ---------------------------------------------------------------------

    def set_path_constraints(self, name: str) -> bool:
        """Set constraints of a database; there is none, so this is always False."""
        LOG.error("there is no database with the constraints '%s'", name)
        return False

    def set_path_constraints_from_msg(self, message: bytes) -> None:
        """Set ``Constraints`` that hold all along."""
        self._settings.path = unpacked("moveit_msgs/Constraints", message)

    def get_path_constraints(self) -> bytes:
        """The ``Constraints`` that hold all along."""
        return packed(self._settings.path or load_message("moveit_msgs/Constraints")())

    def clear_path_constraints(self) -> None:
        """Let nothing hold all along."""
        self._settings.path = None

    def set_trajectory_constraints_from_msg(self, message: bytes) -> None:
        """Set ``TrajectoryConstraints``."""
        self._settings.trajectory = unpacked("moveit_msgs/TrajectoryConstraints", message)

    def get_trajectory_constraints(self) -> bytes:
        """The ``TrajectoryConstraints``."""
        return packed(
            self._settings.trajectory or load_message("moveit_msgs/TrajectoryConstraints")()
        )

    def clear_trajectory_constraints(self) -> None:
        """Forget them."""
        self._settings.trajectory = None

    def get_known_constraints(self) -> list[str]:
        """Names of constraints in a database; there is none."""
        return []

    def set_constraints_database(self, host: str, port: int) -> None:
        """Databases of constraints are not known."""
        LOG.warning("the database of constraints at %s:%s is not asked", host, port)

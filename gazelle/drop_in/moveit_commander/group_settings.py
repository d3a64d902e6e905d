"""The planning settings of ``MoveGroupCommander``."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.drop_in.moveit_client.session import LOG, copied
from gazelle.drop_in.moveit_commander.exception import MoveItCommanderException
from gazelle.drop_in.moveit_commander.group_targets import GroupTargets
from gazelle_ros.msgs import moveit_msgs

_FLAT, _SOLID = 4, 6


class GroupSettings(GroupTargets):
    """Tolerances, times, factors, planners and constraints; sent to ``move_group`` with each request."""

    # -- tolerances ----------------------------------------------------------------------

    def get_goal_joint_tolerance(self) -> float:
        """Return the tolerance of joints [m or rad]."""
        return self._settings.tolerances["joint"]

    def get_goal_position_tolerance(self) -> float:
        """Return the tolerance of positions: radius of a sphere [m]."""
        return self._settings.tolerances["position"]

    def get_goal_orientation_tolerance(self) -> float:
        """Return the tolerance about each axis [rad]."""
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

    def get_goal_tolerance(self) -> tuple[float, float, float]:
        """Return tolerances of joints [m or rad], positions [m] and orientations [rad]."""
        found = self._settings.tolerances
        return found["joint"], found["position"], found["orientation"]

    def set_goal_tolerance(self, value: float) -> None:
        """Set all three."""
        self._settings.tolerances = dict.fromkeys(self._settings.tolerances, float(value))

    # -- planning ------------------------------------------------------------------------

    def set_planning_time(self, seconds: float) -> None:
        """Set the time to plan; what is not above zero changes nothing."""
        if seconds > 0.0:
            self._settings.time = float(seconds)

    def get_planning_time(self) -> float:
        """Return the time to plan [s]."""
        return self._settings.time

    def set_num_planning_attempts(self, number: int) -> None:
        """Set how often to plan; the shortest counts."""
        self._settings.attempts = int(number)

    def set_planning_pipeline_id(self, name: str) -> None:
        """Set the pipeline; another one has other planners."""
        if name != self._settings.pipeline:
            self._settings.pipeline, self._settings.planner = name, ""

    def get_planning_pipeline_id(self) -> str:
        """Return the pipeline; empty for ``move_group``'s default."""
        return self._settings.pipeline

    def set_planner_id(self, name: str) -> None:
        """Set the planner."""
        self._settings.planner = name

    def get_planner_id(self) -> str:
        """Return the planner; empty for the group's default."""
        return self._settings.planner

    def clear_max_cartesian_link_speed(self) -> None:
        """Remove the limit of a link's speed."""
        self._settings.fastest = ("", 0.0)

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

    def get_path_constraints(self) -> moveit_msgs.msg.Constraints:
        """Return the ``Constraints`` that hold all along."""
        return copied(moveit_msgs.msg.Constraints, self._settings.path)

    def set_path_constraints(self, value: moveit_msgs.msg.Constraints | str | None) -> None:
        """Set ``Constraints`` that hold all along, none, or those of a name in a database.

        Raises:
            MoveItCommanderException: There is none of that name.
        """
        if value is None:
            self.clear_path_constraints()
        elif not isinstance(value, str):
            self._settings.path = copied(moveit_msgs.msg.Constraints, value)
        elif not self._use_stored(value):
            raise MoveItCommanderException(f"no path constraints are stored as {value}")

    def get_trajectory_constraints(self) -> moveit_msgs.msg.TrajectoryConstraints:
        """Return the ``TrajectoryConstraints``."""
        return copied(moveit_msgs.msg.TrajectoryConstraints, self._settings.trajectory)

    def set_trajectory_constraints(
        self, value: moveit_msgs.msg.TrajectoryConstraints | None
    ) -> None:
        """Set ``TrajectoryConstraints``, or none."""
        if value is None:
            self.clear_trajectory_constraints()
        else:
            self._settings.trajectory = copied(moveit_msgs.msg.TrajectoryConstraints, value)

    def clear_path_constraints(self) -> None:
        """Remove the path constraints."""
        self._settings.path = None

    def clear_trajectory_constraints(self) -> None:
        """Remove the ``TrajectoryConstraints``."""
        self._settings.trajectory = None

    def get_known_constraints(self) -> list[str]:
        """Return names of constraints in a database; there is none."""
        return []

    def set_constraints_database(self, host: str, port: int) -> None:
        """Do nothing: databases of constraints are not supported."""
        LOG.warning("the database of constraints at %s:%s is not asked", host, port)

    # -- limits --------------------------------------------------------------------------

    def set_max_velocity_scaling_factor(self, value: float) -> None:
        """Set the factor of velocity limits, within (0, 1].

        Raises:
            MoveItCommanderException: It is not within.
        """
        self._settings.set_factor("velocity", _factor(value))

    def set_max_acceleration_scaling_factor(self, value: float) -> None:
        """Set the factor of acceleration limits, within (0, 1]; see the one of velocity."""
        self._settings.set_factor("acceleration", _factor(value))

    def limit_max_cartesian_link_speed(self, speed: float, link_name: str = "") -> None:
        """Set how fast a link may be [m/s].

        Raises:
            MoveItCommanderException: It is not above zero.
        """
        if not speed > 0.0:
            raise MoveItCommanderException(f"a speed is more than 0 m/s, not {speed}")
        self._limit_link_speed(speed, link_name)

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
        self._set_workspace(*corners)

    # -- what MoveIt's C++ class does -------------------------------------------------------

    def _use_stored(self, name: str) -> bool:
        """Set constraints of a database; there is none, so this is always False."""
        LOG.error("there is no database with the constraints '%s'", name)
        return False

    def _set_velocity_factor(self, value: float) -> None:
        """Set the factor of velocity limits."""
        self._settings.set_factor("velocity", value)

    def _set_acceleration_factor(self, value: float) -> None:
        """Set the factor of acceleration limits."""
        self._settings.set_factor("acceleration", value)

    def _limit_link_speed(self, speed: float, link_name: str = "") -> None:
        """Set how fast a link may be [m/s]."""
        self._settings.fastest = (link_name, float(speed))

    def _set_workspace(self, *corners: float) -> None:
        """Set the box within which a robot that drives may be: three lower and three upper ends [m]."""
        self._settings.set_workspace(tuple(map(float, corners)), self.get_planning_frame())


def _factor(value: float) -> float:
    if not 0.0 < value <= 1.0:
        raise MoveItCommanderException(f"a scaling factor is between 0 and 1, not {value}")
    return value

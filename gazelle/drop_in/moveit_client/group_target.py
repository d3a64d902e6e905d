"""Joint targets of a group, as set by ``set_joint_value_target`` and similar."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import Pose
from gazelle.drop_in.moveit_client.robot_access import RobotAccess
from gazelle.drop_in.moveit_client.session import LOG
from gazelle.errors import PlanningError
from gazelle.kinematics import InverseKinematics
from gazelle_ros.msgs import moveit_msgs


class GroupTarget:
    """A state of the whole robot, of which a group's part is the goal.

    All setters return whether the value is within limits; it is set in any case, as in MoveIt, but
    for names that are not there.

    Args:
        access: The robot.
        group: Name of the group.

    Attributes:
        variables: Of the group, those that follow others too.
        state: Of all variables, shape (variables,).
        margin: By which limits may be exceeded [m or rad].
    """

    def __init__(self, access: RobotAccess, group: str, margin: float) -> None:
        self._access, self._robot, self.margin = access, access.robot, margin
        self.group = access.robot.group(group)
        self.variables = access.names.group_variables(group)
        self.state = access.default()
        self._random = np.random.default_rng()

    @property
    def values(self) -> list[float]:
        """Values of the group's variables."""
        values: list[float] = self.state[self._robot.columns(self.variables)].tolist()
        return values

    def set_all(self, values: Iterable[float]) -> bool:
        """Set all variables of the group, in order."""
        given = [float(each) for each in values]
        if len(given) != len(self.variables):
            LOG.error(
                "%d values are given to the %d variables of group '%s': %s",
                len(given), len(self.variables), self.group.name, ", ".join(self.variables),
            )  # fmt: skip
            return False
        self._put(dict(zip(self.variables, given, strict=True)))
        return self._access.within(self.state, self.variables, self.margin)

    def set_named(self, values: Mapping[str, float]) -> bool:
        """Set some variables of the group by name."""
        for name in values:
            if name not in self.variables:
                LOG.error("joint variable %s is not part of group %s", name, self.group.name)
                return False
        self._put(values)
        return self._access.within(self.state, self._robot.names, self.margin)

    def set_joint(self, joint: str, values: Sequence[float] | float) -> bool:
        """Set one joint of the group."""
        given = [float(values)] if np.ndim(values) == 0 else [float(v) for v in values]  # type: ignore[union-attr,arg-type]
        if joint not in self.variables or len(given) != 1:
            LOG.error("joint %s is not part of group %s", joint, self.group.name)
            return False
        self._put({joint: given[0]})
        return self._access.within(self.state, [joint], self.margin)

    def set_state(self, name: str) -> bool:
        """Set a named posture of the SRDF."""
        if name not in self.group.states:
            LOG.error("The requested named target '%s' does not exist", name)
            return False
        self._put(self.group.named(name))
        return True

    def set_random(self) -> None:
        """Set positions drawn between the limits."""
        self._put(dict(zip(self.variables, self.random(), strict=True)))

    def random(self) -> list[float]:
        """Return random positions of the group's variables within the limits."""
        state = self.state.copy()
        state[self.group.columns] = self.group.sample(self._random, 1)[0]
        drawn: list[float] = self._robot.complete(state)[
            self._robot.columns(self.variables)
        ].tolist()
        return drawn

    def set_pose(self, pose: Pose, link: str, start: Floats, *, approximate: bool) -> bool:
        """Set positions that put a link at a pose; whether there are any.

        Args:
            pose: In the frame that is planned in.
            link: Of the group.
            start: Start of the search, shape (variables,).
            approximate: To be content with less; MoveIt's usual solvers know no such thing.
        """
        self.state = self._access.bounded(start)
        if approximate:
            LOG.error("Kinematics of group '%s' have no approximate solutions", self.group.name)
            return False
        try:
            found = InverseKinematics(self._robot, self.group, link).solve(pose, self.state)
        except PlanningError as error:
            LOG.error("%s", error)
            return False
        if found is None:
            return False
        self.state[self.group.columns] = found
        self.state = self._robot.complete(self.state)
        return True

    def _put(self, values: Mapping[str, float]) -> None:
        """Set variables, and the joints that mimic them."""
        for name, value in values.items():
            self.state[self._robot.column(name)] = value
        self.state = self._robot.complete(self.state)

    def constraints(self, tolerance: float) -> moveit_msgs.msg.Constraints:
        """Return a ``moveit_msgs/Constraints`` with one joint constraint for each variable."""
        made = moveit_msgs.msg.Constraints()
        joint = moveit_msgs.msg.JointConstraint
        made.joint_constraints = [
            joint(
                joint_name=name,
                position=value,
                tolerance_above=tolerance,
                tolerance_below=tolerance,
                weight=1.0,
            )
            for name, value in zip(self.variables, self.values, strict=True)
        ]
        return made

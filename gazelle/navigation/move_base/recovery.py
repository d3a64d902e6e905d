"""Recovery behaviours for a blocked robot: clear obstacles, or rotate."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from gazelle.errors import Error, did_you_mean
from gazelle.navigation.angles import wrapped
from gazelle.navigation.costmap import Costmap
from gazelle.navigation.following import Pose2
from gazelle.navigation.planners.plugins import Velocity
from gazelle.navigation.planners.rollout import TrajectoryRollout
from gazelle_ros.base.parameter_values import Values, value_of


class RecoveryBehavior(ABC):
    """Something a robot does when it has no plan or no velocity.

    Args:
        name: Of the behaviour.
        whole: The global costmap.
        local: The local one.
        parameters: Parameters below its name.
    """

    def __init__(self, name: str, whole: Costmap, local: Costmap, parameters: Values) -> None:
        self.name, self.whole, self.local, self.parameters = name, whole, local, parameters

    @abstractmethod
    def begin(self, global_pose: Pose2, local_pose: Pose2) -> None:
        """Start, with the robot at a pose in each costmap's frame."""

    @abstractmethod
    def update(self, local_pose: Pose2) -> Velocity | None:
        """Return the velocity to have now; None when it is done."""


class ClearCostmapRecovery(RecoveryBehavior):
    """Forgets obstacles outside a square about the robot, or within.

    Parameters: ``reset_distance`` 3, ``layer_names``, ``affected_maps`` both,
    ``invert_area_to_clear`` false.
    """

    def begin(self, global_pose: Pose2, local_pose: Pose2) -> None:
        """Clear the costmaps, at once."""
        side = value_of(self.parameters, "reset_distance", 3.0)
        # "obstacles" is the original's; flat parameters make a layer of the other name.
        names = self.parameters.get("layer_names", ["obstacles", "obstacle_layer", "voxel_layer"])
        maps = value_of(self.parameters, "affected_maps", "both")
        outside = not value_of(self.parameters, "invert_area_to_clear", False)
        for which, costmap, pose in (
            ("global", self.whole, global_pose),
            ("local", self.local, local_pose),
        ):
            if maps in {which, "both"}:
                costmap.clear(pose, side, names, outside=outside)

    def update(self, local_pose: Pose2) -> Velocity | None:
        """Return None: it is done."""
        del local_pose
        return None


class RotateRecovery(RecoveryBehavior):
    """Turns once around, if there is room.

    Parameters: ``sim_granularity`` 0.017 rad. As in the original the others stand below
    ``~TrajectoryPlannerROS``, whichever planner is used: ``acc_lim_theta`` 3.2, ``max_vel_theta`` 1.0,
    ``min_in_place_vel_theta`` 0.4 (before Melodic ``acc_lim_th``, ``max_rotational_vel``,
    ``min_in_place_rotational_vel``), ``yaw_goal_tolerance`` 0.1.
    """

    def begin(self, global_pose: Pose2, local_pose: Pose2) -> None:
        """Start to turn, counter-clockwise."""
        del global_pose
        self._last = local_pose[2]
        self._left = 2.0 * math.pi

    def update(self, local_pose: Pose2) -> Velocity | None:
        """Return the velocity of the turn."""
        self._left -= wrapped(local_pose[2] - self._last)
        self._last = local_pose[2]
        if self._left < self._limit("yaw_goal_tolerance", "", 0.1) or not self._has_room(
            local_pose
        ):
            return None
        rate = math.sqrt(2.0 * self._limit("acc_lim_theta", "acc_lim_th", 3.2) * self._left)
        least = self._limit("min_in_place_vel_theta", "min_in_place_rotational_vel", 0.4)
        most = self._limit("max_vel_theta", "max_rotational_vel", 1.0)
        return 0.0, 0.0, min(max(rate, least), most)

    def _limit(self, name: str, before: str, default: float) -> float:
        """Return a parameter by its name of today or of before."""
        values = self.parameters
        key = before if before in values and name not in values else name
        return float(value_of(values, key, default))

    def _has_room(self, pose: Pose2) -> bool:
        """Return whether the rest of the turn is free of collisions."""
        costs = self.local.cells
        rollout = TrajectoryRollout(
            costs,
            self.local.origin,
            self.local.resolution,
            self.local.footprint,
            np.zeros((4, *costs.shape), np.int32),
            np.zeros(6),
            0.0,
        )
        step = max(value_of(self.parameters, "sim_granularity", 0.017), 1e-3)
        return rollout.can_turn(pose, min(self._left, 2.0 * math.pi), step)


MakeRecovery = Callable[[str, Costmap, Costmap, Values], RecoveryBehavior]
_ROTATE = "rotate_recovery/RotateRecovery"
_KINDS: dict[str, MakeRecovery] = {
    "clear_costmap_recovery/ClearCostmapRecovery": ClearCostmapRecovery,
    _ROTATE: RotateRecovery,
}


def register_recovery(kind: str, make: MakeRecovery) -> None:
    """Register a recovery behaviour under a type's name, in this process."""
    _KINDS[kind] = make


def make_recovery(
    entry: Mapping[str, Any], whole: Costmap, local: Costmap, values: Values, *, conservative: float
) -> RecoveryBehavior:
    """Return the behaviour of an entry ``{name, type}``.

    Args:
        entry: Name and type.
        whole: The global costmap.
        local: The local one.
        values: Parameters of ``move_base``; its own stand below its name.
        conservative: ``conservative_reset_dist`` [m].

    Raises:
        Error: The type is unknown.
    """
    name, kind = str(entry["name"]), str(entry["type"])
    if kind not in _KINDS:
        raise Error(f"the recovery type '{kind}' is unknown", hint=did_you_mean(kind, _KINDS))
    own = values.get(name)
    parameters: dict[str, Any] = dict(own) if isinstance(own, Mapping) else {}
    if name == "conservative_reset":
        parameters.setdefault("reset_distance", conservative)
    elif name == "aggressive_reset":
        parameters.setdefault("reset_distance", 4.0 * local.circumscribed)
    if kind == _ROTATE:
        base = values.get("TrajectoryPlannerROS")
        parameters = {**(base if isinstance(base, Mapping) else {}), **parameters}
    return _KINDS[kind](name, whole, local, parameters)

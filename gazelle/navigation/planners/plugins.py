"""Protocols of planners, and lookup of a planner by its type's name: built-in or the user's own.

Own planners are named as ``module:Class`` (``base_local_planner: my_package.planners:Mine``), or are
registered by the name of their type in this process (`register_global`, `register_local`).
"""

from __future__ import annotations

import importlib
import sys
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, cast

from gazelle.array_types import Floats
from gazelle.errors import Error, did_you_mean
from gazelle.navigation.costmap import Costmap
from gazelle.navigation.following import Pose2
from gazelle_ros.base.entry_points import UNIMPORTABLE

Values = Mapping[str, Any]
Velocity = tuple[float, float, float]
"""Along x and y [m/s], and turning [rad/s], in the robot's frame."""

STOP: Velocity = (0.0, 0.0, 0.0)


class GlobalPlannerPlugin(ABC):
    """Finds paths over a costmap.

    Args:
        name: Of the planner: the last part of its type.
        costmap: The global one.
        parameters: Parameters below its name.
    """

    def __init__(self, name: str, costmap: Costmap, parameters: Values) -> None:
        self.name, self.costmap, self.parameters = name, costmap, parameters

    @abstractmethod
    def make_plan(self, start: Pose2, goal: Pose2, tolerance: float | None = None) -> Floats:
        """Return a path in the frame of the costmap.

        Args:
            start: x, y [m] and heading [rad].
            goal: Likewise.
            tolerance: Tolerance of the goal [m]; the planner's own if None.

        Returns:
            Poses, shape (n, 3); (0, 3) if there is none.
        """


class LocalPlannerPlugin(ABC):
    """Follows a plan, around what turns up.

    Args:
        name: Of the planner: the last part of its type.
        costmap: The local one.
        parameters: Parameters below its name.
        period: Between two commands [s].

    Attributes:
        local_plan: Poses that the last command leads through, in the costmap's frame, shape (n, 3).
    """

    def __init__(self, name: str, costmap: Costmap, parameters: Values, period: float) -> None:
        self.name, self.costmap, self.parameters, self.period = name, costmap, parameters, period
        self.local_plan: Floats | None = None

    @abstractmethod
    def set_plan(self, plan: Floats) -> bool:
        """Set a plan in the global frame, shape (n, 3); returns whether it will be followed."""

    @abstractmethod
    def command(self, pose: Pose2, velocity: Velocity, to_local: Pose2) -> Velocity | None:
        """Return the velocity to go with now; None if there is none.

        Args:
            pose: In the costmap's frame.
            velocity: Velocity of the robot.
            to_local: The frame of the plan in the costmap's frame.
        """

    @abstractmethod
    def goal_reached(self, pose: Pose2, velocity: Velocity, to_local: Pose2) -> bool:
        """Return whether the end of the plan is reached, and the robot stands."""


MakeGlobal = Callable[[str, Costmap, Values], GlobalPlannerPlugin]
MakeLocal = Callable[[str, Costmap, Values, float], LocalPlannerPlugin]

_global: dict[str, MakeGlobal | str] = {
    "navfn/NavfnROS": "gazelle.navigation.planners.navfn:NavfnPlanner",
    "global_planner/GlobalPlanner": "gazelle.navigation.planners.global_planner:GlobalPlanner",
    "carrot_planner/CarrotPlanner": "gazelle.navigation.planners.carrot:CarrotPlanner",
}
_local: dict[str, MakeLocal | str] = {
    "dwa_local_planner/DWAPlannerROS": "gazelle.navigation.planners.dwa:DwaPlanner",
    "base_local_planner/TrajectoryPlannerROS": (
        "gazelle.navigation.planners.trajectory_planner:TrajectoryPlanner"
    ),
    "teb_local_planner/TebLocalPlannerROS": "gazelle.navigation.planners.teb:TebPlanner",
}
# Names of before packages were part of them.
_SHORT = {name.rpartition("/")[2]: name for name in (*_global, *_local)}


def register_global(kind: str, make: MakeGlobal) -> None:
    """Register a global planner under a type's name, in this process."""
    _global[kind] = make


def register_local(kind: str, make: MakeLocal) -> None:
    """Register a local planner under a type's name, in this process."""
    _local[kind] = make


def global_planner(kind: str) -> MakeGlobal:
    """Return the global planner of a type.

    Raises:
        Error: There is none, or its module cannot be imported.
    """
    return cast("MakeGlobal", _found(kind, _global, "global planner"))


def local_planner(kind: str) -> MakeLocal:
    """Return the local planner of a type.

    Raises:
        Error: There is none, or its module cannot be imported.
    """
    return cast("MakeLocal", _found(kind, _local, "local planner"))


def names_class(kind: str) -> bool:
    """Return whether a type is ``module:Class`` of Python, not ``namespace::Class`` of C++."""
    return ":" in kind and "::" not in kind


def _found(kind: str, table: Mapping[str, Any], what: str) -> Any:
    full = kind if kind in table else _SHORT.get(kind, kind)
    target = table.get(full, full)
    if not isinstance(target, str):
        return target
    if not names_class(target):
        hint = did_you_mean(kind, table)
        raise Error(
            f"there is no {what} of type '{kind}'",
            hint=f"{hint}; one of your own is named module:Class",
        )
    module, _, attribute = target.partition(":")
    here = str(Path.cwd())
    if here not in sys.path:
        # As Python itself does for a script: a planner may lie beside the launch file.
        sys.path.append(here)
    try:
        return getattr(importlib.import_module(module), attribute)
    except (*UNIMPORTABLE, AttributeError) as error:
        raise Error(f"the {what} '{kind}' cannot be imported: {error}") from error

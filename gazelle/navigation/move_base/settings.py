"""Parameters of ``move_base``, and the planners created from them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from gazelle.argument_checks import checked
from gazelle.errors import Error
from gazelle_ros.base.parameter_values import Values, fields_of

DEFAULT_RECOVERY = (
    {"name": "conservative_reset", "type": "clear_costmap_recovery/ClearCostmapRecovery"},
    {"name": "rotate_recovery", "type": "rotate_recovery/RotateRecovery"},
    {"name": "aggressive_reset", "type": "clear_costmap_recovery/ClearCostmapRecovery"},
    {"name": "rotate_recovery", "type": "rotate_recovery/RotateRecovery"},
)


@checked(Error)
@dataclass(frozen=True, slots=True)
class MoveBaseSettings:
    """Names and defaults are those of ``move_base``."""

    base_global_planner: str = "navfn/NavfnROS"
    base_local_planner: str = "base_local_planner/TrajectoryPlannerROS"
    planner_frequency: float = 0.0
    controller_frequency: float = 20.0
    planner_patience: float = 5.0
    controller_patience: float = 15.0
    max_planning_retries: int = -1
    oscillation_timeout: float = 0.0
    oscillation_distance: float = 0.5
    conservative_reset_dist: float = 3.0
    recovery_behavior_enabled: bool = True
    clearing_rotation_allowed: bool = True
    shutdown_costmaps: bool = False
    make_plan_clear_costmap: bool = True
    make_plan_add_unreachable_goal: bool = True

    @classmethod
    def read(cls, values: Values) -> MoveBaseSettings:
        """Read the parameters.

        Raises:
            Error: One is of the wrong kind, or the controller would never run.
        """
        return cls(**fields_of(cls, values))

    def __post_init__(self) -> None:
        if not self.controller_frequency > 0.0:
            raise Error("'controller_frequency' must be greater than zero")


def recoveries_of(values: Values, settings: MoveBaseSettings) -> list[Mapping[str, Any]]:
    """Return names and types of recovery behaviours, in their order.

    Raises:
        Error: An entry of ``recovery_behaviors`` is none, or a name stands there twice.
    """
    behaviors = values.get("recovery_behaviors")
    if behaviors is None:
        return [
            each
            for each in DEFAULT_RECOVERY
            if settings.clearing_rotation_allowed or "Rotate" not in each["type"]
        ]
    if not isinstance(behaviors, list):
        raise Error("'recovery_behaviors' is a list of entries {name: ..., type: ...}")
    names = set()
    for each in behaviors:
        if not isinstance(each, Mapping) or not {"name", "type"} <= set(each):
            raise Error(f"an entry of 'recovery_behaviors' has a name and a type, not {each!r}")
        if each["name"] in names:
            raise Error(f"the recovery behaviour '{each['name']}' is there twice")
        names.add(each["name"])
    return list(behaviors)

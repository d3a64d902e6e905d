"""All of ``move_base`` from its parameters."""

from __future__ import annotations

from dataclasses import dataclass

from gazelle.navigation.costmap import CostmapSetup, costmap_of
from gazelle.navigation.costmap.parameters import section
from gazelle.navigation.move_base.recovery import make_recovery
from gazelle.navigation.move_base.settings import MoveBaseSettings, recoveries_of
from gazelle.navigation.move_base.state_machine import MoveBase
from gazelle.navigation.planners.plugins import global_planner, local_planner
from gazelle_ros.base.parameter_values import Values, positive, value_of


@dataclass(frozen=True, slots=True)
class NavigationStack:
    """A ``move_base`` and its costmaps.

    Attributes:
        move_base: Takes the robot to goals.
        whole: The global costmap, and what feeds it.
        local: The local one.
        settings: Of ``move_base``.
    """

    move_base: MoveBase
    whole: CostmapSetup
    local: CostmapSetup
    settings: MoveBaseSettings

    @property
    def period(self) -> float:
        """Time between two cycles [s]."""
        return 1.0 / self.settings.controller_frequency


def navigation_stack(values: Values) -> NavigationStack:
    """Return the stack of some parameters, nested as on the parameter server below ``~``.

    Raises:
        Error: A parameter is wrong, or names something that is not there.
    """
    settings = MoveBaseSettings.read(values)
    whole = costmap_of(section(values, "global_costmap"), name="global_costmap", frame="map")
    local = costmap_of(section(values, "local_costmap"), name="local_costmap", frame="odom")
    kind = settings.base_global_planner
    name = kind.rpartition("/")[2].rpartition(":")[2]
    planner = global_planner(kind)(name, whole.costmap, section(values, name))
    kind = settings.base_local_planner
    name = kind.rpartition("/")[2].rpartition(":")[2]
    own = section(values, name)
    # The planner's own frequency counts where it is given, as in the original.
    rate = value_of(own, "controller_frequency", settings.controller_frequency)
    rate = positive(f"{name}/controller_frequency", rate)
    controller = local_planner(kind)(name, local.costmap, own, 1.0 / rate)
    recoveries = [
        make_recovery(
            entry,
            whole.costmap,
            local.costmap,
            values,
            conservative=settings.conservative_reset_dist,
        )
        for entry in recoveries_of(values, settings)
    ]
    return NavigationStack(
        MoveBase(settings, planner, controller, recoveries), whole, local, settings
    )

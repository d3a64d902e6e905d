"""A global planner on a graph: topics and service below its name."""

from __future__ import annotations

import threading
from collections.abc import Callable
from functools import partial

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Floats32
from gazelle.bridges.navigation.map_messages import grid_message
from gazelle.bridges.navigation.messages import path_message
from gazelle.description import Pose
from gazelle.description.occupancy import UNKNOWN, OccupancyMap
from gazelle.navigation.following import Pose2
from gazelle.navigation.planners.global_planner import GlobalPlanner, GlobalPlannerSettings
from gazelle.navigation.planners.navfn import NO_PLAN
from gazelle.navigation.planners.plugins import GlobalPlannerPlugin
from gazelle.navigation.planners.potential import NOT_REACHED
from gazelle_ros.builtin.tuned_settings import TunedSettings
from gazelle_ros.msgs import geometry_msgs, nav_msgs
from gazelle_ros.node import Node


class PlannerTopics:
    """Topics ``plan``, ``make_plan`` and, of `GlobalPlanner`, ``potential`` and its settings.

    Args:
        node: On the graph.
        planner: The planner.
        lock: Of the costmap and the planner.
        to_frame: Converts a pose to the planner's frame; None if it is not known.
    """

    def __init__(
        self,
        node: Node,
        planner: GlobalPlannerPlugin,
        lock: threading.RLock,
        to_frame: Callable[[geometry_msgs.msg.PoseStamped], Pose2 | None],
    ) -> None:
        self._node, self._planner = node, planner
        self._lock, self._to_frame = lock, to_frame
        name = f"~{planner.name}"
        self._plans = node.advertise(f"{name}/plan", nav_msgs.msg.Path, queue_size=1)
        node.serve(f"{name}/make_plan", nav_msgs.srv.GetPlan, self._make_plan)
        if isinstance(planner, GlobalPlanner):
            grid = nav_msgs.msg.OccupancyGrid
            self._potentials = node.advertise(f"{name}/potential", grid, queue_size=1)
            self._tune(planner, planner.settings)
            TunedSettings(node, planner.settings, partial(self._tune, planner), name)

    def _tune(self, planner: GlobalPlanner, settings: GlobalPlannerSettings) -> None:
        with self._lock:
            planner.settings, self._scale = settings, settings.publish_scale
            planner.on_potential = self._publish_potential if settings.publish_potential else None

    def publish(self, plan: Floats, now: int) -> None:
        """Publish a plan made at a time [ns]."""
        self._plans.publish(path_message(plan, self._planner.costmap.frame, now))

    def _publish_potential(self, potentials: Floats32) -> None:
        if not self._potentials.has_subscribers:
            return
        costmap = self._planner.costmap
        shown = scaled(potentials, self._scale)
        grid = OccupancyMap(shown, costmap.resolution, Pose(*costmap.origin))
        self._potentials.publish(grid_message(grid, costmap.frame, self._node.clock.now()))

    def _make_plan(self, request: nav_msgs.srv.GetPlanRequest) -> list[nav_msgs.msg.Path]:
        """Return a plan between two poses; empty if there is none."""
        now = self._node.clock.now()
        with self._lock:
            start, goal = self._to_frame(request.start), self._to_frame(request.goal)
            plan = NO_PLAN
            if start is not None and goal is not None:
                plan = self._planner.make_plan(start, goal)
            if len(plan):
                self.publish(plan, now)
            return [path_message(plan, self._planner.costmap.frame, now)]


def scaled(potentials: Floats32, scale: int) -> NDArray[np.int8]:
    """Return potentials as shares of the greatest one, times a scale; -1 where there is none."""
    reached = potentials < NOT_REACHED
    most = float(potentials[reached].max(initial=0.0))
    shown = np.full(potentials.shape, UNKNOWN, np.int8)
    if most > 0.0:
        shown[reached] = (potentials[reached] * (scale / most)).astype(np.int8)
    return shown

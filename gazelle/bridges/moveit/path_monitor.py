"""Check of the rest of a motion against changes of the scene."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager

import numpy as np

from gazelle.bridges.moveit.planning_context import PlanningContext
from gazelle.bridges.moveit.scene_services import SceneServices
from gazelle.planning import MotionPlan
from gazelle.planning.state_validity import StateValidity


class PathMonitor:
    """Looks at the rest of a path whenever the scene has changed.

    Args:
        context: The robot and its scene.
        services: Know when the scene changes.
        plan: Along which the robot moves.
        seen: The scene's revision that it was planned in.
        change: Of the scene, for this motion alone.

    Attributes:
        blocked: Whether something is in the way; it stays so.
    """

    def __init__(
        self,
        context: PlanningContext,
        services: SceneServices,
        plan: MotionPlan,
        seen: int,
        change: Callable[[], AbstractContextManager[None]],
    ) -> None:
        self._context, self._services, self._group = context, services, plan.group
        self._points, self._change = plan.trajectory.positions, change
        self._scene = context.scene.copy()
        self._seen, self._passed = seen, 0
        self.blocked = False

    def is_blocked(self) -> bool:
        """Return whether the rest of the path is blocked now."""
        if self._seen != self._services.revision and not self.blocked:
            with self._context.lock:
                self._seen = self._services.revision
                with self._change():
                    self._scene.follow(self._context.scene)
                state = self._context.current()
            here = state[self._group.columns]
            left = self._points[self._passed :]
            away = np.linalg.norm(self._group.difference(here, left), axis=1)
            self._passed += int(np.argmin(away))
            validity = StateValidity(self._scene, self._group, state)
            self.blocked = not validity.path(self._points[self._passed :])
        return self.blocked

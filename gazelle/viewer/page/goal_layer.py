"""Goals of the episodes that a task plays in the worlds of a page."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.viewer.page.context import ROOT, PageContext
from gazelle.viewer.page.shapes import extent_of_world

_RED = (220, 30, 30)
_SHARE = 0.02  # radius of a mark as a share of the world's longest side
_DISC, _BALL = (0.25, 1.0), (0.03, 0.25)  # least and largest radius on the ground and in space [m]
_THICK = 0.02  # height of a disc [m]
_UPRIGHT = (1.0, 0.0, 0.0, 0.0)

GoalPlaces = Callable[[], Floats | None]
"""Function that returns the goals in all worlds [m], shape (worlds * n, 2 or 3), world by world."""


class GoalLayer:
    """A disc on the ground at each goal in the plane, a ball at each goal in space.

    Args:
        context: Of the page.
        goals: Of the task.
    """

    def __init__(self, context: PageContext, goals: GoalPlaces) -> None:
        self._context, self._goals, self.shown = context, goals, True
        low, high = extent_of_world(context.simulation.world)
        self._radius = _SHARE * float((high - low).max())
        self._marks: Any = None
        self._drawn = b""

    def read(self) -> Floats:
        """Return the goals in the worlds of the page as (x, y) or (x, y, z) [m], shape (n, 2 or 3)."""
        goals = self._goals() if self.shown else None
        if goals is None:
            return np.zeros((0, 3))
        context = self._context
        of_world = goals.reshape(context.simulation.nworld, -1, goals.shape[1])[context.worlds]
        spots = context.spots[:, None, : goals.shape[1]]
        placed: Floats = (of_world + spots).reshape(-1, goals.shape[1])
        return placed

    def show(self, state: Floats) -> None:
        """Draw the goals that changed."""
        now = state.tobytes()
        if now == self._drawn:
            return
        flat = state.shape[1] == 2
        at = np.column_stack((state, np.full(len(state), _THICK / 2.0))) if flat else state
        if self._marks is not None and len(at) == len(self._marks.batched_positions):
            self._marks.batched_positions = at.astype(np.float32)
        else:
            if self._marks is not None:
                self._marks.remove()
            self._marks = self._made(at, flat=flat) if len(at) else None
        self._drawn = now

    def renew(self) -> None:
        """Do nothing: goals are looked up with every picture."""

    def _made(self, at: Floats, *, flat: bool) -> Any:
        from trimesh import creation

        radius = float(np.clip(self._radius, *(_DISC if flat else _BALL)))
        mark = creation.cylinder(radius, _THICK) if flat else creation.icosphere(2, radius)
        return self._context.scene.add_batched_meshes_simple(
            f"{ROOT}/task_goals",
            np.asarray(mark.vertices, np.float32),
            np.asarray(mark.faces, np.uint32),
            np.tile(_UPRIGHT, (len(at), 1)),
            at,
            batched_colors=_RED,
            batched_opacities=np.full(len(at), 0.7),
            lod="off",
            cast_shadow=False,
        )

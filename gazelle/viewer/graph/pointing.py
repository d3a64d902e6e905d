"""Places on the ground that users point at: with a click, or with a drag for a direction."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.viewer.graph.context import GraphContext

_REACH_M = 500.0
_NEAR = 0.015  # distance of a picked point from the ray, as a share of that from the camera
_CLICK_M = 0.05  # drags shorter than that have no direction


class GroundPointer:
    """An invisible ground that takes clicks and drags while a tool is in use.

    Args:
        context: Of the page.
        moved: Called while the user drags, with both ends on the ground [m], shape (3,).
        ended: Called at the end, with both ends; they are equal for a click.
        pick: Returns what a click takes in place of the ground, by the ray's origin and direction,
            or None.
    """

    def __init__(
        self,
        context: GraphContext,
        moved: Callable[[Floats, Floats], None],
        ended: Callable[[Floats, Floats], None],
        pick: Callable[[Floats, Floats], Floats | None],
    ) -> None:
        self._context, self._moved, self._ended, self._pick = context, moved, ended, pick
        self._ground: Any = None
        self._start: Floats | None = None

    def arm(self, *, armed: bool) -> None:
        """Take clicks and drags from now on, or leave them to the camera."""
        if armed and self._ground is None:
            corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float64)
            faces = np.array([[0, 1, 2], [0, 2, 3]])
            self._ground = self._context.scene.add_mesh_simple(
                "/pointing", _REACH_M * corners, faces, opacity=0.0, side="double",
                cast_shadow=False, receive_shadow=False,
            )  # fmt: skip
            self._ground.on_drag(self._drag)
            self._ground.on_click(self._click)
        elif not armed and self._ground is not None:
            self._ground.remove()
            self._ground = None

    async def _drag(self, event: Any) -> None:
        camera = np.array(event.client.camera.position)
        if event.phase == "start":
            self._start = on_ground(camera, np.array(event.start_position) - camera)
        end = on_ground(camera, np.array(event.end_position) - camera)
        if self._start is None or end is None:
            return
        if np.hypot(*(end - self._start)[:2]) < _CLICK_M:
            end = self._start
        (self._ended if event.phase == "end" else self._moved)(self._start, end)

    async def _click(self, event: Any) -> None:
        origin, direction = np.array(event.ray_origin), np.array(event.ray_direction)
        picked = self._pick(origin, direction)
        found = on_ground(origin, direction) if picked is None else picked
        if found is not None:
            self._ended(found, found)


def on_ground(origin: Floats, direction: Floats) -> Floats | None:
    """Return where a ray meets the ground [m], shape (3,), or None.

    >>> on_ground(np.array([0.0, 1.0, 2.0]), np.array([1.0, 0.0, -1.0])).tolist()
    [2.0, 1.0, 0.0]
    """
    if direction[2] == 0.0 or origin[2] / direction[2] >= 0.0:
        return None
    found: Floats = origin - direction * (origin[2] / direction[2])
    return found


def nearest_on_ray(origin: Floats, direction: Floats, points: Floats) -> Floats | None:
    """Return the first of some points that a ray meets or nearly meets [m], shape (3,), or None.

    Args:
        origin: Of the ray [m], shape (3,).
        direction: Of the ray, shape (3,).
        points: [m], shape (n, 3).
    """
    unit = direction / np.linalg.norm(direction)
    along = (points - origin) @ unit
    away = np.linalg.norm(points - origin - along[:, None] * unit, axis=1)
    near = np.flatnonzero((along > 0.0) & (away < _NEAR * along))
    if not len(near):
        return None
    found: Floats = points[near[np.argmin(along[near])]]
    return found

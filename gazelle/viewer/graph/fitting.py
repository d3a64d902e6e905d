"""Camera of the page: turned to all that is shown."""

from __future__ import annotations

import time

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import Vector3
from gazelle.rendering import PinholeLens
from gazelle.viewer.graph.context import GraphContext
from gazelle.viewer.scene_camera import distance_to_see

_ASIDE = np.array([-0.45, -0.6, 0.9])
_LENS = PinholeLens(400, 400, 1.25)  # about that of the page
_LEAST_M = 0.5  # half of the smallest box that the camera looks at
_SETTLE_S = 5.0  # after a page was opened, while its camera follows what becomes known


class ViewFitter:
    """Turns the cameras of all pages so that they see everything.

    Args:
        context: Of the page.
    """

    def __init__(self, context: GraphContext) -> None:
        self._context = context
        self._count, self._placed = 0, False
        self._since = time.monotonic()
        context.page.on_client_connect(self._begin)

    def fit(self, extent: Floats | None) -> None:
        """Look at a box.

        Args:
            extent: Lowest and highest corner [m], shape (2, 3); None does nothing.
        """
        if extent is None:
            return
        middle = extent.mean(axis=0)
        half = np.maximum((extent[1] - extent[0]) / 2.0, _LEAST_M)
        position = middle + _ASIDE * distance_to_see(half, _ASIDE, _LENS)
        for client in self._context.page.get_clients().values():
            with client.atomic():
                client.camera.up_direction = (0.0, 0.0, 1.0)
                client.camera.position = position
                client.camera.look_at = middle

    def place(self, position: Vector3, look_at: Vector3) -> None:
        """Look from one point to another [m], now and on pages that are opened later."""
        self._placed = True
        camera = self._context.page.initial_camera
        camera.position, camera.look_at = position, look_at
        for client in self._context.page.get_clients().values():
            with client.atomic():
                client.camera.position, client.camera.look_at = position, look_at

    def follow(self, extent: Floats | None, count: int) -> None:
        """Look at a box while the page is new and more is shown than before."""
        if not self._placed and count > self._count and time.monotonic() - self._since < _SETTLE_S:
            self._count = count
            self.fit(extent)

    async def _begin(self, _client: object) -> None:
        self._count, self._since = 0, time.monotonic()

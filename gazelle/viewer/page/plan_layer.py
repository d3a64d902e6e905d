"""Goals and global plans of ``robot.navigation``."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.navigation.robot_navigation import RobotNavigation
from gazelle.viewer.page.context import ROOT, PageContext

_ABOVE = 0.03  # the floor [m]
_ARROW = 0.35  # [m]
_GREEN, _RED = (40, 160, 70), (210, 40, 40)


class PlanLayer:
    """Lines along the plans, and arrows at the goals.

    Args:
        context: Of the page.
    """

    def __init__(self, context: PageContext) -> None:
        self._context, self.shown = context, True
        self._lines: Any = None
        self._arrows: Any = None
        self._drawn: tuple[bytes, bytes] = (b"", b"")

    def read(self) -> tuple[Floats, Floats]:
        """Return lines and arrows, from start to end each [m], shape (n, 2, 3)."""
        lines, arrows = [np.zeros((0, 2, 3))], [np.zeros((0, 2, 3))]
        if self.shown:
            for entry in self._context.simulation.plugins:
                if isinstance(entry.plugin, RobotNavigation):
                    self._add(entry.plugin, lines, arrows)
        return np.concatenate(lines), np.concatenate(arrows)

    def show(self, state: tuple[Floats, Floats]) -> None:
        """Draw the plans that changed."""
        lines, arrows = (part.astype(np.float32) for part in state)
        now = lines.tobytes(), arrows.tobytes()
        if now == self._drawn:
            return
        self._drawn = now
        for handle in (self._lines, self._arrows):
            if handle is not None:
                handle.remove()
        self._lines = self._arrows = None
        scene = self._context.scene
        if len(lines):
            self._lines = scene.add_line_segments(
                f"{ROOT}/plans", lines, _GREEN, thickness=3.0, thickness_units="screen"
            )
        if len(arrows):
            self._arrows = scene.add_arrows(
                f"{ROOT}/goals", arrows, _RED,
                shaft_radius=0.02, head_radius=0.05, head_length=0.1,
            )  # fmt: skip

    def renew(self) -> None:
        """Do nothing: robots are looked up with every picture."""

    def _add(self, plugin: RobotNavigation, lines: list[Floats], arrows: list[Floats]) -> None:
        spots = dict(zip(self._context.worlds.tolist(), self._context.spots, strict=True))
        for world, plan in plugin.plans().items():
            if world not in spots:
                continue
            lift = spots[world] + (0.0, 0.0, _ABOVE)
            path = np.zeros((len(plan.path), 3))
            path[:, :2] = plan.path[:, :2]
            if len(path) > 1:
                lines.append(np.stack((path[:-1], path[1:]), axis=1) + lift)
            x, y, heading = plan.goal
            tip = x + _ARROW * np.cos(heading), y + _ARROW * np.sin(heading), 0.0
            arrows.append(np.array([[(x, y, 0.0), tip]]) + lift)

"""Axes of joints."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import Model
from gazelle.rotations import rotate
from gazelle.viewer.page.context import ROOT, PageContext
from gazelle.viewer.page.link_places import LinkPlaces

_YELLOW = (230, 180, 20)
_LENGTH = 0.2  # [m]


class JointAxisLayer:
    """An arrow along the first axis of each joint that moves.

    Args:
        context: Of the page.
    """

    def __init__(self, context: PageContext) -> None:
        self._context, self.shown = context, False
        self._arrows: Any = None
        self.renew()

    def read(self) -> Floats | None:
        """Return starts and ends of arrows [m], shape (n, 2, 3)."""
        if not self.shown or not len(self._at):
            return None
        at, turned = self._places.read(self._context.worlds)
        start = at + rotate(turned, self._at[None]) + self._context.spots[:, None]
        along = _LENGTH * rotate(turned, self._axes[None])
        return np.stack((start, start + along), axis=2).reshape(-1, 2, 3)

    def show(self, state: Floats | None) -> None:
        """Draw the arrows."""
        if self._arrows is not None:
            self._arrows.visible = state is not None
        if state is None:
            return
        lines = state.astype(np.float32)
        if self._arrows is None:
            self._arrows = self._context.scene.add_arrows(
                f"{ROOT}/joints",
                lines,
                _YELLOW,
                shaft_radius=0.01,
                head_radius=0.025,
                head_length=0.05,
            )
        elif not np.array_equal(self._arrows.points, lines):
            self._arrows.points = lines

    def renew(self) -> None:
        """List the joints again."""
        if self._arrows is not None:
            self._arrows.remove()
            self._arrows = None
        simulation = self._context.simulation
        moving = set(simulation.engine.joints.names)
        found = [
            (child, at, axis)
            for model in simulation.world.models
            for name, child, at, axis in _axes_of(model)
            if name in moving
        ]
        self._places = LinkPlaces(simulation, tuple(child for child, _, _ in found))
        self._at = np.array([at for _, at, _ in found]).reshape(-1, 3)
        self._axes = np.array([axis for _, _, axis in found]).reshape(-1, 3)


def _axes_of(model: Model) -> Iterator[tuple[str, str, Floats, Floats]]:
    """Yield names of joints and of their links, and places and axes in these links."""
    for placed in model.walk():
        for joint in placed.model.joints:
            for axis in joint.axes[:1]:
                yield (
                    f"{placed.scope}::{joint.name}",
                    f"{placed.scope}::{joint.child}",
                    np.asarray(joint.pose.position),
                    np.asarray(joint.pose.rotate(axis.xyz)),
                )

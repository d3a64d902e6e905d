"""Overlays of mass: centres of mass, and boxes of equal inertia."""

from __future__ import annotations

import time
from typing import Any

import numpy as np

from gazelle.array_types import Floats, Floats32
from gazelle.errors import EngineError
from gazelle.rotations import from_matrices, multiply, rotate
from gazelle.viewer.page.context import ROOT, PageContext
from gazelle.viewer.page.link_places import LinkPlaces

_LEAD = 11340.0  # density of the balls [kg/m³], as in Gazebo
_PERIOD = 1.0  # wall time between two readings of masses [s]
_MOST = 1000  # links
_PARAMETERS = ("link_mass", "link_centre", "link_inertia")


class MassLayer:
    """A mesh at the centre of mass of each link that moves: a ball of lead as heavy as the link.

    Args:
        context: Of the page.
        boxes: Whether boxes of the link's mass and inertia are drawn instead.
    """

    def __init__(self, context: PageContext, *, boxes: bool = False) -> None:
        self._context, self._boxes, self.shown = context, boxes, False
        self._handle: Any = None
        self._next = 0.0
        self.renew()

    def read(self) -> tuple[Floats, Floats, Floats] | None:
        """Return places, quaternions and sizes, shapes (n, 3), (n, 4) and (n, 3)."""
        if not self.shown or not self._places.links:
            return None
        if time.monotonic() >= self._next:
            self._next = time.monotonic() + _PERIOD
            self._measure()
        spots = self._context.spots
        at, turned = self._places.read(self._context.worlds)
        at = at + rotate(turned, self._centre[None]) + spots[:, None]
        turned = multiply(turned, self._turned[None])
        sizes = np.tile(self._size, (len(spots), 1))
        return at.reshape(-1, 3), turned.reshape(-1, 4), sizes

    def show(self, state: tuple[Floats, Floats, Floats] | None) -> None:
        """Draw the balls or boxes."""
        if self._handle is not None:
            self._handle.visible = state is not None
        if state is None:
            return
        at, turned, sizes = (part.astype(np.float32) for part in state)
        if self._handle is None:
            self._handle = self._drawn(at, turned)
        self._handle.batched_positions, self._handle.batched_scales = at, sizes
        self._handle.batched_wxyzs = turned[:, [3, 0, 1, 2]]

    def renew(self) -> None:
        """List the links again."""
        if self._handle is not None:
            self._handle.remove()
            self._handle = None
        engine, links = self._context.simulation.engine, []
        for link in engine.links.names:
            try:
                engine.parameter("link_mass", link, self._context.chosen)
            except EngineError:  # static, or of an engine without masses
                continue
            links.append(link)
        self._places = LinkPlaces(self._context.simulation, tuple(links[:_MOST]))
        self._next = 0.0

    def _measure(self) -> None:
        """Read mass, centre and inertia of each link, which may be changed in the middle of a run."""
        engine, chosen = self._context.simulation.engine, self._context.chosen
        rows = [
            np.concatenate([engine.parameter(kind, link, chosen)[0] for kind in _PARAMETERS])
            for link in self._places.links
        ]
        table = np.array(rows)
        mass, self._centre = table[:, 0], table[:, 1:4]
        self._turned = np.tile((0.0, 0.0, 0.0, 1.0), (len(table), 1))
        if self._boxes:
            self._size, self._turned = boxes_of_equal_inertia(mass, table[:, 4:])
        else:
            radius = np.cbrt(3.0 * mass / (4.0 * np.pi * _LEAD))
            self._size = np.repeat(radius[:, None], 3, axis=1)

    def _drawn(self, at: Floats32, turned: Floats32) -> Any:
        import trimesh

        mesh = trimesh.creation.box() if self._boxes else trimesh.creation.icosphere(2)
        return self._context.scene.add_batched_meshes_simple(
            f"{ROOT}/{'inertias' if self._boxes else 'masses'}",
            np.asarray(mesh.vertices, np.float32),
            np.asarray(mesh.faces, np.uint32),
            turned,
            at,
            batched_colors=(150, 60, 190) if self._boxes else (0, 160, 120),
            opacity=0.6 if self._boxes else None,
            lod="off",
            cast_shadow=False,
        )


def boxes_of_equal_inertia(mass: Floats, inertia: Floats) -> tuple[Floats, Floats]:
    """Return full sizes (n, 3) [m] and quaternions (n, 4) of uniform boxes in the links' axes.

    The moment of a box about x is m (y² + z²) / 12, and likewise about y and z.

    Args:
        mass: [kg], shape (n,).
        inertia: xx, yy, zz, xy, xz, yz [kg m²], shape (n, 6).
    """
    moments, axes = np.linalg.eigh(inertia[:, [0, 3, 4, 3, 1, 5, 4, 5, 2]].reshape(-1, 3, 3))
    axes[np.linalg.det(axes) < 0.0, :, 2] *= -1.0
    squares = moments.sum(axis=1, keepdims=True) - 2.0 * moments
    size: Floats = np.sqrt(np.maximum(6.0 * squares / np.maximum(mass, 1e-12)[:, None], 0.0))
    return size, from_matrices(axes)

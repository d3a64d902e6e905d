"""Overlays of a world: names, frames, contacts, rays of lidars."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.engines.planar import PlanarEngine
from gazelle.errors import EngineError
from gazelle.rotations import rotate
from gazelle.sensors import LidarModel
from gazelle.viewer.page.context import ROOT, PageContext
from gazelle.viewer.page.link_places import LinkPlaces

_NAMES = 200  # models beyond which names are not shown
_RAYS = 20_000  # of all lidars together, drawn at most
_FRAMES = 2000
_CONTACTS = 2000
_NORMAL = 0.15  # length of an arrow [m]
_RED, _BLUE = (210, 40, 40), (30, 90, 220)


class NameLayer:
    """A label at each model that moves.

    Args:
        context: Of the page.
    """

    def __init__(self, context: PageContext) -> None:
        self._context, self.shown = context, False
        self._labels: dict[str, Any] = {}

    def read(self) -> dict[str, Floats]:
        """Return the positions of models in the first world that is shown [m], each shape (3,)."""
        simulation = self._context.simulation
        robots = [each for each in simulation.robots.values() if not each.description.static]
        if not self.shown or len(robots) > _NAMES:
            return {}
        first = self._context.worlds[:1]
        return {each.name: each.placement(first).position[0] for each in robots}

    def show(self, state: dict[str, Floats]) -> None:
        """Move the labels."""
        for name in [name for name in self._labels if name not in state]:
            self._labels.pop(name).remove()
        for name, place in state.items():
            if name not in self._labels:
                path = f"{ROOT}/names/{name}"
                self._labels[name] = self._context.scene.add_label(path, name)
            self._labels[name].position = place + self._context.spots[0]

    def renew(self) -> None:
        """Do nothing: deleted models lose their labels with the next picture."""


class FrameLayer:
    """Axes of all links: x red, y green, z blue.

    Args:
        context: Of the page.
    """

    def __init__(self, context: PageContext) -> None:
        self._context, self.shown = context, False
        self._axes: Any = None
        self.renew()

    def read(self) -> tuple[Floats, Floats] | None:
        """Return places of the links, (n, 3) and (n, 4)."""
        if not self.shown or not self._places.links:
            return None
        at, turned = self._places.read(self._context.worlds)
        return (at + self._context.spots[:, None]).reshape(-1, 3), turned.reshape(-1, 4)

    def show(self, state: tuple[Floats, Floats] | None) -> None:
        """Draw the frames."""
        if self._axes is not None:
            self._axes.visible = state is not None
        if state is None:
            return
        at, turned = state[0].astype(np.float32), state[1][:, [3, 0, 1, 2]].astype(np.float32)
        if self._axes is None:
            self._axes = self._context.scene.add_batched_axes(
                f"{ROOT}/frames", turned, at, axes_length=0.15, axes_radius=0.006
            )
        self._axes.batched_positions, self._axes.batched_wxyzs = at, turned

    def renew(self) -> None:
        """List the links again."""
        if self._axes is not None:
            self._axes.remove()
            self._axes = None
        simulation = self._context.simulation
        self._places = LinkPlaces(simulation, simulation.engine.links.names[:_FRAMES])


class ContactLayer:
    """An arrow at each contact: along its normal, or as long as the logarithm of the force.

    Args:
        context: Of the page.
        forces: Whether forces on what is touched are drawn instead of normals.
    """

    def __init__(self, context: PageContext, *, forces: bool = False) -> None:
        self._context, self._forces, self.shown = context, forces, False
        self._arrows: Any = None
        self._names: tuple[str, ...] = ()
        self.renew()

    def read(self) -> Floats | None:
        """Return starts and ends of arrows [m], shape (n, 2, 3)."""
        if not self.shown:
            return None
        context = self._context
        try:
            table = context.simulation.engine.contacts([self._names], context.worlds)
        except EngineError:  # an engine that knows no contacts
            return np.zeros((0, 2, 3))
        found, rows = table.named(), np.searchsorted(context.worlds, table.worlds)
        start = found.position + context.spots[rows]
        arrow = _NORMAL * found.normal
        if self._forces:
            force = np.linalg.norm(found.force, axis=1, keepdims=True)
            arrow = found.force * (0.1 * np.log1p(force) / np.maximum(force, 1e-9))
        return np.stack((start, start + arrow), axis=1)[:_CONTACTS]

    def show(self, state: Floats | None) -> None:
        """Draw the arrows."""
        if self._arrows is not None:
            self._arrows.remove()
            self._arrows = None
        if state is not None and len(state):
            self._arrows = self._context.scene.add_arrows(
                f"{ROOT}/{'forces' if self._forces else 'contacts'}",
                state.astype(np.float32),
                _RED if self._forces else _BLUE,
                shaft_radius=0.008,
                head_radius=0.02,
                head_length=0.03,
            )

    def renew(self) -> None:
        """List the collision shapes of what moves again."""
        self._names = tuple(
            f"{placed.scope}::{link.name}::{collision.name}"
            for model in self._context.simulation.world.models
            if not model.static
            for placed in model.walk()
            for link in placed.model.links
            for collision in link.collisions
        )


class RayLayer:
    """Rays of lidars and rangers, and the points where they meet something.

    What sensors measure is left alone: the rays are followed without noise.

    Args:
        context: Of the page.
    """

    def __init__(self, context: PageContext) -> None:
        self._context, self.shown = context, False
        self._lines: Any = None
        self._points: Any = None

    def read(self) -> tuple[Floats, Floats] | None:
        """Return rays, shape (n, 2, 3), and points, shape (m, 3) [m]."""
        if not self.shown:
            return None
        rays, met = [np.zeros((0, 2, 3))], [np.zeros((0, 3))]
        count = 0
        for eyes, ends, hits in self._followed():
            rays.append(np.stack((eyes, ends), axis=1))
            met.append(ends[hits])
            count += len(ends)
            if count > _RAYS:
                break
        return np.concatenate(rays)[:_RAYS], np.concatenate(met)[:_RAYS]

    def show(self, state: tuple[Floats, Floats] | None) -> None:
        """Draw the rays."""
        for handle in (self._lines, self._points):
            if handle is not None:
                handle.visible = state is not None
        if state is None:
            return
        lines, points = (part.astype(np.float32) for part in state)
        scene = self._context.scene
        if self._lines is None:
            self._lines = scene.add_line_segments(f"{ROOT}/rays", lines, (120, 170, 230))
            self._points = scene.add_point_cloud(
                f"{ROOT}/scan", points, (210, 40, 40), point_size=0.03, point_shape="circle",
                precision="float32",
            )  # fmt: skip
            return
        self._lines.points = lines
        self._points.points = points

    def renew(self) -> None:
        """Do nothing: sensors are looked up with every picture."""

    def _followed(self) -> Iterator[tuple[Floats, Floats, Any]]:
        """Yield for each sensor in each world starts and ends of rays, and their hits."""
        context = self._context
        if isinstance(context.simulation.engine, PlanarEngine):
            yield from self._planar()
            return
        for unit in tuple(context.simulation.entities.sensors):
            model = unit.model
            if isinstance(model, LidarModel):
                yield from self._spatial(model)

    def _planar(self) -> Iterator[tuple[Floats, Floats, Any]]:
        from gazelle.viewer.plan import fleet_of, rays_of
        from gazelle.viewer.plan_scans import scanners_of

        context = self._context
        for scanner in scanners_of(context.simulation, fleet_of(context.simulation)):
            for world, spot in zip(context.worlds.tolist(), context.spots, strict=True):
                for eye, ends, met in zip(*rays_of(scanner, world), strict=True):
                    high = np.full(len(ends), 0.2)
                    tips = np.column_stack((ends, high)) + spot
                    root = np.array([*eye, 0.2]) + spot
                    yield np.broadcast_to(root, tips.shape), tips, met

    def _spatial(self, model: LidarModel) -> Iterator[tuple[Floats, Floats, Any]]:
        context = self._context
        engine = context.simulation.engine
        found = engine.links[model.link].cast_rays(model.origins, model.directions, context.worlds)
        place = engine.links[model.link].placement(context.worlds)
        reach = model.lidar.range_max - model.lidar.range_min
        for number, spot in enumerate(context.spots):
            turned = place.quaternion[number][None]
            eyes = place.position[number] + rotate(turned, model.origins) + spot
            along = rotate(turned, model.directions)
            away = np.minimum(found.distance[number], reach)
            yield eyes, eyes + away[:, None] * along, found.distance[number] < reach

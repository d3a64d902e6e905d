"""Fields of view of cameras, and sectors of lidars."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import Camera, Lidar, Link, Scan, Sensor
from gazelle.rotations import rotate
from gazelle.viewer.page.context import ROOT, PageContext
from gazelle.viewer.page.link_places import LinkPlaces

_FAR = 10.0  # drawn at most [m]
_CAMERA, _LIDAR = (30, 90, 200), (0, 150, 140)
_ARC = math.radians(5.0)  # between corners of an arc [rad]


class FrustumLayer:
    """Lines around what cameras and lidars see, from the nearest to the farthest distance.

    Args:
        context: Of the page.
    """

    def __init__(self, context: PageContext) -> None:
        self._context, self.shown = context, False
        self._handle: Any = None
        self.renew()

    def read(self) -> Floats | None:
        """Return lines [m], shape (n, 2, 3)."""
        if not self.shown or not len(self._lines):
            return None
        at, turned = (part[:, self._link, None] for part in self._places.read(self._context.worlds))
        placed = at + rotate(turned, self._lines[None]) + self._context.spots[:, None, None]
        lines: Floats = placed.reshape(-1, 2, 3)
        return lines

    def show(self, state: Floats | None) -> None:
        """Draw the lines."""
        if self._handle is not None:
            self._handle.visible = state is not None
        if state is None:
            return
        lines = state.astype(np.float32)
        if self._handle is None:
            colors = np.tile(self._colors, (len(self._context.spots), 1))
            self._handle = self._context.scene.add_line_segments(
                f"{ROOT}/frusta",
                lines,
                np.repeat(colors[:, None], 2, axis=1),
                thickness=1.5,
                thickness_units="screen",
            )
        elif not np.array_equal(self._handle.points, lines):
            self._handle.points = lines

    def renew(self) -> None:
        """Measure the sensors again."""
        if self._handle is not None:
            self._handle.remove()
            self._handle = None
        simulation = self._context.simulation
        links: list[str] = []
        drawn: list[tuple[int, tuple[int, int, int], Floats]] = []
        for model in simulation.world.models:
            for placed in model.walk():
                for link in placed.model.links:
                    drawn += [(len(links), *each) for each in _outlines(link)]
                    links.append(f"{placed.scope}::{link.name}")
        self._places = LinkPlaces(simulation, tuple(links))
        counts = [len(lines) for _, _, lines in drawn]
        self._link = np.repeat([number for number, _, _ in drawn], counts).astype(np.intp)
        self._colors = np.repeat([color for _, color, _ in drawn], counts, axis=0).astype(np.uint8)
        self._lines = np.concatenate([np.zeros((0, 2, 3)), *(lines for _, _, lines in drawn)])


def _outlines(link: Link) -> Iterator[tuple[tuple[int, int, int], Floats]]:
    """Yield colour and lines in the link's frame of each sensor that sees something."""
    for sensor in link.sensors:
        for color, lines in _outlines_of_sensor(sensor):
            turned = np.asarray(sensor.pose.quaternion)[None, None]
            yield color, rotate(turned, lines) + np.asarray(sensor.pose.position)


def _outlines_of_sensor(sensor: Sensor) -> Iterator[tuple[tuple[int, int, int], Floats]]:
    if sensor.lidar is not None:
        yield _LIDAR, lidar_outline(sensor.lidar)
    for camera in sensor.cameras:
        turned = np.asarray(camera.pose.quaternion)[None, None]
        yield _CAMERA, rotate(turned, camera_outline(camera)) + np.asarray(camera.pose.position)


def camera_outline(camera: Camera) -> Floats:
    """Return the edges of a frustum, x forward [m], shape (12, 2, 3)."""
    side = math.tan(camera.horizontal_fov / 2.0)
    up = side * camera.height / camera.width
    corners = np.array(
        [(1.0, y, z) for y, z in ((side, up), (-side, up), (-side, -up), (side, -up))]
    )
    near, far = camera.near * corners, min(camera.far, _FAR) * corners
    rims = [np.stack((rim, np.roll(rim, -1, axis=0)), axis=1) for rim in (near, far)]
    return np.concatenate((*rims, np.stack((near, far), axis=1)))


def lidar_outline(lidar: Lidar) -> Floats:
    """Return the rims of a sector, and lines from the nearest to the farthest at its ends [m]."""
    turns, tilts = _angles(lidar.horizontal), _ends(lidar.vertical)
    far = min(lidar.range_max, _FAR)
    lines = []
    for tilt in tilts:
        along = np.column_stack(
            (
                np.cos(tilt) * np.cos(turns),
                np.cos(tilt) * np.sin(turns),
                np.full(len(turns), np.sin(tilt)),
            )
        )
        arcs = np.stack((along[:-1], along[1:]), axis=1)
        lines += [lidar.range_min * arcs, far * arcs]
        ends = along[[0, -1]]
        lines.append(np.stack((lidar.range_min * ends, far * ends), axis=1))
    return np.concatenate(lines)


def _angles(scan: Scan) -> Floats:
    """Return angles along a fan [rad]."""
    count = max(2, math.ceil(abs(scan.max_angle - scan.min_angle) / _ARC) + 1)
    return np.linspace(scan.min_angle, scan.max_angle, count)


def _ends(scan: Scan) -> Floats:
    return np.unique([scan.min_angle, scan.max_angle]) if scan.samples > 1 else np.zeros(1)

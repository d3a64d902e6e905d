"""Worlds of the planar engine seen from above: walls, robots, scans and trails."""

from __future__ import annotations

import warnings
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Picture
from gazelle.engines.planar import Fleet, PlanarEngine, PrimitiveTable, Scanner, footprint_of
from gazelle.errors import Error
from gazelle.simulation import Simulation
from gazelle.simulation.inputs import one_world
from gazelle.viewer.limits import check_size
from gazelle.viewer.plan_scans import scanners_of

Colour = tuple[int, int, int]

PAPER: Colour = (250, 250, 248)
_WALL: Colour = (60, 60, 66)
_SEEN: Colour = (222, 236, 250)
_HIT: Colour = (206, 62, 52)
_BODIES: tuple[Colour, ...] = (
    (55, 110, 175),
    (225, 130, 40),
    (75, 150, 95),
    (150, 90, 165),
    (60, 160, 170),
)
_FINER = 2  # drawn larger by this factor, then reduced: smooth edges
_FEW = 8  # robots up to which what they see is filled


@checked(Error)
class TopView:
    """Draws a world of the planar engine from above; needs no screen.

    Args:
        simulation: Of a world with ``engine="planar"``.
        world: World of a batch.
        size: Width and height of pictures [pixel].
        scans: Whether to show what rangers and lidars meet.
        trails: Whether to show where bodies have been at earlier pictures.
        extent: Least x, least y, greatest x and greatest y that are shown [m]; all by default.

    Raises:
        Error: The simulation is not in the plane, or there is no such world or picture.
    """

    def __init__(
        self,
        simulation: Simulation,
        *,
        world: int = 0,
        size: tuple[int, int] = (960, 720),
        scans: bool = True,
        trails: bool = True,
        extent: tuple[float, float, float, float] | None = None,
    ) -> None:
        self._simulation, self._size = simulation, size
        self._scans, self._trails = scans, trails
        fleet = fleet_of(simulation)
        self._world = one_world(world, fleet.nworld)
        self._frame = PlanFrame(extent or extent_of(fleet, world), size)
        self._been: list[Floats] = []
        self._scanners: tuple[Fleet | None, list[Scanner]] = (None, [])

    def render(self) -> Picture:
        """Render the world now, shape (height, width, 3), and extend the trails."""
        fleet = fleet_of(self._simulation)
        poses = fleet.pose[self._world].copy()
        if self._been and len(self._been[-1]) != len(poses):
            self._been.clear()  # models came or went
        self._been.append(poses)
        width, height = self._size
        image = Image.new("RGB", (width * _FINER, height * _FINER), PAPER)
        draw = ImageDraw.Draw(image)
        if self._scans:
            self._draw_scans(draw, fleet)
        self._draw_statics(draw, fleet.scene.table)
        if self._trails:
            self._draw_trails(draw)
        for body in range(fleet.nbody):
            self._draw_body(draw, fleet, body, poses[body])
        return np.asarray(image.resize(self._size, Image.Resampling.BOX), np.uint8)

    def look(self) -> Picture:
        """Render the scene; deprecated, use `render`."""
        warnings.warn(DeprecationWarning("TopView.look is called render now"), stacklevel=2)
        return self.render()

    def forget(self) -> None:
        """Clear the trails."""
        self._been.clear()

    def _draw_scans(self, draw: ImageDraw.ImageDraw, fleet: Fleet) -> None:
        if self._scanners[0] is not fleet:
            self._scanners = fleet, scanners_of(self._simulation, fleet)
        crowd = fleet.nbody > _FEW
        for scanner in self._scanners[1]:
            eyes, ends, met = rays_of(scanner, self._world)
            for eye, beams, hits in zip(eyes, ends, met, strict=True):
                if not crowd:
                    draw.polygon(self._frame.path([eye, *beams]), fill=_SEEN)
                for x, y in self._frame.path(beams[hits]):
                    draw.rectangle((x - 1, y - 1, x + 1, y + 1), fill=_HIT)

    def _draw_statics(self, draw: ImageDraw.ImageDraw, table: PrimitiveTable) -> None:
        segments = table.segments
        starts, ends = self._frame.path(segments[:, :2]), self._frame.path(segments[:, 2:])
        for start, end in zip(starts, ends, strict=True):
            draw.line((start, end), fill=_WALL, width=2 * _FINER)
        for x, y, radius in table.discs:
            draw.ellipse(self._frame.box(x, y, radius), outline=_WALL, width=2 * _FINER)

    def _draw_trails(self, draw: ImageDraw.ImageDraw) -> None:
        if len(self._been) < 2:
            return
        for body, trail in enumerate(np.moveaxis(np.array(self._been), 1, 0)):
            if np.ptp(trail[:, :2], axis=0).any():
                draw.line(self._frame.path(trail[:, :2]), fill=_pale(colour_of(body)), width=_FINER)

    def _draw_body(self, draw: ImageDraw.ImageDraw, fleet: Fleet, body: int, pose: Floats) -> None:
        footprint, colour = footprint_of(fleet, body), colour_of(body)
        cos, sin = np.cos(pose[2]), np.sin(pose[2])
        turn = np.array([[cos, sin], [-sin, cos]])
        for *middle, radius in footprint.discs:
            x, y = middle @ turn + pose[:2]
            draw.ellipse(self._frame.box(x, y, radius), fill=colour)
        for corners in footprint.polygons:
            draw.polygon(self._frame.path(corners @ turn + pose[:2]), fill=colour)
        ahead = np.array([pose[:2], [footprint.radius, 0.0] @ turn + pose[:2]])
        draw.line(self._frame.path(ahead), fill=PAPER, width=_FINER)


class PlanFrame:
    """From metres to pixels of the large picture, which is made smaller in the end.

    Args:
        extent: Least x, least y, greatest x and greatest y that are shown [m].
        size: Width and height of the small picture [pixel].

    Raises:
        Error: The extent has no size, or there is no such picture.
    """

    def __init__(self, extent: tuple[float, float, float, float], size: tuple[int, int]) -> None:
        check_size(size, _FINER)
        low, high = np.array(extent[:2]), np.array(extent[2:])
        if not (high > low).all():
            raise Error(f"a picture needs a part of the world with a size, not {extent}")
        pixels = np.array(size) * _FINER
        self._scale = float((pixels / (high - low)).min())
        self._middle, self._centre = (low + high) / 2.0, pixels / 2.0
        self.shape = int(pixels[1]), int(pixels[0])

    def middles(self) -> Floats:
        """Return the centres of all pixels [m], shape (height, width, 2)."""
        rows, columns = np.mgrid[: self.shape[0], : self.shape[1]] + 0.5
        away = np.stack((columns, rows), axis=2) - self._centre
        places: Floats = away / (self._scale * np.array([1.0, -1.0])) + self._middle
        return places

    def path(self, points: Iterable[Any] | Floats) -> list[tuple[float, float]]:
        """Return points [m] as pixels."""
        array = np.asarray(points, np.float64).reshape(-1, 2)
        x, y = ((array - self._middle) * self._scale * [1.0, -1.0] + self._centre).T
        return list(zip(x.tolist(), y.tolist(), strict=True))

    def box(self, x: float, y: float, radius: float) -> tuple[float, float, float, float]:
        """Return the square around a disc."""
        ((left, top),) = self.path([[x - radius, y + radius]])
        ((right, bottom),) = self.path([[x + radius, y - radius]])
        return left, top, right, bottom


def fleet_of(simulation: Simulation) -> Fleet:
    """Return the bodies in the plane.

    Raises:
        Error: The simulation is not in the plane.
    """
    if isinstance(simulation.engine, PlanarEngine):
        return simulation.engine.fleet
    raise Error(
        "only worlds in the plane have a top view",
        hint='use engine="planar", or take_picture() for worlds in space',
    )


def rays_of(scanner: Scanner, world: int) -> tuple[Floats, Floats, NDArray[np.bool_]]:
    """Return origins and ends of one world's sensor beams, and a mask of those that hit something.

    Shapes (sensors, 2), (sensors, beams, 2) and (sensors, beams), all in the world's frame [m].
    """
    ranges = scanner.scan(np.array([world]))[0]
    fleet = scanner.fleet
    eyes = np.array([[m.x, m.y, m.yaw, m.body] for m in scanner.mounts]).reshape(-1, 4)
    pose = fleet.pose[world, eyes[:, 3].astype(int)]
    cos, sin = np.cos(pose[:, 2]), np.sin(pose[:, 2])
    x = pose[:, 0] + cos * eyes[:, 0] - sin * eyes[:, 1]
    y = pose[:, 1] + sin * eyes[:, 0] + cos * eyes[:, 1]
    angles = (pose[:, 2] + eyes[:, 2])[:, None] + scanner.fan.angles
    ends = np.stack(
        (x[:, None] + ranges * np.cos(angles), y[:, None] + ranges * np.sin(angles)), axis=2
    )
    return np.stack((x, y), axis=1), ends, ranges < scanner.fan.reach


def extent_of(fleet: Fleet, world: int) -> tuple[float, float, float, float]:
    """Return the extent of all bodies and statics, with a margin."""
    ends, discs = fleet.scene.table.segments.reshape(-1, 2), fleet.scene.table.discs
    middles, radii = discs[:, :2], discs[:, 2:]
    poses, wide = fleet.pose[world, :, :2], fleet.widest
    points = np.vstack((ends, middles - radii, middles + radii, poses - wide, poses + wide))
    if not len(points):
        return (-1.0, -1.0, 1.0, 1.0)
    low, high = points.min(axis=0), points.max(axis=0)
    margin = 0.03 * float((high - low).max()) + 1e-3
    return (*(low - margin).tolist(), *(high + margin).tolist())


def colour_of(body: int) -> Colour:
    """Return red, green and blue of a body, from 0 to 255."""
    return _BODIES[body % len(_BODIES)]


def _pale(colour: Colour) -> Colour:
    red, green, blue = ((part + 255) // 2 for part in colour)
    return red, green, blue

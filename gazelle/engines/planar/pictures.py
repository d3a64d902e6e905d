"""Cameras in the plane: pictures and depths of outlines that stand between two heights."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.engines.planar import columns as c
from gazelle.engines.planar import picture_columns as k
from gazelle.engines.planar.fleet import Fleet
from gazelle.engines.planar.picture_drawing import ColoredFaces, PictureDrawing
from gazelle.engines.planar.shapes import Point, ccw, convex
from gazelle.errors import EngineError

Rgb = tuple[float, float, float]

_SHARE = 1  # pictures that are worth a thread


@dataclass(frozen=True, slots=True)
class Lens:
    """What all cameras of one painter have in common.

    Attributes:
        width: Columns of pixels.
        height: Rows of pixels.
        fov: Horizontal and vertical field of view [rad].
        near: What is nearer along the axis is not drawn [m].
        far: What is farther along the axis is not drawn [m].
    """

    width: int
    height: int
    fov: tuple[float, float]
    near: float = 0.01
    far: float = 100.0

    @property
    def focal(self) -> tuple[float, float]:
        """Focal lengths along rows and columns [pixel]."""
        return (
            self.width / (2.0 * math.tan(self.fov[0] / 2.0)),
            self.height / (2.0 * math.tan(self.fov[1] / 2.0)),
        )


@dataclass(frozen=True, slots=True)
class CameraMount:
    """Where a camera is on a body, and where it looks.

    Attributes:
        body: Index of the body.
        x: In the body's frame [m].
        y: In the body's frame [m].
        z: Height above the body's frame [m].
        yaw: Of its axis in the body's frame [rad].
        pitch: Of its axis, downwards [rad].
        unseen: Owner of those faces on the body that it does not see.
    """

    body: int
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    yaw: float = 0.0
    pitch: float = 0.0
    unseen: int = -1


@dataclass(frozen=True, slots=True)
class Scenery:
    """The faces of a world.

    Attributes:
        still: In the world, shape (n, FACE).
        bodies: Of each body in its frame, shape (m, FACE) each; the same array may serve several.
        floor: Colour of the ground at height zero, 0 to 255.
        sky: Colour of all else.
    """

    still: Floats
    bodies: Sequence[Floats]
    floor: Rgb = (255.0, 255.0, 255.0)
    sky: Rgb = (179.0, 179.0, 204.0)


@dataclass(frozen=True, slots=True)
class CameraPictures:
    """What some cameras see.

    Attributes:
        color: Red, green, blue and 255, bytes, shape (..., height, width, 4), top row first.
        depth: Along the optical axis [m], infinite where nothing is, shape (..., height, width).
    """

    color: NDArray[np.uint8]
    depth: NDArray[np.float32]


class Painter:
    """Draws what cameras on bodies of a fleet see.

    Args:
        fleet: What moves.
        scenery: How it looks.

    Raises:
        EngineError: The scenery is of other bodies.
    """

    def __init__(self, fleet: Fleet, scenery: Scenery) -> None:
        if len(scenery.bodies) != fleet.nbody:
            raise EngineError(f"{len(scenery.bodies)} looks for {fleet.nbody} bodies")
        self.fleet = fleet
        firsts: dict[int, int] = {}
        looks: list[Floats] = [np.zeros((0, k.FACE)), scenery.still]
        for faces in scenery.bodies:
            if id(faces) not in firsts:
                firsts[id(faces)] = sum(map(len, looks))
                looks.append(faces)
        first = np.array([firsts[id(faces)] for faces in scenery.bodies], np.int64)
        count = np.array([len(faces) for faces in scenery.bodies], np.int64)
        sizes = {id(faces): _radius_of(faces) for faces in looks}
        self._faces = ColoredFaces(
            np.vstack(looks),
            len(scenery.still),
            np.stack((first, first + count), axis=1).reshape(-1, 2),
            np.array([sizes[id(faces)] for faces in scenery.bodies], np.float64),
            np.array(scenery.floor, np.float64),
            np.array(scenery.sky, np.float64),
        )

    def draw(
        self, lens: Lens, views: Sequence[CameraMount], worlds: NDArray[np.intp]
    ) -> CameraPictures:
        """Pictures of all views in some worlds, shape (worlds, views, height, width, ...).

        Args:
            lens: Of all of them.
            views: Where the cameras are.
            worlds: Indices.

        Raises:
            EngineError: The lens cannot be.
        """
        _check(lens)
        count, shape = len(worlds) * len(views), (lens.height, lens.width)
        color = np.empty((count, *shape, 4), np.uint8)
        inverse = np.empty((count, *shape))
        cameras = self._cameras(views, worlds)
        row = np.array([*lens.focal, lens.near, lens.far])

        def work(first: int, last: int, _part: int) -> None:
            scratch = PictureDrawing(self._faces, self.fleet.rows, row, cameras, color, inverse)
            scratch.draw(first, last)

        self.fleet.pool.share(work, count, _SHARE)
        with np.errstate(divide="ignore"):
            depth = (1.0 / inverse).astype(np.float32)
        lead = (len(worlds), len(views), *shape)
        return CameraPictures(color.reshape(*lead, 4), depth.reshape(lead))

    def _cameras(self, views: Sequence[CameraMount], worlds: NDArray[np.intp]) -> Floats:
        bodies = np.array([view.body for view in views], np.int64)
        carriers = (worlds[:, None] * self.fleet.nbody + bodies).ravel()
        where = np.array([[v.x, v.y, v.z, v.yaw, v.pitch, v.unseen] for v in views])
        x, y, z, yaw, pitch, unseen = np.tile(where, (len(worlds), 1)).T
        pose = self.fleet.rows[carriers]
        cos, sin = pose[:, c.COS], pose[:, c.SIN]
        made = np.zeros((len(carriers), k.CAMERA))
        made[:, 0] = pose[:, c.X] + cos * x - sin * y
        made[:, 1] = pose[:, c.Y] + sin * x + cos * y
        made[:, 2] = pose[:, c.Z] + z
        heading = pose[:, c.YAW] + yaw
        cos, sin, low, level = np.cos(heading), np.sin(heading), np.sin(pitch), np.cos(pitch)
        zero = np.zeros_like(cos)
        made[:, k.RIGHT : k.DOWN] = np.stack((sin, -cos, zero), axis=1)
        made[:, k.DOWN : k.AHEAD] = np.stack((-cos * low, -sin * low, -level), axis=1)
        made[:, k.AHEAD : k.CARRIER] = np.stack((cos * level, sin * level, -low), axis=1)
        made[:, k.CARRIER], made[:, k.UNSEEN] = carriers, unseen
        return made


def walls_between(lines: Floats, low: float, high: float, color: Rgb, owner: int = 0) -> Floats:
    """Faces on segments x0, y0, x1, y1 [m], shape (n, 4), from a height to another.

    They are seen from the right of the segments, and what is on their left is solid.
    """
    faces = np.zeros((len(lines), k.FACE))
    for corner, (x, y, z) in enumerate(((0, 1, low), (2, 3, low), (2, 3, high), (0, 1, high))):
        faces[:, 3 * corner : 3 * corner + 2] = lines[:, [x, y]]
        faces[:, 3 * corner + 2] = z
    faces[:, k.RED : k.OWNER] = color
    faces[:, k.OWNER] = owner
    return faces


def plates(quads: Floats, height: float, color: Rgb, owner: int = 0) -> Floats:
    """Level faces with these corners, shape (n, 4, 2), at a height.

    They are seen from above if the corners go counter-clockwise.
    """
    faces = np.zeros((len(quads), k.FACE))
    for corner in range(4):
        faces[:, 3 * corner : 3 * corner + 2] = quads[:, corner]
        faces[:, 3 * corner + 2] = height
    faces[:, k.RED : k.OWNER] = color
    faces[:, k.OWNER] = owner
    return faces


def prism(points: Iterable[Point], low: float, high: float, color: Rgb, owner: int = 0) -> Floats:
    """All faces of an outline that stands between two heights."""
    ring = ccw(np.asarray(list(points), np.float64))
    sides = walls_between(np.hstack((ring, np.roll(ring, -1, axis=0))), low, high, color, owner)
    quads = np.vstack([np.zeros((0, 4, 2)), *(_fan_of(polygon) for polygon in convex(ring))])
    bottom, top = plates(quads[:, ::-1], low, color, owner), plates(quads, high, color, owner)
    return np.vstack((sides, bottom, top))


def _fan_of(polygon: Floats) -> Floats:
    """A convex polygon as quadrangles from its first corner, shape (n, 4, 2)."""
    count = len(polygon)
    firsts = range(1, count - 1, 2)
    found = [polygon[[0, i, i + 1, i + 2 if i + 2 < count else 0]] for i in firsts]
    return np.array(found).reshape(-1, 4, 2)


def _radius_of(faces: Floats) -> float:
    corners = faces[:, : k.RED].reshape(-1, 3)[:, :2]
    return float(np.linalg.norm(corners, axis=1).max(initial=0.0))


def _check(lens: Lens) -> None:
    if lens.width < 1 or lens.height < 1:
        raise EngineError(f"a picture needs pixels, not {lens.width} x {lens.height}")
    if not all(0.0 < angle < math.pi for angle in lens.fov):
        raise EngineError("the field of view of a camera is between 0 and 180 degrees")
    if not 0.0 < lens.near < lens.far < math.inf:
        raise EngineError("a camera sees from a distance above zero to a greater one")

"""What of a world can be seen, as the arrays that are drawn."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Floats, Floats32, Ints64
from gazelle.description import Geometry, Pose, Visual, World
from gazelle.rendering import columns as c
from gazelle.rendering.rasterizer import DrawnShapes
from gazelle.rendering.shape_meshes import triangles_of
from gazelle.rendering.tessellation import TriangleMesh, joined

GREY = (0.7, 0.7, 0.7)


@dataclass(frozen=True, slots=True)
class VisiblePart:
    """A visual on a link.

    Attributes:
        link: Scoped name of the link: ``model::link``.
        visual: Its look and shape.
    """

    link: str
    visual: Visual


@dataclass(frozen=True, slots=True)
class VisibleWorld:
    """All that can be seen in a world.

    Attributes:
        links: Names of the links, as poses are given for them.
        parts: What labels in pictures count.
        shapes: What is drawn.
        rest: Where links are in the description, rotation by rows and place [m], shape (nlink, 12).
    """

    links: tuple[str, ...]
    parts: tuple[VisiblePart, ...]
    shapes: DrawnShapes
    rest: Floats


def visible_world(world: World) -> VisibleWorld:
    """Gather all visuals of a world.

    Raises:
        FormatError: A mesh or a terrain cannot be read.
    """
    poses: dict[str, Pose] = {}
    parts: list[VisiblePart] = []
    for name, pose, visual in _visuals(world):
        poses[name] = pose
        parts.append(VisiblePart(name, visual))
    links = tuple(poses)
    meshes: dict[Geometry, int] = {}
    shapes: list[TriangleMesh] = []
    rows = np.zeros((len(parts), c.PART), np.int64)
    for number, part in enumerate(parts):
        shape = part.visual.geometry
        if shape not in meshes:
            meshes[shape] = len(shapes)
            shapes.append(triangles_of(shape))
        rows[number] = (meshes[shape], links.index(part.link), number)
    drawn = _drawn(shapes, rows, [part.visual for part in parts])
    rest = np.array([_row(pose) for pose in poses.values()]).reshape(-1, 12)
    return VisibleWorld(links, tuple(parts), drawn, rest)


def rows_of(positions: Floats, quaternions: Floats) -> Floats:
    """Poses as they are drawn: rotation by rows and place, shape (..., 12).

    Args:
        positions: [m], shape (..., 3).
        quaternions: x, y, z, w of unit length, shape (..., 4).
    """
    x, y, z, w = np.moveaxis(quaternions, -1, 0)
    made = np.empty((*positions.shape[:-1], 12))
    made[..., 0], made[..., 4] = 1.0 - 2.0 * (y * y + z * z), 1.0 - 2.0 * (x * x + z * z)
    made[..., 8] = 1.0 - 2.0 * (x * x + y * y)
    made[..., 1], made[..., 3] = 2.0 * (x * y - z * w), 2.0 * (x * y + z * w)
    made[..., 2], made[..., 6] = 2.0 * (x * z + y * w), 2.0 * (x * z - y * w)
    made[..., 5], made[..., 7] = 2.0 * (y * z - x * w), 2.0 * (y * z + x * w)
    made[..., 9:] = positions
    return made


def _visuals(world: World) -> Iterator[tuple[str, Pose, Visual]]:
    for model in world.models:
        for placed in model.walk():
            for link in placed.model.links:
                for visual in link.visuals:
                    if visual.transparency < 1.0:
                        yield f"{placed.scope}::{link.name}", placed.pose * link.pose, visual


def _drawn(meshes: list[TriangleMesh], parts: Ints64, visuals: list[Visual]) -> DrawnShapes:
    together = joined(meshes)
    vertices = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    faces = np.cumsum([0, *(len(mesh.faces) for mesh in meshes)])
    table = np.zeros((len(meshes), c.MESH), np.int64)
    for number, mesh in enumerate(meshes):
        table[number] = (
            vertices[number],
            vertices[number + 1],
            faces[number],
            faces[number + 1],
            mesh.two_sided,
        )
    return DrawnShapes(
        np.ascontiguousarray(together.vertices),
        np.ascontiguousarray(together.normals),
        np.vstack([np.zeros((0, 3), np.int32), *(mesh.faces for mesh in meshes)]),
        table,
        np.array([_ball(mesh) for mesh in meshes]).reshape(-1, 4),
        parts,
        np.array([_row(visual.pose) for visual in visuals]).reshape(-1, 12),
        _colors(visuals),
        np.array([_glow(visual) for visual in visuals], np.float32).reshape(-1, 3),
    )


def _row(pose: Pose) -> Floats:
    return rows_of(np.asarray(pose.position), np.asarray(pose.quaternion))


def _ball(mesh: TriangleMesh) -> tuple[float, float, float, float]:
    if not len(mesh.vertices):
        return (0.0, 0.0, 0.0, 0.0)
    middle = (mesh.vertices.min(axis=0) + mesh.vertices.max(axis=0)) / 2.0
    radius = float(np.linalg.norm(mesh.vertices - middle, axis=1).max())
    x, y, z = middle.tolist()
    return (x, y, z, radius)


def _colors(visuals: list[Visual]) -> Floats32:
    return np.array([_color(visual) for visual in visuals], np.float32).reshape(-1, 3)


def _color(visual: Visual) -> tuple[float, float, float]:
    material = visual.material
    chosen = None if material is None else (material.diffuse or material.ambient)
    return GREY if chosen is None else chosen[:3]


def _glow(visual: Visual) -> tuple[float, float, float]:
    material = visual.material
    glow = None if material is None else material.emissive
    return (0.0, 0.0, 0.0) if glow is None else glow[:3]

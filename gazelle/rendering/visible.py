"""Visible parts of a world, as the arrays that are drawn."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Ints64
from gazelle.description import Geometry, Pose, Visual, World
from gazelle.errors import EngineError
from gazelle.geometry.triangles import TriangleMesh, joined
from gazelle.rendering import columns as c
from gazelle.rendering.rasterizer import DrawnShapes
from gazelle.rendering.shape_meshes import ShapePiece, pieces_of
from gazelle.rendering.surface_materials import SurfaceMaterial, surface_material
from gazelle.rendering.textures import TextureTable


@checked(EngineError)
@dataclass(frozen=True, slots=True)
class VisiblePart:
    """A visual on a link.

    Attributes:
        link: Scoped name of the link: ``model::link``.
        visual: Its material and shape.
    """

    link: str
    visual: Visual


@dataclass(frozen=True, slots=True)
class VisibleWorld:
    """All that can be seen in a world.

    Attributes:
        links: Names of the links, as poses are given for them.
        parts: Parts by which labels in images count.
        shapes: Shapes to draw.
        rest: Poses of links in the description, rotation by rows and place [m], shape (nlink, 12).
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
    numbers = {name: number for number, name in enumerate(links)}
    gathered = GatheredShapes()
    for label, part in enumerate(parts):
        gathered.add(part.visual, numbers[part.link], label)
    rest = np.array([_row(pose) for pose in poses.values()]).reshape(-1, 12)
    return VisibleWorld(links, tuple(parts), gathered.drawn(), rest)


def rows_of(positions: Floats, quaternions: Floats) -> Floats:
    """Return poses for drawing: rotation by rows and place, shape (..., 12).

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


class GatheredShapes:
    """Shapes and parts as they come, each shape and each texture once."""

    def __init__(self) -> None:
        self._meshes: list[TriangleMesh] = []
        self._known: dict[Geometry, tuple[tuple[int, ShapePiece], ...]] = {}
        self._textures = TextureTable()
        self._parts: list[tuple[int, int, int, int]] = []
        self._places: list[Floats] = []
        self._materials: list[SurfaceMaterial] = []

    def add(self, visual: Visual, link: int, label: int) -> None:
        """Add a visual: as many parts as its shape has materials."""
        for mesh, piece in self._pieces(visual.geometry):
            material = surface_material(visual, piece)
            number = None if material.texture is None else self._textures.number(material.texture)
            if number is not None and piece.mesh.uv is None:  # it is nowhere in the picture
                material, number = replace(material, color=self._textures.mean(number)), None
            self._parts.append((mesh, link, label, -1 if number is None else number))
            self._places.append(_row(visual.pose))
            self._materials.append(material)

    def add_mesh(self, mesh: TriangleMesh) -> int:
        """Add triangles that parts may have; returns their number."""
        self._meshes.append(mesh)
        return len(self._meshes) - 1

    def add_part(self, mesh: int, material: SurfaceMaterial, link: int, label: int) -> None:
        """Add a mesh in the frame of a link; it has no texture."""
        self._parts.append((mesh, link, label, -1))
        self._places.append(_row(Pose()))
        self._materials.append(material)

    def drawn(self) -> DrawnShapes:
        """Return all as arrays."""
        meshes = self._meshes
        together = joined(meshes)
        count = len(together.vertices)
        return DrawnShapes(
            np.ascontiguousarray(together.vertices),
            np.ascontiguousarray(together.normals),
            np.vstack([np.zeros((0, 3), np.int32), *(mesh.faces for mesh in meshes)]),
            _table(meshes),
            np.array([_ball(mesh) for mesh in meshes]).reshape(-1, 4),
            np.array(self._parts, np.int64).reshape(-1, c.PART),
            np.array(self._places).reshape(-1, 12),
            np.array([material.color for material in self._materials], np.float32).reshape(-1, 3),
            np.array([material.glow for material in self._materials], np.float32).reshape(-1, 3),
            np.array([material.alpha for material in self._materials], np.float32),
            np.zeros((count, 2)) if together.uv is None else np.ascontiguousarray(together.uv),
            self._textures.rows(),
            self._textures.texels(),
        )

    def _pieces(self, shape: Geometry) -> tuple[tuple[int, ShapePiece], ...]:
        if shape not in self._known:
            pieces = pieces_of(shape)
            first = len(self._meshes)
            self._meshes += [piece.mesh for piece in pieces]
            self._known[shape] = tuple(enumerate(pieces, first))
        return self._known[shape]


def _table(meshes: list[TriangleMesh]) -> Ints64:
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
    return table


def _row(pose: Pose) -> Floats:
    return rows_of(np.asarray(pose.position), np.asarray(pose.quaternion))


def _ball(mesh: TriangleMesh) -> tuple[float, float, float, float]:
    if not len(mesh.vertices):
        return (0.0, 0.0, 0.0, 0.0)
    middle = (mesh.vertices.min(axis=0) + mesh.vertices.max(axis=0)) / 2.0
    radius = float(np.linalg.norm(mesh.vertices - middle, axis=1).max())
    x, y, z = middle.tolist()
    return (x, y, z, radius)

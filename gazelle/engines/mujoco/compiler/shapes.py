"""SDF shapes as MuJoCo geoms: one small function a shape, in a table.

MuJoCo collides convex shapes only, but its rays meet the triangles of a mesh. So a mesh that
is not convex becomes convex pieces that collide, and the mesh itself, which only rays meet.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import mujoco
import numpy as np

from gazelle.array_types import Floats
from gazelle.description import (
    Box,
    Capsule,
    Cone,
    Cylinder,
    Ellipsoid,
    Empty,
    Geometry,
    Heightmap,
    Image,
    Mesh,
    Plane,
    Polyline,
    Pose,
    Source,
    Sphere,
    Vector3,
)
from gazelle.engines.mujoco.compiler.mesh_solids import MeshSolids, key_of
from gazelle.engines.mujoco.compiler.meshes import SHELL, cone_mesh, inertia_of
from gazelle.errors import EngineWarning, located
from gazelle.geometry.ground import Ground
from gazelle.geometry.polygons import convex_polygons

if TYPE_CHECKING:
    from gazelle.geometry.convex_decomposition import ConvexPieces
    from gazelle.geometry.mesh_data import MeshData

CONTACT_GROUP = 2
"""Of what collides and is not seen by rays, since a mesh stands for it."""
CLOSED_GROUP = 3
"""Of meshes that only rays meet, and that have an inside."""
OPEN_GROUP = 4
"""Of meshes that only rays meet, and that have none."""

_GROUND = 1.0
"""Depth of the ground below the lowest point of a heightmap [m]."""
_THIN = 1e-6
_FEWEST = 4
"""Vertices that MuJoCo wants a mesh to have."""


@dataclass(slots=True)
class ShapeBuilder:
    """Makes geoms in one ``MjSpec``; meshes used twice are stored once.

    Attributes:
        spec: Specification of the geoms.
        name_mesh: Gives a mesh its name, at once or later.
        meshes: Names of what is stored already.
        pieces: Of meshes in pieces, the names of those and their middles, shape (n, 3) [m].
        heightmaps: Likewise.
        solids: Ground and pieces of meshes.
    """

    spec: mujoco.MjSpec
    name_mesh: Callable[[Any, str], None] = lambda mesh, name: setattr(mesh, "name", name)
    meshes: dict[Any, str] = field(default_factory=dict)
    pieces: dict[Any, tuple[list[str], Floats]] = field(default_factory=dict)
    heightmaps: dict[Heightmap, str] = field(default_factory=dict)
    solids: MeshSolids = field(default_factory=MeshSolids)

    def options(
        self, shape: Geometry, pose: Pose, source: Source | None, *, static: bool = False
    ) -> list[dict[str, Any]]:
        """Return the arguments of ``add_geom`` for a shape at a pose; none without a surface.

        A static mesh is followed closely, by as many geoms as that takes.
        """
        if isinstance(shape, Mesh):
            return self._pieces(shape, pose, source, static=static)
        return _READERS[type(shape)](self, shape, pose, source)

    def _pieces(
        self, shape: Mesh, pose: Pose, source: Source | None, *, static: bool
    ) -> list[dict[str, Any]]:
        """Return one geom for each convex piece: MuJoCo fills a mesh's hull, hollows and all."""
        if shape.path is None:
            return []
        ground = self.solids.ground(shape) if static else None
        if ground is not None:
            return [self._ground_geom(shape, ground, pose, source)]
        pieces = self.solids.pieces(shape, static=static)
        key = (key_of(shape), static)
        if pieces.gap > pieces.promised and key not in self.pieces:
            _warn_of_gap(shape, pieces.gap, source)
        if not pieces.solids and key not in self.pieces:
            self.pieces[key] = [], np.zeros((0, 3))
            text = f"the mesh '{shape.uri}' does not collide: its triangles have no area"
            warnings.warn(EngineWarning(located(text, source)), stacklevel=2)
        return self._piece_geoms(key, pieces, pose)

    def data_options(self, data: MeshData, pose: Pose, *, static: bool) -> list[dict[str, Any]]:
        """Return the arguments of ``add_geom`` for a mesh without a file.

        ``static`` as in ``options``.
        """
        from gazelle.geometry.convex_decomposition import decompose

        key = ("data", len(self.meshes), static)
        return self._piece_geoms(key, decompose(data, static=static), pose)

    def _piece_geoms(self, key: Any, pieces: ConvexPieces, pose: Pose) -> list[dict[str, Any]]:
        """Return a geom of each piece.

        Its origin is its middle: far from it MuJoCo's hull rounds.
        """
        if not pieces.solids:
            return []
        if key not in self.pieces:
            self.pieces[key] = self._store_pieces(key, pieces)
        names, middles = self.pieces[key]
        matrix, placed = pose.matrix(), _placed(pose)
        places = (middles @ matrix[:3, :3].T + matrix[:3, 3]).tolist()
        kind = mujoco.mjtGeom.mjGEOM_MESH
        return [
            {**placed, "type": kind, "meshname": name, "pos": place}
            for name, place in zip(names, places, strict=True)
        ]

    def _store_pieces(self, key: Any, pieces: ConvexPieces) -> tuple[list[str], Floats]:
        """Store the meshes of pieces around their middles; returns the names and those."""
        kind = None if pieces.whole else SHELL
        sizes = [len(piece.vertices) for piece in pieces.solids]
        starts = np.cumsum([0, *sizes[:-1]])
        points = np.concatenate([piece.vertices for piece in pieces.solids])
        middles = np.add.reduceat(points, starts) / np.array(sizes)[:, None]
        local = np.split(points - np.repeat(middles, sizes, axis=0), starts[1:])
        names = [
            self._store((key, number), local[number], piece.faces, kind)
            for number, piece in enumerate(pieces.solids)
        ]
        return names, middles

    def _ground_geom(
        self, shape: Mesh, ground: Ground, pose: Pose, source: Source | None
    ) -> dict[str, Any]:
        """Return ground as a height field with cells that MuJoCo splits from (0, 0) to (1, 1).

        Where the mesh has them split the other way, it is turned by a right angle.
        """
        from gazelle.geometry.convex_decomposition import PROMISED

        gap, turned = min(ground.gaps), ground.gaps[1] < ground.gaps[0]
        if gap > PROMISED:
            _warn_of_gap(shape, gap, source)
        heights = ground.heights.T[::-1] if turned else ground.heights
        sides = [(b - a) / 2.0 for a, b in zip(ground.low, ground.high, strict=True)]
        middle = [(b + a) / 2.0 for a, b in zip(ground.low, ground.high, strict=True)]
        low, range_z = float(heights.min()), max(float(np.ptp(heights)), _THIN)
        key = (key_of(shape), "ground")
        if key not in self.meshes:
            self.meshes[key] = f"ground_{len(self.meshes)}"
            self.spec.add_hfield(
                name=self.meshes[key],
                nrow=heights.shape[0],
                ncol=heights.shape[1],
                size=[*(sides[::-1] if turned else sides), range_z, _GROUND],
                userdata=((heights - low) / range_z).ravel(),
            )
        x, y = middle
        placed = pose * Pose(x, y, low, yaw=np.pi / 2.0 if turned else 0.0)
        kind = mujoco.mjtGeom.mjGEOM_HFIELD
        return {"type": kind, "hfieldname": self.meshes[key], **_placed(placed)}

    def seen(self, shape: Geometry, pose: Pose, *, static: bool) -> dict[str, Any] | None:
        """Return the arguments of ``add_geom`` for rays, where their shape is not the collision's.

        Raises:
            FormatError: A mesh cannot be read.
        """
        if not isinstance(shape, Mesh) or shape.path is None:
            return None
        from gazelle.formats.mesh import load_mesh

        data, closed = load_mesh(shape), False
        if not static or self.solids.ground(shape) is None:
            pieces = self.solids.pieces(shape, static=static)
            if pieces.whole or not pieces.solids:
                return None
            closed = pieces.closed
        geom = self._sheet_geom((key_of(shape), "seen"), data.vertices, data.faces, pose)
        untouched = {"contype": 0, "conaffinity": 0}
        return {"group": CLOSED_GROUP if closed else OPEN_GROUP, **untouched, **geom}

    def visible(self, shape: Geometry, pose: Pose, source: Source | None) -> list[dict[str, Any]]:
        """Return the arguments of ``add_geom`` for a visual shape without contacts.

        Raises:
            FormatError: A mesh cannot be read.
        """
        if not isinstance(shape, Mesh):
            return self.options(shape, pose, source)
        if shape.path is None:
            return []
        from gazelle.formats.mesh import load_mesh

        data = load_mesh(shape)
        return [self._sheet_geom((key_of(shape), "visible"), data.vertices, data.faces, pose)]

    def _sheet_geom(self, key: Any, vertices: Any, faces: Any, pose: Pose) -> dict[str, Any]:
        """Return a mesh geom that need not have a volume."""
        lacking = max(0, _FEWEST - len(vertices))
        padded = np.concatenate([vertices, vertices[:1].repeat(lacking, axis=0)])
        return self.mesh_geom(key, padded, faces, pose, SHELL)

    def mesh_geom(
        self, key: Any, vertices: Any, faces: Any, pose: Pose, inertia: Any = None
    ) -> dict[str, Any]:
        """Return a mesh geom; its vertices are stored on first use of the key."""
        return {
            "type": mujoco.mjtGeom.mjGEOM_MESH,
            "meshname": self._store(key, vertices, faces, inertia),
            **_placed(pose),
        }

    def _store(self, key: Any, vertices: Any, faces: Any, inertia: Any) -> str:
        """Store a mesh unless it is; returns its name."""
        if key not in self.meshes:
            name = f"mesh_{len(self.meshes)}"
            mesh = self.spec.add_mesh(
                uservert=np.asarray(vertices, dtype=np.float64).ravel(),
                userface=np.asarray(faces, dtype=np.int32).ravel(),
                inertia=inertia_of(np.asarray(vertices)) if inertia is None else inertia,
            )
            self.name_mesh(mesh, name)
            self.meshes[key] = name
        return self.meshes[key]


def _warn_of_gap(shape: Mesh, gap: float, source: Source | None) -> None:
    text = f"the mesh '{shape.uri}' collides up to {gap:.2g} m beside its surface: it is too rough"
    warnings.warn(EngineWarning(located(text, source)), stacklevel=2)


def _placed(pose: Pose) -> dict[str, Any]:
    x, y, z, w = pose.quaternion
    return {"pos": list(pose.position), "quat": [w, x, y, z]}


def _primitive(kind: Any, size: tuple[float, ...], pose: Pose) -> list[dict[str, Any]]:
    padded = (*size, 0.0, 0.0)[:3]
    return [{"type": kind, "size": list(padded), **_placed(pose)}]


def _box(_: ShapeBuilder, shape: Box, pose: Pose, __: Source | None) -> list[dict[str, Any]]:
    x, y, z = shape.size
    return _primitive(mujoco.mjtGeom.mjGEOM_BOX, (x / 2, y / 2, z / 2), pose)


def _sphere(_: ShapeBuilder, shape: Sphere, pose: Pose, __: Source | None) -> list[dict[str, Any]]:
    return _primitive(mujoco.mjtGeom.mjGEOM_SPHERE, (shape.radius,), pose)


def _cylinder(
    _: ShapeBuilder, shape: Cylinder, pose: Pose, __: Source | None
) -> list[dict[str, Any]]:
    return _primitive(mujoco.mjtGeom.mjGEOM_CYLINDER, (shape.radius, shape.length / 2), pose)


def _capsule(
    _: ShapeBuilder, shape: Capsule, pose: Pose, __: Source | None
) -> list[dict[str, Any]]:
    return _primitive(mujoco.mjtGeom.mjGEOM_CAPSULE, (shape.radius, shape.length / 2), pose)


def _ellipsoid(
    _: ShapeBuilder, shape: Ellipsoid, pose: Pose, __: Source | None
) -> list[dict[str, Any]]:
    return _primitive(mujoco.mjtGeom.mjGEOM_ELLIPSOID, shape.radii, pose)


def _plane(_: ShapeBuilder, shape: Plane, pose: Pose, __: Source | None) -> list[dict[str, Any]]:
    turned = pose * Pose.from_quaternion((0.0, 0.0, 0.0), _from_z_to(shape.normal))
    return [{"type": mujoco.mjtGeom.mjGEOM_PLANE, "size": [0.0, 0.0, 1.0], **_placed(turned)}]


def _cone(builder: ShapeBuilder, shape: Cone, pose: Pose, _: Source | None) -> list[dict[str, Any]]:
    return [builder.mesh_geom(shape, *cone_mesh(shape), pose)]


def _polyline(
    builder: ShapeBuilder, shape: Polyline, pose: Pose, _: Source | None
) -> list[dict[str, Any]]:
    from gazelle.geometry.patches import prism

    geoms = []
    for number, corners in enumerate(convex_polygons(shape.outlines)):
        rim = np.column_stack([corners, np.full(len(corners), shape.height)])
        vertices, faces = prism(rim, np.array([0.0, 0.0, shape.height]))
        geoms.append(builder.mesh_geom((shape, number), vertices, faces, pose))
    return geoms


def _heightmap(
    builder: ShapeBuilder, shape: Heightmap, pose: Pose, _: Source | None
) -> list[dict[str, Any]]:
    if shape.path is None:
        return []
    from gazelle.formats.terrain import load_heights

    name = builder.heightmaps.get(shape)
    heights = load_heights(shape)
    low, range_z = float(heights.min()), max(float(np.ptp(heights)), _THIN)
    if name is None:
        name = builder.heightmaps[shape] = f"heightmap_{len(builder.heightmaps)}"
        builder.spec.add_hfield(
            name=name,
            nrow=heights.shape[0],
            ncol=heights.shape[1],
            size=[shape.size[0] / 2.0, shape.size[1] / 2.0, range_z, _GROUND],
            userdata=((heights - low) / range_z).ravel(),
        )
    x, y, z = shape.position
    placed = pose * Pose(x, y, z + low)
    return [{"type": mujoco.mjtGeom.mjGEOM_HFIELD, "hfieldname": name, **_placed(placed)}]


def _image(_: ShapeBuilder, shape: Image, pose: Pose, __: Source | None) -> list[dict[str, Any]]:
    if shape.path is None:
        return []
    from gazelle.formats.terrain import load_boxes

    geoms = []
    for x, y, width, depth in load_boxes(shape).tolist():
        placed = pose * Pose(x, y, shape.height / 2.0)
        size = (width / 2.0, depth / 2.0, shape.height / 2.0)
        geoms += _primitive(mujoco.mjtGeom.mjGEOM_BOX, size, placed)
    return geoms


def _nothing(_: ShapeBuilder, __: Empty, ___: Pose, ____: Source | None) -> list[dict[str, Any]]:
    return []


_READERS: dict[type, Callable[..., list[dict[str, Any]]]] = {
    Box: _box,
    Capsule: _capsule,
    Cone: _cone,
    Cylinder: _cylinder,
    Ellipsoid: _ellipsoid,
    Empty: _nothing,
    Heightmap: _heightmap,
    Image: _image,
    Plane: _plane,
    Polyline: _polyline,
    Sphere: _sphere,
}


def _from_z_to(normal: Vector3) -> tuple[float, float, float, float]:
    """Return the shortest rotation (x, y, z, w) that turns the z axis into a direction."""
    n = np.asarray(normal, dtype=np.float64)
    length = float(np.linalg.norm(n))
    if length == 0.0:
        return (0.0, 0.0, 0.0, 1.0)
    x, y, z = n / length
    if z < -1.0 + 1e-12:
        return (1.0, 0.0, 0.0, 0.0)
    return (-y, x, 0.0, 1.0 + z)

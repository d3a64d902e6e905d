"""A world's shapes on the page: one batched mesh for each distinct shape."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from gazelle.array_types import Bytes, Floats, Floats32, Ints32, Ints64
from gazelle.description import Plane, Pose, World
from gazelle.rendering import columns as c
from gazelle.rendering.visible import VisibleWorld, visible_world
from gazelle.rotations import multiply, rotate

if TYPE_CHECKING:
    from viser import SceneApi

_FAR = 40.0
"""Largest extent that counts for the distance of worlds from each other [m]."""


@dataclass(frozen=True, slots=True)
class Instance:
    """Instance of a batch that was hit.

    Attributes:
        link: Scoped name.
        world: Number among those that are shown.
    """

    link: str
    world: int


@dataclass(frozen=True, slots=True)
class _Tables:
    """The tables of ``DrawnShapes``, of which compiled code shows no arrays."""

    vertices: Floats
    uv: Floats
    faces: Ints32
    meshes: Ints64
    parts: Ints64
    local: Floats
    color: Floats32
    glow: Floats32
    alpha: Floats32
    textures: Ints64
    texels: Bytes

    @classmethod
    def of(cls, seen: VisibleWorld) -> _Tables:
        """Return the tables of a world."""
        shapes = seen.shapes
        return cls(*(np.asarray(getattr(shapes, field)) for field in cls.__slots__))


@dataclass(frozen=True, slots=True)
class _Batch:
    """All that has one shape and one picture on it."""

    handle: Any
    parts: Ints64
    worlds: int
    sent: list[Floats32] = field(default_factory=list)


class ShapeBatches:
    """The visuals of some copies of a world.

    Args:
        scene: Of the page.
        root: Under which name they are.
        world: World to show.
        spots: Positions of the copies [m], shape (copies, 3).
        on_batch: Called with every batch, with what names the part of an instance.
        opacity: Below 1 is transparent.
        wireframe: Whether only edges of triangles are drawn.

    Attributes:
        links: Names of the links to place.
        rest: Poses in the description, positions (links, 3) and quaternions (links, 4).

    Raises:
        FormatError: A mesh or a terrain cannot be read.
    """

    def __init__(
        self,
        scene: SceneApi,
        root: str,
        world: World,
        spots: Floats,
        on_batch: Callable[[Any, Callable[[int], Instance]], None] | None = None,
        *,
        opacity: float = 1.0,
        wireframe: bool = False,
    ) -> None:
        seen = visible_world(world)
        self.links, self.rest = seen.links, rest_of(world, seen.links)
        self._spots, self._seen, self._tables = spots, seen, _Tables.of(seen)
        self._labels = self._tables.parts[:, c.LABEL_OF_PART]
        poses = [seen.parts[label].visual.pose for label in self._labels.tolist()]
        self._at = np.array([pose.position for pose in poses]).reshape(-1, 3)
        self._turned = np.array([pose.quaternion for pose in poses]).reshape(-1, 4)
        self._link = self._tables.parts[:, c.LINK_OF_PART]
        self._opacity, self._wireframe = opacity, wireframe
        self._batches: list[_Batch] = []
        for number, parts in enumerate(_alike(self._tables)):
            self._add(scene, f"{root}/{number}", parts, on_batch)

    def show(self, positions: Floats, quaternions: Floats) -> None:
        """Set the poses of links.

        Args:
            positions: In their worlds [m], shape (copies, links, 3).
            quaternions: x, y, z, w, shape (copies, links, 4).
        """
        turned = quaternions[:, self._link]
        at = positions[:, self._link] + rotate(turned, self._at[None]) + self._spots[:, None]
        rotations = multiply(turned, self._turned[None])
        for batch in self._batches:
            places = np.ascontiguousarray(at[: batch.worlds, batch.parts], np.float32)
            turns = np.ascontiguousarray(
                rotations[: batch.worlds, batch.parts][..., [3, 0, 1, 2]], np.float32
            )
            now = [places.reshape(-1, 3), turns.reshape(-1, 4)]
            for name, old, new in zip(
                ("batched_positions", "batched_wxyzs"), batch.sent or (None, None), now, strict=True
            ):
                if old is None or not np.array_equal(old, new):
                    setattr(batch.handle, name, new)
            batch.sent[:] = now

    def hide(self, *, hidden: bool) -> None:
        """Show them or not."""
        for batch in self._batches:
            batch.handle.visible = not hidden

    def remove(self) -> None:
        """Remove them from the page."""
        for batch in self._batches:
            batch.handle.remove()
        self._batches.clear()

    def _add(
        self,
        scene: SceneApi,
        name: str,
        parts: Ints64,
        on_batch: Callable[[Any, Callable[[int], Instance]], None] | None,
    ) -> None:
        # Grounds of several worlds would lie in each other.
        worlds = 1 if self._is_ground(parts) else len(self._spots)
        handle = self._handle(scene, name, parts, worlds)
        self._batches.append(_Batch(handle, parts, worlds))
        if on_batch is None:
            return

        def met(instance: int) -> Instance:
            world, part = divmod(instance, len(parts))
            return Instance(self.links[int(self._link[parts[part]])], world)

        on_batch(handle, met)

    def _is_ground(self, parts: Ints64) -> bool:
        first = self._seen.parts[int(self._labels[parts[0]])]
        return isinstance(first.visual.geometry, Plane)

    def _handle(self, scene: SceneApi, name: str, parts: Ints64, worlds: int) -> Any:
        shapes, count = self._tables, len(parts) * worlds
        mesh = shapes.meshes[int(shapes.parts[parts[0], c.MESH_OF_PART])]
        vertices = shapes.vertices[int(mesh[c.FIRST_VERTEX]) : int(mesh[c.LAST_VERTEX])]
        faces = shapes.faces[int(mesh[c.FIRST_FACE]) : int(mesh[c.LAST_FACE])]
        at, rotations = np.zeros((count, 3)), np.tile((1.0, 0.0, 0.0, 0.0), (count, 1))
        texture = int(shapes.parts[parts[0], c.TEXTURE_OF_PART])
        if texture >= 0 and self._opacity == 1.0 and not self._wireframe:
            uv = shapes.uv[int(mesh[c.FIRST_VERTEX]) : int(mesh[c.LAST_VERTEX])]
            dressed = textured_mesh(vertices, faces, uv, _picture(shapes, texture))
            return scene.add_batched_meshes_trimesh(name, dressed, rotations, at, lod="off")
        colors = np.clip(shapes.color[parts] + shapes.glow[parts], 0.0, 1.0)
        clear = shapes.alpha[parts].astype(np.float64)
        if not self._is_ground(parts):  # one that can be seen through hides what stands on it
            clear *= self._opacity
        see_through = bool((clear < 1.0).any())
        return scene.add_batched_meshes_simple(
            name,
            np.asarray(vertices, np.float32),
            faces,
            rotations,
            at,
            batched_colors=np.tile(np.asarray(colors * 255.0 + 0.5, np.uint8), (worlds, 1)),
            batched_opacities=np.tile(clear, worlds) if see_through else None,
            wireframe=self._wireframe,
            side="double" if mesh[c.TWO_SIDED] else "front",
            lod="off",
            cast_shadow=not (mesh[c.TWO_SIDED] or see_through),
        )


def rest_of(world: World, links: tuple[str, ...]) -> tuple[Floats, Floats]:
    """Return the initial poses of links: positions (links, 3), quaternions (links, 4)."""
    poses: dict[str, Pose] = {}
    for model in world.models:
        for placed in model.walk():
            for link in placed.model.links:
                poses[f"{placed.scope}::{link.name}"] = placed.pose * link.pose
    found = [poses[link] for link in links]
    return (
        np.array([pose.position for pose in found]).reshape(-1, 3),
        np.array([pose.quaternion for pose in found]).reshape(-1, 4),
    )


def corners_of_links(world: World) -> dict[str, Floats]:
    """Return corners of the boxes around visible shapes by link, in the link's frame [m], shape (n, 3).

    Grounds are left out.
    """
    seen = visible_world(world)
    tables = _Tables.of(seen)
    boxes = [_box(tables, mesh) for mesh in tables.meshes]
    points: dict[str, list[Floats]] = {}
    for part, local in zip(tables.parts, tables.local, strict=True):
        corners = boxes[int(part[c.MESH_OF_PART])]
        if len(corners) and np.ptp(corners, axis=0).max() < _FAR:
            placed = corners @ local[:9].reshape(3, 3).T + local[9:]
            points.setdefault(seen.links[int(part[c.LINK_OF_PART])], []).append(placed)
    return {link: np.vstack(found) for link, found in points.items()}


def extent_of_world(world: World) -> tuple[Floats, Floats]:
    """Return least and greatest corner of visible shapes except grounds [m], shape (3,)."""
    points = corners_of_links(world)
    at, turned = rest_of(world, tuple(points))
    placed = [
        place + rotate(turn[None], corners)
        for place, turn, corners in zip(at, turned, points.values(), strict=True)
    ]
    if not placed:
        return np.full(3, -1.0), np.full(3, 1.0)
    corners = np.vstack(placed)
    return corners.min(axis=0), corners.max(axis=0)


def _box(tables: _Tables, mesh: Ints64) -> Floats:
    """Return corners of the box around a mesh [m], shape (8, 3); empty without vertices."""
    vertices = tables.vertices[int(mesh[c.FIRST_VERTEX]) : int(mesh[c.LAST_VERTEX])]
    if not len(vertices):
        return np.zeros((0, 3))
    return corners_around(vertices)


def corners_around(points: Floats, room: float = 0.0) -> Floats:
    """Return corners of the box around points, larger by some room on each side [m], shape (8, 3)."""
    low, high = points.min(axis=0) - room, points.max(axis=0) + room
    which = np.array(list(itertools.product((False, True), repeat=3)))
    corners: Floats = np.where(which, high, low)
    return corners


def _alike(tables: _Tables) -> list[Ints64]:
    """Return numbers of the parts with a common shape and picture."""
    groups: dict[tuple[int, int], list[int]] = {}
    for number, row in enumerate(tables.parts):
        key = int(row[c.MESH_OF_PART]), int(row[c.TEXTURE_OF_PART])
        mesh = tables.meshes[key[0]]
        if mesh[c.LAST_FACE] > mesh[c.FIRST_FACE]:
            groups.setdefault(key, []).append(number)
    return [np.array(parts, np.int64) for parts in groups.values()]


def _picture(tables: _Tables, texture: int) -> Bytes:
    """Return red, green and blue, top row first, shape (height, width, 3)."""
    row = tables.textures[texture]
    width, height = int(row[c.TEXTURE_WIDTH]), int(row[c.TEXTURE_HEIGHT])
    first = int(row[c.FIRST_TEXEL])
    pixels = tables.texels[first : first + width * height].reshape(height, width, 3)
    return np.ascontiguousarray(pixels[::-1])


def textured_mesh(vertices: Floats, faces: Any, uv: Floats, picture: Bytes) -> Any:
    """Return textured triangles, top row first, as trimesh has them."""
    import trimesh
    from PIL import Image

    material = trimesh.visual.material.PBRMaterial(
        baseColorTexture=Image.fromarray(picture), metallicFactor=0.0, roughnessFactor=0.9
    )
    dress = trimesh.visual.TextureVisuals(uv=uv, material=material)
    return trimesh.Trimesh(vertices, faces, visual=dress, process=False)

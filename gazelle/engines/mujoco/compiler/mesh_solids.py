"""Collision of meshes: ground as a height field, or convex pieces."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from gazelle.description import Mesh
from gazelle.errors import FormatError
from gazelle.kinematics.tree import TreeLink

if TYPE_CHECKING:
    from gazelle.geometry.convex_decomposition import ConvexPieces
    from gazelle.geometry.ground import Ground

_LARGE = 60_000
"""Triangles from which on ground is a height field, however rough it is."""


class MeshSolids:
    """Ground and pieces of meshes, each computed once."""

    def __init__(self) -> None:
        self._grounds: dict[Any, Ground | None] = {}
        self._pieces: dict[Any, ConvexPieces] = {}

    def prepare(self, bodies: Iterable[TreeLink]) -> None:
        """Compute the pieces of all meshes that bodies collide with, by all processors.

        Meshes that cannot be read are left out: ``pieces`` raises their errors.
        """
        from gazelle.formats.mesh import load_mesh
        from gazelle.geometry.convex_decomposition import decompose_all

        wanted = {}
        for body in bodies:
            static = body.root == "static"
            for collision in body.link.collisions:
                shape = collision.geometry
                if isinstance(shape, Mesh) and shape.path is not None:
                    with suppress(FormatError):
                        if not static or self.ground(shape) is None:
                            wanted[key_of(shape), static] = load_mesh(shape), static
        found = decompose_all(list(wanted.values()))
        self._pieces.update(zip(wanted, found, strict=True))

    def pieces(self, shape: Mesh, *, static: bool) -> ConvexPieces:
        """Return the convex pieces of a mesh.

        Raises:
            FormatError: It cannot be read.
        """
        from gazelle.formats.mesh import load_mesh
        from gazelle.geometry.convex_decomposition import decompose

        key = (key_of(shape), static)
        if key not in self._pieces:
            self._pieces[key] = decompose(load_mesh(shape), static=static)
        return self._pieces[key]

    def ground(self, shape: Mesh) -> Ground | None:
        """Return the height field of a mesh; None if it has none that is fine enough.

        Raises:
            FormatError: It cannot be read.
        """
        from gazelle.formats.mesh import load_mesh
        from gazelle.geometry.convex_decomposition import PROMISED
        from gazelle.geometry.ground import ground_of

        key = key_of(shape)
        if key not in self._grounds:
            data = load_mesh(shape)
            found = ground_of(data)
            rough = found is not None and min(found.gaps) > PROMISED
            self._grounds[key] = None if rough and len(data.faces) < _LARGE else found
        return self._grounds[key]


def key_of(shape: Mesh) -> tuple[Any, ...]:
    """Return what identifies the triangles of a mesh."""
    return (shape.path, shape.scale, shape.submesh, shape.center_submesh)

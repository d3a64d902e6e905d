"""Meshes as vertices and faces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Ints32
from gazelle.errors import FormatError


@checked(FormatError)
@dataclass(frozen=True, slots=True)
class MeshData:
    """Triangles.

    Attributes:
        vertices: Positions [m] in the frame of the mesh, shape (n, 3); not writable.
        faces: Corners of each triangle, counter-clockwise from outside, shape (m, 3).

    Raises:
        FormatError: There is no triangle, one has corners that are not there, or a number is not
            finite.
    """

    vertices: Floats
    faces: Ints32

    def __post_init__(self) -> None:
        count, faces = len(self.vertices), self.faces
        if self.vertices.shape != (count, 3) or faces.shape != (len(faces), 3) or not len(faces):
            raise FormatError("a mesh needs triangles, vertices and faces of three numbers each")
        if faces.dtype.kind not in "iu" or not 0 <= faces.min() <= faces.max() < count:
            raise FormatError(f"triangles of a mesh need three ints each, from 0 to {count - 1}")

    @property
    def bounds(self) -> Floats:
        """Smallest and largest coordinates [m], shape (2, 3)."""
        return np.stack([self.vertices.min(axis=0), self.vertices.max(axis=0)])

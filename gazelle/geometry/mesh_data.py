"""Meshes as vertices and faces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class MeshData:
    """Triangles.

    Attributes:
        vertices: Positions [m] in the frame of the mesh, shape (n, 3); not writable.
        faces: Corners of each triangle, counter-clockwise from outside, shape (m, 3).
    """

    vertices: NDArray[np.float64]
    faces: NDArray[np.int32]

    @property
    def bounds(self) -> NDArray[np.float64]:
        """Smallest and largest coordinates [m], shape (2, 3)."""
        return np.stack([self.vertices.min(axis=0), self.vertices.max(axis=0)])

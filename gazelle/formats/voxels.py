"""A surface in a grid of cells: where it is, and what of the air around it is open to it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from gazelle.array_types import Bools, Floats, Indices
from gazelle.formats.cube_samples import CubeSampler
from gazelle.formats.surface import WeldedSurface

_MOST_CELLS = 4_000_000
_RATIO = 1.2
"""Between the numbers of steps along edges that are told apart."""
_SWEEPS = 12
"""Times that the air flows along all axes, at most."""


@dataclass(frozen=True, slots=True)
class Voxels:
    """A grid of cubes around a surface.

    Attributes:
        side: Of a cube [m].
        low: Corner of the first [m], shape (3,).
        points: Places on the surface, less than half a side apart, that air from outside
            touches [m], shape (n, 3).
        air: Middles of cubes outside that do not touch one with surface [m], shape (k, 3).
        full: Whether each cube has surface.
    """

    side: float
    low: Floats
    points: Floats
    air: Floats
    full: Bools

    def distance(self, air: Floats) -> float:
        """How far from the surface the farthest of some places is [m], rounded up.

        Of no place it is what is not looked at: two cubes, along their diagonals.
        """
        place = tuple(((air - self.low) / self.side).astype(np.intp).T)
        near, steps = _grown(self.full), 2
        while not near[place].all():
            near, steps = _grown(near), steps + 1
        return math.sqrt(3.0) * steps * self.side


def voxels_of(surface: WeldedSurface, side: float) -> Voxels:
    """The grid of a surface; coarser than asked if it would have too many cubes.

    Air is outside if it can flow there from beyond the grid, straight along its axes.
    """
    span = np.ptp(surface.vertices, axis=0)
    while np.prod(np.ceil(span / side) + 4.0) > _MOST_CELLS:
        side *= 1.1
    low = surface.vertices.min(axis=0) - 2.0 * side
    x, y, z = (np.ceil(span / side) + 4.0).astype(int).tolist()
    points, cubes, filled = samples(surface, 0.5 * side, (low, side, (x, y, z)))
    full = filled.reshape(x, y, z)
    outside = _flooded(full)
    points = points[_grown(outside).ravel()[cubes]]
    air = np.argwhere(outside & ~_grown(full))
    return Voxels(side, low, points, low + (air + 0.5) * side, full)


Grid: TypeAlias = tuple[Floats, float, tuple[int, int, int]]
"""The least corner of a grid [m], the side of its cubes [m], how many along x, y and z."""


def samples(surface: WeldedSurface, spacing: float, grid: Grid) -> tuple[Floats, Indices, Bools]:
    """Of places all over a surface, about this far from each other at most, one a cube.

    Args:
        surface: Any triangles.
        spacing: [m].
        grid: Of cubes, which hold the surface.

    Returns:
        The first place in each cube [m], shape (n, 3), the cubes as rows of the grid in one
        piece, shape (n,), and which cubes there have a place.
    """
    corners = surface.vertices[surface.faces]
    lengths = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
    longest = lengths.argmax(axis=1)
    turn = (longest[:, None] + np.arange(3)) % 3
    turned = np.take_along_axis(corners, turn[:, :, None], axis=1)
    base = lengths.max(axis=1)
    along = _steps(base, spacing)
    aside = _steps(2.0 * surface.areas / base, spacing)
    most = len(surface.vertices) + int(((along + 1) * (aside + 1)).sum())
    low, side, shape = grid
    sampler = CubeSampler(low, side, shape, min(most, math.prod(shape)))
    nothing = np.zeros(len(surface.vertices), np.int64)
    sampler.take(surface.vertices[:, None].repeat(3, axis=1), nothing, nothing)
    order = np.lexsort((aside, along))
    sampler.take(turned[order], along[order], aside[order])
    return sampler.found()


def _steps(length: Floats, spacing: float) -> Indices:
    """How many steps each length needs, rounded up so that few kinds differ."""
    power = np.ceil(np.log(np.maximum(length / spacing, 1.0)) / np.log(_RATIO))
    steps: Indices = np.ceil(_RATIO**power - 1e-9).astype(np.int64)
    return steps


def _flooded(full: Bools) -> Bools:
    """Cubes without surface that are joined to the rim of the grid by others."""
    free = ~full
    outside = np.zeros_like(full)
    for axis in range(3):
        rim = np.moveaxis(outside, axis, 0)
        rim[0] = rim[-1] = True
    for _ in range(_SWEEPS):
        before = int(outside.sum())
        for axis in range(3):
            here, open_ = np.moveaxis(outside, axis, 0), np.moveaxis(free, axis, 0)
            for i in range(1, len(here)):
                here[i] |= here[i - 1] & open_[i]
            for i in range(len(here) - 2, -1, -1):
                here[i] |= here[i + 1] & open_[i]
        if int(outside.sum()) == before:
            break
    return outside


def _grown(cubes: Bools) -> Bools:
    """Cubes with all that touch them, by a corner at least."""
    for axis in range(3):
        moved = np.moveaxis(cubes, axis, 0)
        wide = moved.copy()
        wide[1:] |= moved[:-1]
        wide[:-1] |= moved[1:]
        cubes = np.moveaxis(wide, 0, axis)
    return cubes

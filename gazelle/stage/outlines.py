"""Rays from one point against all outlines at a height."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.geometry.planar_part import PlanarPart
from gazelle.stage.description import PlacedStageModel, StagePose
from gazelle.stage.shapes import bitmap_lines, blocks_of


@dataclass(frozen=True, slots=True)
class Outlines:
    """Segments of some models, all in one frame.

    Attributes:
        lines: x0, y0, x1, y1 [m], shape (n, 4).
        heights: Lowest and highest [m], shape (n, 2).
        owners: Index of the model that each is of, shape (n,).
    """

    lines: Floats
    heights: Floats
    owners: NDArray[np.intp]

    def moved(self, pose: StagePose) -> Outlines:
        """Return outlines of a pose's frame in the parent frame."""
        cos, sin = math.cos(pose.yaw), math.sin(pose.yaw)
        turn = np.array([[cos, sin], [-sin, cos]])
        points = self.lines.reshape(-1, 2) @ turn + (pose.x, pose.y)
        return Outlines(points.reshape(-1, 4), self.heights + pose.z, self.owners)

    def at(self, height: float) -> Outlines:
        """Return the outlines at a height."""
        low, high = self.heights.T
        kept = (low <= height) & (height <= high)
        return Outlines(self.lines[kept], self.heights[kept], self.owners[kept])


def outlines_of(models: list[PlacedStageModel]) -> Outlines:
    """Return the outlines of models; ``owners`` counts them."""
    found = [(np.zeros((0, 4)), (0.0, 0.0), 0)]
    for index, placed in enumerate(models):
        frame, bitmap = placed.body_pose, placed.model.bitmap
        found += [(_lines_of(part), (part.low, part.high), index) for part in blocks_of(placed)]
        if bitmap is not None:
            extent = (frame.z + bitmap.z[0], frame.z + bitmap.z[1])
            found.append((bitmap_lines(bitmap, frame), extent, index))
    counts = [len(lines) for lines, _, _ in found]
    return Outlines(
        np.vstack([lines for lines, _, _ in found]),
        np.repeat(np.array([extent for _, extent, _ in found]), counts, axis=0),
        np.repeat(np.array([index for _, _, index in found], np.intp), counts),
    )


def joined(parts: list[tuple[Outlines, int]]) -> Outlines:
    """Return several outlines as one; a number is added to the owners of each."""
    return Outlines(
        np.vstack([each.lines for each, _ in parts]),
        np.vstack([each.heights for each, _ in parts]),
        np.concatenate([each.owners + first for each, first in parts]),
    )


def distances(x: float, y: float, angles: Floats, there: Outlines) -> Floats:
    """Return distances to each segment along each ray [m], infinite if not met, (rays, n).

    Args:
        x: Of the point [m].
        y: Of the point [m].
        angles: Of the rays [rad], shape (rays,).
        there: Known models.
    """
    dx, dy = np.cos(angles)[:, None], np.sin(angles)[:, None]
    x0, y0, x1, y1 = (there.lines - (x, y, x, y)).T
    ex, ey = x1 - x0, y1 - y0
    across = dx * ey - dy * ex
    with np.errstate(divide="ignore", invalid="ignore"):
        distance = (x0 * ey - y0 * ex) / across
        along = (x0 * dy - y0 * dx) / across
        met = (across != 0.0) & (distance >= 0.0) & (along >= 0.0) & (along <= 1.0)
    found: Floats = np.where(met, distance, np.inf)
    return found


def _lines_of(part: PlanarPart) -> Floats:
    ring = np.asarray(part.points, np.float64)
    return np.hstack((ring, np.roll(ring, -1, axis=0)))

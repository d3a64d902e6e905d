"""Bumpers: strips that report contacts."""

from __future__ import annotations

import math

import numpy as np

from gazelle.array_types import Floats
from gazelle.stage.description import (
    StageBumper,
    StageModel,
    StagePose,
)
from gazelle.stage.finders import Surroundings
from gazelle.stage.outlines import Outlines


def find_bumps(around: Surroundings, robot: int, which: int, world: int) -> tuple[str | None, ...]:
    """Return what each strip of a bumper touches: the whole name of a model, or None.

    A strip touches what is nearer than a cell of Stage's grid and as high as anything of its
    robot, whether that is an obstacle or not.

    Raises:
        SimulationError: It has no such bumper.
    """
    bumper = around.mounted(robot, StageBumper, which, world)
    own, margin = around.model(robot), around.resolution
    strips = [_strip(bumper.pose.then(StagePose(*p)), n) for p, n in bumper.device.strips]
    here = around.place(robot, world)
    reach = max(
        (math.hypot(x - here.x, y - here.y) for strip in strips for x, y in strip.tolist()),
        default=0.0,
    )
    models, lines = around.around(robot, reach + margin, world)
    low, high = _heights(own)
    level = _within(lines, low, high)
    found: list[str | None] = []
    for strip in strips:
        gaps = gaps_to(strip, level.lines)
        nearest = int(gaps.argmin()) if len(gaps) else 0
        touched = bool(len(gaps)) and float(gaps[nearest]) <= margin
        found.append(models[int(level.owners[nearest])].name if touched else None)
    return tuple(found)


def gaps_to(strip: Floats, lines: Floats) -> Floats:
    """Return the distances of a segment to others [m], shape (n,).

    Args:
        strip: Ends of the segment, shape (2, 2).
        lines: The others: x0, y0, x1, y1, shape (n, 4).
    """
    starts, ends = lines[:, :2], lines[:, 2:]
    gaps = np.minimum(
        np.minimum(_to_segments(strip[0], starts, ends), _to_segments(strip[1], starts, ends)),
        np.minimum(_to_segment(starts, strip), _to_segment(ends, strip)),
    )
    along = strip[1] - strip[0]
    sides = _cross(along, starts - strip[0]) * _cross(along, ends - strip[0])
    others = _cross(ends - starts, strip[0] - starts) * _cross(ends - starts, strip[1] - starts)
    found: Floats = np.where((sides < 0.0) & (others < 0.0), 0.0, gaps)
    return found


def _strip(middle: StagePose, length: float) -> Floats:
    """Return the ends of a strip across the heading of its pose, shape (2, 2)."""
    half = np.array([-math.sin(middle.yaw), math.cos(middle.yaw)]) * length / 2.0
    return np.asarray(np.array([middle.x, middle.y]) + np.array([-half, half]))


def _heights(model: StageModel) -> tuple[float, float]:
    """Return lowest and highest point of a robot and all on it in the world [m]."""
    ends = [
        placed.body_pose.z + end
        for placed in model.walk()
        for block in placed.model.blocks
        for end in block.z
    ]
    return min(ends, default=model.pose.z), max(ends, default=model.pose.z)


def _within(lines: Outlines, low: float, high: float) -> Outlines:
    kept = (lines.heights[:, 0] < high) & (lines.heights[:, 1] > low)
    return Outlines(lines.lines[kept], lines.heights[kept], lines.owners[kept])


def _cross(a: Floats, b: Floats) -> Floats:
    found: Floats = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return found


def _to_segments(point: Floats, starts: Floats, ends: Floats) -> Floats:
    along = ends - starts
    square = np.maximum((along**2).sum(axis=1), 1e-300)
    share = np.clip(((point - starts) * along).sum(axis=1) / square, 0.0, 1.0)
    return np.asarray(np.linalg.norm(starts + share[:, None] * along - point, axis=1))


def _to_segment(points: Floats, strip: Floats) -> Floats:
    along = strip[1] - strip[0]
    square = max(float(along @ along), 1e-300)
    share = np.clip((points - strip[0]) @ along / square, 0.0, 1.0)
    return np.asarray(np.linalg.norm(strip[0] + share[:, None] * along - points, axis=1))

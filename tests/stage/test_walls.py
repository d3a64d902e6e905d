"""Walls of bitmaps as the planar engine takes them, and rays against exact ones."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from stage_samples import draw, write

from gazelle.geometry.bitmap_outline import bitmap_outline
from gazelle.stage import StageSimulation
from gazelle.stage.description import (
    PlacedStageModel,
    StageBitmap,
    StageModel,
    StagePose,
)
from gazelle.stage.shapes import parts_of
from gazelle.stage.walls import table_of

masks = arrays(np.bool_, st.tuples(st.integers(1, 12), st.integers(1, 12)))


def edges_of(lines):
    """Return each segment as edges of single cells, with their direction."""
    found = []
    for x0, y0, x1, y1 in lines.tolist():
        steps = max(abs(x1 - x0), abs(y1 - y0))
        dx, dy = (x1 - x0) // steps, (y1 - y0) // steps
        found += [(x0 + i * dx, y0 + i * dy, dx, dy) for i in range(steps)]
    return found


@pytest.mark.long
@given(cells=masks)
def test_the_outline_has_every_edge_once_with_the_wall_on_its_left(cells):
    edges = edges_of(bitmap_outline(cells))
    framed = np.pad(cells, 1)
    wanted = int(np.abs(np.diff(framed.astype(int), axis=0)).sum())
    wanted += int(np.abs(np.diff(framed.astype(int), axis=1)).sum())
    assert len(edges) == len(set(edges)) == wanted
    for x, y, dx, dy in edges:
        left = (x + (dx - dy - 1) / 2, y + (dy + dx - 1) / 2)
        right = (x + (dx + dy - 1) / 2, y + (dy - dx - 1) / 2)
        inside = [framed[round(row) + 1, round(column) + 1] for column, row in (left, right)]
        assert inside == [True, False]


@given(cells=masks)
def test_the_outline_encloses_the_area_of_the_walls(cells):
    x0, y0, x1, y1 = bitmap_outline(cells).T
    assert (x0 * y1 - x1 * y0).sum() / 2 == cells.sum()


def test_segments_go_on_as_far_as_the_wall_does():
    assert len(bitmap_outline(np.ones((50, 80), bool))) == 4


def placed(**fields):
    bitmap = StageBitmap(
        "m", None, np.array([[True, False], [True, True]]), (-1.0, -2.0), (1.0, 2.0), (0.5, 1.0)
    )
    return PlacedStageModel(
        StageModel("model", "m", bitmap=bitmap, **fields), "m", StagePose(10.0, 0.0, 2.0, math.pi)
    )


def test_bitmaps_stand_where_their_model_does():
    rows = table_of([placed()]).rows
    assert sorted({round(x, 9) for x in rows[:, 0]}) == [9.0, 10.0, 11.0]
    assert sorted({round(y, 9) for y in rows[:, 1]}) == [-2.0, 0.0, 2.0]
    assert rows[:, 4] == pytest.approx(2.5)
    assert rows[:, 5] == pytest.approx(3.0)


def test_a_bitmap_on_a_robot_is_rectangles():
    parts = list(parts_of(placed()))
    areas = []
    for part in parts:
        points = np.array(part.points)
        areas.append(np.prod(np.ptp(points, axis=0)))
    assert sum(areas) == pytest.approx(6.0)


@pytest.mark.parametrize("resolution", [0.02, 0.1])
def test_rays_in_a_box_are_exact(tmp_path, resolution):
    # Stage's own mean error there is 4 mm at a resolution of 0.02 m, and 56 mm at 0.1 m.
    cells = round(10.0 / resolution) + 2
    draw(tmp_path, ["#" * cells, *["#" + "." * (cells - 2) + "#"] * (cells - 2), "#" * cells])
    side = cells * resolution
    file = write(
        tmp_path,
        f'model ( bitmap "map.png" size [{side} {side} 1] )'
        'position ( name "r" size [.1 .1 .1] '
        "ranger ( sensor ( range [0 20] fov 360 samples 361 ) ) )",
    )
    rng = np.random.default_rng(1)
    errors = []
    with StageSimulation(file, threads=1) as sim:
        for x, y, yaw in rng.uniform([-4.9, -4.9, -3], [4.9, 4.9, 3], (20, 3)):
            sim.set_pose("r", (x, y, yaw))
            angles = yaw + np.linspace(-math.pi, math.pi, 361)
            with np.errstate(divide="ignore"):
                across = (np.where(np.cos(angles) > 0, 5.0, -5.0) - x) / np.cos(angles)
                along = (np.where(np.sin(angles) > 0, 5.0, -5.0) - y) / np.sin(angles)
            errors.append(np.abs(sim.scan_of("r") - np.minimum(across, along)))
    assert np.max(errors) < 1e-9

"""Beams that stride through clear space and stop at a bitmap's cells, against exact geometry."""

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle.engines.planar import Body, Fan, Fleet, Mount, PlanarPart, Scanner
from gazelle.engines.planar import scan_columns as k
from gazelle.engines.planar.clear_space import measure_clear
from gazelle.engines.planar.clear_space_grid import clear_space_grid_of
from gazelle.engines.planar.shapes import PrimitiveTable
from gazelle.stage.description import (
    PlacedStageModel,
    StageBitmap,
    StageModel,
    StagePose,
)
from gazelle.stage.outlines import distances, outlines_of
from gazelle.stage.walls import table_of

REACH = 6.0
SEEDS = st.integers(0, 2**32 - 1)


def picture(rng, rows=40, columns=50, share=0.15):
    """Return a bitmap of scattered walls, 5 m wide and 3.2 m deep, somewhere at some angle."""
    cells = rng.random((rows, columns)) < share
    bitmap = StageBitmap("x.png", Path("x.png"), cells, (-2.5, -1.6), (2.5, 1.6), (0.0, 1.0))
    pose = StagePose(*rng.uniform(-3.0, 3.0, 2), 0.0, rng.uniform(-3.0, 3.0))
    return PlacedStageModel(StageModel("model", "wall", bitmap=bitmap), "wall", pose)


def exact(models, circle, poses, fan):
    """Return the ranges of one sensor at each pose, by every segment and the circle."""
    there = outlines_of(models).at(0.5)
    ranges = np.full((len(poses), fan.count), fan.reach)
    for row, (x, y, yaw) in zip(ranges, poses, strict=True):
        angles = yaw + fan.angles
        row[:] = np.minimum(row, distances(x, y, angles, there).min(axis=1, initial=np.inf))
        dx, dy = np.cos(angles), np.sin(angles)
        along = dx * (circle[0] - x) + dy * (circle[1] - y)
        aside = dx * (circle[1] - y) - dy * (circle[0] - x)
        root = np.sqrt(np.maximum(circle[2] ** 2 - aside**2, 0.0))
        for t in (along - root, along + root):
            met = (np.abs(aside) <= circle[2]) & (t >= 0.0)
            row[:] = np.where(met, np.minimum(row, t), row)
    return ranges


def fleet_of(models, circle, poses, z=0.5):
    """Return bodies without shapes, and a round post that is no part of a bitmap."""
    table = table_of(models)
    post = table_of([])
    rows = np.zeros((1, table.rows.shape[1]))
    rows[0] = [circle[0], circle[1], circle[2], 0.0, -math.inf, math.inf, 1.0, 1.0]
    assert len(post.rows) == 0
    whole = PrimitiveTable(
        np.vstack((table.rows, rows)), np.zeros(len(table.rows) + 1, np.int64), table.raster
    )
    return Fleet([Body((), tuple(pose), z=z) for pose in poses], whole)


@pytest.mark.long
@pytest.mark.parametrize("count", [3, 90, 700])
@given(seed=SEEDS)
@settings(max_examples=12, deadline=None)
def test_beams_among_bitmaps_are_exact(count, seed):
    rng = np.random.default_rng(seed)
    models = [picture(rng), picture(rng, 20, 20)]
    circle = (*rng.uniform(-5.0, 5.0, 2), 0.4)
    poses = np.column_stack((rng.uniform(-5.0, 5.0, (40, 2)), rng.uniform(-3.0, 3.0, 40)))
    fan = Fan(-math.pi, 2 * math.pi / count, count, REACH)
    fleet = fleet_of(models, circle, poses)
    scanner = Scanner(fleet, fan, [Mount(i) for i in range(40)])
    error = np.abs(scanner.scan()[0] - exact(models, circle, poses, fan))
    # a beam along an edge of a pixel may be on either side of it
    assert np.sort(error.ravel())[: -max(2, error.size // 5000)].max() < 1e-9


@pytest.mark.parametrize("count", [2, 120])
def test_what_beams_met_is_told_the_same_with_and_without_solid_cells(count):
    rng = np.random.default_rng(3)
    models = [picture(rng)]
    poses = np.column_stack((rng.uniform(-4.0, 4.0, (60, 2)), rng.uniform(-3.0, 3.0, 60)))
    fleet = fleet_of(models, (9.0, 9.0, 0.1), poses)
    fan = Fan(0.0, 6.0 / count, count, REACH)
    mounts = [Mount(i) for i in range(60)]
    solid, listed = (Scanner(fleet, fan, mounts, named=True) for _ in range(2))
    listed._clearing = fleet.scene.clearing(solid=False)
    assert solid.scan() == pytest.approx(listed.scan(), abs=1e-9)
    assert (np.sign(solid.names) == np.sign(listed.names)).all()  # from inside or outside
    assert (solid.glows() == listed.glows()).all()
    assert (solid.bodies() == -1).all()


@pytest.mark.parametrize("count", [2, 120])
def test_beams_pass_over_a_bitmap_that_is_lower(count):
    rng = np.random.default_rng(4)
    fleet = fleet_of([picture(rng)], (3.0, 0.0, 0.5), [(0.0, 0.0, 0.0)], z=1.5)
    fan = Fan(0.0, 1e-3, count, REACH)
    assert Scanner(fleet, fan, [Mount(0)]).scan()[0, 0, 0] == pytest.approx(2.5)


@pytest.mark.parametrize("count", [1, 120])
@pytest.mark.parametrize("yaw", [0.0, math.pi / 2, math.pi, -math.pi / 2])
def test_a_sensor_on_the_edge_of_a_wall_sees_away_from_it(count, yaw):
    cells = np.ones((60, 60), bool)
    cells[20:40, 20:40] = False  # a hole of 1 m by 1 m
    bitmap = StageBitmap("x.png", Path("x.png"), cells, (-1.5, -1.5), (1.5, 1.5), (0.0, 1.0))
    room = PlacedStageModel(StageModel("model", "room", bitmap=bitmap), "room", StagePose())
    place = (-0.5 * round(math.cos(yaw)), -0.5 * round(math.sin(yaw)), yaw)
    # 270 more posts far away, so that beams are followed
    posts = [picture(np.random.default_rng(2))]
    posts[0] = PlacedStageModel(posts[0].model, "posts", StagePose(40.0, 0.0))
    fleet = fleet_of([room, *posts], (50.0, 0.0, 0.1), [place])
    fan = Fan(0.0, 1e-4, count, REACH)
    assert Scanner(fleet, fan, [Mount(0)]).scan()[0, 0, 0] == pytest.approx(1.0, abs=1e-8)


@given(seed=SEEDS)
@settings(max_examples=20, deadline=None)
def test_squares_are_the_largest_that_are_empty(seed):
    rng = np.random.default_rng(seed)
    rows, columns = rng.integers(1, 14, 2)
    full, there = rng.random((2, rows, columns)) < 0.12
    start = np.concatenate(([0], np.cumsum(there.ravel()))).astype(np.int32)
    clear = np.zeros(5 * rows * columns, np.int8)
    measure_clear(full.ravel().astype(np.int8), start, int(columns), clear)
    squares = clear.reshape(5, rows, columns)
    taken = np.pad(full | there, 20)
    for row in range(rows):
        for column in range(columns):
            sides = [
                largest(taken, row + 20, column + 20, up, right)
                for right in (1, -1)
                for up in (1, -1)
            ]
            found = squares[:, row, column]
            if full[row, column]:
                assert (found == -1).all()
            else:
                wide = [side if side <= 20 else found[i] for i, side in enumerate(sides)]
                assert found[:4].tolist() == wide
                assert found[4] == min(found[:4])


def largest(taken, row, column, up, right):
    """Return side of the largest square without any that is taken.

    21 for one that leaves the picture.
    """
    for side in range(1, 21):
        rows = sorted((row, row + up * (side - 1)))
        columns = sorted((column, column + right * (side - 1)))
        if taken[rows[0] : rows[1] + 1, columns[0] : columns[1] + 1].any():
            return side - 1
    return 21


def test_a_picture_of_a_million_cells_is_left_out_where_much_more_is_around_it():
    bitmap = StageBitmap(
        "x.png", Path("x.png"), np.ones((4, 4), bool), (0.0, 0.0), (0.004, 0.004), (0, 1)
    )
    model = StageModel("model", "dot", bitmap=bitmap)
    dot = PlacedStageModel(model, "dot", StagePose())
    table = table_of([dot])
    far = PrimitiveTable(
        np.vstack((table.rows, [500.0, 500.0, 1.0, 0.0, -1.0, 1.0, 1.0, 1.0])),
        np.zeros(len(table.rows) + 1, np.int64),
        table.raster,
    )
    assert clear_space_grid_of(table, solid=True).fine[k.SOLID_NAME] == 1.0
    assert clear_space_grid_of(far, solid=True).fine[k.SOLID_NAME] == 0.0


def test_nothing_static_is_clear_all_over():
    bodies = [Body((PlanarPart.circle(0.0, 0.0, 0.2),), (1.0 * i, 0.0, 0.0)) for i in range(60)]
    scanner = Scanner(Fleet(bodies), Fan(0.0, 1.0, 1, 3.0), [Mount(i) for i in range(60)])
    ranges = scanner.scan()[0, :, 0]
    assert ranges[:-1] == pytest.approx(0.8)
    assert ranges[-1] == 3.0


@pytest.mark.parametrize("count", [1, 3, 200])
def test_any_number_of_threads_sees_the_same(count):
    rng = np.random.default_rng(8)
    bodies = [
        Body((PlanarPart.box(0.3, 0.2),), (*rng.uniform(-4.0, 4.0, 2), rng.uniform(-3.0, 3.0)))
        for _ in range(300)
    ]
    mounts = [Mount(i, yaw=yaw) for i in range(300) for yaw in rng.uniform(-3.0, 3.0, 16)]
    fan, found = Fan(0.0, 3.0 / count, count, REACH), []
    for threads in (1, 2, 3):
        fleet = Fleet(bodies, table_of([picture(np.random.default_rng(1))]), threads=threads)
        scanner = Scanner(fleet, fan, mounts, named=True)
        found.append((scanner.scan().tobytes(), scanner.names.tobytes()))
        fleet.close()
    assert found[0] == found[1] == found[2]

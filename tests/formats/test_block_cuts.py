"""What blocks are cut by: the same as NumPy says in many operations, and the same bits in any build."""

import os
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle import native
from gazelle.formats.block_cuts import BlockCutter
from gazelle.formats.cube_samples import CubeSampler
from gazelle.formats.hull import convex_hull
from gazelle.formats.integer_hull import HullBuilder

SEEDS = st.integers(0, 2**32 - 1)
PIECES = """
import hashlib, sys
import numpy as np
from gazelle import native
from gazelle.formats.mesh import MeshData
from gazelle.formats.surface import clean
from gazelle.formats.blocks import blocks_of
corner = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
faces = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2]], np.int32)
found = blocks_of(clean(corner, faces), 0.2)
text = hashlib.sha256(b"".join(hull.tobytes() for hull in found.hulls)).hexdigest()
print(native.BUILD, len(found.hulls), found.gap, text)
"""


def cloud(chance, count):
    return np.ascontiguousarray(chance.normal(size=(count, 3)), np.float32)


def directions(chance, count):
    found = chance.normal(size=(count, 3))
    return np.array(found / np.linalg.norm(found, axis=1)[:, None], np.float32)


@settings(max_examples=40, deadline=None)
@given(SEEDS, st.integers(1, 300), st.integers(1, 70))
def test_points_reach_as_far_as_the_farthest(seed, count, ways):
    chance = np.random.default_rng(seed)
    points, around = cloud(chance, count), directions(chance, ways)
    tops, which = BlockCutter(around, 1, 1, 4).tops(points)
    along = points.astype(float) @ around.astype(float).T
    np.testing.assert_allclose(tops[:ways], along.max(axis=0), atol=1e-6)
    np.testing.assert_allclose(along[which, np.arange(ways)], along.max(axis=0), atol=1e-6)


@settings(max_examples=40, deadline=None)
@given(SEEDS, st.integers(0, 300), st.integers(1, 70))
def test_air_is_kept_that_is_beyond_nothing(seed, count, ways):
    chance = np.random.default_rng(seed)
    air, around = cloud(chance, count), directions(chance, ways)
    cutter = BlockCutter(around, 1, 1, 4)
    tops, _ = cutter.tops(np.float32(0.7) * cloud(chance, 20))
    along = air.astype(float) @ around.astype(float).T
    clear = (np.abs(along - tops[:ways]) > 1e-5).all(axis=1)
    expected = (along <= tops[:ways]).all(axis=1)
    assert cutter.behind(air, tops)[clear].tolist() == expected[clear].tolist()


@settings(max_examples=40, deadline=None)
@given(SEEDS, st.integers(4, 100), st.integers(0, 200))
def test_air_in_a_hull_is_behind_all_of_its_faces(seed, corners, count):
    chance = np.random.default_rng(seed)
    points, air = chance.normal(size=(corners, 3)), cloud(chance, count)
    depth = convex_hull(points).depth(air.astype(float))
    cutter = BlockCutter(np.eye(3, dtype=np.float32), 1, 1, corners)
    clear = np.abs(depth) > 1e-4
    assert cutter.within(points, air)[clear].tolist() == (depth > 0.0)[clear].tolist()
    flat = np.ascontiguousarray(points * [1.0, 1.0, 0.0])
    assert not cutter.within(flat, air).any()


@settings(max_examples=40, deadline=None)
@given(SEEDS, st.integers(2, 60), st.integers(1, 60))
def test_the_best_cut_leaves_least_air(seed, count, places):
    chance = np.random.default_rng(seed)
    points, air, around = cloud(chance, count), cloud(chance, places), directions(chance, 33)
    axes = chance.integers(0, 3, 12).astype(np.int32)
    levels = chance.normal(size=12)
    cutter = BlockCutter(around, 1, 60, 4)
    costs = []
    for axis, level in zip(axes, levels, strict=True):
        under = points[:, axis] <= level
        if under.all() or not under.any():
            costs.append(np.inf)
            continue
        halves = [(points[half] @ around.T).max(axis=0) for half in (under, ~under)]
        held = [(air @ around.T <= top).all(axis=1) for top in halves]
        costs.append((held[0] | held[1]).sum() + 0.5 * abs(under.mean() - 0.5))
    best = cutter.best_cut(points, air, axes, levels, 0.5)
    assert best == (-1 if np.isinf(costs).all() else int(np.argmin(costs)))


@settings(max_examples=30, deadline=None)
@given(SEEDS, st.integers(1, 30), st.floats(0.05, 0.5))
def test_each_cube_has_its_first_place(seed, count, side):
    chance = np.random.default_rng(seed)
    corners = chance.uniform(size=(count, 3, 3))
    steps = chance.integers(1, 9, (2, count))
    shape = (int(1.0 / side) + 1,) * 3
    sampler = CubeSampler(np.zeros(3), side, shape, int(((steps + 1).prod(axis=0)).sum()))
    sampler.take(corners, steps[0], steps[1])
    points, cubes, full = sampler.found()
    first = {}
    for (a, b, c), (u, v) in zip(corners, steps.T.tolist(), strict=True):
        for i in range(u + 1):
            for j in range(v + 1):
                t, s = j / v, (1.0 - j / v) * (i / u)
                place = (1.0 - s - t) * a + s * b + t * c
                first.setdefault(tuple((place / side).astype(int)), place)
    assert [tuple(np.unravel_index(cube, shape)) for cube in cubes] == list(first)
    np.testing.assert_array_equal(points, list(first.values()))
    assert np.flatnonzero(full).tolist() == sorted(cubes.tolist())


def test_too_many_points_are_refused():
    with pytest.raises(ValueError, match="room for 4 points, not for 5"):
        HullBuilder(4).hull(np.zeros((5, 3)))


def test_a_hull_after_another_knows_nothing_of_it():
    chance = np.random.default_rng(0)
    clouds = [chance.normal(size=(count, 3)) for count in (4, 300, 5, 80, 4)]
    builder = HullBuilder(300)
    for points in clouds:
        assert builder.hull(points).tolist() == HullBuilder(300).hull(points).tolist()


@pytest.mark.long
@pytest.mark.parametrize("build", ["avx2", "python"])
def test_blocks_do_not_depend_on_the_build(build):
    if build == "avx2" and native.BUILD != "avx2":
        pytest.skip("this processor has no AVX2")
    found = {}
    for each in ("baseline", build):
        done = subprocess.run(
            [sys.executable, "-c", PIECES],
            env=os.environ | {"GAZELLE_NATIVE": each},
            check=True,
            capture_output=True,
            text=True,
        )
        name, found[each] = done.stdout.split(maxsplit=1)
        assert name == each
    assert found["baseline"] == found[build]

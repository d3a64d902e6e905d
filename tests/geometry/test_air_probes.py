"""Hulls against places in the air: the same as NumPy says, and the same bits in any build."""

import os
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle import native
from gazelle.geometry.air_probes import AirProbes
from gazelle.geometry.hull import convex_hull
from gazelle.geometry.integer_hull import HullBuilder
from gazelle.geometry.merging import PieceMerger

SEEDS = st.integers(0, 2**32 - 1)
PIECES = """
import hashlib
import numpy as np
from gazelle import native
from gazelle.geometry.merging import PieceMerger
chance = np.random.default_rng(0)
clouds = [chance.normal(size=(6, 3)) + chance.normal(size=3) for _ in range(12)]
merger = PieceMerger(clouds, chance.normal(size=(20, 3)))
merger.merge(merger.overlapping())
found = merger.clouds()
text = hashlib.sha256(b"".join(cloud.tobytes() for cloud in found)).hexdigest()
print(native.BUILD, len(found), text)
"""


@settings(max_examples=60, deadline=None)
@given(SEEDS, st.integers(4, 60), st.integers(1, 200), st.floats(0.1, 3.0))
def test_a_hull_is_refused_that_holds_a_place(seed, corners, count, spread):
    chance = np.random.default_rng(seed)
    points, places = chance.normal(size=(corners, 3)), spread * chance.normal(size=(count, 3))
    depth = convex_hull(points).depth(places)
    if np.abs(depth).min() < 1e-4:
        return  # too near to tell
    found = AirProbes(places, corners).corners(points)
    assert (found is None) == bool((depth > 0.0).any())
    if found is not None:
        assert convex_hull(points[found]).depth(points).min() > -1e-5


def test_points_in_a_plane_hold_nothing():
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
    assert AirProbes(np.array([[0.5, 0.5, 0.0]]), 4).corners(square).tolist() == [0, 1, 2, 3]


@settings(max_examples=30, deadline=None)
@given(SEEDS, st.integers(2, 15), st.integers(1, 40))
def test_merged_pieces_hold_no_place_and_all_points(seed, count, places):
    chance = np.random.default_rng(seed)
    clouds = [0.3 * chance.normal(size=(6, 3)) + chance.normal(size=3) for _ in range(count)]
    air = chance.normal(size=(places, 3))
    merger = PieceMerger(clouds, air)
    merger.merge(merger.overlapping())
    pieces = merger.clouds()
    assert 1 <= len(pieces) <= count
    hulls = [convex_hull(piece) for piece in pieces]
    merged = [
        hull
        for hull, piece in zip(hulls, pieces, strict=True)
        if not any(np.array_equal(piece, cloud) for cloud in clouds)
    ]
    assert all(hull.depth(air).max() < 1e-5 for hull in merged)
    points = np.concatenate(clouds)
    assert np.max([hull.depth(points) for hull in hulls], axis=0).min() > -1e-5


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
def test_pieces_do_not_depend_on_the_build(build):
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

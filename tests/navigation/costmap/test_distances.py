"""Distances on a grid are exact."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from gazelle.navigation.costmap.distances import FAR, squared_distances


@given(
    arrays(np.uint8, st.tuples(st.integers(1, 23), st.integers(1, 23)), elements=st.integers(0, 1))
)
def test_every_cell_knows_the_nearest_marked_one(marked):
    found = squared_distances(marked)
    places = np.argwhere(marked)
    if not len(places):
        assert (found == FAR).all()
        return
    rows, columns = np.indices(marked.shape)
    away = (rows[..., None] - places[:, 0]) ** 2 + (columns[..., None] - places[:, 1]) ** 2
    assert np.array_equal(found, away.min(axis=-1))


def test_a_large_grid_agrees_with_scipy():
    transform = pytest.importorskip("scipy.ndimage").distance_transform_edt
    marked = (np.random.default_rng(1).random((300, 411)) < 0.003).astype(np.uint8)
    assert np.array_equal(squared_distances(marked), np.rint(transform(marked == 0) ** 2))

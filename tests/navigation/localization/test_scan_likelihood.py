"""Sums over beams are the same bits as one after another, however many poses are scored at once."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle.navigation.localization.scan_likelihood import LikelihoodField

ORIGIN, CELL, OUTSIDE = (-3.0, 2.0), 0.25, 0.125


def field(seed, rows, columns):
    terms = np.random.default_rng(seed).uniform(0.2, 1.0, (rows, columns)).astype(np.float32)
    return terms, LikelihoodField(terms, ORIGIN, CELL, OUTSIDE)


def values_at(terms, pose, points):
    """Return each end's term, None off the map: shape (m,)."""
    c, s = np.cos(pose[2]), np.sin(pose[2])
    x = pose[0] + c * points[:, 0] - s * points[:, 1] - ORIGIN[0]
    y = pose[1] + s * points[:, 0] + c * points[:, 1] - ORIGIN[1]
    column, row = np.floor(x / CELL), np.floor(y / CELL)
    rows, columns = terms.shape
    with np.errstate(invalid="ignore"):
        inside = (column >= 0) & (column < columns) & (row >= 0) & (row < rows)
    return [
        float(terms[int(r), int(c)]) if ok else None
        for r, c, ok in zip(row, column, inside, strict=True)
    ]


SIZES = st.integers(1, 9)


@pytest.mark.long
@settings(max_examples=60)
@given(st.integers(0, 2**32 - 1), SIZES, SIZES, st.integers(1, 70), st.integers(0, 20))
def test_scores_and_counts_are_those_of_one_end_after_another(seed, rows, columns, count, beams):
    random = np.random.default_rng(seed)
    terms, made = field(seed, rows, columns)
    poses = random.uniform(-4.0, 4.0, (count, 3))
    points = random.uniform(-3.0, 3.0, (beams, 2))
    values = [values_at(terms, pose, points) for pose in poses]
    wanted = []
    for each in values:
        total = 1.0
        for value in each:
            total += OUTSIDE if value is None else value
        wanted.append(total)
    assert made.scores(poses, points, 1.0).tolist() == wanted
    for least in (0.5, 0.0, 0.9):
        above = [
            sum(v is not None and v > least for v in beam) for beam in zip(*values, strict=True)
        ]
        assert made.count_above(poses, points, least).tolist() == above


@pytest.mark.parametrize("split", [1, 5, 31, 32, 33, 64, 99])
def test_bits_do_not_depend_on_how_poses_are_divided(split):
    random = np.random.default_rng(split)
    _, made = field(1, 40, 50)
    poses, points = random.uniform(-4.0, 12.0, (100, 3)), random.uniform(-3.0, 3.0, (37, 2))
    whole = made.scores(poses, points, 0.0)
    parts = [made.scores(poses[:split], points, 0.0), made.scores(poses[split:], points, 0.0)]
    assert whole.tobytes() == np.concatenate(parts).tobytes()


@pytest.mark.parametrize("odd", [np.nan, np.inf, -np.inf, 1e300, -1e300, 1e15, -1e15])
def test_ends_that_are_nowhere_are_off_the_map(odd):
    _, made = field(2, 5, 5)
    points = np.array([[odd, 0.0], [0.0, odd], [odd, odd]])
    poses = np.array([[-2.5, 2.5, 0.0], [-2.5, 2.5, 1.0]])
    assert made.scores(poses, points, 0.0).tolist() == [3 * OUTSIDE] * 2
    assert made.count_above(poses, points, 0.0).tolist() == [0.0] * 3


def test_no_poses_and_no_beams_are_no_trouble():
    _, made = field(3, 4, 4)
    assert made.scores(np.zeros((0, 3)), np.zeros((2, 2)), 1.0).shape == (0,)
    assert made.scores(np.zeros((2, 3)), np.zeros((0, 2)), 1.0).tolist() == [1.0, 1.0]
    assert made.count_above(np.zeros((0, 3)), np.zeros((2, 2)), 0.0).tolist() == [0.0, 0.0]

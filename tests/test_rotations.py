"""Quaternions by the batch."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from gazelle.rotations import (
    conjugate,
    cross,
    from_matrices,
    from_yaw,
    multiply,
    rotate,
    seen_on_ground,
    turns,
    yaw_of,
)

numbers = st.floats(-10.0, 10.0)
quaternions = arrays(np.float64, 4, elements=numbers).filter(lambda q: np.linalg.norm(q) > 0.1)


@given(quaternions, arrays(np.float64, 3, elements=numbers))
def test_one_vector_is_turned_to_the_bit_as_one_of_many(q, v):
    q = q / np.linalg.norm(q)
    many = rotate(np.stack((q, q)), np.stack((v, v)))
    assert np.array_equal(rotate(q[None], v[None]), many[:1])
    assert np.array_equal(rotate(q, v), many[0])


@given(quaternions, quaternions)
def test_one_product_is_to_the_bit_that_of_one_among_many(p, q):
    for operation, a, b in ((multiply, p, q), (cross, p[:3], q[1:])):
        many = operation(np.stack((a, a, b)), np.stack((b, b, a)))
        assert np.array_equal(operation(a[None], b[None]), many[:1])
        assert np.array_equal(operation(a, b), many[0])
        assert np.array_equal(operation(a[None], b), many[:1])
        assert operation(a[None, None], b[None]).shape == (1, 1, len(a))


@given(quaternions, arrays(np.float64, 3, elements=numbers))
def test_turning_keeps_lengths_and_is_the_sandwich_product(q, v):
    x, y, z, w = q = q / np.linalg.norm(q)
    turned = rotate(q, v)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    matrix = np.eye(3) + 2.0 * w * cross + 2.0 * cross @ cross
    np.testing.assert_allclose(turned, matrix @ v, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(turned), np.linalg.norm(v), atol=1e-12)


def test_shapes_broadcast_also_for_one_vector():
    q = np.array([[0.0, 0.0, 0.0, 1.0]])
    assert rotate(q[:, None, :], np.ones((1, 1, 3))).shape == (1, 1, 3)
    assert rotate(q[0], np.ones((1, 3))).shape == (1, 3)


def test_many_vectors_turn_alike_in_a_world_alone_and_among_others():
    rng = np.random.default_rng(0)
    q = rng.normal(size=(300, 4))
    q /= np.linalg.norm(q, axis=1, keepdims=True)
    for count in (1, 7, 360):
        v = rng.normal(size=(count, 3))
        together = v @ turns(q)
        np.testing.assert_allclose(together, rotate(q[:, None], v[None]), atol=1e-12)
        for world in (0, 100, 299):
            assert np.array_equal((v @ turns(q[world : world + 1]))[0], together[world])


@given(quaternions)
def test_one_heading_is_to_the_bit_that_of_one_among_many(q):
    assert yaw_of(q[None]).tobytes() == yaw_of(np.tile(q, (5, 1)))[:1].tobytes()
    assert yaw_of(q[None, None]).shape == (1, 1)


@given(quaternions, arrays(np.float64, 3, elements=numbers))
def test_what_is_seen_on_the_ground_is_turned_back_by_the_heading(q, v):
    q = q / np.linalg.norm(q)
    seen = seen_on_ground(q[None], v[None])
    among = seen_on_ground(np.array([q, q]), np.array([v, v]))
    assert (among == seen).all()
    assert seen[0, 2] == 0.0
    assert np.hypot(*seen[0, :2]) == pytest.approx(np.hypot(*v[:2]), abs=1e-9)
    ahead, aside = 1 - 2 * (q[1] ** 2 + q[2] ** 2), 2 * (q[3] * q[2] + q[0] * q[1])
    if math.hypot(ahead, aside) > 1e-6:  # else the heading is anything
        back = conjugate(from_yaw(yaw_of(q[None])))
        assert seen == pytest.approx(rotate(back, v[None] * (1.0, 1.0, 0.0)), abs=1e-6)


def test_who_looks_straight_up_sees_the_ground_as_it_is():
    up = np.array([[-0.5, 0.5, 0.5, 0.5]])
    assert seen_on_ground(up, np.array([[1.0, 2.0, 3.0]]))[0] == pytest.approx([1.0, 2.0, 0.0])


@given(quaternions)
def test_a_matrix_has_the_quaternion_that_made_it(q):
    q = q / np.linalg.norm(q)
    half_turns = np.eye(4)  # where three of four ways divide by nothing
    many = np.vstack((q, half_turns))
    back = from_matrices(np.swapaxes(turns(many), 1, 2))
    assert np.abs((back * many).sum(axis=1)) == pytest.approx(np.ones(5), abs=1e-12)
    assert from_matrices(turns(many[:1])[0].T).shape == (4,)

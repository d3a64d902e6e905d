"""Motion of a body in space, and its derivatives."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from gazelle.navigation.estimation.motion import (
    ANGLES,
    LINEAR,
    POSITION,
    angle_rates,
    moved,
    moved_with_jacobian,
    rotation,
)
from gazelle.rotations import multiply, roll_pitch_yaw, rotate, unit

STATES = st.lists(st.floats(-1.2, 1.2), min_size=15, max_size=15).map(np.array)


@given(STATES, st.floats(0.001, 0.5))
def test_the_jacobian_is_the_derivative(state, seconds):
    after, slope = moved_with_jacobian(state, seconds)
    h = 1e-6
    ahead, behind = moved(state + h * np.eye(15), seconds), moved(state - h * np.eye(15), seconds)
    np.testing.assert_allclose(slope, (ahead - behind).T / (2 * h), atol=1e-7, rtol=1e-7)
    np.testing.assert_allclose(after, moved(state[None], seconds)[0], atol=1e-12)


@given(STATES)
def test_rates_of_angles_turn_as_the_angular_velocity(state):
    """A small turn of the body by its angular velocity is that of roll, pitch and yaw by their rates."""
    roll, pitch, yaw = state[ANGLES]
    angular, h = state[9:12], 1e-7
    turn = rotation(roll, pitch, yaw)
    later = rotation(*(state[ANGLES] + h * angle_rates(roll, pitch, angular)))
    x, y, z = angular
    np.testing.assert_allclose(
        turn.T @ (later - turn) / h, [[0, -z, y], [z, 0, -x], [-y, x, 0]], atol=1e-5
    )


@given(STATES)
def test_the_rotation_is_that_of_roll_pitch_and_yaw(state):
    roll, pitch, yaw = state[ANGLES]

    def about(axis, angle):
        return np.array([*np.sin(angle / 2) * np.eye(3)[axis], np.cos(angle / 2)])

    q = multiply(about(2, yaw), multiply(about(1, pitch), about(0, roll)))
    turned = rotation(roll, pitch, yaw) @ state[LINEAR]
    np.testing.assert_allclose(turned, rotate(q, state[LINEAR]), atol=1e-12)
    np.testing.assert_allclose(roll_pitch_yaw(unit(q)), state[ANGLES], atol=1e-12)


def test_constant_acceleration_along_a_heading():
    state = np.zeros(15)
    state[5], state[6], state[12] = np.pi / 2, 2.0, 0.5
    after, _ = moved_with_jacobian(state, 2.0)
    np.testing.assert_allclose(after[POSITION], [0.0, 5.0, 0.0], atol=1e-12)
    np.testing.assert_allclose(after[LINEAR], [3.0, 0.0, 0.0])

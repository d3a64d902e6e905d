"""Actions as velocities."""

import numpy as np
import pytest

from gazelle.envs.turtlebot3.actions import continuous_command, discrete_command
from gazelle.errors import TaskError


def test_five_turns_from_left_to_right():
    linear, angular = discrete_command(np.arange(5), 5)
    assert linear.tolist() == [0.15] * 5
    assert angular.tolist() == [1.5, 0.75, 0.0, -0.75, -1.5]


def test_the_box_spans_the_burgers_speeds():
    actions = np.array([[-1.0, -1.0], [0.0, 0.0], [1.0, 1.0], [7.0, -7.0]])
    linear, angular = continuous_command(actions, 4)
    assert linear.tolist() == [0.0, 0.11, 0.22, 0.22]
    assert angular.tolist() == [-1.5, 0.0, 1.5, -1.5]


def test_actions_are_ints_of_any_kind():
    for kind in (np.int8, np.uint8, np.int32, np.uint64):
        assert discrete_command(np.array([4, 0], kind), 2)[1].tolist() == [-1.5, 1.5]


FAR = np.array([0, 2**64 - 1], np.uint64)


@pytest.mark.parametrize(
    "actions", [[0], [0, 5], [0, 10], [0, -1], [0, -6], [0, -11], [0.0, 1.0], [[0], [1]], FAR]
)
def test_what_is_no_action_is_refused(actions):
    with pytest.raises(TaskError, match="actions"):
        discrete_command(actions, 2)


@pytest.mark.parametrize("actions", [[0.0, 0.0], [[0.0, np.nan]], [[0.0]]])
def test_what_is_no_continuous_action_is_refused(actions):
    with pytest.raises(TaskError, match="actions"):
        continuous_command(actions, 1)

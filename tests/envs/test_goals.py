"""Goals come evenly from the places that may follow."""

import numpy as np
import pytest

from gazelle.envs.goals import GoalTable
from gazelle.errors import TaskError

SQUARE = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]


def test_every_other_place_follows_equally_often():
    table = GoalTable(SQUARE)
    uniform = (np.arange(3000) + 0.5) / 3000
    after = table.after(np.full(3000, 2), uniform)
    assert np.bincount(after, minlength=4).tolist() == [1000, 1000, 0, 1000]


def test_only_what_the_rule_allows_follows():
    follows = np.zeros((4, 4), dtype=np.bool_)
    follows[0, 3] = follows[3, 1] = follows[3, 2] = True
    table = GoalTable(SQUARE, follows)
    uniform = np.array([0.0, 0.49, 0.5, 0.999999])
    assert table.after(np.zeros(4, dtype=int), uniform).tolist() == [3, 3, 3, 3]
    assert table.after(np.full(4, 3), uniform).tolist() == [1, 1, 2, 2]


def test_a_lone_goal_stays():
    table = GoalTable([(1.0, 2.0)])
    assert table.after(np.array([0]), np.array([0.7])).tolist() == [0]


def test_first_reaches_every_place():
    uniform = (np.arange(400) + 0.5) / 400
    assert np.bincount(GoalTable(SQUARE).first(uniform)).tolist() == [100] * 4


@pytest.mark.parametrize("points", [[], [(1.0,)], [(1.0, np.inf)], "ab", [("a", "b")], 3, [[]]])
def test_what_is_no_list_of_places_is_refused(points):
    with pytest.raises(TaskError, match="pairs"):
        GoalTable(points)


def test_places_are_those_of_the_goals_in_their_order():
    assert GoalTable(SQUARE).places(np.array([2, 0, 2])).tolist() == [[1, 1], [0, 0], [1, 1]]

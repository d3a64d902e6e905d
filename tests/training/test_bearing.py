"""Distance and direction of a fixed goal, which networks are given beside what is observed."""

from __future__ import annotations

import dataclasses

import gymnasium as gym
import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st

from gazelle.errors import TaskError
from gazelle.training.bearing import Bearing, bearing_of
from gazelle.training.features import Features
from gazelle.training.overrides import with_values
from gazelle.training.recipe import Recipe, recipe_from_dict, recipe_to_dict
from gazelle.training.scaling import ScaledObservations

SPACE = gym.spaces.Box(-10.0, 10.0, (4,), np.float32)
GOAL = (2.0, -1.0)
SEEN = Bearing(x=1, y=2, yaw=3, goal=GOAL)
UNSEEN = Bearing(x=1, y=2, goal=GOAL)
near = st.floats(-9.0, 9.0, width=32)


@given(near, near, st.floats(-3.25, 3.25, width=32))
def test_it_is_where_the_goal_is_seen_from_the_base(x, y, yaw):
    away = np.hypot(GOAL[0] - x, GOAL[1] - y)
    if away < 0.01:
        return
    row = np.array([[0.0, x, y, yaw]], np.float32)
    angle = np.arctan2(GOAL[1] - y, GOAL[0] - x) - yaw
    distance, ahead, left = SEEN.of(row)[0]
    assert np.exp(distance * 2.9 - 0.6) - 0.03 == pytest.approx(away, rel=1e-4, abs=1e-4)
    assert [ahead, left] == pytest.approx([np.cos(angle), np.sin(angle)], abs=1e-3)


def test_without_a_yaw_ahead_is_along_x():
    row = np.array([[0.0, 2.0, -4.0, 1.3]], np.float32)
    np.testing.assert_allclose(UNSEEN.of(row)[0, 1:], [0.0, 1.0], atol=1e-6)


def test_at_the_goal_it_is_finite():
    row = np.array([[0.0, *GOAL, 0.4]], np.float32)
    distance, *direction = SEEN.of(row)[0]
    assert direction == [0.0, 0.0]
    assert np.isfinite(distance)


@pytest.mark.parametrize("bearing", [SEEN, UNSEEN])
def test_torch_computes_the_same_and_it_is_all_that_is_added(bearing):
    rows = np.random.default_rng(0).uniform(-5.0, 5.0, (50, 4)).astype(np.float32)
    layer = ScaledObservations(SPACE, bearing=bearing)
    found = layer(torch.as_tensor(rows)).numpy()[:, 4:]
    features = Features.of(SPACE, by_bounds=False, bearing=bearing)
    assert features.count == 3
    np.testing.assert_allclose(found, features.added_to(rows)[:, 4:], atol=1e-5)


def test_entries_that_are_not_observed_are_refused():
    for wrong in ({"x": 4}, {"y": -1}, {"yaw": 9}):
        with pytest.raises(TaskError, match="for a bearing"):
            Features.of(SPACE, bearing=dataclasses.replace(SEEN, **wrong))


def test_recipes_keep_it_as_json_and_take_it_by_name():
    recipe = Recipe(bearing=SEEN)
    assert recipe_from_dict(recipe_to_dict(recipe)) == recipe
    values = {"x": 1, "y": 2, "yaw": 3, "goal": [2.0, -1.0]}
    assert with_values(Recipe(), {"bearing": values}).bearing == SEEN
    assert with_values(recipe, {"bearing": None}).bearing is None


@pytest.mark.parametrize(
    "values", [{"x": 1, "y": 2}, {"x": 1, "y": 2, "goal": [1.0]}, {"x": 1, "why": 2}, [1, 2], "x"]
)
def test_what_is_no_bearing_is_refused(values):
    with pytest.raises(TaskError, match="earing"):
        bearing_of(values)

"""Sines, cosines and logarithms that the networks are given beside what is observed."""

from __future__ import annotations

import dataclasses

import gymnasium as gym
import numpy as np
import pytest
import torch
from corridor import Corridor
from hypothesis import given
from hypothesis import strategies as st

from gazelle.errors import TaskError
from gazelle.training.actor import load_actor
from gazelle.training.export import export_actor
from gazelle.training.features import Features
from gazelle.training.learners import ALGORITHMS, build_learner
from gazelle.training.overrides import with_values
from gazelle.training.recipes import recipe_for
from gazelle.training.scaling import ScaledObservations
from gazelle.training.threads import limit_threads
from gazelle.training.vecenv import VectorEnvAdapter

limit_threads(1)

PI = np.pi
LOW = np.array([0.0, -PI, 0.0, -1.0, 0.0, 0.0, -np.inf], np.float32)
HIGH = np.array([3.5, PI, 6.6, 1.0, np.inf, 0.0, np.inf], np.float32)
SPACE = gym.spaces.Box(LOW, HIGH)


def test_bounds_tell_angles_and_magnitudes():
    found = Features.of(SPACE)
    assert found.angles.tolist() == [1]
    assert found.magnitudes.tolist() == [0, 2]
    assert found.spans.tolist() == [3.5, np.float32(6.6)]
    assert found.count == 4


@pytest.mark.parametrize(("bound", "angles"), [(3.14, [0]), (3.15, [0]), (3.0, []), (3.3, [])])
def test_bounds_of_an_angle_may_be_rounded(bound, angles):
    found = Features.of(gym.spaces.Box(-bound, bound, (1,), np.float32))
    assert found.angles.tolist() == angles


@given(
    st.floats(-0.5, 4.0, width=32), st.floats(-4.0, 4.0, width=32), st.floats(0.0, 7.0, width=32)
)
def test_they_are_what_they_are_called(near, angle, far):
    row = np.array([[near, angle, far, 0.3, 12.0, 0.0, -7.0]], np.float32)
    seen = Features.of(SPACE).added_to(row)
    np.testing.assert_array_equal(seen[:, :7], row)
    logs = np.log(np.maximum([near / 3.5, far / 6.6], 0.0) + 0.03) + 1.75
    np.testing.assert_allclose(seen[0, 7:], [np.sin(angle), np.cos(angle), *logs], atol=1e-5)
    assert np.isfinite(seen).all()


def test_torch_computes_the_same():
    rows = np.random.default_rng(0).uniform(-1.0, 4.0, (50, 7)).astype(np.float32)
    found = ScaledObservations(SPACE, features=True)(torch.as_tensor(rows)).numpy()
    wanted = Features.of(SPACE).added_to(rows)
    np.testing.assert_allclose(found[:, 7:], wanted[:, 7:], atol=1e-5)
    plain = ScaledObservations(SPACE)(torch.as_tensor(rows)).numpy()
    np.testing.assert_array_equal(found[:, :7], plain)


class Ranges(Corridor):
    """A corridor seen as an angle, a range and a plain number."""

    def __init__(self, num_envs, **options):
        super().__init__(num_envs, **options)
        self.single_observation_space = gym.spaces.Box(
            np.array([-PI, 0.0, -1.0], np.float32), np.array([PI, 4.0, 1.0], np.float32)
        )


@pytest.mark.parametrize("algo", ALGORITHMS)
def test_the_numpy_policy_and_its_file_do_what_torch_does(algo, tmp_path):
    env = VectorEnvAdapter(Ranges(4, continuous=algo != "dqn"))
    recipe = dataclasses.replace(recipe_for("Corridor", algo), net_arch=(24, 16), features=True)
    learner = build_learner(recipe, env, seed=3)
    rows = np.random.default_rng(0).uniform(-1.0, 1.0, (50, 3)).astype(np.float32)
    wanted, _ = learner.predict(rows, deterministic=True)
    actor = export_actor(learner.policy)
    assert actor.inputs == 3
    np.testing.assert_allclose(actor.act(rows), wanted, atol=1e-5)
    actor.save(tmp_path / "policy.npz")
    again = load_actor(tmp_path / "policy.npz")
    assert again.inputs == 3
    np.testing.assert_array_equal(again.act(rows), actor.act(rows))


def test_entries_are_angles_where_a_recipe_says_so():
    """Whatever their bounds; without features they are all that is added."""
    found = Features.of(SPACE, angles=(3, 6))
    assert found.angles.tolist() == [1, 3, 6]
    assert found.magnitudes.tolist() == [0, 2]
    alone = Features.of(SPACE, by_bounds=False, angles=(3,))
    assert (alone.angles.tolist(), alone.magnitudes.tolist()) == ([3], [])
    rows = np.random.default_rng(1).uniform(-2.0, 2.0, (20, 7)).astype(np.float32)
    added = ScaledObservations(SPACE, angles=(3,))(torch.as_tensor(rows)).numpy()[:, 7:]
    expected = np.column_stack((np.sin(rows[:, 3]), np.cos(rows[:, 3])))
    np.testing.assert_allclose(added, expected, atol=1e-6)


def test_an_angle_that_is_not_observed_is_refused():
    with pytest.raises(TaskError, match="there is no entry 7") as caught:
        Features.of(SPACE, angles=(7,))
    assert "entries 0 to 6" in str(caught.value)


@pytest.mark.parametrize("std", [0.1, 2.0])
def test_first_actions_scatter_as_the_recipe_says(std):
    values = {"initial_std": std, "angles": [1], "features": False}
    recipe = with_values(recipe_for("Corridor", "ppo"), values)
    learner = build_learner(recipe, VectorEnvAdapter(Ranges(4, continuous=True)), seed=0)
    actor = export_actor(learner.policy)
    assert actor.features.angles.tolist() == [1]
    drawn = actor.sample(np.zeros((20_000, 1), np.float32), np.random.default_rng(0))
    assert np.std(drawn) == pytest.approx(std, rel=0.02)

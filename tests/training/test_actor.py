from __future__ import annotations

import dataclasses
import warnings

import numpy as np
import pytest
import torch
from corridor import Corridor

from gazelle.errors import FormatError
from gazelle.training.actor import Actor, load_actor
from gazelle.training.export import export_actor
from gazelle.training.learners import ALGORITHMS, build_learner
from gazelle.training.recipes import recipe_for
from gazelle.training.threads import limit_threads
from gazelle.training.vecenv import VectorEnvAdapter

limit_threads(1)


def learner_for(algo, *, continuous, seed=3):
    recipe = dataclasses.replace(recipe_for("Corridor", algo), net_arch=(24, 16))
    settings = recipe.settings
    if algo != "ppo":
        settings = dataclasses.replace(settings, buffer_size=1000)
    recipe = dataclasses.replace(recipe, settings=settings)
    env = VectorEnvAdapter(Corridor(4, continuous=continuous))
    return build_learner(recipe, env, seed)


CASES = [(algo, algo != "dqn") for algo in ALGORITHMS] + [("ppo", False)]
OBS = np.random.default_rng(0).uniform(-1.2, 1.2, (50, 3)).astype(np.float32)


@pytest.mark.parametrize(("algo", "continuous"), CASES)
def test_best_actions_are_those_of_the_torch_policy(algo, continuous):
    learner = learner_for(algo, continuous=continuous)
    expected, _ = learner.predict(OBS, deterministic=True)
    np.testing.assert_allclose(export_actor(learner.policy).act(OBS), expected, atol=1e-5)


@pytest.mark.parametrize("continuous", [False, True])
def test_log_probabilities_are_those_of_the_torch_policy(continuous):
    learner = learner_for("ppo", continuous=continuous)
    actor = export_actor(learner.policy)
    outputs = actor.outputs(OBS)
    actions = actor.sample(outputs, np.random.default_rng(1))
    with torch.no_grad():
        _, expected, _ = learner.policy.evaluate_actions(
            torch.as_tensor(OBS), torch.as_tensor(actions)
        )
    found = actor.log_prob(outputs, actions)
    np.testing.assert_allclose(found, expected.numpy(), atol=1e-5)


def test_drawn_actions_follow_their_probabilities():
    logits = np.log(np.array([0.1, 0.6, 0.3], dtype=np.float32))
    actor = Actor((), (), "tanh", "categorical")
    drawn = actor.sample(np.tile(logits, (40_000, 1)), np.random.default_rng(2))
    shares = np.bincount(drawn, minlength=3) / len(drawn)
    np.testing.assert_allclose(shares, [0.1, 0.6, 0.3], atol=0.01)


def test_drawn_numbers_follow_their_normal_distribution():
    log_std = np.log(np.array([0.5], dtype=np.float32))
    actor = Actor((), (), "tanh", "gaussian", log_std=log_std)
    drawn = actor.sample(np.full((40_000, 1), 0.25, np.float32), np.random.default_rng(2))
    assert drawn.mean() == pytest.approx(0.25, abs=0.02)
    assert drawn.std() == pytest.approx(0.5, abs=0.02)


def test_even_hopeless_logits_give_a_valid_action():
    logits = np.array([[-1e30, 0.0, -1e30]] * 100, dtype=np.float32)
    actor = Actor((), (), "tanh", "categorical")
    assert (actor.sample(logits, np.random.default_rng(0)) == 1).all()


@pytest.mark.parametrize(("algo", "continuous"), CASES)
def test_a_policy_file_holds_the_whole_policy(tmp_path, algo, continuous):
    actor = export_actor(learner_for(algo, continuous=continuous).policy)
    actor.save(tmp_path / "policy.npz")
    again = load_actor(tmp_path / "policy.npz")
    np.testing.assert_array_equal(again.act(OBS), actor.act(OBS))
    draws = [each.act(OBS, np.random.default_rng(5)) for each in (actor, again)]
    np.testing.assert_array_equal(*draws)


@pytest.mark.parametrize("content", [b"", b"nonsense", b"PK\x03\x04 cut off"])
def test_a_damaged_policy_is_one_clear_error(tmp_path, content):
    file = tmp_path / "policy.npz"
    file.write_bytes(content)
    with pytest.raises(FormatError, match=r"policy\.npz.*not a policy"):
        load_actor(file)


def test_another_archive_is_no_policy(tmp_path):
    np.savez(tmp_path / "policy.npz", a=np.zeros(2))
    with pytest.raises(FormatError, match="not a policy"):
        load_actor(tmp_path / "policy.npz")


def test_observations_are_scaled_by_their_bounds():
    learner = learner_for("ppo", continuous=False)
    extractor = learner.policy.features_extractor
    assert extractor(torch.full((1, 3), 1.2)).tolist() == [[pytest.approx(1.0)] * 3]


def test_observations_without_bounds_stay_as_they_are():
    import gymnasium as gym

    from gazelle.training.scaling import ScaledObservations

    space = gym.spaces.Box(np.array([-np.inf, 0, 0]), np.array([np.inf, np.inf, 4]))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        extractor = ScaledObservations(space)
    assert extractor(torch.tensor([[7.0, 8.0, 1.0]])).tolist() == [[7.0, 8.0, -0.5]]

"""Policies that look at pictures: the same in torch, numpy and ONNX, and they learn."""

from __future__ import annotations

import dataclasses

import gymnasium as gym
import numpy as np
import onnxruntime
import pytest
import torch

from gazelle.errors import TaskError
from gazelle.training import evaluate, load_actor, train
from gazelle.training.learners import build_learner
from gazelle.training.onnx_graph import onnx_model
from gazelle.training.picture_features import PictureFeatures
from gazelle.training.picture_layers import is_picture, observation_dtype
from gazelle.training.recipes import recipe_for
from gazelle.training.session import resume
from gazelle.training.tasks import make_task
from gazelle.training.vecenv import VectorEnvAdapter

TASK = "TurtleBot3CameraWorld"


def test_what_is_a_picture():
    assert is_picture(gym.spaces.Box(0, 255, (84, 84, 3), np.uint8))
    assert observation_dtype(gym.spaces.Box(0, 255, (84, 84, 3), np.uint8)) is np.uint8
    for other in (
        gym.spaces.Box(0, 1, (84, 84, 3), np.float32),
        gym.spaces.Box(0, 255, (84,), np.uint8),
        gym.spaces.Discrete(3),
    ):
        assert not is_picture(other)
        assert observation_dtype(other) is np.float32


@pytest.mark.parametrize("shape", [(84, 84, 3), (40, 60, 3), (31, 29, 1), (90, 120, 4)])
def test_numpy_sees_what_torch_sees(shape):
    torch.manual_seed(0)
    layers = PictureFeatures(gym.spaces.Box(0, 255, shape, np.uint8))
    seen = np.random.default_rng(0).integers(0, 256, (5, *shape), np.uint8)
    with torch.no_grad():
        wanted = layers(torch.as_tensor(seen)).numpy()
    found = layers.exported().features(seen.reshape(5, -1))
    assert found.shape == (5, layers.features_dim)
    np.testing.assert_allclose(found, wanted, atol=2e-6)


@pytest.mark.long
def test_a_policy_is_the_same_in_every_form(tmp_path):
    env = VectorEnvAdapter(make_task("gazelle/TurtleBot3CameraWorld-v0", 2, engine="planar"))
    learner = build_learner(recipe_for(TASK), env, seed=1)
    seen = env.reset()
    assert seen.dtype == np.uint8
    from gazelle.training.export import export_actor

    actor = export_actor(learner.policy)
    file = tmp_path / "policy.npz"
    actor.save(file)
    read = load_actor(file)
    flat = seen.reshape(2, -1)
    np.testing.assert_array_equal(read.outputs(flat), actor.outputs(flat))
    np.testing.assert_array_equal(read.act(seen), learner.predict(seen, deterministic=True)[0])
    assert read.inputs == 84 * 84 * 3
    session = onnxruntime.InferenceSession(
        onnx_model(read).SerializeToString(), providers=["CPUExecutionProvider"]
    )
    outputs, action = session.run(["outputs", "action"], {"observation": flat.astype(np.float32)})
    np.testing.assert_allclose(outputs, read.outputs(flat), atol=1e-5)
    np.testing.assert_array_equal(action, read.act(seen))
    env.close()


def test_other_algorithms_say_that_they_do_not_see():
    env = VectorEnvAdapter(make_task("gazelle/TurtleBot3CameraWorld-v0", 1, engine="planar"))
    for algo in ("dqn", "a2c"):
        with pytest.raises(TaskError, match="cannot learn from pictures"):
            build_learner(recipe_for(TASK, algo), env, seed=0)
    env.close()


@pytest.mark.long
def test_a_training_goes_on_where_it_stopped(tmp_path):
    recipe = dataclasses.replace(
        recipe_for(TASK),
        num_envs=4,
        learning_rate_decay=False,
        settings=dataclasses.replace(recipe_for(TASK).settings, n_steps=8, batch_size=16),
    )
    whole = train(TASK, recipe=recipe, steps=64, checkpoint_every=32, out=tmp_path / "whole")
    part = train(TASK, recipe=recipe, steps=32, checkpoint_every=32, out=tmp_path / "part")
    again = resume(part.run.folder, steps=64)
    ends = [load_actor(each.run.policy_file()) for each in (whole, again)]
    for name in ("weights", "biases"):
        for one, other in zip(*(getattr(end, name) for end in ends), strict=True):
            np.testing.assert_array_equal(one, other)
    assert evaluate(again.run.folder, episodes=2, num_envs=2).episodes == 2


@pytest.mark.slow
def test_the_red_post_is_found(tmp_path):
    """Half of the recipe's steps; 94.9 % of 256 when this was written."""
    result = train(TASK, steps=40_000, out=tmp_path)
    found = evaluate(result.run.folder, episodes=128)
    assert found.success is not None
    assert found.success.value > 0.85

"""Policies with a memory act as the library's, step for step, and are evaluated so."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from corridor import MODES, Corridor
from test_more_algorithms import library

from gazelle.errors import TaskError
from gazelle.training import evaluate, export_policy, load_actor, train
from gazelle.training.actor import Actor
from gazelle.training.checkpoint import read_checkpoint
from gazelle.training.deploy.policies import open_policy
from gazelle.training.learners import build_learner
from gazelle.training.memory_layers import MemoryLayers
from gazelle.training.stepper import Stepper
from gazelle.training.tasks import make_task
from gazelle.training.vecenv import VectorEnvAdapter

ROUNDS = 40


def counting(inputs=3):
    """Return a policy that outputs how many steps it remembers, by a cell that grows by 0.1."""
    zero = np.zeros((1, 4), np.float32)
    # Gates: let in all, keep all, new value atanh(0.1), give all.
    bias = np.array([50.0, 50.0, np.arctanh(0.1), 50.0], np.float32)
    memory = MemoryLayers((np.zeros((inputs, 4), np.float32),), (zero,), (bias,))
    weights = (np.ones((1, 1), np.float32),)
    bounds = np.full(1, 9.0, np.float32)
    return Actor(
        weights, (np.zeros(1, np.float32),), "tanh", "squashed", low=-bounds, high=bounds,
        memory=memory,
    )  # fmt: skip


@pytest.mark.parametrize("mode", MODES)
def test_a_memory_is_empty_where_an_episode_begins_in_every_mode(mode):
    actor, stepper = counting(), Stepper(Corridor(6, mode=mode.value, continuous=True, limit=7))
    obs, memory = stepper.reset(seed=1), actor.begin(6)
    lengths = np.zeros(6)
    ended = 0
    for moves in np.random.default_rng(3).uniform(-1.0, 1.0, (ROUNDS, 6, 1)):
        found = np.arctanh(actor.outputs(obs, memory)[:, 0]) * 10.0
        acts = ~stepper.waiting
        np.testing.assert_allclose(found[acts], lengths[acts] + 1.0, rtol=1e-3)
        step = stepper.step(moves.astype(np.float32))
        lengths = np.where(step.begun, 0.0, lengths + 1.0)
        memory.forget(step.begun)
        obs = step.obs
        ended += 0 if step.ended is None else len(step.ended.slots)
        # What an episode's number of steps is, by the corridor itself.
        np.testing.assert_array_equal(
            lengths[~stepper.waiting], stepper.env.steps[~stepper.waiting]
        )
    assert ended > 6


def test_layers_with_a_memory_give_what_those_of_torch_do():
    torch = pytest.importorskip("torch")
    torch.manual_seed(0)
    lstm = torch.nn.LSTM(3, 5, num_layers=2)
    arrays = {name: value.detach().numpy() for name, value in lstm.named_parameters()}
    layers = MemoryLayers(
        tuple(arrays[f"weight_ih_l{number}"].T for number in range(2)),
        tuple(arrays[f"weight_hh_l{number}"].T for number in range(2)),
        tuple(arrays[f"bias_ih_l{number}"] + arrays[f"bias_hh_l{number}"] for number in range(2)),
    )
    given = torch.randn(ROUNDS, 4, 3)
    expected = lstm(given)[0].detach().numpy()
    memory = layers.empty(4)
    for x, wanted in zip(given.numpy(), expected, strict=True):
        np.testing.assert_allclose(layers.outputs(x, memory), wanted, rtol=0, atol=2e-6)


def test_without_its_memory_such_a_policy_does_not_act():
    with pytest.raises(TaskError, match="is recurrent"):
        counting().act(np.zeros((2, 3), np.float32))


def test_what_is_saved_is_what_is_loaded(tmp_path):
    actor = counting()
    actor.save(tmp_path / "policy.npz")
    found = load_actor(tmp_path / "policy.npz")
    assert found.inputs == actor.inputs == 3
    assert found.memory is not None
    for field in dataclasses.fields(MemoryLayers):
        for one, other in zip(
            getattr(found.memory, field.name), getattr(actor.memory, field.name), strict=True
        ):
            np.testing.assert_array_equal(one, other)


@pytest.mark.long
@pytest.mark.parametrize("continuous", [False, True])
def test_recurrent_ppo_is_evaluated_as_the_library_predicts(tmp_path, continuous):
    pytest.importorskip("sb3_contrib")
    recipe = library("recurrent_ppo", {"n_steps": 16, "batch_size": 32, "n_epochs": 1})
    run = train("test/Corridor-v0", recipe=recipe, out=tmp_path, continuous=continuous).run
    assert evaluate(run.folder, episodes=10).episodes == 10
    copies = run.config.recipe.num_envs
    env = VectorEnvAdapter(make_task(run.config.task, copies, **run.config.options))
    learner = build_learner(run.config.recipe, env, 0)
    read_checkpoint(run.newest_checkpoint(), learner)
    actor = load_actor(run.policy_file())
    rng = np.random.default_rng(0)
    memory, state, starts = actor.begin(copies), None, np.ones(copies, bool)
    for _ in range(ROUNDS):
        obs = rng.uniform(-1.2, 1.2, (copies, 3)).astype(np.float32)
        memory.forget(starts)
        expected, state = learner.predict(obs, state, starts, deterministic=True)
        found = actor.act(obs, memory=memory)
        np.testing.assert_allclose(found, expected, rtol=0, atol=2e-6)
        starts = rng.random(copies) < 0.2


@pytest.mark.long
def test_numpy_is_written_and_what_cannot_be_is_refused_in_one_line(tmp_path):
    pytest.importorskip("sb3_contrib")
    recipe = library("recurrent_ppo", {"n_steps": 16, "batch_size": 32, "n_epochs": 1})
    run = train("test/Corridor-v0", recipe=recipe, out=tmp_path).run
    assert load_actor(export_policy(run.folder, "numpy").policy).memory is not None
    with pytest.raises(TaskError, match="cannot be exported as ONNX yet"):
        export_policy(run.folder, "onnx")
    with pytest.raises(TaskError, match="cannot be deployed yet"):
        open_policy(run.folder)

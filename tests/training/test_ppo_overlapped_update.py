"""Updates beside the next rollout: when they count, that timing does not, and what goes wrong."""

from __future__ import annotations

import dataclasses
import sys
import threading
import time

import numpy as np
import pytest
import torch
from corridor import Corridor
from stable_baselines3.common.callbacks import BaseCallback

from gazelle.training.actor import Actor
from gazelle.training.learners import build_learner, ppo
from gazelle.training.learners.ppo_dense_update import DenseUpdate
from gazelle.training.learners.ppo_overlapped_update import OverlappedUpdate
from gazelle.training.recipes import PPOSettings, Recipe
from gazelle.training.threads import limit_threads
from gazelle.training.vecenv import VectorEnvAdapter

limit_threads(1)
SETTINGS = PPOSettings(n_steps=16, batch_size=32, n_epochs=2, overlap=True)
RECIPE = Recipe(
    num_envs=8, net_arch=(16,), learning_rate=0.01, learning_rate_decay=False, settings=SETTINGS
)
ROLLOUT = 128


class Watching(BaseCallback):
    """Keeps the policy's weights as they are when a rollout begins, and when it ends."""

    def __init__(self):
        super().__init__()
        self.begun, self.ended = [], []

    def _on_step(self):
        return True

    def _on_rollout_start(self):
        self.begun.append(weights(self.model))

    def _on_rollout_end(self):
        self.ended.append(weights(self.model))


def made(*, overlap=True, continuous=False):
    recipe = dataclasses.replace(RECIPE, settings=dataclasses.replace(SETTINGS, overlap=overlap))
    env = Corridor(8, mode="SameStep", limit=9, continuous=continuous)
    return build_learner(recipe, VectorEnvAdapter(env), seed=3)


def weights(learner):
    return torch.cat([each.detach().reshape(-1).clone() for each in learner.policy.parameters()])


def learnt(rollouts=5, **options):
    learner, seen = made(**options), Watching()
    learner.learn(rollouts * ROLLOUT, seen, log_interval=None)
    return learner, seen


def test_a_rollout_is_played_by_weights_that_are_one_update_old():
    learner, seen = learnt()
    alone, _ = learnt(rollouts=1, overlap=False)
    assert torch.equal(seen.begun[0], seen.begun[1])  # nothing is learnt yet when the second begins
    assert torch.equal(seen.ended[1], weights(alone))  # the first update, as without overlap
    for before, after in zip(seen.ended[1:], seen.begun[2:], strict=False):
        assert torch.equal(before, after)
    assert not torch.equal(seen.ended[-1], weights(learner))  # the last update is handed over, too
    assert learner.ahead is None
    assert learner._n_updates == 5 * SETTINGS.n_epochs


@pytest.mark.parametrize("continuous", [False, True])
def test_timing_changes_nothing(monkeypatch, continuous):
    plain, _ = learnt(continuous=continuous)
    update, outputs = DenseUpdate.learn_from, Actor.outputs
    rng = np.random.default_rng(0)

    def late(part):
        def method(*arguments):
            time.sleep(0.004 * rng.random())
            return part(*arguments)

        return method

    monkeypatch.setattr(DenseUpdate, "learn_from", late(update))
    slow_update, _ = learnt(continuous=continuous)
    monkeypatch.setattr(DenseUpdate, "learn_from", update)
    monkeypatch.setattr(Actor, "outputs", late(outputs))
    slow_rollout, _ = learnt(continuous=continuous)
    for other in (slow_update, slow_rollout):
        assert torch.equal(weights(plain), weights(other))


def test_it_runs_while_the_rollout_is_played(monkeypatch):
    """Each of the two waits for the other: one after the other, the first would wait in vain."""
    playing, learning, begun = (threading.Event() for _ in range(3))
    update, outputs, start = DenseUpdate.learn_from, Actor.outputs, OverlappedUpdate.start

    def learn_from(*arguments):
        learning.set()
        assert playing.wait(20)
        return update(*arguments)

    def act(*arguments):
        if begun.is_set():
            assert learning.wait(20)
            playing.set()
        return outputs(*arguments)

    def begin(self):
        begun.set()
        start(self)

    monkeypatch.setattr(OverlappedUpdate, "start", begin)
    monkeypatch.setattr(DenseUpdate, "learn_from", learn_from)
    monkeypatch.setattr(Actor, "outputs", act)
    learnt(rollouts=2)
    assert playing.is_set()


def test_what_goes_wrong_is_raised_once(monkeypatch):
    calls = []

    def broken(self, batch, weights):
        calls.append(1)
        raise RuntimeError("no memory left")

    monkeypatch.setattr(DenseUpdate, "learn_from", broken)
    learner = made()
    with pytest.raises(RuntimeError, match="no memory left"):
        learner.learn(5 * ROLLOUT, Watching(), log_interval=None)
    assert len(calls) == 1
    assert "ppo_update" not in {thread.name for thread in threading.enumerate()}
    learner.ahead.wait()  # told once


def test_an_error_of_the_environment_waits_for_the_update(monkeypatch):
    learner = made()
    step = learner.env.copies.advance
    left = [20]

    def advance(actions):
        left[0] -= 1
        if left[0] < 0:
            raise OSError("the cable is out")
        return step(actions)

    monkeypatch.setattr(learner.env.copies, "advance", advance)
    with pytest.raises(OSError, match="the cable is out"):
        learner.learn(5 * ROLLOUT, Watching(), log_interval=None)
    assert "ppo_update" not in {thread.name for thread in threading.enumerate()}


def test_networks_that_need_recorded_gradients_learn_as_without(monkeypatch):
    monkeypatch.setattr(ppo, "fits_dense_update", lambda policy: False)
    (first, _), (second, _) = learnt(), learnt(overlap=False)
    assert torch.equal(weights(first), weights(second))


def test_the_library_loads_a_model_that_learnt_so(tmp_path):
    from stable_baselines3 import PPO

    learner, _ = learnt()
    learner.save(tmp_path / "model.zip")
    other = PPO.load(tmp_path / "model.zip", device="cpu")
    obs = np.random.default_rng(0).random((5, 3)).astype(np.float32)
    np.testing.assert_array_equal(
        learner.predict(obs, deterministic=True)[0], other.predict(obs, deterministic=True)[0]
    )


@pytest.mark.parametrize("overlap", [False, True])
def test_threads_take_turns_as_before_afterwards(overlap):
    class Turns(Watching):
        def _on_step(self):
            turns.append(sys.getswitchinterval())
            return True

    turns, before = [], sys.getswitchinterval()
    made(overlap=overlap).learn(ROLLOUT, Turns(), log_interval=None)
    assert sys.getswitchinterval() == before
    assert (max(turns) < before) == overlap

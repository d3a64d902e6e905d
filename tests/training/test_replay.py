from __future__ import annotations

import numpy as np
from corridor import Corridor

from gazelle.training.learners.replay import MaskedReplayBuffer
from gazelle.training.vecenv import VectorEnvAdapter


def filled(mode):
    adapter = VectorEnvAdapter(Corridor(5, mode=mode, limit=6))
    memory = MaskedReplayBuffer(
        200, adapter.observation_space, adapter.action_space, device="cpu", n_envs=5
    )
    adapter.seed(0)
    obs = adapter.reset()
    rng = np.random.default_rng(0)
    for _ in range(30):
        actions = rng.integers(0, 3, 5)
        after, rewards, dones, infos = adapter.step(actions)
        following = after.copy()
        for slot in np.flatnonzero(dones):
            following[slot] = infos[slot]["terminal_observation"]
        memory.add(obs, following, actions, rewards, dones, infos)
        obs = after
    return memory


def test_clock_goes_on_by_one_in_every_transition_that_is_taught():
    """An idle step would show a clock that jumps back to zero."""
    for mode in ("SameStep", "NextStep", "Disabled"):
        batch = filled(mode).sample(2000)
        ticks = (batch.next_observations - batch.observations)[:, 2] * 6
        np.testing.assert_allclose(ticks.numpy(), 1.0, atol=1e-5)


def test_cut_off_episodes_are_not_taught_as_ends():
    batch = filled("SameStep").sample(2000)
    cut_off = np.isclose(batch.next_observations[:, 2].numpy(), 1.0)
    position, goal = batch.next_observations[:, 0].numpy(), batch.next_observations[:, 1].numpy()
    ended = (np.abs(position - goal) < 0.06) | (np.abs(position) > 1.0)
    assert (cut_off & ~ended).any()
    np.testing.assert_array_equal(batch.dones[:, 0].numpy() > 0, ended)


def test_memory_comes_back_from_its_state():
    memory, other = filled("NextStep"), filled("SameStep")
    other.set_state(memory.get_state())
    np.random.seed(0)  # noqa: NPY002  # the memory draws from the global generator
    first = memory.sample(64)
    np.random.seed(0)  # noqa: NPY002  # the memory draws from the global generator
    second = other.sample(64)
    for left, right in zip(first[:5], second[:5], strict=True):
        np.testing.assert_array_equal(left.numpy(), right.numpy())

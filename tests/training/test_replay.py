from __future__ import annotations

import numpy as np
import torch
from corridor import Corridor

from gazelle.training.learners.replay import MaskedReplayBuffer, targets
from gazelle.training.vecenv import VectorEnvAdapter


def filled(mode, rows=40, **options):
    adapter = VectorEnvAdapter(Corridor(5, mode=mode, limit=6))
    memory = MaskedReplayBuffer(
        5 * rows, adapter.observation_space, adapter.action_space, device="cpu", n_envs=5, **options
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


def test_rewards_of_several_steps_are_summed_to_the_end_of_an_episode_or_of_the_memory():
    """Compared with a walk, transition by transition, along a memory that is overwritten."""
    gamma, n_steps = 0.5, 4
    for mode, rows in (("SameStep", 40), ("NextStep", 40), ("SameStep", 23)):
        memory = filled(mode, rows, n_steps=n_steps, gamma=gamma)
        at, slots = memory._draw(500)
        batch = memory._gather(at, slots)
        lengths = set()
        for index, (first, slot) in enumerate(zip(at, slots, strict=True)):
            row, worth, steps = first, 0.0, 0
            while True:
                worth += gamma**steps * memory.rewards[row, slot]
                steps += 1
                after = (row + 1) % memory.buffer_size
                if memory.dones[row, slot] or after == memory.pos or steps == n_steps:
                    break
                row = after
            lengths.add(steps)
            over = memory.dones[row, slot] and not memory.timeouts[row, slot]
            following = memory.next_observations[row, slot]
            np.testing.assert_allclose(batch.rewards[index, 0], worth, atol=1e-5)
            np.testing.assert_allclose(batch.discounts[index, 0], gamma**steps)
            np.testing.assert_array_equal(batch.next_observations[index], following)
            assert bool(batch.dones[index, 0]) == over
        assert lengths == {1, 2, 3, 4}


def test_one_step_is_discounted_by_the_learner():
    batch = filled("SameStep").sample(8)
    assert batch.discounts is None
    values = torch.ones((8, 1))
    expected = batch.rewards + (1.0 - batch.dones) * 0.9
    assert torch.equal(targets(batch, values, 0.9), expected)

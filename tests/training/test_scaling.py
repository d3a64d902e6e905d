"""Observations reach the network in a range that it can learn from, whatever their bounds."""

from __future__ import annotations

import dataclasses

import gymnasium as gym
import numpy as np
import pytest
import torch
from corridor import Corridor
from gymnasium.envs.classic_control.cartpole import CartPoleVectorEnv
from hypothesis import given
from hypothesis import strategies as st

from gazelle.envs import task_ids
from gazelle.errors import TaskError
from gazelle.training import Recipe, train
from gazelle.training.export import export_actor
from gazelle.training.learners import ALGORITHMS, build_learner
from gazelle.training.recipes import recipe_for
from gazelle.training.scaling import ObservationScale, ScaledObservations
from gazelle.training.threads import limit_threads
from gazelle.training.vecenv import VectorEnvAdapter

limit_threads(1)


def box(*bounds):
    high = np.array(bounds, np.float32)
    return gym.spaces.Box(-high, high)


def scaled(space, scale, rows):
    return ScaledObservations(space, scale=scale)(
        torch.as_tensor(rows, dtype=torch.float32)
    ).numpy()


def test_only_entries_that_their_bounds_do_not_fit_are_normalised():
    space = box(1.0, 1000.0, np.inf, 3e38, 5.0)
    scale = ObservationScale(space)
    rows = np.random.default_rng(0).normal(0.3, 0.4, (500, 5)).astype(np.float32)
    scale.observe(rows)
    assert scale.refresh()
    assert not scale.refresh()  # the first time is over
    assert scale.normalised.tolist() == [False, True, True, True, False]
    seen = scaled(space, scale, rows)
    np.testing.assert_allclose(seen[:, [0, 4]], rows[:, [0, 4]] / [1.0, 5.0], atol=1e-6)
    np.testing.assert_allclose(seen[:, 1:4].mean(axis=0), 0.0, atol=1e-5)
    np.testing.assert_allclose(seen[:, 1:4].std(axis=0), 1.0, atol=1e-5)


DRAWN = {
    "even": lambda rng, size: rng.uniform(-1.0, 1.0, size),
    "normal": lambda rng, size: rng.normal(0.0, 1.0 / 3.0, size),
    "skewed": lambda rng, size: rng.exponential(0.3, size),
    "aside": lambda rng, size: rng.uniform(0.5, 1.0, size),
    "angles": lambda rng, size: np.sin(rng.uniform(-np.pi, np.pi, size)),
}
"""Observations that bounds of -1 and 1 fit."""


@pytest.mark.parametrize("factor", [1.0, 2.0, 30.0, 100.0, 1000.0])
@pytest.mark.parametrize("kind", DRAWN)
def test_bounds_that_are_too_wide_do_not_squeeze(kind, factor):
    rows = DRAWN[kind](np.random.default_rng(0), (4000, 1)).astype(np.float32)
    scale = ObservationScale(box(factor))
    scale.observe(rows)
    scale.refresh()
    assert scale.normalised.all() == (factor > 10.0)
    assert 0.06 < scaled(box(factor), scale, rows).std() < 1.1


@pytest.mark.parametrize("kind", DRAWN)
def test_rare_values_at_the_bounds_do_not_make_them_fit(kind):
    rows = DRAWN[kind](np.random.default_rng(0), (4000, 1)).astype(np.float32)
    scale = ObservationScale(box(30.0))
    scale.observe(np.concatenate([rows, np.array([[-30.0], [30.0]], np.float32)]))
    scale.refresh()
    assert scale.normalised.all()
    assert scaled(box(30.0), scale, rows).std() > 5.0 * rows.std() / 30.0


@given(
    st.lists(st.integers(1, 40), min_size=1, max_size=8),
    st.floats(-1e4, 1e4),
    st.floats(1e-3, 1e3),
)
def test_moments_are_those_of_all_that_was_observed(sizes, mean, spread):
    generator = np.random.default_rng(len(sizes))
    parts = [generator.normal(mean, spread, (size, 2)).astype(np.float32) for size in sizes]
    scale = ObservationScale(box(np.inf, np.inf))
    for part in parts:
        scale.observe(part)
    scale.refresh()
    rows = np.concatenate(parts).astype(np.float64)
    if len(rows) < 3 or rows.std(axis=0).min() < 1e-5 * abs(mean):
        return
    size = np.maximum(rows.std(axis=0), np.abs(rows - rows.mean(axis=0)).max(axis=0) / 10.0)
    np.testing.assert_allclose(1.0 / scale.gain.numpy(), size, rtol=1e-5)
    seen = rows * scale.gain.numpy() + scale.offset.numpy()
    np.testing.assert_allclose(seen.mean(axis=0), 0.0, atol=1e-6 * (1.0 + abs(mean) / spread))


def test_a_rare_jump_is_not_blown_up_and_a_constant_stays_as_it_is():
    space = box(np.inf, 1000.0)
    scale = ObservationScale(space)
    rows = np.zeros((2000, 2), np.float32)
    scale.observe(rows)
    assert not scale.refresh()
    assert scaled(space, scale, rows[:1] + 500.0).tolist() == [[500.0, 0.5]]
    rows[7] = 1.0
    scale.observe(rows)
    scale.refresh()
    assert np.abs(scaled(space, scale, rows)).max() < 10.01


def test_nothing_is_normalised_where_no_scaling_is_wanted():
    space = box(1000.0, np.inf)
    scale = ObservationScale(space, scale=False)
    rows = np.random.default_rng(0).normal(size=(9, 2)).astype(np.float32)
    scale.observe(rows)
    assert not scale.refresh()
    np.testing.assert_array_equal(scaled(space, scale, rows), rows)


@pytest.mark.parametrize("algo", ALGORITHMS)
def test_all_networks_of_a_learner_scale_alike_and_so_does_its_numpy_actor(algo):
    env = VectorEnvAdapter(Corridor(4, continuous=algo != "dqn", bound=1000.0))
    recipe = dataclasses.replace(recipe_for("Corridor", algo), net_arch=(8,))
    learner = build_learner(recipe, env, seed=1)
    env.reset()
    for _ in range(20):
        env.copies.advance(np.array([env.action_space.sample() for _ in range(4)]))
    before = export_actor(learner.policy).weights[0]
    assert learner.scale.refresh()
    extractors = [m for m in learner.policy.modules() if isinstance(m, ScaledObservations)]
    assert len({extractor.gain.data_ptr() for extractor in extractors}) == 1
    assert (extractors[0].gain > 1.0).all()
    actor = export_actor(learner.policy)
    assert not np.array_equal(actor.weights[0], before)
    seen = np.random.default_rng(0).uniform(-1.0, 1.0, (50, 3)).astype(np.float32)
    wanted, _ = learner.predict(seen, deterministic=True)
    np.testing.assert_allclose(actor.act(seen), wanted, atol=1e-5)
    env.close()


# Bounds of openai_ros and frobs_rl are far from where their robots are, those of Fetch infinite;
# pictures are not scaled so.
OTHERS = (
    "CartPole",
    "Camera",
    "Fetch",
    "Hopper",
    "Husarion",
    "KobukiMaze",
    "MovingCube",
    "ParrotDrone",
    "Wamv",
)


@pytest.mark.parametrize(
    "task", [task for task in task_ids() if not any(name in task for name in OTHERS)]
)
def test_bounds_of_our_own_tasks_fit(task):
    asked = recipe_for(task).training_options
    options = {name: asked[name] for name in ("engine", "starts", "goals") if name in asked}
    copies = 64 if asked["engine"] == "planar" else 16
    env = gym.make_vec(task, copies, vectorization_mode="vector_entry_point", **options)
    scale = ObservationScale(env.single_observation_space)
    env.action_space.seed(0)
    env.reset(seed=0)
    for _ in range(64):
        scale.observe(env.step(env.action_space.sample())[0])
    scale.refresh()
    assert not scale.normalised.any()
    env.close()


class WideCartPole(CartPoleVectorEnv):
    """CartPole as a user may write it: with other bounds, units and origins."""

    def __init__(self, num_envs=1, bound=1000.0, unit=1.0, origin=0.0, **options):
        super().__init__(num_envs, **options)
        self.unit, self.origin = unit, origin
        most = np.full(4, bound, np.float32)
        self.single_observation_space = gym.spaces.Box(-most, most, dtype=np.float32)
        self.observation_space = gym.vector.utils.batch_space(
            self.single_observation_space, num_envs
        )

    def step(self, action):
        seen, *rest = super().step(action)
        return (seen * self.unit + self.origin).astype(np.float32), *rest

    def reset(self, **options):
        seen, info = super().reset(**options)
        return (seen * self.unit + self.origin).astype(np.float32), info


CARTPOLES = {
    "thousand": {"bound": 1000.0},
    "twenty": {"bound": 20.0},
    "none": {"bound": np.inf},
    "float32": {"bound": 3e38},
    "millimetres": {"bound": np.inf, "unit": 1000.0},
    "kilometres": {"bound": 1000.0, "unit": 0.001},
    "far": {"bound": 1e6, "origin": 500.0},
}


@pytest.mark.long
@pytest.mark.filterwarnings("ignore:this environment cannot save its state")
@pytest.mark.parametrize("factor", [1.0, 10.0, 100.0, 1000.0])
def test_a_users_cartpole_is_learnt_as_well_with_bounds_too_wide(factor, tmp_path):
    """Bounds that fit are what is reached before it falls: places, speeds, angles and rates.

    Divided by its bounds alone, the return is 25 with bounds a hundred times too wide.
    """
    task = f"test/CartPole-{factor:.0f}-times-v0"
    bound = factor * np.array([2.4, 3.0, 0.21, 3.0], np.float32)
    gym.register(
        task,
        vector_entry_point=WideCartPole,
        kwargs={"bound": bound},
        max_episode_steps=500,
    )
    result = train(task, steps=40_000, recipe=recipe_for("CartPole"), out=tmp_path)
    del gym.registry[task]
    assert result.summary["return"] > 160.0


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:this environment cannot save its state")
@pytest.mark.parametrize("name", CARTPOLES)
def test_a_users_cartpole_is_learnt_whatever_its_bounds(name, tmp_path):
    task = f"test/CartPole-{name}-v0"
    gym.register(
        task,
        vector_entry_point=WideCartPole,
        kwargs=CARTPOLES[name],
        max_episode_steps=500,
    )
    recipe: Recipe = dataclasses.replace(recipe_for("CartPole"), steps=150_000)
    result = train(task, recipe=recipe, out=tmp_path)
    del gym.registry[task]
    assert result.summary["return"] > 400.0


def test_what_flies_off_is_cut_and_does_not_make_the_rest_small():
    rng = np.random.default_rng(0)
    seen = rng.normal([1.0, -2.0], [0.1, 3.0], (20_000, 2)).astype(np.float32)
    seen[::1000, 0] = -50.0
    scales = [ObservationScale(box(np.inf, np.inf), cut=cut) for cut in (None, 4.0)]
    for scale in scales:
        scale.observe(seen)
        scale.refresh()
    spread = seen.std(axis=0)
    assert 1.0 / scales[0].gain[0] > 3.0 * spread[0]
    np.testing.assert_allclose(1.0 / scales[1].gain, spread, rtol=1e-4)
    assert not scales[0].cuts
    assert torch.isinf(scales[0].limits).all()
    wanted = seen.mean(axis=0) + np.outer([-4.0, 4.0], spread)
    np.testing.assert_allclose(scales[1].limits, wanted, rtol=1e-3)
    shown = scaled(box(np.inf, np.inf), scales[1], seen)
    assert np.abs(shown).max() == pytest.approx(4.0, abs=1e-3)
    inside = (np.abs(seen - seen.mean(axis=0)) < 4.0 * spread).all(axis=1)
    plain = (seen - seen.mean(axis=0)) / spread
    np.testing.assert_allclose(shown[inside], plain[inside], atol=2e-3)


def test_entries_with_bounds_that_fit_are_not_cut():
    scale = ObservationScale(box(1.0, np.inf), cut=2.0)
    scale.observe(np.random.default_rng(0).uniform(-1, 1, (500, 2)).astype(np.float32))
    scale.refresh()
    assert torch.isinf(scale.limits[:, 0]).all()
    assert torch.isfinite(scale.limits[:, 1]).all()


def test_a_cut_below_nothing_is_refused():
    with pytest.raises(TaskError, match="cut_observations must be above 0"):
        dataclasses.replace(recipe_for("Corridor"), cut_observations=0.0)

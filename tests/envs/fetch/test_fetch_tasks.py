"""Fetch's tasks: the rules of Gymnasium-Robotics' version 4, and how its gripper and objects move."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from scipy.spatial.transform import Rotation

import gazelle.envs
from gazelle.envs.dict_rows import DictRows
from gazelle.envs.fetch.demonstrators import pick_and_place, push
from gazelle.envs.fetch.task import _euler
from gazelle.errors import TaskError

TASKS = ("Reach", "Push", "Slide", "PickAndPlace")

# Measured there: where the gripper begins, and its ways along x in steps with 1, 1, 1, 0, 0 [m].
STARTS = {
    "Reach": (1.3419, 0.7491, 0.5347),
    "Push": (1.3455, 0.7490, 0.4136),
    "Slide": (0.9927, 0.7490, 0.4127),
    "PickAndPlace": (1.3419, 0.7491, 0.5347),
}
WAYS = (0.0302, 0.0326, 0.0320, 0.0019, -0.0006)


def vector(task, count, **options):
    name = f"gazelle/Fetch{task}-v0"
    return gym.make_vec(name, num_envs=count, vectorization_mode="vector_entry_point", **options)


@pytest.fixture(scope="module")
def envs():
    made = {task: vector(task, 64, threads=1) for task in TASKS}
    yield made
    for env in made.values():
        env.close()


@pytest.mark.parametrize("reward", ["", "Dense"])
@pytest.mark.parametrize("task", TASKS)
def test_gymnasiums_checker_finds_nothing(task, reward):
    env = gym.make(f"gazelle/Fetch{task}{reward}-v0")
    check_env(env.unwrapped, skip_render_check=True)
    assert env.unwrapped.task.max_episode_steps is None or env.spec.max_episode_steps == 50
    env.close()


@pytest.mark.parametrize("task", TASKS)
def test_spaces_starts_and_goals_are_the_published_ones(envs, task):
    env = envs[task]
    space = env.single_observation_space
    assert space["observation"].shape == ((10,) if task == "Reach" else (25,))
    assert space["achieved_goal"].shape == space["desired_goal"].shape == (3,)
    assert env.single_action_space == gym.spaces.Box(-1.0, 1.0, (4,), np.float32)
    goals, objects = [], []
    for seed in range(8):
        obs, info = env.reset(seed=seed)
        np.testing.assert_allclose(obs["observation"][:, :3], [STARTS[task]] * 64, atol=3e-4)
        goals.append(obs["desired_goal"])
        objects.append(obs["achieved_goal"])
        np.testing.assert_allclose(info["scenario"][:, :3], obs["desired_goal"], atol=1e-6)
    goals, objects = np.concatenate(goals), np.concatenate(objects)
    reach, ahead = (0.3, 0.4) if task == "Slide" else (0.15, 0.0)
    away = goals - STARTS[task] - [ahead, 0.0, 0.0]
    flat = away[:, :3] if task == "Reach" else away[:, :2]
    assert np.abs(flat).max() < reach + 1e-3
    assert (np.abs(flat).max(axis=0) > 0.98 * reach).all()
    if task == "Reach":
        np.testing.assert_allclose(objects, [STARTS[task]] * len(objects), atol=3e-4)
        return
    height = {"Slide": 0.42}.get(task, 0.425)
    raised = goals[:, 2] > height + 1e-6
    assert raised.mean() == pytest.approx(0.5 if task == "PickAndPlace" else 0.0, abs=0.07)
    assert goals[:, 2].max() <= height + (0.45 if task == "PickAndPlace" else 1e-6)
    off = (objects - STARTS[task])[:, :2]
    assert np.abs(off).max() < (0.1 if task == "Slide" else 0.15) + 1e-3
    assert np.linalg.norm(off, axis=1).min() > 0.0995


@pytest.mark.parametrize("task", TASKS)
def test_the_gripper_moves_as_there(envs, task):
    env = envs[task]
    for axis in range(3):
        obs, _ = env.reset(seed=1)
        before, ways = obs["observation"][:, :3], []
        for told in (1, 1, 1, 0, 0):
            actions = np.zeros((64, 4))
            actions[:, axis] = told
            obs, *_ = env.step(actions)
            ways.append(obs["observation"][:, axis] - before[:, axis])
            before = obs["observation"][:, :3]
        # On the table there it rubs in the first step (0.023).
        np.testing.assert_allclose(np.median(ways, axis=1), WAYS, atol=3e-3)
    obs, _ = env.reset(seed=1)
    for _ in range(40):
        obs, *_ = env.step(np.zeros((64, 4)))
    np.testing.assert_allclose(obs["observation"][:, :3], [STARTS[task]] * 64, atol=1e-3)


# Measured there, in Reach: three steps with an action of 1 (or -1) along an axis, and three with 0 [m].
WELDED_WAYS = {
    (0, 1): (0.0302, 0.0326, 0.0320, 0.0021, -0.0005, -0.0001),
    (0, -1): (0.0306, 0.0334, 0.0330, 0.0023, -0.0004, -0.0001),
    (1, 1): (0.0308, 0.0334, 0.0331, 0.0023, -0.0003, 0.0),
    (1, -1): (0.0308, 0.0334, 0.0331, 0.0023, -0.0003, 0.0),
    (2, 1): (0.0304, 0.0333, 0.0330, 0.0025, -0.0004, -0.0001),
    (2, -1): (0.0306, 0.0335, 0.0331, 0.0027, -0.0002, 0.0001),
}


def test_a_weld_draws_the_arm_as_there():
    env = vector("Reach", 6, control="original", threads=1)
    obs, _ = env.reset(seed=1)
    before = obs["observation"][:, :3]
    np.testing.assert_allclose(before, [STARTS["Reach"]] * 6, atol=3e-4)
    ways = np.zeros((6, 6, 3))
    for step in range(6):
        actions = np.zeros((6, 4))
        for world, (axis, sign) in enumerate(WELDED_WAYS):
            actions[world, axis] = sign * (step < 3)
        obs, *_ = env.step(actions)
        ways[:, step] = obs["observation"][:, :3] - before
        before = obs["observation"][:, :3]
    for world, ((axis, sign), wanted) in enumerate(WELDED_WAYS.items()):
        np.testing.assert_allclose(sign * ways[world, :, axis], wanted, atol=5e-4)
        aside = np.delete(ways[world], axis, axis=1)
        assert np.abs(aside).max() < 1e-3
    env.close()


def test_a_weld_does_the_same_in_any_number_of_worlds_and_after_a_reset():
    alone, many = (vector("PickAndPlace", count, control="original") for count in (1, 3))
    rng, seen = np.random.default_rng(4), []
    for env in (alone, many):
        env.reset(seed=5)
    for _ in range(55):
        actions = rng.uniform(-1, 1, (3, 4))
        first, second = alone.step(actions[:1])[0], many.step(actions)[0]
        seen.append(second["observation"][:, :3])
        np.testing.assert_array_equal(first["observation"][0], second["observation"][0])
    starts = np.array(seen)[49]  # the next episode has begun
    np.testing.assert_allclose(starts, [STARTS["PickAndPlace"]] * 3, atol=3e-4)
    assert np.abs(np.diff(seen, axis=0)).max() > 0.02
    for env in (alone, many):
        env.close()


@pytest.mark.parametrize("task", TASKS[1:])
def test_the_observation_is_what_its_table_says(envs, task):
    env = envs[task]
    last, _ = env.reset(seed=2)
    rng = np.random.default_rng(0)
    for _ in range(12):
        actions = rng.uniform(-1, 1, (64, 4))
        actions[:, 2] = 0.3
        obs, *_ = env.step(actions)
        seen = obs["observation"]
        np.testing.assert_array_equal(seen[:, 3:6], obs["achieved_goal"])
        np.testing.assert_allclose(seen[:, 6:9], seen[:, 3:6] - seen[:, :3], atol=1e-6)
        last = seen
    # What goes on steadily goes as far in a step as its velocity says.
    obs, *_ = env.step(np.tile([0.0, 0.0, 1.0, 0.0], (64, 1)))
    obs, *_ = env.step(np.tile([0.0, 0.0, 1.0, 0.0], (64, 1)))
    last, now = obs["observation"], env.step(np.tile([0.0, 0.0, 1.0, 0.0], (64, 1)))[0]
    now = now["observation"]
    np.testing.assert_allclose(now[:, 22], now[:, 2] - last[:, 2], atol=1e-3)
    relative = now[:, 14:17] + now[:, 20:23]
    still = np.linalg.norm(now[:, 3:6] - last[:, 3:6], axis=1) < 1e-4
    assert np.abs(relative[still]).max() < 1e-3


def test_angles_are_those_of_turns_about_x_y_and_z():
    turned = Rotation.random(500, random_state=0)
    wanted = turned.as_euler("XYZ")
    np.testing.assert_allclose(_euler(turned.as_quat()), wanted, atol=1e-9)
    upright = _euler(np.array([[0.0, 0.0, 0.0, 1.0]]))
    np.testing.assert_array_equal(upright, np.zeros((1, 3)))


@pytest.mark.parametrize("dense", [False, True])
def test_rewards_are_the_published_ones(dense):
    env = gym.make(f"gazelle/FetchPush{'Dense' if dense else ''}-v0").unwrapped
    goal = np.zeros((6, 3))
    achieved = np.outer([0.0, 0.0499, 0.0501, 0.1, 1.0, 3.0], [0.0, 0.6, 0.8])
    distance = np.array([0.0, 0.0499, 0.0501, 0.1, 1.0, 3.0])
    wanted = -distance if dense else np.array([0.0, 0.0, -1.0, -1.0, -1.0, -1.0])
    np.testing.assert_allclose(env.compute_reward(achieved, goal, {}), wanted)
    assert env.compute_reward(achieved[3], goal[3], {}) == pytest.approx(wanted[3])
    obs, _ = env.reset(seed=0)
    obs, reward, terminated, truncated, info = env.step(np.ones(4, np.float32))
    assert not terminated
    assert not truncated
    told = env.compute_reward(obs["achieved_goal"], obs["desired_goal"], info)
    assert reward == pytest.approx(float(told))
    assert info["is_success"] is False
    env.close()


@pytest.mark.parametrize("task", TASKS)
def test_dense_twins_pay_the_distance_in_every_world_and_differ_in_nothing_else(envs, task):
    dense = gym.make_vec(
        f"gazelle/Fetch{task}Dense-v0",
        num_envs=64,
        vectorization_mode="vector_entry_point",
        threads=1,
    )
    sparse = envs[task]
    for env in (dense, sparse):
        env.reset(seed=6)
    rng = np.random.default_rng(6)
    for _ in range(5):
        actions = rng.uniform(-1, 1, (64, 4))
        obs, paid, *_ = dense.step(actions)
        twin, told, *_ = sparse.step(actions)
        for name, part in obs.items():
            np.testing.assert_array_equal(part, twin[name])
        apart = np.linalg.norm(obs["achieved_goal"] - obs["desired_goal"], axis=1)
        np.testing.assert_allclose(paid, -apart, atol=1e-6)
        np.testing.assert_array_equal(told, np.where(apart > 0.05, -1.0, 0.0))
    # Any number of leading axes, as a replay memory asks.
    goals = rng.uniform(-0.1, 0.1, (2, 7, 5, 3))
    found = dense.unwrapped.compute_reward(goals[0], goals[1], {})
    np.testing.assert_allclose(found, -np.linalg.norm(goals[0] - goals[1], axis=-1))
    dense.close()


def test_episodes_have_fifty_steps_and_a_world_does_the_same_among_others():
    alone, many = vector("PickAndPlace", 1), vector("PickAndPlace", 5)
    seen = [env.reset(seed=9)[0] for env in (alone, many)]
    rng = np.random.default_rng(1)
    for step in range(60):
        actions = rng.uniform(-1, 1, (5, 4))
        for key, part in seen[0].items():
            np.testing.assert_array_equal(part[0], seen[1][key][0])
        first, second = alone.step(actions[:1]), many.step(actions)
        assert first[3][0] == (step == 49)
        assert first[1][0] == second[1][0]
        seen = [first[0], second[0]]
    for env in (alone, many):
        env.close()


def picked(env, seed, reach=0.033):
    """Run a hand-made policy: over the cube, down, close, and to the goal."""
    obs, _ = env.reset(seed=seed)
    held = np.zeros(env.num_envs)
    for _ in range(49):
        seen, goal = obs["observation"], obs["desired_goal"]
        grip, cube = seen[:, :3], seen[:, 3:6]
        aside = np.linalg.norm((cube - grip)[:, :2], axis=1) > 0.01
        there = np.linalg.norm(cube - grip, axis=1) < 0.015
        held = np.where(there | (held > 0), held + 1, 0)
        above = aside & (held == 0)
        wanted = np.where(above[:, None], cube + np.array([0, 0, 0.08]), cube)
        wanted = np.where((held > 3)[:, None], grip + np.clip(goal - cube, -0.02, 0.02), wanted)
        actions = np.ones((env.num_envs, 4))
        actions[:, :3] = np.clip((wanted - grip) / reach, -1, 1)
        actions[held > 0, 3] = -1
        obs, _, _, _, info = env.step(actions)
    return info["is_success"], obs


@pytest.mark.long
def test_what_is_grasped_is_lifted_and_carried_to_the_goal(envs):
    success, obs = picked(envs["PickAndPlace"], 0)
    assert success.mean() > 0.95
    raised = obs["desired_goal"][:, 2] > 0.5
    assert raised.sum() > 10
    assert success[raised].all()


@pytest.mark.parametrize(
    ("task", "shows", "least"),
    [("PickAndPlace", pick_and_place, 0.95), ("Push", push, 0.95), ("Slide", push, 0.5)],
)
@pytest.mark.parametrize("seed", [1, 2])
def test_demonstrators_reach_goals(envs, task, shows, least, seed):
    env = envs[task]
    obs, _ = env.reset(seed=seed)
    rows = DictRows(env.single_observation_space)
    for _ in range(49):
        obs, _, _, _, info = env.step(shows(rows.join(obs)))
    assert info["is_success"].mean() >= least


def test_fingers_open_and_close_together_within_their_range(envs):
    env = envs["PickAndPlace"]
    env.reset(seed=0)
    for told, wanted in ((1, 0.05), (-1, 0.0), (1, 0.05)):
        for _ in range(5):
            obs, *_ = env.step(np.tile([0.0, 0.0, 0.0, told], (64, 1)))
            opening = obs["observation"][:, 9:11]
            assert (opening > -5e-3).all()
            assert (opening < 0.056).all()
            np.testing.assert_allclose(opening[:, 0], opening[:, 1], atol=4e-3)
        np.testing.assert_allclose(opening, wanted, atol=2e-3)


def test_what_is_pushed_moves_and_slides_on_only_where_it_is_slippery(envs):
    far = {}
    for task in ("Push", "Slide"):
        env = envs[task]
        obs, _ = env.reset(seed=0)
        # The edge of the table is farther away on this side.
        ahead = obs["observation"][:, 6] * (1 if task == "Slide" else -1)
        inner = ahead > 0.05
        for step in range(30):
            seen = obs["observation"]
            way = np.zeros((64, 4))
            if step < 9:
                way[:, :2] = np.clip(seen[:, 6:8] / 0.033, -0.5, 0.5)
            obs, *_ = env.step(way)
            if step == 8:
                before = obs["achieved_goal"][:, :2]
        way = np.linalg.norm(obs["achieved_goal"][:, :2] - before, axis=1)[inner]
        far[task] = np.median(way)
        assert (np.abs(obs["achieved_goal"][inner, 2] - 0.42) < 0.03).mean() > 0.9
    assert far["Slide"] > 3 * far["Push"]


@pytest.mark.parametrize("task", TASKS)
def test_the_arms_joints_carry_the_gripper_alike(task):
    env = vector(task, 8, control="joint", threads=1)
    obs, _ = env.reset(seed=3)
    np.testing.assert_allclose(obs["observation"][:, :3], [STARTS[task]] * 8, atol=3e-4)
    before = obs["observation"][:, :3]
    for axis, sign in ((2, 1), (0, 1), (1, -1), (2, 1)):
        actions = np.zeros((8, 4))
        actions[:, axis] = sign
        obs, *_ = env.step(actions)
        after = obs["observation"][:, :3]
        wanted = np.zeros(3)
        wanted[axis] = 0.033 * sign
        np.testing.assert_allclose(after - before, [wanted] * 8, atol=4e-3)
        before = after
    link = env.task._gripper._link
    turned = Rotation.from_quat(link.placement(None).quaternion)
    down = turned.apply([1.0, 0.0, 0.0])
    assert (down[:, 2] < -0.999).all()
    env.close()


def test_what_cannot_be_is_named():
    with pytest.raises(TaskError, match=r"no task 'Push2'.*Push"):
        gazelle.envs.fetch.envs.FetchEnv("Push2")
    with pytest.raises(TaskError, match=r"no reward_type 'sparce'.*sparse"):
        gym.make("gazelle/FetchReach-v0", reward_type="sparce")
    with pytest.raises(TaskError, match=r"no control 'joints'.*joint"):
        gym.make("gazelle/FetchReach-v0", control="joints")


PROBE = """
import json, sys
import gymnasium as gym, numpy as np, gymnasium_robotics
gym.register_envs(gymnasium_robotics)
out = {}
for task in sys.argv[1:]:
    env = gym.make(f"Fetch{task}-v4")
    obs, _ = env.reset(seed=0)
    start, ways, goals = obs["observation"][:3], [], []
    for told in (1, 1, 1, 0, 0):
        now, *_ = env.step(np.array([0, 0, told, 0], np.float32))
        ways.append(float(now["observation"][2] - obs["observation"][2]))
        obs = now
    for _ in range(200):
        goals.append(env.reset()[0]["desired_goal"])
    rng, path = np.random.default_rng(3), []
    env.reset(seed=0)
    for _ in range(20):
        action = np.append(rng.uniform(-1, 1, 3), 0.0)
        action[2] = abs(action[2])  # what leans on a table differs more
        path.append(env.step(action.astype(np.float32))[0]["observation"][:3].tolist())
    achieved = np.random.default_rng(0).uniform(-0.1, 0.1, (50, 3))
    rewards = env.unwrapped.compute_reward(achieved, np.zeros((50, 3)), {})
    size = env.observation_space["observation"].shape
    out[task] = dict(start=start.tolist(), ways=ways, path=path, size=list(size), rewards=rewards.tolist(),
                     low=np.min(goals, 0).tolist(), high=np.max(goals, 0).tolist(),
                     period=env.unwrapped.dt, steps=env.spec.max_episode_steps)
print(json.dumps(out))
"""


@pytest.mark.slow
@pytest.mark.skipif(
    "GAZELLE_GYMNASIUM_ROBOTICS" not in os.environ, reason="set GAZELLE_GYMNASIUM_ROBOTICS"
)
def test_it_equals_gymnasium_robotics_itself(envs):
    python = Path(os.environ["GAZELLE_GYMNASIUM_ROBOTICS"])
    done = subprocess.run([python, "-c", PROBE, *TASKS], capture_output=True, text=True, check=True)
    for task, there in json.loads(done.stdout.strip().splitlines()[-1]).items():
        env = envs[task]
        obs, _ = env.reset(seed=0)
        assert list(obs["observation"].shape[1:]) == there["size"]
        np.testing.assert_allclose(obs["observation"][0, :3], there["start"], atol=1e-3)
        assert env.control_period == pytest.approx(there["period"])
        assert env.spec.max_episode_steps == there["steps"]
        ways, goals = [], [obs["desired_goal"]]
        for told in (1, 1, 1, 0, 0):
            now, *_ = env.step(np.tile([0, 0, told, 0], (64, 1)))
            ways.append(float(now["observation"][0, 2] - obs["observation"][0, 2]))
            obs = now
        np.testing.assert_allclose(ways, there["ways"], atol=3e-3)
        goals += [env.reset(seed=seed)[0]["desired_goal"] for seed in range(4)]
        np.testing.assert_allclose(np.concatenate(goals).min(0), there["low"], atol=0.03)
        np.testing.assert_allclose(np.concatenate(goals).max(0), there["high"], atol=0.03)
        achieved = np.random.default_rng(0).uniform(-0.1, 0.1, (50, 3))
        told = env.compute_reward(achieved, np.zeros((50, 3)), {})
        np.testing.assert_allclose(told, there["rewards"])
        check_path(task, there["path"])


def check_path(task, there):
    """Check twenty steps of the weld with any actions."""
    env, rng, path = vector(task, 1, control="original"), np.random.default_rng(3), []
    env.reset(seed=0)
    for _ in range(20):
        action = np.append(rng.uniform(-1, 1, 3), 0.0)
        action[2] = abs(action[2])
        path.append(env.step(action[None])[0]["observation"][0, :3])
    env.close()
    ways = [np.diff([STARTS[task], *each], axis=0) for each in (path, there)]
    np.testing.assert_allclose(*ways, atol=3e-3)
    np.testing.assert_allclose(path, there, atol=0.02)

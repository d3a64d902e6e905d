"""The registered environments keep Gymnasium's contract and do what their data sheet says."""

import warnings
from dataclasses import replace

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env, data_equivalence
from gymnasium.utils.passive_env_checker import env_render_passive_checker

from gazelle import assets, formats
from gazelle.envs import task_ids
from gazelle.envs.turtlebot3.envs import TurtleBot3Env
from gazelle.errors import GazelleWarning, ResolveError, TaskError

STAGE1 = "gazelle/TurtleBot3Stage1-v0"
STRAIGHT = 2


# As the originals have it, and Gymnasium's checker would rather not: observations without
# bounds, and joints in radians as actions.
ODD = {
    "CartPoleStayUp": ".*Box observation space (min|max)imum value is -?infinity.*",  # velocities
    "Fetch": ".*Box observation space (min|max)imum value is -?infinity.*",
    "Reach-": ".*recommend using a symmetric and normalized space.*",
}


@pytest.mark.parametrize("task", task_ids())
def test_gymnasiums_checker_finds_nothing(task):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for name, message in ODD.items():
            if name in task:
                warnings.filterwarnings("ignore", message)
        env = gym.make(task)
        check_env(env.unwrapped, skip_render_check=True)
    env.close()


@pytest.mark.long
@pytest.mark.parametrize("task", task_ids())
def test_gymnasiums_checker_finds_nothing_in_pictures(task):
    env = gym.make(task, render_mode="rgb_array").unwrapped
    env.reset(seed=0)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        picture = env_render_passive_checker(env)
    assert picture.dtype == np.uint8
    assert np.ptp(picture) > 0
    env.close()


@pytest.mark.parametrize("task", task_ids())
def test_two_runs_with_one_seed_are_the_same(task):
    first, second = gym.make(task), gym.make(task, threads=1)
    first.action_space.seed(7)
    seen_1, info_1 = first.reset(seed=11)
    seen_2, info_2 = second.reset(seed=11)
    for _ in range(4):
        assert data_equivalence(seen_1, seen_2)
        action = first.action_space.sample()
        seen_1, reward_1, *ends_1, info_1 = first.step(action)
        seen_2, reward_2, *ends_2, info_2 = second.step(action)
        assert (reward_1, ends_1) == (reward_2, ends_2)
        assert str(info_1) == str(info_2)
    first.close()
    second.close()


def test_seeds_differ_and_reset_goes_on():
    env = gym.make(STAGE1)
    one, two = env.reset(seed=1)[0], env.reset(seed=2)[0]
    again, later = env.reset(seed=1)[0], env.reset()[0]
    assert not np.array_equal(one, two)
    assert np.array_equal(one, again)
    assert not np.array_equal(one, later)
    env.close()


def test_the_robot_drives_where_the_action_points():
    env = gym.make(STAGE1)
    for action, sign in ((0, 1), (2, 0), (4, -1)):
        env.reset(seed=0)
        for _ in range(5):
            env.step(action)
        robot = env.unwrapped.task.scene.robot
        assert np.sign(np.round(robot.yaw[0], 1)) == sign
        assert robot.position[0, 0] > 0.05
    env.close()


def test_a_goal_reached_pays_and_the_episode_goes_on():
    env = gym.make(STAGE1)
    _, info = env.reset(seed=3)
    assert info["goal"].tolist() == [0.6, 0.0]
    while not info["is_success"]:
        _, reward, terminated, truncated, info = env.step(STRAIGHT)
        assert not terminated
        assert not truncated
    assert reward == 200.0
    assert info["distance"] < 0.2
    assert info["goals_reached"] == 1
    assert np.abs(info["goal"] - (0.6, 0.0)).max() >= 1.0
    goal = info["goal"]
    seen, *_, info = env.step(STRAIGHT)
    assert seen[25] > 0.5
    _, info = env.reset()
    assert info["goal"].tolist() == goal.tolist()
    env.close()


def test_without_respawn_a_goal_ends_the_episode():
    env = gym.make(STAGE1, respawn=False, goals=[(0.5, 0.0)])
    _, info = env.reset(seed=3)
    terminated = False
    while not terminated:
        _, reward, terminated, _, info = env.step(STRAIGHT)
    assert info["is_success"]
    assert not info["is_collision"]
    assert reward == 200.0
    env.close()


def test_a_wall_ends_the_episode():
    env = gym.make(STAGE1, goals=[(-1.5, -1.5)], max_episode_steps=200)
    env.reset(seed=3)
    terminated, steps = False, 0
    while not terminated and steps < 100:
        seen, reward, terminated, truncated, info = env.step(STRAIGHT)
        steps += 1
    assert terminated
    assert not truncated
    assert info["is_collision"]
    assert reward == -200.0
    assert 0 < seen[:24].min() < 0.13
    env.close()


def test_the_step_limit_truncates():
    env = gym.make(STAGE1, max_episode_steps=3)
    env.reset(seed=0)
    ends = [env.step(0)[2:4] for _ in range(3)]
    assert ends == [(False, False), (False, False), (False, True)]
    env.close()


def test_a_time_out_comes_in_the_step_after_the_five_hundredth():
    # As in the published loop; in a circle of 0.1 m about the start nothing else ends an episode.
    env = gym.make(STAGE1)
    env.reset(seed=0)
    ends = [env.step(0)[2:4] for _ in range(501)]
    assert ends[:-1] == [(False, False)] * 500
    assert ends[-1] == (False, True)
    env.close()


def test_a_robot_file_with_more_rays_is_fitted_with_a_notice():
    file = assets.robot("turtlebot3_burger")
    with pytest.warns(GazelleWarning, match="360 rays and the task reads 12"):
        env = gym.make(STAGE1, robot=file, lidar_samples=12)
    assert env.observation_space.shape == (14,)
    assert env.reset(seed=0)[0].shape == (14,)
    env.close()


@pytest.mark.filterwarnings("ignore:sensor .*is not measured yet")
@pytest.mark.parametrize("robot", ["turtlebot3_waffle", "turtlebot3_waffle_pi"])
def test_other_bundled_robots_drive_without_a_notice(robot):
    env = gym.make(STAGE1, robot=robot)
    _, before = env.reset(seed=0)
    for _ in range(5):
        *_, after = env.step(STRAIGHT)
    assert after["distance"] < before["distance"] - 0.05
    env.close()


@pytest.mark.parametrize(
    ("options", "error", "text"),
    [
        ({"lidarsamples": 24}, TaskError, "did you mean 'lidar_samples'"),
        ({"lidar_samples": 400}, TaskError, r"turtlebot3_burger.*360 rays.*reads 400"),
        ({"time_step": 0.03}, TaskError, "must divide"),
        ({"goals": [1.0, 2.0]}, TaskError, "pairs"),
        ({"world": "turtlebot3_stage_7"}, ResolveError, "turtlebot3_stage_"),
        ({"stage": 5}, TaskError, "there is no stage '5'"),
    ],
)
def test_a_wrong_option_is_an_error_that_says_so(options, error, text):
    with pytest.raises(error, match=text):
        gym.make(STAGE1, **options)


def test_a_robot_that_cannot_be_driven_is_refused():
    robot = replace(formats.load_model("turtlebot3_burger"), plugins=())
    with pytest.raises(TaskError, match="'turtlebot3_burger' has no input 'cmd_vel'"):
        gym.make(STAGE1, robot=robot, lidar_samples=360)


def test_a_picture_shows_the_goal_in_red():
    env = gym.make(STAGE1, render_mode="rgb_array", goals=[(1.0, 0.0)])
    env.reset(seed=0)
    picture = env.render()
    assert picture.dtype == np.uint8
    red = picture[..., 0].astype(int) - picture[..., 1] > 40
    rows, columns = np.nonzero(red)
    assert red.sum() > 200
    assert columns.mean() == pytest.approx(picture.shape[1] / 2, abs=2)
    assert rows.mean() < picture.shape[0] / 2
    env.close()
    with pytest.raises(TaskError, match="did you mean 'rgb_array'"):
        TurtleBot3Env(1, render_mode="rgb_aray")


def test_a_wrong_action_is_an_error():
    env = gym.make(STAGE1).unwrapped
    env.reset(seed=0)
    with pytest.raises(TaskError, match="from 0 to 4"):
        env.step(5)
    env.close()

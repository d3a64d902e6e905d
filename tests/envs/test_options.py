"""Options are checked, and near misses are named."""

import pytest

from gazelle.envs.options import NavigationSettings, TaskSettings, read_options
from gazelle.errors import TaskError


def test_defaults():
    settings = read_options(NavigationSettings, {})
    assert (settings.engine, settings.lidar_samples, settings.respawn) == ("mujoco", 24, True)


@pytest.mark.parametrize(
    ("options", "text"),
    [
        ({"lidar_sample": 24}, "did you mean 'lidar_samples'"),
        ({"engine": "mujocco"}, "did you mean 'mujoco'"),
        ({"lidar_samples": 1}, "lidar_samples must be an int, 2 or more"),
        ({"lidar_samples": 24.0}, "not 24.0"),
        ({"max_episode_steps": 0}, "max_episode_steps"),
        ({"max_episode_steps": True}, "max_episode_steps"),
        ({"seed": -1}, "seed"),
        ({"threads": 0}, "threads"),
        ({"time_step": 0.0}, "time_step"),
        ({"time_step": "fast"}, "time_step"),
        ({"respawn": 1}, "respawn must be True or False"),
        ({"world": 3}, "world must be a file"),
        ({"robot": []}, "robot must be a file"),
    ],
)
def test_a_wrong_option_is_named(options, text):
    with pytest.raises(TaskError, match=text):
        read_options(NavigationSettings, options)


def test_options_of_another_kind_of_task_are_unknown():
    with pytest.raises(TaskError, match="there is no option 'goals'"):
        read_options(TaskSettings, {"goals": [(0.0, 0.0)]})

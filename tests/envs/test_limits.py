"""Arguments that ask for more than any machine has are one error that names the limit, at once."""

import gymnasium as gym
import pytest

import gazelle.envs  # noqa: F401
from gazelle.errors import TaskError


@pytest.mark.parametrize(
    ("task", "count", "options", "text"),
    [
        ("TurtleBot3Stage1", 2**40, {}, "num_envs must be 1,048,576 at most"),
        ("CartPoleStayUp", 2**62, {}, "num_envs must be 1,048,576 at most"),
        ("FetchReach", 2**40, {}, "num_envs must be 1,048,576 at most"),
        ("AGVFleet", 72 * 2**40, {}, "num_envs must be 1,048,576 at most"),
        ("AGVFleet", 4, {"agents": 10**9}, "agents must be 10,000 at most"),
        ("AGVFleet", 4, {"lidar_samples": 10**9}, "lidar_samples must be 100,000 at most"),
        ("TurtleBot3Stage1", 4, {"lidar_samples": 10**9}, "lidar_samples must be 100,000 at most"),
        ("CartPoleStayUp", 4, {"max_episode_steps": 10**30}, "max_episode_steps must be"),
    ],
)
def test_what_no_machine_has_is_refused(task, count, options, text):
    with pytest.raises(TaskError, match=text):
        gym.make_vec(
            f"gazelle/{task}-v0", count, vectorization_mode="vector_entry_point", **options
        )


@pytest.mark.parametrize("options", [5, "reset_mask", ["reset_mask"], [], 0.5])
def test_options_that_are_no_mapping_are_refused(options):
    single = gym.make("gazelle/CartPoleStayUp-v0")
    many = gym.make_vec("gazelle/CartPoleStayUp-v0", 2, vectorization_mode="vector_entry_point")
    for env in (single, many):
        with pytest.raises(TaskError, match="reset options must be a mapping of names to values"):
            env.reset(options=options)
        env.close()

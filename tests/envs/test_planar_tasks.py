"""Every task runs in the plane, or says that it cannot."""

import gymnasium as gym
import numpy as np
import pytest

from gazelle.envs import task_ids
from gazelle.errors import TaskError

FORCED = (
    "CartPoleStayUp",
    "MovingCube",
    "HopperStayUp",
    "ParrotDrone",
    "Wamv",
    "ABBIRB",
    "UR5",
    "Fetch",
)
"""How the names of tasks begin whose robots are moved by forces."""


def names(forced):
    found = [task.removeprefix("gazelle/").removesuffix("-v0") for task in task_ids()]
    return [name for name in found if name.startswith(FORCED) is forced]


def makers(name, **options):
    """Yield ways to make the single and the vector environment."""
    task = f"gazelle/{name}-v0"
    vector = {"vectorization_mode": "vector_entry_point"}
    yield lambda: gym.make(task, **options)
    yield lambda: gym.make_vec(task, num_envs=2, **vector, **options)


@pytest.mark.parametrize("name", names(forced=True))
def test_what_forces_move_is_refused(name):
    for make in makers(name, engine="planar"):
        with pytest.raises(TaskError, match=r"planar engine computes no forces.*or choose mujoco"):
            make()


@pytest.mark.parametrize("name", names(forced=False))
def test_what_drives_moves_in_the_plane(name):
    for make in makers(name, engine="planar"):
        env = make()
        first, _ = env.reset(seed=0)
        env.action_space.seed(0)
        for _ in range(5):
            seen, reward, *_ = env.step(env.action_space.sample())
        env.close()
        assert not np.array_equal(first, seen)
        assert np.isfinite(reward).all()
        assert env.observation_space.contains(seen)

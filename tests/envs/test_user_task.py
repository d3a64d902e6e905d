"""The task of a user that benchmarks run: short, right in both engines, and reproducible."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

FILE = Path(__file__).parents[2] / "benchmarks" / "user_task.py"


@pytest.fixture(scope="module")
def user_task():
    spec = importlib.util.spec_from_file_location("user_task", FILE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_its_task_and_drive_are_under_80_lines():
    code = FILE.read_text(encoding="utf-8").partition("class CartDrive")[2]
    assert 40 < len(code.splitlines()) < 80


@pytest.mark.parametrize("engine", ["planar", "mujoco"])
def test_it_drives_and_ends_before_walls(user_task, engine):
    env = user_task.make(3, engine)
    env.reset(seed=1)
    ended = 0
    for _ in range(150):
        _, reward, terminated, _, _ = env.step(np.tile([1.0, 0.0], (3, 1)))
        ended += int(terminated.sum())
        assert (reward == 1.0).all()
    x, y, yaw = env.task.cart.planar_pose().T
    # straight ahead to the wall at 2.45 m, whose inner side is at 2.4, and back to the start
    assert ended >= 3
    assert (np.abs(y) < 0.1).all()
    assert (x < 2.2).all()
    assert (np.abs(yaw) < 0.1).all()
    env.close()


def test_a_world_does_the_same_among_others(user_task):
    envs = [user_task.make(count) for count in (1, 40)]
    generator = np.random.default_rng(0)
    seen = [env.reset(seed=4)[0] for env in envs]
    for _ in range(80):
        actions = generator.uniform(-1.0, 1.0, (40, 2))
        np.testing.assert_array_equal(seen[0][0], seen[1][0])
        seen = [env.step(actions[: env.num_envs])[0] for env in envs]
    for env in envs:
        env.close()

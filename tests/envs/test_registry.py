"""The ids are registered, lazily, and near misses are named."""

import subprocess
import sys

import gymnasium as gym
import pytest

from gazelle.envs import task_ids


def test_all_ids_are_known_to_gymnasium():
    assert len(task_ids()) == 37
    for task in task_ids():
        spec = gym.spec(task)
        steps = {
            "Fetch": 50,
            "TurtleBot3World": 500,
            "TurtleBot3Camera": 120,
            "TurtleBot3": 501,
            "AGVFleet": 500,
            "CartPole": 1000,
            "MovingCube": 1000,
            "TurtleBot2": 500,
            "Kobuki": 1000,
            "Husarion": 500,
            "SummitXL": 500,
            "Hopper": 1000,
            "ParrotDrone": 100,
            "Wamv": 100,
            "VelocityReach": 300,
            "Reach": 50,
        }
        assert spec.max_episode_steps == next(steps[key] for key in steps if key in task)
        assert spec.vector_entry_point is not None


def test_an_unknown_id_gets_the_closest():
    with pytest.raises(gym.error.NameNotFound, match="TurtleBot3Stage1"):
        gym.make("gazelle/TurtleBot3Stge1-v0")


def test_registering_imports_no_simulation():
    code = "import sys, gazelle.envs; sys.exit('mujoco' in sys.modules or 'torch' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0

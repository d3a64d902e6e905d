"""openai_ros' drone by its names: the rules on a graph are those of the task on arrays."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.clients.descriptions import find_file
from gazelle.compat.openai_ros.task_envs.geometry import point
from gazelle.compat.openai_ros.task_envs.parrotdrone import parrotdrone_goto
from gazelle.envs.parrot_drone.rules import distance_of, ends_of, reward_of
from gazelle.ros.launch.values import load_yaml

FOLDER = "src/openai_ros/task_envs/parrotdrone/config"
metres = st.integers(-2, 11)
tilts = st.sampled_from((-1.6, -1.5, 0.0, 1.5, 1.6))


def parameter(name):
    path = find_file(f"{FOLDER}/parrotdrone_goto.yaml", "openai_ros")
    value = load_yaml(path.read_text(encoding="utf-8"))
    for part in name.strip("/").split("/"):
        value = value[part]
    return value


@pytest.fixture(scope="module")
def env():
    """The task with its parameters, and no graph; it notes what it commands."""
    made = object.__new__(parrotdrone_goto.ParrotDroneGotoEnv)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(parrotdrone_goto, "rospy", SimpleNamespace(get_param=parameter))
        made._read_parameters()
    made.cumulated_reward = made.cumulated_steps = 0.0
    made.commands = []
    made.move_base = lambda linear, angular: made.commands.append(
        (linear.x, linear.y, linear.z, angular)
    )
    return made


@given(metres, metres, st.integers(-2, 4), tilts, tilts, st.integers(0, 50), st.booleans())
def test_rewards_and_ends_are_those_of_the_native_task(env, x, y, z, roll, pitch, sonar, closer):
    seen = np.array([[x, y, z, roll, pitch, 0.0, sonar / 10]])
    ends = ends_of(seen)
    distance = distance_of(seen[:, :3])[0]
    env.previous_distance_from_des_point = distance + (0.1 if closer else 0.0)
    done = env._is_done(seen[0])
    assert done == ends.over[0]
    assert env._compute_reward(seen[0], done) == reward_of(ends, np.array([closer]))[0]
    assert env.previous_distance_from_des_point == pytest.approx(distance)


def test_actions_go_along_the_axes_both_ways(env):
    del env.commands[:]
    for action in range(6):
        env._set_action(action)
    half = 0.5
    assert env.commands == [
        (half, 0, 0, 0),
        (-half, 0, 0, 0),
        (0, half, 0, 0),
        (0, -half, 0, 0),
        (0, 0, half, 0),
        (0, 0, -half, 0),
    ]
    assert env.last_action == "DOWN"


def test_places_are_cut_and_angles_are_rounded(env):
    env.gt_pose = SimpleNamespace(
        position=point(1.9, -0.9, 2.2), orientation=SimpleNamespace(x=0.1, y=0.0, z=0.0, w=0.995)
    )
    env.sonar = SimpleNamespace(range=3.26)
    assert env._get_obs() == [1, 0, 2, 0.2, 0.0, 0.0, 3.3]

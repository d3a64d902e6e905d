"""Pictures as observations of anybody's task."""

from __future__ import annotations

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

from gazelle import assets, formats
from gazelle.envs import SimulationTask, StepOutcome, TaskEnv, TaskVectorEnv
from gazelle.envs.cameras import CameraObservation, fit_camera
from gazelle.errors import TaskError
from gazelle.simulation import Simulation

WAFFLE = "turtlebot3_waffle_pi"


class Looking(SimulationTask):
    """A task as a user writes one: turn until it is dark."""

    def __init__(self, nworld):
        simulation = Simulation("turtlebot3_stage_1", "planar", nworld=nworld, time_step=0.01)
        model = fit_camera(formats.load_model(assets.robot(WAFFLE)), 24, 16)
        self.robot = simulation.spawn(model, name="robot")
        self.camera = CameraObservation(self.robot)
        self.observation_space = self.camera.space
        self.action_space = gym.spaces.Discrete(2)
        super().__init__(simulation, control_period=0.1, max_episode_steps=5)

    def start(self, worlds):
        yaw = self.draw(-3.0, 3.0, worlds)[:, 0]
        self.robot.set_pose(np.zeros((len(worlds), 3)), yaw=yaw, worlds=worlds)

    def observe(self, worlds):
        return self.camera.read(worlds)

    def act(self, actions):
        self.robot.inputs["cmd_vel"].send(linear=0.0, angular=actions - 0.5)

    def outcome(self, observation):
        light = observation.mean(axis=(1, 2, 3))
        return StepOutcome(-light / 255.0, light < 50.0)


def test_a_users_task_sees():
    env = TaskEnv(Looking(1))
    assert env.observation_space == gym.spaces.Box(0, 255, (16, 24, 3), np.uint8)
    check_env(env)
    env.close()


def test_only_the_worlds_asked_for_are_drawn():
    task = Looking(4)
    task.begin(np.arange(4))
    everything = task.camera.read()
    assert everything.shape == (4, 16, 24, 3)
    np.testing.assert_array_equal(task.camera.read(np.array([2, 0])), everything[[2, 0]])
    task.close()


@pytest.mark.parametrize("mode", ["SameStep", "NextStep", "Disabled"])
def test_pictures_stay_bytes_in_every_mode(mode):
    env = TaskVectorEnv(Looking(3), autoreset_mode=mode)
    seen, _ = env.reset(seed=0)
    for _ in range(5):
        assert seen.dtype == np.uint8
        seen, *_, info = env.step(np.zeros(3, int))
    if mode == "SameStep":
        assert info["final_obs"][0].dtype == np.uint8
    state = env.get_state()
    if mode == "Disabled":
        env.reset(options={"reset_mask": np.ones(3, bool)})
    first = env.step(np.ones(3, int))[0]
    env.set_state(state)
    if mode == "Disabled":
        env.reset(options={"reset_mask": np.ones(3, bool)})
    np.testing.assert_array_equal(env.step(np.ones(3, int))[0], first)
    env.close()


def test_robots_without_eyes_and_wrong_names_are_refused():
    burger = formats.load_model(assets.robot("turtlebot3_burger"))
    with pytest.raises(TaskError, match="has no camera"):
        fit_camera(burger, 84, 84)
    with Simulation("empty", "planar") as simulation:
        blind = simulation.spawn(burger, name="blind")
        seeing = simulation.spawn(assets.robot(WAFFLE), name="seeing")
        with pytest.raises(TaskError, match="0 cameras"):
            CameraObservation(blind)
        with pytest.raises(TaskError, match="Pi Camera"):
            CameraObservation(seeing, "Pi Camra")
        assert CameraObservation(seeing, "Pi Camera").space.shape == (480, 640, 3)

"""A small task with goals: a block on two rails gets to a place; for environments and training."""

from __future__ import annotations

import gymnasium as gym
import numpy as np

import gazelle
from gazelle import formats
from gazelle.envs import GoalSimulationTask, TaskGoalEnv, TaskGoalVectorEnv

RAIL = """<link name='{0}'><inertial><mass>1</mass></inertial></link><joint name='along_{0}' type='prismatic'>
<parent>{1}</parent><child>{0}</child><axis><xyz>{2}</xyz><limit><lower>-2</lower><upper>2</upper>
</limit></axis></joint>"""
ROBOT = f"""<sdf version='1.7'><model name='block'>{RAIL.format("x", "world", "1 0 0")}
{RAIL.format("y", "x", "0 1 0")}</model></sdf>"""
NEAR, STEP = 0.1, 0.2


class Slider(GoalSimulationTask):
    """An action moves the block by up to 0.2 m along each rail; goals lie within half a metre."""

    observation_space = gym.spaces.Box(-10.0, 10.0, (4,), np.float32)
    goal_space = gym.spaces.Box(-2.0, 2.0, (2,), np.float32)
    action_space = gym.spaces.Box(-1.0, 1.0, (2,), np.float32)

    def __init__(self, nworld, dense=False, steps=20):
        empty = formats.load_string(
            "<sdf version='1.7'><world name='w'><gravity>0 0 0</gravity></world></sdf>"
        )
        simulation = gazelle.Simulation(empty, nworld=nworld, time_step=0.02)
        robot = simulation.spawn(formats.load_string(ROBOT).models[0])
        self.rails = [robot.joints["along_x"], robot.joints["along_y"]]
        for rail in self.rails:
            rail.add_motor(1000.0)
        self.dense = dense
        super().__init__(simulation, control_period=0.1, max_episode_steps=steps)

    def start(self, worlds):
        for rail in self.rails:
            rail.drive(0.0, worlds)

    def draw_goals(self, worlds):
        return self.draw(-0.5, 0.5, worlds, 2)

    def achieved(self, worlds):
        return np.hstack([rail.positions(worlds) for rail in self.rails])

    def observe(self, worlds):
        velocities = [rail.velocities(worlds) for rail in self.rails]
        return np.hstack([self.achieved(worlds), *velocities])

    def act(self, actions):
        for rail, action in zip(self.rails, actions.T, strict=True):
            rail.drive(action * STEP / self.control_period)

    def reached(self, achieved, desired):
        return np.linalg.norm(achieved - desired, axis=-1) < NEAR

    def compute_reward(self, achieved_goal, desired_goal, info):
        if not self.dense:
            return super().compute_reward(achieved_goal, desired_goal, info)
        return -np.linalg.norm(achieved_goal - desired_goal, axis=-1)


class SliderEnv(TaskGoalEnv):
    """One of them."""

    def __init__(self, seed=None, render_mode=None, **options):
        super().__init__(Slider(1, **options), seed=seed, render_mode=render_mode)


class SliderVectorEnv(TaskGoalVectorEnv):
    """Many of them."""

    def __init__(self, num_envs=1, seed=None, autoreset_mode="SameStep", **options):
        super().__init__(Slider(num_envs, **options), seed=seed, autoreset_mode=autoreset_mode)


def register():
    """Register it with Gymnasium, and a twin without a vector version of its own."""
    if "test/Slider-v0" in gym.registry:
        return
    gym.register("test/Slider-v0", SliderEnv, vector_entry_point=SliderVectorEnv)
    gym.register("test/SingleSlider-v0", SliderEnv)


register()

"""A task of your own: a burger docks at the origin, heading along x.

    gazelle train examples/dock.py:my/Dock-v0
    gazelle eval runs/Dock-* --import examples/dock.py

It observes its goal as distance, bearing and heading: training adds the logarithm of the one and sines and
cosines of the others, so that a network tells 5 cm from 10 cm as well as 1 m from 2 m.
"""

from __future__ import annotations

import gymnasium as gym
import numpy as np

import gazelle
from gazelle import assets
from gazelle.array_types import Floats, Floats32, Worlds
from gazelle.envs import SimulationTask, StepOutcome, register_task
from gazelle.rotations import roll_pitch_yaw

FARTHEST = 2.5  # [m]
PAST = 0.06  # the charger's wall [m]
NEAR, STRAIGHT = 0.05, 0.15  # [m], [rad]
HEADING_WEIGHT = 0.3  # of a radian, in metres


class Dock(SimulationTask):
    """A burger drives to the origin and heads along x there."""

    def __init__(self, nworld: int, engine: str = "planar") -> None:
        """Make the task in a number of worlds."""
        world = gazelle.load(assets.world("empty"))
        simulation = gazelle.Simulation(world, engine, nworld=nworld, time_step=0.02)
        self.robot = simulation.spawn(assets.robot("turtlebot3_burger"))
        low, high = np.array([0.0, -np.pi, -np.pi]), np.array([4.0, np.pi, np.pi])
        self.observation_space = gym.spaces.Box(low.astype(np.float32), high.astype(np.float32))
        self.action_space = gym.spaces.Box(-1.0, 1.0, (2,), np.float32)
        super().__init__(simulation, control_period=0.2, max_episode_steps=150)
        self.memory["away"] = np.zeros(nworld)

    def start(self, worlds: Worlds) -> None:
        """Place the robot 0.5 to 1.5 m before the dock, up to 0.5 m beside it, with any heading."""
        x, y, yaw = self.draw(-1.0, 1.0, worlds, 3).T * [[0.5], [0.5], [np.pi]]
        place = np.column_stack((x - 1.0, y, np.zeros_like(x)))
        none = np.zeros_like(yaw)
        turned = np.column_stack((none, none, np.sin(yaw / 2.0), np.cos(yaw / 2.0)))
        self.robot.set_pose(place, turned, worlds=worlds)
        self.memory["away"][worlds] = np.hypot(x - 1.0, y) + HEADING_WEIGHT * np.abs(yaw)

    def observe(self, worlds: Worlds | None) -> Floats:
        """Return distance [m] and bearing [rad] of the dock, and the heading [rad], shape (n, 3)."""
        pose = self.robot.placement(worlds)
        x, y = pose.position[:, 0], pose.position[:, 1]
        yaw = roll_pitch_yaw(pose.quaternion)[:, 2]
        bearing = np.arctan2(-y, -x) - yaw
        around = np.arctan2(np.sin(bearing), np.cos(bearing))
        return np.column_stack((np.minimum(np.hypot(x, y), 4.0), around, yaw))

    def act(self, actions: Floats) -> None:
        """Drive at up to 0.2 m/s and 1.5 rad/s."""
        self.robot.inputs["cmd_vel"].send(0.2 * actions[:, 0], 1.5 * actions[:, 1])

    def outcome(self, observation: Floats32) -> StepOutcome:
        """Return the reward: for coming nearer and straighter, and 5 for the dock."""
        distance, _, yaw = observation.T.astype(np.float64)
        docked = (distance < NEAR) & (np.abs(yaw) < STRAIGHT)
        lost = (distance > FARTHEST) | (self.robot.placement().position[:, 0] > PAST)
        away = distance + HEADING_WEIGHT * np.abs(yaw)
        reward = self.memory["away"] - away + 5.0 * docked - lost - 0.01
        self.memory["away"] = away
        return StepOutcome(reward, docked | lost, {"is_success": docked, "is_collision": lost})


register_task("my/Dock-v0", Dock)

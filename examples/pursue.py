"""A task of your own: a burger catches another one, which turns away from it.

    gazelle train examples/pursue.py:my/Pursue-v0
    gazelle eval runs/Pursue-* --import examples/pursue.py

The other one is slower, but leads the way.
"""

from __future__ import annotations

import gymnasium as gym
import numpy as np

import gazelle
from gazelle import assets
from gazelle.array_types import Floats, Floats32, Worlds
from gazelle.envs import SimulationTask, StepOutcome, register_task

SPEED = 0.2, 0.12  # of the pursuer and of the other [m/s]
TURN = 1.5, 0.8  # likewise [rad/s]
CAUGHT = 0.3  # [m]
FARTHEST = 4.0  # [m]


class Pursue(SimulationTask):
    """A burger catches a slower one that flees."""

    def __init__(self, nworld: int, engine: str = "planar") -> None:
        """Make the task in a number of worlds."""
        world = gazelle.load(assets.world("empty"))
        simulation = gazelle.Simulation(world, engine, nworld=nworld, time_step=0.02)
        burger = assets.robot("turtlebot3_burger")
        self.robot = simulation.spawn(burger, name="pursuer")
        self.other = simulation.spawn(burger, name="other", pose=gazelle.Pose(x=1.0))
        high = np.array([FARTHEST, np.pi, np.pi], np.float32)
        self.observation_space = gym.spaces.Box(np.array([0.0, -np.pi, -np.pi], np.float32), high)
        self.action_space = gym.spaces.Box(-1.0, 1.0, (2,), np.float32)
        super().__init__(simulation, control_period=0.2, max_episode_steps=200)
        self.memory["distance"] = np.zeros(nworld)

    def start(self, worlds: Worlds) -> None:
        """Place the other burger 0.8 to 2 m away, both with any heading."""
        angles = self.draw(-np.pi, np.pi, worlds, 3)
        distance = self.draw(0.8, 2.0, worlds)[:, 0]
        x, y = distance * np.cos(angles[:, 0]), distance * np.sin(angles[:, 0])
        zero = np.zeros_like(x)
        middle, place = np.zeros((len(x), 3)), np.column_stack((x, y, zero))
        self.robot.set_pose(middle, yaw=angles[:, 1], worlds=worlds)
        self.other.set_pose(place, yaw=angles[:, 2], worlds=worlds)
        self.memory["distance"][worlds] = distance

    def observe(self, worlds: Worlds | None) -> Floats:
        """Return distance [m], bearing and relative heading [rad] of the other, shape (n, 3)."""
        own, other = self.robot.planar_pose(worlds), self.other.planar_pose(worlds)
        away = other[:, :2] - own[:, :2]
        distance = np.hypot(away[:, 0], away[:, 1])
        bearing = np.arctan2(away[:, 1], away[:, 0]) - own[:, 2]
        heading = other[:, 2] - own[:, 2]
        return np.column_stack((np.minimum(distance, FARTHEST), around(bearing), around(heading)))

    def act(self, actions: Floats) -> None:
        """Drive the pursuer, while the other turns to where it gets away."""
        commands = np.clip(actions, -1.0, 1.0)
        self.robot.inputs["cmd_vel"].send(SPEED[0] * commands[:, 0], TURN[0] * commands[:, 1])
        own, other = self.robot.planar_pose(), self.other.planar_pose()
        away = other[:, :2] - own[:, :2]
        off = around(np.arctan2(away[:, 1], away[:, 0]) - other[:, 2])
        speed = np.full(self.nworld, SPEED[1])
        self.other.inputs["cmd_vel"].send(speed, np.clip(off, -TURN[1], TURN[1]))

    def outcome(self, observation: Floats32) -> StepOutcome:
        """Return the reward: for coming nearer, and 5 for the catch."""
        distance = observation[:, 0].astype(np.float64)
        caught, lost = distance < CAUGHT, distance >= FARTHEST
        reward = self.memory["distance"] - distance + 5.0 * caught - lost - 0.01
        self.memory["distance"] = distance
        return StepOutcome(reward, caught | lost, {"is_success": caught, "is_collision": lost})


def around(angle: Floats) -> Floats:
    """Return angles within -pi to pi."""
    return np.arctan2(np.sin(angle), np.cos(angle))


register_task("my/Pursue-v0", Pursue)

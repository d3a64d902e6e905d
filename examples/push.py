"""A task of your own: a Kobuki pushes a box to the origin.

    gazelle train examples/push.py:my/Push-v0
    gazelle eval runs/Push-* --import examples/push.py

The box slides and turns as it is pushed, so this task needs MuJoCo's contacts.
"""

from __future__ import annotations

import gymnasium as gym
import numpy as np

import gazelle
from gazelle import assets
from gazelle.array_types import Floats, Floats32, Worlds
from gazelle.builders import assemble, slab
from gazelle.envs import SimulationTask, StepOutcome, register_task

SIDE = 0.3  # of the box [m]
THERE = 0.1  # of the box from the origin [m]
FARTHEST = 3.0  # [m]


class Push(SimulationTask):
    """A Kobuki pushes a box to the origin."""

    def __init__(self, nworld: int, engine: str = "mujoco") -> None:
        """Make the task in a number of worlds."""
        world = gazelle.load(assets.world("empty"))
        simulation = gazelle.Simulation(world, engine, nworld=nworld, time_step=0.02)
        simulation.physics.contacts = "fast"
        self.robot = simulation.spawn(assets.robot("kobuki"))
        cube = slab("cube", (SIDE, SIDE, SIDE), (0.0, 0.0, SIDE / 2.0), "beech")
        box = assemble("box", [cube], mass=0.3, friction=0.2)
        self.box = simulation.spawn(box, pose=gazelle.Pose(x=1.0))
        high = np.array([FARTHEST, np.pi, FARTHEST, np.pi], np.float32)
        low = np.array([0.0, -np.pi, 0.0, -np.pi], np.float32)
        self.observation_space = gym.spaces.Box(low, high)
        self.action_space = gym.spaces.Box(-1.0, 1.0, (2,), np.float32)
        super().__init__(simulation, control_period=0.1, max_episode_steps=150)
        self.memory["way"] = np.zeros(nworld)

    def start(self, worlds: Worlds) -> None:
        """Place the box 0.5 to 1 m from the origin, the robot behind it, with any heading."""
        angle, side, yaw = self.draw(-1.0, 1.0, worlds, 3).T * [[np.pi], [0.3], [np.pi]]
        far = self.draw(0.5, 1.0, worlds)[:, 0]
        ahead = np.column_stack((np.cos(angle), np.sin(angle), np.zeros_like(angle)))
        across = np.column_stack((-ahead[:, 1], ahead[:, 0], ahead[:, 2]))
        place = far[:, None] * ahead
        behind = place + 0.6 * ahead + side[:, None] * across
        self.box.set_pose(place, yaw=angle, worlds=worlds)
        self.robot.set_pose(behind, yaw=yaw, worlds=worlds)
        self.memory["way"][worlds] = far + np.hypot(0.6, side)

    def observe(self, worlds: Worlds | None) -> Floats:
        """Return distance [m] and bearing [rad] of the box, and of the origin, shape (n, 4)."""
        own, box_ = self.robot.planar_pose(worlds), self.box.planar_pose(worlds)
        columns = []
        for away in (box_[:, :2] - own[:, :2], -own[:, :2]):
            bearing = np.arctan2(away[:, 1], away[:, 0]) - own[:, 2]
            columns += [
                np.hypot(away[:, 0], away[:, 1]),
                np.arctan2(np.sin(bearing), np.cos(bearing)),
            ]
        return np.column_stack(columns)

    def act(self, actions: Floats) -> None:
        """Drive at up to 0.5 m/s and 1.5 rad/s."""
        self.robot.inputs["cmd_vel"].send(0.5 * actions[:, 0], 1.5 * actions[:, 1])

    def outcome(self, observation: Floats32) -> StepOutcome:
        """Return the reward: for a robot nearer to the box and a box nearer to the origin."""
        left = np.linalg.norm(self.box.planar_pose()[:, :2], axis=1)
        there, lost = left < THERE, (observation[:, ::2] > FARTHEST).any(axis=1)
        way = left + observation[:, 0].astype(np.float64)
        reward = self.memory["way"] - way + 5.0 * there - lost - 0.01
        self.memory["way"] = way
        return StepOutcome(reward, there | lost, {"is_success": there, "is_collision": lost})


register_task("my/Push-v0", Push)

"""A task of your own: an arm reaches for a place behind a post.

    gazelle train examples/reach_around.py:my/ReachAround-v0
    gazelle eval runs/ReachAround-* --import examples/reach_around.py

The post blocks the straight way: the arm has to draw back, or to go over it.
"""

from __future__ import annotations

import gymnasium as gym
import numpy as np

import gazelle
from gazelle import assets
from gazelle.array_types import Floats, Floats32, Worlds
from gazelle.builders import cylinder
from gazelle.description import World
from gazelle.envs import SimulationTask, StepOutcome, register_task
from gazelle.rotations import rotate

JOINTS = "shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint"
LOW, HIGH = np.array([-2.0, -2.5, 0.0]), np.array([2.0, 0.0, 2.7])  # of the joints [rad]
POST = gazelle.Pose(x=0.55, z=0.3)  # its middle [m]
REACHED = 0.05  # [m]


class ReachAround(SimulationTask):
    """A UR5 reaches for a place on the other side of a post."""

    def __init__(self, nworld: int, engine: str = "mujoco") -> None:
        """Make the task in a number of worlds."""
        world = World(name="cell", models=(cylinder("post", 0.05, 0.6, pose=POST),))
        simulation = gazelle.Simulation(world, engine, nworld=nworld, time_step=0.01)
        robot = simulation.spawn(assets.robot("ur5"))
        self.hand, tool = robot.frame("tool0")
        self.tool = np.array(tool.position)
        for joint in robot.joints.values():
            joint.add_motor(60.0)  # N m at most
        self.joints = [robot.joints[name] for name in JOINTS]
        high = np.concatenate((HIGH + 0.1, np.full(3, 2.0))).astype(np.float32)
        low = np.concatenate((LOW - 0.1, np.full(3, -2.0))).astype(np.float32)
        self.observation_space = gym.spaces.Box(low, high)
        self.action_space = gym.spaces.Box(-1.0, 1.0, (3,), np.float32)
        super().__init__(simulation, control_period=0.1, max_episode_steps=100)
        self.memory["goal"] = np.zeros((nworld, 3))
        self.memory["distance"] = np.zeros(nworld)

    def start(self, worlds: Worlds) -> None:
        """Turn the arm to one side of the post, and choose a goal on the other."""
        drawn = self.draw(-1.0, 1.0, worlds, 7)
        side = np.sign(drawn[:, 0])
        posture = np.array([0.0, -1.2, 1.5]) + drawn[:, 1:4] * [0.2, 0.2, 0.2]
        posture[:, 0] -= 0.8 * side
        for joint, angle in zip(self.joints, posture.T, strict=True):
            joint.set_position(angle, worlds)
            joint.drive(0.0, worlds)
        angle = side * (0.8 + 0.2 * drawn[:, 4])
        radius, height = 0.55 + 0.1 * drawn[:, 5], 0.3 + 0.1 * drawn[:, 6]
        goal = np.column_stack((radius * np.cos(angle), radius * np.sin(angle), height))
        self.memory["goal"][worlds] = goal
        self.memory["distance"][worlds] = np.linalg.norm(self.way(worlds), axis=1)

    def way(self, worlds: Worlds | None) -> Floats:
        """Return the way from tool to goal [m], shape (n, 3)."""
        hand = self.hand.placement(worlds)
        offset = np.broadcast_to(self.tool, hand.position.shape)
        goal = self.memory["goal"] if worlds is None else self.memory["goal"][worlds]
        return goal - hand.position - rotate(hand.quaternion, offset)

    def observe(self, worlds: Worlds | None) -> Floats:
        """Return angles of the joints [rad] and the way from tool to goal [m], shape (n, 6)."""
        return np.hstack([joint.positions(worlds) for joint in self.joints] + [self.way(worlds)])

    def act(self, actions: Floats) -> None:
        """Turn the joints at up to 1 rad/s, within their limits."""
        speeds = np.clip(actions, -1.0, 1.0)
        for joint, speed, low, high in zip(self.joints, speeds.T, LOW, HIGH, strict=True):
            angle = joint.positions()[:, 0]
            blocked = ((angle <= low) & (speed < 0.0)) | ((angle >= high) & (speed > 0.0))
            joint.drive(np.where(blocked, 0.0, speed))

    def outcome(self, observation: Floats32) -> StepOutcome:
        """Return the reward: for coming nearer, and 5 for the goal."""
        distance = np.linalg.norm(observation[:, 3:].astype(np.float64), axis=1)
        there = distance < REACHED
        reward = self.memory["distance"] - distance + 5.0 * there - 0.01
        self.memory["distance"] = distance
        return StepOutcome(reward, there, {"is_success": there})


register_task("my/ReachAround-v0", ReachAround)

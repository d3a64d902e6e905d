"""A task of your own: a waffle follows a line on the floor by what its camera sees.

    gazelle train examples/follow_line.py:my/FollowLine-v0
    gazelle eval runs/FollowLine-* --import examples/follow_line.py

The robot drives on at one speed; the policy only steers.
"""

from __future__ import annotations

import gymnasium as gym
import numpy as np

import gazelle
from gazelle import assets, formats
from gazelle.array_types import Bytes, Floats, Worlds
from gazelle.builders import assemble, ground, slab, sun
from gazelle.description import World
from gazelle.envs import SimulationTask, StepOutcome, register_task
from gazelle.envs.cameras import CameraObservation, fit_camera

PIECES = 120
WIDTH = 0.05  # of the line [m]
LOST = 0.25  # of the robot's middle from the line's [m]
SPEED = 0.2  # [m/s]


def line() -> Floats:
    """Return points along the middle of the line, a closed curve [m], shape (PIECES, 2)."""
    angle = np.linspace(0.0, 2.0 * np.pi, PIECES, endpoint=False)
    radius = 2.0 + 0.5 * np.sin(3.0 * angle)
    return np.column_stack((radius * np.cos(angle), radius * np.sin(angle)))


def painted() -> World:
    """Return a floor with the line on it."""
    points = line()
    ends = np.roll(points, -1, axis=0)
    parts = [
        slab(
            f"piece_{number}",
            (float(np.hypot(*(end - begin))) + 0.02, WIDTH, 0.002),
            (*(begin + end) / 2.0, 0.001),
            "white",
            yaw=float(np.arctan2(*(end - begin)[::-1])),
            collides=False,
        )
        for number, (begin, end) in enumerate(zip(points, ends, strict=True))
    ]
    floor = ground(color="asphalt")
    return World(name="track", models=(floor, assemble("line", parts)), lights=(sun(),))


class FollowLine(SimulationTask):
    """A waffle with a camera follows a closed line for 30 s."""

    def __init__(self, nworld: int, engine: str = "planar") -> None:
        """Make the task in a number of worlds."""
        simulation = gazelle.Simulation(painted(), engine, nworld=nworld, time_step=0.02)
        model = formats.load_model(assets.robot("turtlebot3_waffle_pi"))
        self.robot = simulation.spawn(fit_camera(model, 36, 36))
        self.camera = CameraObservation(self.robot)
        self.observation_space = self.camera.space
        self.action_space = gym.spaces.Box(-1.0, 1.0, (1,), np.float32)
        self.line = line()
        super().__init__(simulation, control_period=0.2, max_episode_steps=150)

    def start(self, worlds: Worlds) -> None:
        """Place the robot somewhere on the line, up to 5 cm and 0.3 rad off, either way round."""
        which, way, off, turned = self.draw(0.0, 1.0, worlds, 4).T
        first = (which * PIECES).astype(np.intp)
        along = self.line[(first + 1) % PIECES] - self.line[first]
        yaw = np.arctan2(along[:, 1], along[:, 0]) + np.pi * (way < 0.5) + 0.6 * (turned - 0.5)
        beside = 0.1 * (off - 0.5)[:, None] * np.column_stack((-np.sin(yaw), np.cos(yaw)))
        place = np.column_stack((self.line[first] + beside, np.zeros(len(yaw))))
        self.robot.set_pose(place, yaw=yaw, worlds=worlds)

    def observe(self, worlds: Worlds | None) -> Bytes:
        """Return the camera's pictures."""
        return self.camera.read(worlds)

    def act(self, actions: Floats) -> None:
        """Drive on, and turn at up to 1 rad/s."""
        speed = np.full(self.nworld, SPEED)
        self.robot.inputs["cmd_vel"].send(speed, np.clip(actions[:, 0], -1.0, 1.0))

    def outcome(self, observation: Bytes) -> StepOutcome:
        """Return the reward: more the nearer the line's middle is."""
        del observation
        place = self.robot.planar_pose()[:, None, :2]
        off = np.linalg.norm(place - self.line, axis=2).min(axis=1)
        lost = off > LOST
        info = {"is_success": self.lasting & ~lost, "is_collision": lost}
        return StepOutcome(1.0 - off / LOST, lost, info)


register_task("my/FollowLine-v0", FollowLine)

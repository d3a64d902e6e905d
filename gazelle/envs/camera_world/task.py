"""A TurtleBot3 with a camera drives to the red post, in many worlds at once."""

from __future__ import annotations

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray

from gazelle import assets, formats
from gazelle.array_types import Bools, Bytes, Floats, Worlds
from gazelle.envs.cameras import CameraObservation, fit_camera
from gazelle.envs.options import TaskSettings
from gazelle.envs.simulation_task import SimulationTask, StepOutcome, simulation_of
from gazelle.sensors import View, look_at

SIDE = 84  # pixels of the picture
PERIOD = 0.25  # [s]
COMMANDS = ((0.26, 0.0), (0.0, 1.2), (0.0, -1.2))  # of the actions [m/s, rad/s]
REACHED = 0.5  # from the middle of the robot to that of the red post [m]
TOO_CLOSE = 0.36  # likewise to another post [m]
WALL = 1.85 - 0.24  # from the middle of the room, along x or y [m]
ROOM = 1.4  # posts and starts are as far from the middle at most, along x or y [m]
APART = (1.2, 0.8)  # the red post from the start, all others from each other [m]
_TIME_STEPS = {"planar": 0.01}
_TRIES = 16
_POSTS = ("red_post", "green_post", "blue_post")
_ROBOT = "turtlebot3_waffle_pi"


class CameraWorldTask(SimulationTask):
    """Drive to the red post by what the camera sees, in ``nworld`` worlds; see the environment.

    Args:
        nworld: Number of worlds.
        settings: Options of the user.

    Raises:
        TaskError: The robot has no camera.
    """

    observation_space: gym.spaces.Box
    scenario_names = (
        "start_x", "start_y", "start_yaw",
        "red_x", "red_y", "green_x", "green_y", "blue_x", "blue_y",
    )  # fmt: skip
    view = View(look_at((-2.6, -2.6, 3.4), (0.0, 0.0, 0.1)), width=480, height=400, samples=1)

    def __init__(self, nworld: int, settings: TaskSettings) -> None:
        step = _TIME_STEPS.get(settings.engine)
        simulation = simulation_of(assets.world("turtlebot3_camera"), nworld, settings, step)
        model = fit_camera(formats.load_model(assets.robot(_ROBOT)), SIDE, SIDE)
        self._robot = simulation.spawn(model, name=_ROBOT)
        self._posts = [simulation.robots[name] for name in _POSTS]
        self._camera = CameraObservation(self._robot)
        self.observation_space = self._camera.space
        self.action_space = gym.spaces.Discrete(len(COMMANDS))
        super().__init__(
            simulation, control_period=PERIOD, max_episode_steps=settings.max_episode_steps
        )
        self.memory["scene"] = np.zeros((nworld, len(self.scenario_names)))
        self.memory["distance"] = np.zeros(nworld)
        self.memory["bearing"] = np.zeros(nworld)

    def start(self, worlds: Worlds) -> None:
        """Place robot and posts anywhere in the room, not too close to each other."""
        drawn = self.draw(-1.0, 1.0, worlds, 1 + 2 * _TRIES * 4)
        yaw = np.pi * drawn[:, 0]
        spots = ROOM * drawn[:, 1:].reshape(len(worlds), 4, _TRIES, 2)
        placed = [spots[:, 0, 0]]
        for number in range(1, 4):
            least = [APART[0] if number == 1 and not other else APART[1] for other in range(number)]
            placed.append(_first_apart(spots[:, number], placed, least))
        for post, spot in zip(self._posts, placed[1:], strict=True):
            post.set_pose(_standing(spot), yaw=np.zeros(len(worlds)), worlds=worlds)
        self._robot.set_pose(_standing(placed[0]), yaw=yaw, worlds=worlds)
        self.memory["scene"][worlds] = np.column_stack([placed[0], yaw, *placed[1:]])
        for name, values in zip(("distance", "bearing"), self._goal(), strict=True):
            self.memory[name][worlds] = values[worlds]

    def scenario(self, worlds: Worlds) -> Floats:
        """Return the initial poses of robot and posts [m, rad], shape (n, 9)."""
        scene: Floats = self.memory["scene"][worlds]
        return scene

    def observe(self, worlds: Worlds | None) -> Bytes:
        """Return the camera's images."""
        return self._camera.read(worlds)

    def act(self, actions: NDArray[np.int64]) -> None:
        """Drive ahead, or turn."""
        speeds = np.asarray(COMMANDS)[actions]
        self._robot.inputs["cmd_vel"].send(linear=speeds[:, 0], angular=speeds[:, 1])

    def outcome(self, observation: NDArray[np.generic]) -> StepOutcome:
        """Reward approaching the red post and turning towards it."""
        del observation
        distance, bearing = self._goal()
        before = self.memory["distance"] - distance, self.memory["bearing"] - bearing
        self.memory["distance"], self.memory["bearing"] = distance, bearing
        success, collision = distance < REACHED, self._collision()
        collision &= ~success
        reward = 2.0 * before[0] + 0.3 * before[1] - 0.02 + 5.0 * success - 3.0 * collision
        info = {"is_success": success, "is_collision": collision, "distance": distance}
        return StepOutcome(reward, success | collision, info)

    def _goal(self) -> tuple[Floats, Floats]:
        """Return distance [m] and angle off the heading [rad] of the red post, shapes (nworld,)."""
        pose = self._robot.planar_pose()
        away = self.memory["scene"][:, 3:5] - pose[:, :2]
        bearing = np.arctan2(away[:, 1], away[:, 0]) - pose[:, 2]
        return np.hypot(away[:, 0], away[:, 1]), np.abs((bearing + np.pi) % (2.0 * np.pi) - np.pi)

    def _collision(self) -> Bools:
        """Return whether the robot touches a wall or another post, shape (nworld,)."""
        place = self._robot.planar_pose()[:, :2]
        others = self.memory["scene"][:, 5:9].reshape(-1, 2, 2) - place[:, None]
        hit: Bools = np.abs(place).max(axis=1) > WALL
        hit |= np.hypot(others[..., 0], others[..., 1]).min(axis=1) < TOO_CLOSE
        return hit


def _first_apart(candidates: Floats, placed: list[Floats], least: list[float]) -> Floats:
    """Return the first of some places (n, tries, 2) that keeps its distances, or else the best.

    (n, 2).
    """
    room = np.min(
        [
            np.hypot(*np.moveaxis(candidates - other[:, None], -1, 0)) - far
            for other, far in zip(placed, least, strict=True)
        ],
        axis=0,
    )
    chosen = np.where((room >= 0.0).any(axis=1), (room >= 0.0).argmax(axis=1), room.argmax(axis=1))
    spot: Floats = candidates[np.arange(len(candidates)), chosen]
    return spot


def _standing(spots: Floats) -> Floats:
    """Return places on the floor, shape (n, 3)."""
    return np.column_stack([spots, np.zeros(len(spots))])

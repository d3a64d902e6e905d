"""openai_ros' MovingCubeOneDiskWalk in many worlds at once."""

from __future__ import annotations

from dataclasses import dataclass

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray

import gazelle
from gazelle import assets
from gazelle.array_types import Bools, Floats, Floats32, Worlds
from gazelle.description import Pose
from gazelle.envs.batched_task import Info
from gazelle.envs.decimals import rounded
from gazelle.envs.moving_cube.rules import WalkRules, has_failed, reward_of, wheel_speeds
from gazelle.envs.options import DynamicsSettings
from gazelle.envs.simulation_task import SimulationTask, StepOutcome, simulation_of
from gazelle.errors import TaskError
from gazelle.rotations import roll_pitch_yaw
from gazelle.sensors import View, look_at
from gazelle_ros.base.real_numbers import finite

CONTROL_PERIOD = 0.04  # [s]; openai_ros waits until the wheel has its speed, some hundredths
FIRST_SPEED = 10.0  # of the wheel when an episode begins [rad/s]
START_YAW = 0.05  # largest at the start [rad]
SUCCESS_DISTANCE = 1.0  # farther along y is a success [m]
HALF_SIDE = 0.1  # of the cube [m]
_TIME_STEP = 0.002
_MOTOR = 200.0  # [N m], as the robot's file says
_MOST = (50.0, 10.0, 2.0 * np.pi, 0.3, 100.0, 100.0)  # bounds of what is seen, as published
_ACTIONS = (3, 5)
LONGEST_HOLD = 25  # up to which steps with one command are counted


@dataclass(frozen=True, slots=True, kw_only=True)
class MovingCubeSettings(DynamicsSettings):
    """Options of the task, checked.

    Attributes:
        n_actions: 3 as published, or 5 with those that openai_ros decodes beyond them.
        failure_reward: Reward of the step in which it tilts too far.
        shows_hold: Whether the number of steps with the present command is observed, too.
    """

    n_actions: int = 3
    failure_reward: float = 10.0
    shows_hold: bool = False

    def __post_init__(self) -> None:
        # A zero-argument super() does not work in a dataclass with slots.
        DynamicsSettings.__post_init__(self)
        if self.n_actions not in _ACTIONS:
            raise TaskError(f"n_actions must be 3 or 5, not {self.n_actions!r}")
        if finite(self.failure_reward) is None:
            raise TaskError(f"failure_reward must be finite, not {self.failure_reward!r}")
        if not isinstance(self.shows_hold, bool):
            raise TaskError(f"shows_hold must be True or False, not {self.shows_hold!r}")


class MovingCubeTask(SimulationTask):
    """A cube moves along y, in ``nworld`` worlds; see `MovingCubeEnv`.

    Args:
        nworld: Number of worlds.
        settings: Options of the user.
    """

    scenario_names = ("start_yaw",)
    view = View(look_at((2.6, 0.6, 1.3), (0.0, 0.6, 0.0)), width=480, height=320, samples=1)

    def __init__(self, nworld: int, settings: MovingCubeSettings) -> None:
        simulation = simulation_of(
            gazelle.load(assets.world("empty")), nworld, settings, _TIME_STEP
        )
        self._cube = simulation.spawn(assets.robot("moving_cube"), pose=Pose(z=HALF_SIDE))
        self._wheel = self._cube.joints["inertia_wheel_roll_joint"]
        self._wheel.add_motor(_MOTOR)
        least, most = np.negative(_MOST), np.array(_MOST)
        if settings.shows_hold:
            least, most = np.append(least, 0.0), np.append(most, LONGEST_HOLD)
        self.observation_space = gym.spaces.Box(
            least.astype(np.float32), most.astype(np.float32), dtype=np.float32
        )
        self.action_space = gym.spaces.Discrete(settings.n_actions)
        self.rules = WalkRules(failure_reward=settings.failure_reward)
        self._shows_hold = settings.shows_hold
        super().__init__(
            simulation,
            control_period=CONTROL_PERIOD,
            max_episode_steps=settings.max_episode_steps,
        )
        self.memory["speed"] = np.full(nworld, FIRST_SPEED)
        self.memory["held"] = np.zeros(nworld)
        self.memory["place"] = np.zeros(nworld)
        self.memory["start"] = np.zeros((nworld, 1))

    def start(self, worlds: Worlds) -> None:
        """Place the cube at rest on the floor, its wheel spinning slowly."""
        self.memory["speed"][worlds] = FIRST_SPEED
        self.memory["held"][worlds] = 0.0
        self.memory["place"][worlds] = 0.0
        yaw = self.memory["start"][worlds] = self.draw(-START_YAW, START_YAW, worlds)
        self._cube.set_pose((0.0, 0.0, HALF_SIDE), yaw=yaw[:, 0], worlds=worlds)
        self._wheel.set_velocity(FIRST_SPEED, worlds)
        self._wheel.drive(FIRST_SPEED, worlds)

    def scenario(self, worlds: Worlds) -> Floats:
        """Return the yaw at the start [rad], shape (n, 1)."""
        start: Floats = self.memory["start"][worlds]
        return start

    def observe(self, worlds: Worlds | None) -> Floats:
        """Return the wheel's speed, y, roll, pitch, speed along y and yaw, rounded as published."""
        placement, motion = self._cube.placement(worlds), self._cube.motion(worlds)
        roll, pitch, yaw = roll_pitch_yaw(placement.quaternion).T
        y = placement.position[:, 1]
        tenths = rounded(np.column_stack((y, roll, pitch, motion.linear[:, 1], yaw)), 1)
        seen = np.column_stack((rounded(self._wheel.velocities(worlds)[:, 0], 0), tenths))
        if not self._shows_hold:
            return seen
        held = self.memory["held"] if worlds is None else self.memory["held"][worlds]
        return np.column_stack((seen, held))

    def act(self, actions: NDArray[np.int64]) -> None:
        """Set the wheel's speed, or change it by a step."""
        speed, held = self.memory["speed"], self.memory["held"]
        now = wheel_speeds(self.rules, speed, actions)
        held[:] = np.where(now == speed, np.minimum(held + 1.0, LONGEST_HOLD), 0.0)
        speed[:] = now
        self._wheel.drive(speed)

    def outcome(self, observation: Floats32) -> StepOutcome:
        """Return the reward: distance and speed along y, less for yaw.

        Another one for too much tilt.
        """
        seen = rounded(observation[:, : len(_MOST)], 1)
        failed, y = has_failed(self.rules, seen), seen[:, 1]
        reward = reward_of(self.rules, seen, self.memory["place"], failed)
        self.memory["place"][:] = y
        success = self.lasting & ~failed & (y >= SUCCESS_DISTANCE)
        return StepOutcome(reward, failed, self._info(success, y))

    def _look(self, worlds: Worlds) -> tuple[Floats32, Info]:
        seen = super()._look(worlds)[0]
        return seen, self._info(np.zeros(len(worlds), np.bool_), rounded(seen[:, 1], 1))

    @staticmethod
    def _info(success: Bools, y: Floats) -> Info:
        left = np.maximum(SUCCESS_DISTANCE - y, 0.0)
        return {"is_success": success, "is_collision": np.zeros_like(success), "distance": left}

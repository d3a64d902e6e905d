"""Gymnasium-Robotics' Fetch tasks in many worlds at once."""

from __future__ import annotations

import warnings
from typing import Any

import gymnasium as gym
import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle import assets, rotations
from gazelle.array_types import Bools, Floats, Worlds
from gazelle.envs.batched_task import TaskOutcome
from gazelle.envs.fetch.arm import ReachingArm
from gazelle.envs.fetch.figures import (
    CLEAR,
    CONTROL_PERIOD,
    IN_THE_AIR,
    LARGEST_STEP,
    NEAR,
    SHARE,
    FetchFigures,
    figures_of,
)
from gazelle.envs.fetch.gripper import FetchGripper, FlyingGripper
from gazelle.envs.fetch.options import FetchSettings
from gazelle.envs.fetch.welded import WELDED_STEP, WeldedArm
from gazelle.envs.goal_task import GoalSimulationTask
from gazelle.envs.simulation_task import simulation_of
from gazelle.errors import EngineWarning
from gazelle.sensors import View, look_at
from gazelle.simulation import Simulation

FINGER_SPEED = 0.5
"""Of a finger commanded to open or close as fast as it can [m/s]."""

_OBSERVED = {False: 10, True: 25}


class FetchTask(GoalSimulationTask):
    """Fetch's gripper, or what it moves, gets to places, in ``nworld`` worlds; see `FetchEnv`.

    Args:
        task: A name of `FIGURES`.
        nworld: Number of worlds.
        settings: Options of the user.
    """

    scenario_names = ("goal_x", "goal_y", "goal_z", "object_x", "object_y")
    view = View(look_at((2.5, -0.6, 1.2), (1.3, 0.75, 0.5)), width=480, height=480, samples=1)

    def __init__(self, task: str, nworld: int, settings: FetchSettings) -> None:
        self.figures = figures = figures_of(task)
        welded = settings.control == "original"
        simulation = simulation_of(
            assets.world(figures.world), nworld, settings, WELDED_STEP if welded else None
        )
        self._gripper = _gripper_of(settings.control, simulation, figures)
        # A weld gets the whole way, of which it gets as far in a step as there.
        self._reach = LARGEST_STEP if welded else SHARE * LARGEST_STEP
        self._object = simulation.robots["object"] if figures.has_object else None
        self._dense = settings.reward_type == "dense"
        observed = (_OBSERVED[figures.has_object],)
        self.observation_space = gym.spaces.Box(-np.inf, np.inf, observed, np.float32)
        self.goal_space = gym.spaces.Box(-np.inf, np.inf, (3,), np.float32)
        self.action_space = gym.spaces.Box(-1.0, 1.0, (4,), np.float32)
        super().__init__(
            simulation,
            control_period=CONTROL_PERIOD,
            max_episode_steps=settings.max_episode_steps,
        )
        self.memory["object"] = np.zeros((nworld, 2))

    def start(self, worlds: Worlds) -> None:
        """Set the arm to its start, and the object beside the gripper."""
        self._gripper.begin(worlds)
        if self._object is None:
            return
        places = self._beside(worlds)
        self.memory["object"][worlds] = places
        height = np.full((len(worlds), 1), self.figures.object_height)
        upright = np.tile([0.0, 0.0, 0.0, 1.0], (len(worlds), 1))
        self._object.set_pose(np.hstack((places, height)), upright, worlds=worlds)

    def draw_goals(self, worlds: Worlds) -> Floats:
        """Sample goals around the gripper's start; for objects on the table, or above it."""
        figures = self.figures
        drawn = self.draw(-1.0, 1.0, worlds, 5)
        goals = np.array(figures.gripper) + figures.goal_range * drawn[:, :3]
        goals[:, 0] += figures.goal_ahead
        if figures.has_object:
            goals[:, 2] = figures.object_height
        if figures.in_the_air:
            raised = drawn[:, 3] < 0.0
            goals[raised, 2] += 0.5 * IN_THE_AIR * (drawn[raised, 4] + 1.0)
        return goals

    @property
    def goal_places(self) -> Floats:
        """Goals of the gripper or the object [m], shape (nworld, 3)."""
        return self.goals

    def scenario(self, worlds: Worlds) -> Floats:
        """Return goal and place of the object at the start [m], shape (n, 5)."""
        return np.hstack((self.goals[worlds], self.memory["object"][worlds]))

    def achieved(self, worlds: Worlds | None) -> Floats:
        """Return the position of the gripper or the object [m], shape (n, 3)."""
        if self._object is None:
            return self._gripper.position(worlds)
        return self._object.placement(worlds).position

    def observe(self, worlds: Worlds | None) -> Floats:
        """Return the observation that `FetchEnv` lists, shape (n, 10 or 25)."""
        grip, velocity = (
            self._gripper.position(worlds),
            self._gripper.velocity(worlds) * CONTROL_PERIOD,
        )
        opening, closing = self._gripper.opening(worlds)
        closing = closing * CONTROL_PERIOD
        if self._object is None:
            return np.hstack((grip, opening, velocity, closing))
        place, motion = self._object.placement(worlds), self._object.motion(worlds)
        return np.hstack(
            (
                grip,
                place.position,
                place.position - grip,
                opening,
                _euler(place.quaternion),
                motion.linear * CONTROL_PERIOD - velocity,
                motion.angular * CONTROL_PERIOD,
                velocity,
                closing,
            )
        )

    def act(self, actions: NDArray[Any]) -> None:
        """Move the gripper, and open or close its fingers."""
        command = np.clip(actions, -1.0, 1.0)
        self._gripper.move(self._reach * command[:, :3], CONTROL_PERIOD)
        self._gripper.move_fingers(FINGER_SPEED * command[:, 3], CONTROL_PERIOD)

    def reached(self, achieved: NDArray[Any], desired: NDArray[Any]) -> Bools:
        """Return whether they are less than 5 cm apart."""
        apart: Bools = _distance(achieved, desired) < NEAR
        return apart

    def compute_reward(
        self, achieved_goal: NDArray[Any], desired_goal: NDArray[Any], info: object
    ) -> NDArray[Any]:
        """Return minus the distance [m], or -1 where that is over 5 cm, else 0."""
        del info
        distance = _distance(achieved_goal, desired_goal)
        return -distance if self._dense else np.where(distance > NEAR, -1.0, 0.0)

    def _act(self, actions: ArrayLike) -> TaskOutcome:
        # A cube that is hit at its edge spins for a moment; how it precesses does not matter here.
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", "something turns more", EngineWarning)
            return super()._act(actions)

    def _beside(self, worlds: Worlds) -> Floats:
        """Sample places (x, y) around the gripper, again where they are too near; shape (n, 2)."""
        reach, centre = self.figures.object_range, np.array(self.figures.gripper[:2])
        away = self.draw(-reach, reach, worlds, 2)
        near = np.flatnonzero(np.linalg.norm(away, axis=1) < CLEAR)
        while len(near):
            away[near] = self.draw(-reach, reach, worlds[near], 2)
            near = near[np.linalg.norm(away[near], axis=1) < CLEAR]
        return centre + away


def _gripper_of(control: str, simulation: Simulation, figures: FetchFigures) -> FetchGripper:
    """Create the gripper of an option."""
    moving = figures.fingers_move
    if control == "gripper":
        return FlyingGripper(simulation, figures.gripper, fingers_move=moving)
    arm = WeldedArm if control == "original" else ReachingArm
    return arm(simulation, figures.gripper, figures.base, fingers_move=moving)


def _distance(first: NDArray[Any], second: NDArray[Any]) -> NDArray[Any]:
    distance: NDArray[Any] = np.linalg.norm(np.subtract(first, second), axis=-1)
    return distance


def _euler(quaternion: Floats) -> Floats:
    """Return angles x, y, z of R = Rx(x) Ry(y) Rz(z) [rad], shape (n, 3).

    It is ``mat2euler`` there.
    """
    turned = rotations.turns(quaternion).transpose(0, 2, 1)  # they are for rows
    cosine = np.hypot(turned[:, 1, 2], turned[:, 2, 2])
    regular = cosine > 4.0 * np.finfo(np.float64).eps
    return np.stack(
        (
            np.where(regular, -np.arctan2(turned[:, 1, 2], turned[:, 2, 2]), 0.0),
            np.arctan2(turned[:, 0, 2], cosine),
            np.where(
                regular,
                -np.arctan2(turned[:, 0, 1], turned[:, 0, 0]),
                np.arctan2(turned[:, 1, 0], turned[:, 1, 1]),
            ),
        ),
        axis=1,
    )

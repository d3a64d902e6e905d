"""openai_ros' WamvNavTwoSetsBuoys in many worlds at once."""

from __future__ import annotations

from dataclasses import dataclass

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray

import gazelle
from gazelle import assets
from gazelle.array_types import Floats, Floats32, Worlds
from gazelle.description import Pose
from gazelle.envs.batched_task import Info
from gazelle.envs.decimals import rounded
from gazelle.envs.destination_task import DestinationTask
from gazelle.envs.goal_rules import distance_to
from gazelle.envs.options import StartSettings
from gazelle.envs.simulation_task import StepOutcome, simulation_of
from gazelle.envs.starts import chessboard
from gazelle.envs.wamv.rules import ChannelRules, outside, reached, reward_of
from gazelle.rotations import roll_pitch_yaw
from gazelle.sensors import View, look_at
from gazelle.simulation.values import DriveCommand

CONTROL_PERIOD = 1.0  # [s]: openai_ros sleeps so long after each command
DRAUGHT = -0.08  # height of the origin where it floats [m]
_TIME_STEP = 0.01
_LEFT, _RIGHT = np.array((1.0, -1.0, -1.0, 1.0)), np.array((1.0, -1.0, 1.0, -1.0))
# Where other starts are: columns and rows of squares of a metre, from there, and the largest yaw [rad].
_COLUMNS, _ROWS, _FIRST, _YAW = 24, 7, (0.0, -3.0), 0.6
_TILT, _TURN = 1.6, 3.15
_FASTEST, _FASTEST_TURN = 4.0, 3.0


@dataclass(frozen=True, slots=True, kw_only=True)
class WamvSettings(StartSettings):
    """Options of the task, checked; starts are anywhere in the channel."""


class WamvTask(DestinationTask):
    """A catamaran goes to a place between buoys, in ``nworld`` worlds; see `WamvBuoysEnv`.

    Args:
        nworld: Number of worlds.
        settings: Options of the user.
    """

    scenario_names = ("start_x", "start_y", "start_yaw")
    view = View(look_at((-10.0, -12.0, 9.0), (12.0, 0.0, 0.0)), width=480, height=320, samples=1)

    def __init__(self, nworld: int, settings: WamvSettings) -> None:
        self.rules = ChannelRules()
        simulation = simulation_of(
            gazelle.load(assets.world("wamv_channel")), nworld, settings, _TIME_STEP
        )
        self.robot = simulation.spawn(assets.robot("wamv"), pose=Pose(z=DRAUGHT))
        self._squares = None
        if settings.starts != "published":
            self._squares = squares(held_out=settings.starts == "held-out")
        most = (33.0, 8.0, _TILT, _TILT, _TURN, _FASTEST, _FASTEST, _FASTEST_TURN, 40.0)
        least = (-4.0, *(-each for each in most[1:8]), 0.0)
        self.observation_space = gym.spaces.Box(
            np.array(least, np.float32), np.array(most, np.float32), dtype=np.float32
        )
        self.action_space = gym.spaces.Discrete(len(_LEFT))
        super().__init__(
            simulation,
            control_period=CONTROL_PERIOD,
            max_episode_steps=settings.max_episode_steps,
        )
        self.memory["start"] = np.zeros((nworld, 3))
        self.memory["distance"] = np.zeros(nworld)

    def start(self, worlds: Worlds) -> None:
        """Place the boat at rest: at the origin, or somewhere in the channel."""
        start = self.memory["start"]
        if self._squares is not None:
            share = self.draw(0.0, 1.0, worlds, 4)
            square = self._squares[(share[:, 0] * len(self._squares)).astype(np.intp)]
            start[worlds, :2] = square + 0.8 * (share[:, 1:3] - 0.5)
            start[worlds, 2] = _YAW * (2.0 * share[:, 3] - 1.0)
        place = np.column_stack((start[worlds, :2], np.full(len(worlds), DRAUGHT)))
        self.robot.set_pose(place, yaw=start[worlds, 2], worlds=worlds)
        self.memory["distance"][worlds] = distance_to(place[:, :2], self.rules.goal)

    def scenario(self, worlds: Worlds) -> Floats:
        """Return the initial pose: x, y [m] and yaw [rad], shape (n, 3)."""
        start: Floats = self.memory["start"][worlds]
        return start

    def observe(self, worlds: Worlds | None) -> Floats:
        """Return place, angles, velocities and distance, rounded as published."""
        place, motion = self.robot.placement(worlds), self.robot.motion(worlds)
        left = distance_to(place.position, self.rules.goal)
        seen = (
            place.position[:, :2],
            roll_pitch_yaw(place.quaternion),
            motion.linear[:, :2],
            motion.angular[:, 2:],
            left[:, None],
        )
        return rounded(np.hstack(seen), 1)

    def act(self, actions: NDArray[np.int64]) -> None:
        """Command both propellers."""
        self.robot.inputs["cmd_drive"].send(DriveCommand(_LEFT[actions], _RIGHT[actions]))

    def outcome(self, observation: Floats32) -> StepOutcome:
        """Return reward and termination of openai_ros' task, see `rules`."""
        place = rounded(observation[:, :2], 1)
        success = reached(self.rules, place)
        over = success | outside(self.rules, place)
        distance = distance_to(place, self.rules.goal)
        closer = self.comes_closer(distance)
        info = {"is_success": success, "is_collision": np.zeros(self.nworld, np.bool_)}
        reward = reward_of(self.rules, over=over, success=success, closer=closer)
        return StepOutcome(reward, over, {**info, **self.place_info(None)})

    def place_info(self, worlds: Worlds | None) -> Info:
        """Return the places of robot and goal; see `DestinationTask`."""
        place = self.robot.placement(worlds).position[:, :2]
        goal = np.tile(self.rules.goal[:2], (len(place), 1))
        return {"position": place, "goal": goal, "distance": np.hypot(*(place - goal).T)}


def squares(*, held_out: bool) -> Floats:
    """Return middles of 1 m start squares (x, y) [m], shape (n, 2): one colour of a chessboard.

    Args:
        held_out: Those of the other colour, which trainings do not see.
    """
    return np.asarray(chessboard(_COLUMNS, _ROWS, held_out=held_out) + np.array(_FIRST))

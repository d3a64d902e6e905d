"""openai_ros' HopperStayUp in many worlds at once."""

from __future__ import annotations

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray

import gazelle
from gazelle import assets
from gazelle.array_types import Floats, Floats32, Worlds
from gazelle.description import Pose
from gazelle.envs.decimals import rounded
from gazelle.envs.goal_rules import distance_to
from gazelle.envs.hopper.rules import StandRules, has_height, is_upright, reward_of
from gazelle.envs.options import DynamicsSettings
from gazelle.envs.simulation_task import SimulationTask, StepOutcome, simulation_of
from gazelle.rotations import roll_pitch_yaw
from gazelle.sensors import View, look_at

CONTROL_PERIOD = 0.05  # [s]: openai_ros looks at the joints 20 times a second until they are there
STEP = 0.05  # of one joint [rad]
START = 0.03  # largest roll and pitch at the start [rad]
HEIGHT = 1.0  # of the base when the leg is straight [m]
JOINTS = ("haa_joint", "hfe_joint", "kfe_joint")
LOWER, UPPER = (-1.6, -1.6, -1.6), (1.6, 1.6, 0.0)  # of the joints [rad]
_MOTOR = 10.0  # [N m], as the robot's file says
_TIME_STEP = 0.002
_LEAST = (0.0, -1.57, -1.57, -3.15, 0.0, *LOWER, -3.0, -3.0, 0.0)
_MOST = (3.0, 1.57, 1.57, 3.15, 14.16, *UPPER, 3.0, 3.0, 3.0)


class HopperTask(SimulationTask):
    """A leg stays up, in ``nworld`` worlds; see `HopperStayUpEnv`.

    Args:
        nworld: Number of worlds.
        settings: Options of the user.
    """

    scenario_names = ("start_roll", "start_pitch")
    view = View(look_at((2.4, -1.6, 1.2), (0.0, 0.0, 0.6)), width=480, height=400, samples=1)

    def __init__(self, nworld: int, settings: DynamicsSettings) -> None:
        self.rules = StandRules()
        simulation = simulation_of(
            gazelle.load(assets.world("empty")), nworld, settings, _TIME_STEP
        )
        self.robot = simulation.spawn(assets.robot("monoped"), pose=Pose(z=HEIGHT))
        self._joints = [self.robot.joints[name] for name in JOINTS]
        for joint in self._joints:
            joint.add_motor(_MOTOR)
        self.observation_space = gym.spaces.Box(
            np.array(_LEAST, np.float32), np.array(_MOST, np.float32), dtype=np.float32
        )
        self.action_space = gym.spaces.Discrete(2 * len(JOINTS))
        super().__init__(
            simulation,
            control_period=CONTROL_PERIOD,
            max_episode_steps=settings.max_episode_steps,
        )
        self.memory["start"] = np.zeros((nworld, 2))

    def start(self, worlds: Worlds) -> None:
        """Place the robot upright, leaning a little."""
        lean = self.memory["start"][worlds] = self.draw(-START, START, worlds, 2)
        self.set_lean(lean, worlds)

    def set_lean(self, lean: Floats, worlds: Worlds) -> None:
        """Place the robot in these worlds with this roll and pitch [rad], shape (n, 2)."""
        half = 0.5 * lean
        cos, sin = np.cos(half), np.sin(half)
        turned = np.column_stack(
            (
                sin[:, 0] * cos[:, 1],
                cos[:, 0] * sin[:, 1],
                -sin[:, 0] * sin[:, 1],
                cos[:, 0] * cos[:, 1],
            )
        )
        place = np.tile((0.0, 0.0, HEIGHT), (len(worlds), 1))
        self.robot.set_pose(place, turned, worlds=worlds)
        for joint in self._joints:
            joint.drive(0.0, worlds)

    def scenario(self, worlds: Worlds) -> Floats:
        """Return roll and pitch at the start [rad], shape (n, 2)."""
        start: Floats = self.memory["start"][worlds]
        return start

    def observe(self, worlds: Worlds | None) -> Floats:
        """Return leg and base as openai_ros' code observes them, rounded to 0.1."""
        placement = self.robot.placement(worlds)
        count = len(placement.position)
        angles = np.column_stack([joint.positions(worlds)[:, 0] for joint in self._joints])
        none = np.zeros(count)  # see the data sheet
        turned = roll_pitch_yaw(placement.quaternion)
        return rounded(np.column_stack((none, turned, none, angles, placement.position)), 1)

    def act(self, actions: NDArray[np.int64]) -> None:
        """Command one joint by a step from its position; the others hold."""
        joint, back = np.divmod(actions, 2)
        for number, handle in enumerate(self._joints):
            angle = handle.positions()[:, 0]
            target = angle + np.where(joint == number, STEP * (1.0 - 2.0 * back), 0.0)
            target = np.clip(target, LOWER[number], UPPER[number])
            handle.drive((target - angle) / CONTROL_PERIOD)

    def outcome(self, observation: Floats32) -> StepOutcome:
        """Return the reward.

        It is 100 less penalties of joints, turns, force and distance of the base.
        """
        seen = rounded(observation, 1)
        upright = is_upright(self.rules, self._exactly_turned())
        fallen = ~(upright & has_height(self.rules, seen[:, 10]))
        away = distance_to(seen[:, 8:11], self.rules.desired)
        info = {"is_success": self.lasting & ~fallen, "distance": away}
        return StepOutcome(reward_of(self.rules, seen), fallen, info)

    def _exactly_turned(self) -> Floats:
        """Return roll and pitch [rad] without rounding, for the termination, shape (nworld, 2)."""
        return roll_pitch_yaw(self.robot.placement().quaternion)[:, :2]

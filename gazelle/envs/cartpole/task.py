"""openai_ros' CartPoleStayUp in many worlds at once."""

from __future__ import annotations

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray

from gazelle import assets
from gazelle.array_types import Floats, Floats32, Worlds
from gazelle.description import World
from gazelle.envs.cartpole.rules import ANGLES, has_fallen
from gazelle.envs.options import DynamicsSettings
from gazelle.envs.simulation_task import SimulationTask, StepOutcome, simulation_of
from gazelle.sensors import View, look_at

RUNNING_STEP = 0.04  # [s]
POSITION_STEP = 1.0  # that an action adds to the commanded velocity [m/s]
START = 0.05  # largest angle of the pole at the start [rad]
_TIME_STEP = 0.002
_MOTOR = 100.0  # [N], as the robot's file says
_FASTEST = 50.0  # [m/s], as the robot's file says


class CartPoleTask(SimulationTask):
    """A cart keeps its pole up, in ``nworld`` worlds; see `CartPoleStayUpEnv`.

    Args:
        nworld: Number of worlds.
        settings: Options of the user.
    """

    scenario_names = ("pole_angle",)
    view = View(look_at((3.2, 0.0, 1.4), (0.0, 0.0, 0.8)), width=480, height=320, samples=1)

    def __init__(self, nworld: int, settings: DynamicsSettings) -> None:
        world = simulation_of(World(name="cartpole"), nworld, settings, _TIME_STEP)
        robot = world.spawn(assets.robot("cartpole"), name="cartpole")
        self._foot, self._pole = robot.joints["foot_joint"], robot.joints["pole_joint"]
        self._foot.add_motor(_MOTOR)
        most = np.array([5.0, np.inf, 2.0 * ANGLES[1], np.inf], np.float32)
        self.observation_space = gym.spaces.Box(-most, most, dtype=np.float32)
        self.action_space = gym.spaces.Discrete(2)
        super().__init__(
            world, control_period=RUNNING_STEP, max_episode_steps=settings.max_episode_steps
        )
        self.memory["velocity"] = np.zeros(nworld)
        self.memory["start"] = np.zeros((nworld, 1))

    def start(self, worlds: Worlds) -> None:
        """Set the pole slightly off upright."""
        self.memory["velocity"][worlds] = 0.0
        self._foot.drive(0.0, worlds)
        self.memory["start"][worlds] = self.draw(-START, START, worlds)
        self._pole.set_position(self.memory["start"][worlds], worlds)

    def scenario(self, worlds: Worlds) -> Floats:
        """Return the initial angle of the pole [rad], shape (n, 1)."""
        start: Floats = self.memory["start"][worlds]
        return start

    def observe(self, worlds: Worlds | None) -> Floats:
        """Return place and velocity of the cart, angle and velocity of the pole."""
        joints = (self._foot, self._pole)
        read = [(each.positions(worlds), each.velocities(worlds)) for each in joints]
        return np.hstack([array for pair in read for array in pair])

    def act(self, actions: NDArray[np.int64]) -> None:
        """Change the commanded velocity by a step."""
        velocity = self.memory["velocity"]
        velocity += np.where(actions == 0, -POSITION_STEP, POSITION_STEP)
        np.clip(velocity, -_FASTEST, _FASTEST, out=velocity)
        self._foot.drive(velocity)

    def outcome(self, observation: Floats32) -> StepOutcome:
        """Return a reward of 1 for every step."""
        fallen = has_fallen(observation)
        return StepOutcome(np.ones(self.nworld), fallen, {"is_success": self.lasting & ~fallen})

"""openai_ros' ParrotDroneGoto in many worlds at once."""

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
from gazelle.envs.parrot_drone.places import JITTER, squares
from gazelle.envs.parrot_drone.rules import FlightRules, ends_of, reward_of
from gazelle.envs.simulation_task import StepOutcome, simulation_of
from gazelle.plugins.drone import Drone
from gazelle.rotations import roll_pitch_yaw
from gazelle.sensors import View, look_at

CONTROL_PERIOD = 1.0  # [s]: openai_ros sleeps so long after each command
SPEED = 0.5  # of an action [m/s]
HEIGHT = 0.85  # that a take-off ends at [m]
_TIME_STEP = 0.004
_FARTHEST = 5.0  # range of the sonar [m]
_TURN = 3.15
_UP = 1.6
_DIRECTIONS = ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1))


@dataclass(frozen=True, slots=True, kw_only=True)
class ParrotDroneSettings(StartSettings):
    """Options of the task, checked; starts are anywhere over the field."""


class ParrotDroneTask(DestinationTask):
    """A quadrotor flies to a place, in ``nworld`` worlds; see `ParrotDroneGotoEnv`.

    Args:
        nworld: Number of worlds.
        settings: Options of the user.
    """

    scenario_names = ("start_x", "start_y")
    view = View(look_at((-3.0, -5.0, 5.0), (4.5, 2.0, 0.5)), width=480, height=320, samples=1)

    def __init__(self, nworld: int, settings: ParrotDroneSettings) -> None:
        self.rules = FlightRules()
        simulation = simulation_of(
            gazelle.load(assets.world("drone_field")), nworld, settings, _TIME_STEP
        )
        self.robot = simulation.spawn(assets.robot("parrot_ardrone"), pose=Pose(z=HEIGHT))
        plugins = (entry.plugin for entry in simulation.plugins)
        self.drone = next(each for each in plugins if isinstance(each, Drone))
        self._sonar = self.robot.sensors["sensor_sonar"]
        self._places = None
        if settings.starts != "published":
            self._places = squares(held_out=settings.starts == "held-out")
        # Where an episode ends the drone can be a step beyond the work space.
        low, high = np.array(self.rules.low) - 1.0, np.array(self.rules.high) + 1.0
        tilt = np.array((_TURN, _UP, _TURN))
        self.observation_space = gym.spaces.Box(
            np.hstack((low, -tilt, 0.0)).astype(np.float32),
            np.hstack((high, tilt, _FARTHEST)).astype(np.float32),
            dtype=np.float32,
        )
        self.action_space = gym.spaces.Discrete(len(_DIRECTIONS))
        self._velocities = SPEED * np.array(_DIRECTIONS, np.float64)
        super().__init__(
            simulation,
            control_period=CONTROL_PERIOD,
            max_episode_steps=settings.max_episode_steps,
        )
        self.memory["start"] = np.zeros((nworld, 2))
        self.memory["distance"] = np.zeros(nworld)

    def start(self, worlds: Worlds) -> None:
        """Place the drone as after a take-off: at the origin, or somewhere over the field."""
        start = self.memory["start"]
        if self._places is not None:
            share = self.draw(0.0, 1.0, worlds, 3)
            square = self._places[(share[:, 0] * len(self._places)).astype(np.intp)]
            start[worlds] = square + JITTER * (2.0 * share[:, 1:] - 1.0)
        place = np.column_stack((start[worlds], np.full(len(worlds), HEIGHT)))
        self.robot.set_pose(place, worlds=worlds)
        self.drone.fly(worlds)
        self.robot.inputs["cmd_vel"].send(np.zeros((len(worlds), 3)), 0.0, worlds)
        self.memory["distance"][worlds] = distance_to(place, self.rules.goal)

    def scenario(self, worlds: Worlds) -> Floats:
        """Return the start positions x and y [m], shape (n, 2)."""
        start: Floats = self.memory["start"][worlds]
        return start

    def observe(self, worlds: Worlds | None) -> Floats:
        """Return x, y and z cut to whole metres; roll, pitch, yaw and the sonar, rounded."""
        place = self.robot.placement(worlds)
        rest = np.hstack((roll_pitch_yaw(place.quaternion), self._sonar.measure(worlds)))
        return np.hstack((np.trunc(place.position), rounded(rest, 1)))

    def act(self, actions: NDArray[np.int64]) -> None:
        """Command the velocity of the action."""
        self.robot.inputs["cmd_vel"].send(self._velocities[actions], 0.0)

    def outcome(self, observation: Floats32) -> StepOutcome:
        """Return reward and termination of openai_ros' task, see `rules`."""
        seen = rounded(observation, 1)
        ends = ends_of(self.rules, seen)
        distance = distance_to(seen[:, :3], self.rules.goal)
        closer = self.comes_closer(distance)
        reward = reward_of(self.rules, over=ends.over, succeeded=ends.succeeded, closer=closer)
        info = {"is_success": ends.succeeded, "is_collision": ends.crashed & ~ends.succeeded}
        return StepOutcome(reward, ends.over, {**info, **self.place_info(None)})

    def place_info(self, worlds: Worlds | None) -> Info:
        """Return the places of robot and goal; see `DestinationTask`."""
        place = self.robot.placement(worlds).position
        goal = np.tile(self.rules.goal, (len(place), 1))
        return {"position": place, "goal": goal, "distance": distance_to(place, self.rules.goal)}

"""frobs_rl's reaching tasks in many worlds at once."""

from __future__ import annotations

from dataclasses import dataclass, replace

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray

from gazelle import assets, formats
from gazelle.array_types import Bools, Floats, Floats32, Worlds
from gazelle.description import Model, World
from gazelle.envs.batched_task import Info
from gazelle.envs.options import SPLITS, DynamicsSettings, check_name, check_seconds
from gazelle.envs.reacher.rules import ReachRules, ReachView
from gazelle.envs.simulation_task import SimulationTask, StepOutcome, simulation_of
from gazelle.rotations import rotate
from gazelle.sensors import View, look_at
from gazelle.simulation import Robot, Simulation
from gazelle.streams import Stream

_TIME_STEP = 0.01
_LONGEST_STEP = 60.0  # of control [s]
_EFFORT = 1000.0  # of the motors [N m]
_TRIES, _BATCH = 40, 512  # of postures that goals come from
_SHORTEST = 1e-6  # [m]
_GIVE = 0.05  # [rad]


@dataclass(frozen=True, slots=True, kw_only=True)
class ReachSettings(DynamicsSettings):
    """Options of the reaching tasks, checked.

    Attributes:
        goals: ``published`` and ``training`` goals are the same places, ``held-out`` ones others.
        control_period: Time of a step [s], a multiple of the physics step; None for the task's own.
    """

    goals: str = "published"
    control_period: float | None = None

    def __post_init__(self) -> None:
        # A zero-argument super() does not work in a dataclass with slots.
        DynamicsSettings.__post_init__(self)
        check_name("kind of goals", str(self.goals), SPLITS)
        if self.control_period is not None:
            check_seconds("control_period", self.control_period, below=_LONGEST_STEP)


class ReachTask(SimulationTask):
    """An arm reaches for a place, in ``nworld`` worlds; see `UR5ReachEnv`.

    Args:
        rules: Of the task.
        nworld: Number of worlds.
        settings: Options of the user.
    """

    view = View(look_at((1.7, -1.5, 1.2), (0.2, 0.0, 0.5)), width=480, height=400, samples=1)

    def __init__(self, rules: ReachRules, nworld: int, settings: ReachSettings) -> None:
        self.rules = rules
        simulation, self.robot = _cell(rules, settings, nworld)
        self._link, tool = self.robot.frame("tool0")
        self._tool = np.array(tool.position)
        moving = [joint for joint in self.robot.description.joints if joint.type != "fixed"]
        self._names = [joint.name for joint in moving]
        self._joints = [self.robot.joints[name] for name in self._names]
        self._speeds = np.array([joint.axes[0].velocity for joint in moving])
        for joint in self._joints:
            joint.add_motor(_EFFORT)
        self._lower, self._upper = np.array(rules.lower), np.array(rules.upper)
        self._goals = self._reachable(settings)
        self.observation_space, self.action_space = self._spaces()
        super().__init__(
            simulation,
            control_period=settings.control_period or rules.control_period,
            max_episode_steps=settings.max_episode_steps,
        )
        self.memory["goal"] = np.zeros((nworld, 3))
        self.memory["start"] = np.zeros((nworld, len(self._joints)))

    @property
    def scenario_names(self) -> tuple[str, ...]:  # type: ignore[override]  # not fixed here
        """Names of the numbers that `scenario` returns."""
        joints = tuple(f"start_{number + 1}" for number in range(len(self._joints)))
        return (*joints, "goal_x", "goal_y", "goal_z")

    def scenario(self, worlds: Worlds) -> Floats:
        """Return joint angles at the start [rad] and the goal [m], shape (n, 9)."""
        return np.hstack((self.memory["start"][worlds], self.memory["goal"][worlds]))

    @property
    def goal_places(self) -> Floats:
        """Goals of the tool [m], shape (nworld, 3)."""
        return self.memory["goal"]

    def start(self, worlds: Worlds) -> None:
        """Sample posture and goal."""
        shares = self.draw(0.0, 1.0, worlds, len(self._joints) + 1)
        picked = (shares[:, -1] * len(self._goals)).astype(np.intp)
        self.memory["goal"][worlds] = self._goals[picked]
        if self.rules.random_start:
            start = self._lower + (self._upper - self._lower) * shares[:, :-1]
            self.memory["start"][worlds] = start
        for number, joint in enumerate(self._joints):
            joint.set_position(self.memory["start"][worlds, number], worlds)
            joint.drive(0.0, worlds)

    def observe(self, worlds: Worlds | None) -> Floats:
        """Return direction of the goal, the goal and the joints, in the order of the task."""
        seen = self._see(worlds)
        if self.rules.by_speed:
            return np.hstack((seen.angles, seen.goal, seen.direction))
        return np.hstack((seen.direction, seen.goal, seen.angles))

    def act(self, actions: NDArray[np.float64]) -> None:
        """Command joints by a speed, or a position within reach in a step."""
        rules = self.rules
        angles = np.column_stack([joint.positions()[:, 0] for joint in self._joints])
        if rules.by_speed:
            speed = np.clip(actions, -rules.most_speed, rules.most_speed)
            speed[(angles <= self._lower + rules.limit_margin) & (speed < 0.0)] = 0.0
            speed[(angles >= self._upper - rules.limit_margin) & (speed > 0.0)] = 0.0
        else:
            targets = np.clip(angles + actions, self._lower, self._upper)
            speed = np.clip((targets - angles) / self.control_period, -self._speeds, self._speeds)
        for number, joint in enumerate(self._joints):
            joint.drive(speed[:, number])

    def outcome(self, observation: Floats32) -> StepOutcome:
        """Return the reward: less for distance and limits, more for reaching the goal."""
        del observation
        rules, seen = self.rules, self._see(None)
        there = seen.distance <= rules.tolerance
        away = rules.step_reward - rules.distance_weight * seen.distance
        low, high = self._lower + rules.limit_margin, self._upper - rules.limit_margin
        at_limit = ((seen.angles <= low) | (seen.angles >= high)).any(axis=1)
        reward = np.where(there, rules.goal_reward, away) + rules.limit_reward * at_limit
        if rules.ends:
            return StepOutcome(reward, there, self._info(seen, there.copy()))
        # Where being there is not the end, what counts is to be there in the end.
        over = np.zeros(self.nworld, np.bool_)
        return StepOutcome(reward, over, self._info(seen, there & self.lasting))

    def _look(self, worlds: Worlds) -> tuple[Floats32, Info]:
        seen = self._see(worlds)
        return super()._look(worlds)[0], self._info(seen, np.zeros(len(worlds), np.bool_))

    def _info(self, seen: ReachView, there: Bools) -> Info:
        none = np.zeros(len(there), np.bool_)
        return {"is_success": there, "is_collision": none, "distance": seen.distance}

    def _see(self, worlds: Worlds | None) -> ReachView:
        angles = np.column_stack([joint.positions(worlds)[:, 0] for joint in self._joints])
        goal = self.memory["goal"] if worlds is None else self.memory["goal"][worlds]
        tool = self._tool_place(worlds)
        way = goal - tool
        distance = np.linalg.norm(way, axis=1)
        direction = way / np.maximum(distance, _SHORTEST)[:, None]
        return ReachView(angles, tool, goal, direction, distance)

    def _tool_place(self, worlds: Worlds | None) -> Floats:
        placement = self._link.placement(worlds)
        offset = np.broadcast_to(self._tool, placement.position.shape)
        place: Floats = placement.position + rotate(placement.quaternion, offset)
        return place

    def _reachable(self, settings: ReachSettings) -> Floats:
        """Return places of the tool in random postures, within the goals' box, shape (n, 3)."""
        simulation, robot = _cell(self.rules, replace(settings, seed=0), _BATCH)
        link, tool = robot.frame("tool0")
        joints = [robot.joints[name] for name in self._names]
        stream = Stream(int(settings.goals == "held-out"), "reacher/goals", _BATCH)
        found, every = [], np.arange(_BATCH)
        with simulation:
            for _ in range(_TRIES):
                shares = stream.uniform(len(joints), every)
                for number, joint in enumerate(joints):
                    low, high = self._lower[number], self._upper[number]
                    joint.set_position(low + (high - low) * shares[:, number])
                placement = link.placement()
                offset = np.broadcast_to(np.array(tool.position), placement.position.shape)
                found.append(placement.position + rotate(placement.quaternion, offset))
        places = np.vstack(found)
        inside = (places >= self.rules.goal_low) & (places <= self.rules.goal_high)
        kept: Floats = places[inside.all(axis=1)]
        return kept

    def _spaces(self) -> tuple[gym.spaces.Box, gym.spaces.Box]:
        rules, ones = self.rules, np.ones(3)
        # The stops of the joints give way a little.
        joints = (self._lower - _GIVE, self._upper + _GIVE)
        goals = (rules.goal_low, rules.goal_high)
        parts = [(-ones, ones), goals, joints]
        if rules.by_speed:
            parts = [joints, goals, (-ones, ones)]
        low, high = (np.concatenate(each).astype(np.float32) for each in zip(*parts, strict=True))
        least, most = self._lower.astype(np.float32), self._upper.astype(np.float32)
        if rules.by_speed:
            most = np.full(len(rules.lower), rules.most_speed, np.float32)
            least = -most
        return (
            gym.spaces.Box(low, high, dtype=np.float32),
            gym.spaces.Box(least, most, dtype=np.float32),
        )


def _cell(rules: ReachRules, settings: ReachSettings, nworld: int) -> tuple[Simulation, Robot]:
    """Return the arm alone; MoveIt, which moves it for frobs_rl, knows of no floor either."""
    simulation = simulation_of(World(name="cell"), nworld, settings, _TIME_STEP)
    model = _limited(formats.load_model(assets.robot(rules.robot)), rules)
    return simulation, simulation.spawn(model, name=rules.robot)


def _limited(model: Model, rules: ReachRules) -> Model:
    """Return the arm with the limits that the task gives its joints."""
    limits = iter(zip(rules.lower, rules.upper, strict=True))
    joints = []
    for joint in model.joints:
        if joint.type == "fixed":
            joints.append(joint)
            continue
        low, high = next(limits)
        axis = replace(joint.axes[0], lower=low, upper=high)
        joints.append(replace(joint, axes=(axis,)))
    return replace(model, joints=tuple(joints))

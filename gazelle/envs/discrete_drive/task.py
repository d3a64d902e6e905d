"""openai_ros' driving tasks in many worlds at once."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray

import gazelle
from gazelle import assets, formats
from gazelle.array_types import Floats, Floats32, Worlds
from gazelle.description import Pose
from gazelle.envs.batched_task import BatchedTask, Info
from gazelle.envs.course import CourseTask
from gazelle.envs.decimals import rounded
from gazelle.envs.destination_task import DestinationTask
from gazelle.envs.discrete_drive.rules import CONTROL_PERIOD, DriveRules
from gazelle.envs.discrete_drive.scoring import ends_of, has_crashed, observed, reward_of
from gazelle.envs.free_space import FreeSpace, floor_plan_of
from gazelle.envs.goal_rules import distance_to
from gazelle.envs.lidars import FittedLidar, every_nth_ray
from gazelle.envs.options import SPLITS, TaskSettings, check_name
from gazelle.envs.simulation_task import StepOutcome
from gazelle.errors import TaskError
from gazelle.sensors import View, look_at
from gazelle.simulation import Robot, Simulation

_PLANAR_STEP = 0.02  # [s]
_HIGH = 1.0  # what stands higher is no obstacle [m]
_SIDES = 2  # of a place


@dataclass(frozen=True, slots=True, kw_only=True)
class DriveSettings(TaskSettings):
    """Options of the driving tasks, checked.

    Attributes:
        starts: ``published``, or ``training`` or ``held-out``: anywhere in free space, with any
            heading; places of the two are not the same.
        goal: Goal instead (x, y) [m], in tasks with a goal.
        course: Numbers of steps over which its course is shown as well, in tasks with a goal; see
            `CourseTask`.
    """

    starts: str = "published"
    goal: tuple[float, float] | None = None
    course: Sequence[int] = ()

    def __post_init__(self) -> None:
        # A zero-argument super() does not work in a dataclass with slots.
        TaskSettings.__post_init__(self)
        check_name("kind of starts", str(self.starts), SPLITS)
        if not isinstance(self.course, list | tuple):
            raise TaskError(f"course must be numbers of steps, not {self.course!r}")
        if self.goal is not None:
            place = np.asarray(self.goal, dtype=np.float64)
            if place.shape != (_SIDES,) or not np.isfinite(place).all():
                raise TaskError(f"goal must be x and y, not {self.goal!r}")


def drive_task(rules: DriveRules, nworld: int, settings: DriveSettings) -> BatchedTask:
    """Return the task of these rules and options.

    Raises:
        TaskError: An option does not fit the task.
    """
    if not settings.course:
        return DriveTask(rules, nworld, settings)
    if rules.goal is None:
        raise TaskError("this task shows no place to take a course from", hint="leave out course")
    task = DriveTask(rules, nworld, settings)
    first = task.lidar.lidar.horizontal.samples
    return CourseTask(task, first, first + 1, settings.course)


class DriveTask(DestinationTask):
    """A base drives by one of a few velocities, in ``nworld`` worlds.

    Args:
        rules: Of the task.
        nworld: Number of worlds.
        settings: Options of the user.

    Attributes:
        scan: Ranges at the last observation [m], shape (n, rays).

    Raises:
        TaskError: A goal is given to a task without one, or no place is free to start from.
    """

    scenario_names = ("start_x", "start_y", "start_heading")
    view = View(look_at((-3.0, -5.0, 6.0), (1.0, 0.0, 0.0)), width=480, height=400, samples=1)

    def __init__(self, rules: DriveRules, nworld: int, settings: DriveSettings) -> None:
        if settings.goal is not None and rules.goal is None:
            raise TaskError("this task has no goal", hint="leave out the option goal")
        goal = settings.goal or rules.goal
        if goal is not None and rules.sees_goal:
            goal = (round(goal[0], rules.place_decimals), round(goal[1], rules.place_decimals))
        self.rules = rules = dataclasses.replace(rules, goal=goal)
        self._goal = goal
        model = formats.load_model(assets.robot(rules.robot), xacro_args=rules.robot_args)
        self._lidar = every_nth_ray(model, rules.every)
        simulation, self.robot = self._scene(settings, settings.engine, nworld)
        self._places = self._free_places(settings)
        self._speeds = np.array(rules.velocities)
        self.observation_space = self._space()
        self.action_space = gym.spaces.Discrete(len(rules.velocities))
        super().__init__(
            simulation,
            control_period=CONTROL_PERIOD,
            max_episode_steps=settings.max_episode_steps,
        )
        self.memory["start"] = np.tile((*rules.start, 0.0), (nworld, 1))
        self.memory["distance"] = np.zeros(nworld)

    def start(self, worlds: Worlds) -> None:
        """Place the robot at rest: where the task has it, or somewhere in free space."""
        self.robot.inputs["cmd_vel"].send(0.0, 0.0, worlds)
        if self._places is not None:
            share = self.draw(0.0, 1.0, worlds, 2)
            start = self.memory["start"]
            start[worlds, :2] = self._places[(share[:, 0] * len(self._places)).astype(np.intp)]
            start[worlds, 2] = (2.0 * share[:, 1] - 1.0) * np.pi
            height = self.robot.placement(worlds).position[:, 2]
            place = np.column_stack((start[worlds, :2], height))
            self.robot.set_pose(place, yaw=start[worlds, 2], worlds=worlds)
        if self._goal is not None:
            place = self.robot.planar_pose(worlds)[:, :2]
            self.memory["distance"][worlds] = distance_to(place, self._goal)

    def scenario(self, worlds: Worlds) -> Floats:
        """Return x, y [m] and heading [rad] at the start, shape (n, 3)."""
        start: Floats = self.memory["start"][worlds]
        return start

    def observe(self, worlds: Worlds | None) -> Floats:
        """Return ranges, and where the rules say so x, y, yaw and the goal."""
        rules = self.rules
        # Noise is drawn with each measurement, so the outcome goes by the one that was observed.
        self.scan = ranges = self._ranges(worlds)
        seen = [observed(rules, ranges)]
        if self._goal is not None:
            pose = self.robot.planar_pose(worlds)
            seen.append(rounded(pose[:, : 3 if rules.sees_yaw else 2], rules.place_decimals))
            if rules.sees_goal:
                seen.append(np.tile(self._goal, (len(pose), 1)))
        return np.hstack(seen)

    def act(self, actions: NDArray[np.int64]) -> None:
        """Command the velocity of the action."""
        self._forward = actions == 0
        self.robot.inputs["cmd_vel"].send(*self._speeds[actions].T)

    def outcome(self, observation: Floats32) -> StepOutcome:
        """Return reward and termination of openai_ros' task, see `scoring`."""
        rules, rays = self.rules, self._lidar.lidar.horizontal.samples
        # A base without a goal is nowhere, and never nearer to it.
        place, closer = np.zeros((self.nworld, 2)), np.zeros(self.nworld, np.bool_)
        if self._goal is not None:
            place = rounded(observation[:, rays : rays + 2], rules.place_decimals)
            closer = self.comes_closer(distance_to(place, self._goal))
        crashed = has_crashed(rules, self.scan, observation[:, :rays])
        ends = ends_of(rules, crashed, place)
        reward = reward_of(
            rules, over=ends.over, reached=ends.reached, forward=self._forward, closer=closer
        )
        success = ends.reached if self._goal is not None else self.lasting & ~ends.crashed
        info = {"is_success": success, "is_collision": ends.crashed & ~ends.reached}
        return StepOutcome(reward, ends.over, {**info, **self.place_info(None)})

    def place_info(self, worlds: Worlds | None) -> Info:
        """Return the places of robot and goal; see `DestinationTask`."""
        place = self.robot.planar_pose(worlds)[:, :2]
        if self._goal is None:
            return {"position": place}
        goal = np.tile(self._goal, (len(place), 1))
        return {"position": place, "goal": goal, "distance": distance_to(place, self._goal)}

    def _ranges(self, worlds: Worlds | None) -> NDArray[Any]:
        """Return ranges [m]; those below the minimum range are nearly zero.

        openai_ros takes that (-inf) for nothing in range, so a base that touches a wall would continue.
        """
        ranges = self.robot.sensors[self._lidar.sensor].measure(worlds)
        return np.where(np.isneginf(ranges), np.finfo(np.float32).tiny, ranges)

    def _space(self) -> gym.spaces.Box:
        rules, rays = self.rules, self._lidar.lidar.horizontal.samples
        low, high = [rules.least] * rays, [rules.far] * rays
        if self._goal is not None and rules.bounds is not None:
            x0, x1, y0, y1 = rules.bounds
            # Where an episode ends the base can be a step beyond the bounds.
            least, most = [x0 - 1.0, y0 - 1.0], [x1 + 1.0, y1 + 1.0]
            low += least + [-3.15] * rules.sees_yaw + least * rules.sees_goal
            high += most + [3.15] * rules.sees_yaw + most * rules.sees_goal
        return gym.spaces.Box(
            np.array(low, np.float32), np.array(high, np.float32), dtype=np.float32
        )

    def _scene(self, settings: DriveSettings, engine: str, nworld: int) -> tuple[Simulation, Robot]:
        step = _PLANAR_STEP if engine == "planar" else self.rules.space_step
        simulation = Simulation(
            gazelle.load(assets.world(self.rules.world)),
            engine,
            nworld=nworld,
            seed=settings.seed or 0,
            time_step=settings.time_step or step,
            threads=settings.threads,
        )
        pose = Pose(*self.rules.start)
        return simulation, simulation.spawn(self._lidar.model, name=self.rules.robot, pose=pose)

    def _free_places(self, settings: DriveSettings) -> Floats | None:
        """Return the start positions (x, y) [m], shape (n, 2); None if only the task's own."""
        if settings.starts == "published":
            return None
        simulation, robot = self._scene(settings, "planar", 1)
        with simulation:
            space = FreeSpace(floor_plan_of(robot, _HIGH), self.rules.start)
        margin = self.rules.start_margin
        places = space.places(margin, between=settings.starts == "held-out")
        if self.rules.bounds is not None:
            x0, x1, y0, y1 = self.rules.bounds
            x, y = places.T
            inside = (x > x0 + margin) & (x < x1 - margin) & (y > y0 + margin) & (y < y1 - margin)
            places = places[inside]
        if not len(places):
            raise TaskError("there is no free place to start from")
        return places

    @property
    def lidar(self) -> FittedLidar:
        """The laser, with the rays that the task reads."""
        return self._lidar

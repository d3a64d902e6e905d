"""frobs_rl's tasks for Kobuki in many worlds at once."""

from __future__ import annotations

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray

import gazelle
from gazelle import assets, formats
from gazelle.array_types import Bools, Floats, Floats32, Worlds
from gazelle.description import Pose
from gazelle.envs.batched_task import Info
from gazelle.envs.contract import PolicyContract
from gazelle.envs.kobuki_maze.boxes import MovingBoxes
from gazelle.envs.kobuki_maze.contract import kobuki_contract
from gazelle.envs.kobuki_maze.rules import CONTROL_PERIOD, LASER_MAX, KobukiRules
from gazelle.envs.lidars import every_nth_ray
from gazelle.envs.options import TaskSettings
from gazelle.envs.polar import distance_to, heading_to
from gazelle.envs.simulation_task import SimulationTask, StepOutcome, simulation_of
from gazelle.sensors import View, look_at

_PLANAR_STEP, _SPACE_STEP = 0.02, 0.004  # [s]; in space a light base's wheels slip at longer ones


class KobukiTask(SimulationTask):
    """A Kobuki drives to goals, in ``nworld`` worlds; see `KobukiMazeEnv`.

    Args:
        rules: Of the task.
        nworld: Number of worlds.
        settings: Options of the user.
    """

    scenario_names = ("start_x", "start_y", "start_heading", "goal_x", "goal_y", "way")
    view = View(look_at((-16.0, -24.0, 26.0), (-1.0, -1.0, 0.0)), width=480, height=400, samples=1)

    def __init__(self, rules: KobukiRules, nworld: int, settings: TaskSettings) -> None:
        step = _PLANAR_STEP if settings.engine == "planar" else _SPACE_STEP
        simulation = simulation_of(gazelle.load(assets.world(rules.world)), nworld, settings, step)
        file = assets.root() / "kobuki_maze_rl" / "urdf" / f"{rules.robot}.urdf.xacro"
        start = Pose(*rules.starts[0])
        fitted = every_nth_ray(formats.load_model(file), 1)
        self.robot = simulation.spawn(fitted.model, name="kobuki_robot", pose=start)
        self.rules, self._lidar = rules, fitted.lidar
        self._paths = rules.paths()
        self.action_space = gym.spaces.Box(-rules.speed, rules.speed, (2,), np.float32)
        self.observation_space = _space(rules, fitted.lidar.horizontal.samples)
        super().__init__(
            simulation,
            control_period=CONTROL_PERIOD,
            max_episode_steps=settings.max_episode_steps,
        )
        count = len(rules.boxes)
        boxes = [simulation.robots[f"box{number + 1}"] for number in range(count)]
        self._boxes = MovingBoxes(rules, boxes, nworld) if count else None
        self.memory |= {
            "start": np.zeros((nworld, 3)),
            "goal": np.zeros((nworld, 2)),
            "way": np.zeros(nworld, np.int64),
            "point": np.zeros(nworld, np.int64),
            "collisions": np.zeros(nworld, np.int64),
            **({} if self._boxes is None else self._boxes.memory),
        }

    @property
    def contract(self) -> PolicyContract:
        """Contract of its policies."""
        return kobuki_contract(self.rules, self._lidar, self.action_space, self.max_episode_steps)

    def start(self, worlds: Worlds) -> None:
        """Sample robot, goals and boxes; the robot is at rest."""
        memory, rules = self.memory, self.rules
        shares = self.draw(0.0, 1.0, worlds, 6 + 2 * len(rules.boxes))
        memory["start"][worlds, :2] = _between(rules.starts, shares[:, :2])
        memory["start"][worlds, 2] = (2.0 * shares[:, 2] - 1.0) * np.pi
        memory["way"][worlds] = (shares[:, 3] * len(self._paths)).astype(np.int64)
        memory["point"][worlds] = memory["collisions"][worlds] = 0
        if rules.goals is not None:
            memory["goal"][worlds] = _between(rules.goals, shares[:, 4:6])
        else:
            memory["goal"][worlds] = self._paths[memory["way"][worlds], 0]
        self.robot.inputs["cmd_vel"].send(0.0, 0.0, worlds)
        place = self.robot.placement(worlds).position
        place[:, :2] = memory["start"][worlds, :2]
        self.robot.set_pose(place, yaw=memory["start"][worlds, 2], worlds=worlds)
        if self._boxes is not None:
            self._boxes.begin(worlds, shares[:, 6:])

    def scenario(self, worlds: Worlds) -> Floats:
        """Return start (x, y, heading), first goal (x, y) and number of the path, shape (n, 6)."""
        memory = self.memory
        return np.column_stack([memory[name][worlds] for name in ("start", "goal", "way")])

    def observe(self, worlds: Worlds | None) -> Floats:
        """Return distance and direction of the goal.

        Place, goal and ranges follow if the rules say so.
        """
        pose = self.robot.planar_pose(worlds)
        goal = self.memory["goal"] if worlds is None else self.memory["goal"][worlds]
        seen = [distance_to(pose, goal), heading_to(pose, pose[:, 2], goal)]
        if self.rules.sees_place:
            seen += [pose, goal]
        if self.rules.sees_ranges:
            seen.append(self._ranges(worlds))
        return np.column_stack(seen)

    def act(self, actions: NDArray[np.float64]) -> None:
        """Command forward speed and yaw rate."""
        most = self.rules.speed
        self.robot.inputs["cmd_vel"].send(*np.clip(actions, -most, most).T)

    def outcome(self, observation: Floats32) -> StepOutcome:
        """Return the reward: less for the goal's distance and collisions, more for reaching it."""
        rules, memory = self.rules, self.memory
        distance, heading = observation[:, :2].T.astype(np.float64)
        angle = np.abs(heading)
        left = self._paths.shape[1] - memory["point"]
        taken = rules.distance_weight * distance + rules.remaining_weight * left
        taken += rules.heading_weight * np.minimum(angle, np.pi - angle)
        reached = distance <= rules.tolerance
        collided = self._collided()
        reward = np.where(reached, rules.goal_reward, -taken) + rules.collision_reward * collided
        memory["collisions"] += collided
        done = self._next_point(reached)
        if self._boxes is not None:
            self._boxes.step()
        info = {"is_success": done, "is_collision": collided & ~done}
        return StepOutcome(reward, done, {**info, **self._place_info(None, distance)})

    def _next_point(self, reached: Bools) -> Bools:
        """Set the next point of the path where one is reached.

        Returns where it was the last one.
        """
        point, last = self.memory["point"], self._paths.shape[1]
        point += reached
        on = np.flatnonzero(reached & (point < last))
        self.memory["goal"][on] = self._paths[self.memory["way"][on], point[on]]
        done: Bools = reached & (point >= last)
        return done

    def _collided(self) -> Bools:
        if not self.rules.collision_reward:
            return np.zeros(self.nworld, np.bool_)
        near: Bools = self._ranges(None).min(axis=1) < self.rules.collision_range
        return near

    def _ranges(self, worlds: Worlds | None) -> Floats:
        ranges = self.robot.sensors["laser"].measure(worlds)
        # Too near to measure is -inf here, which frobs_rl would take for nothing in range.
        known: Floats = np.nan_to_num(ranges, posinf=LASER_MAX, neginf=0.0)
        return known

    def _look(self, worlds: Worlds) -> tuple[Floats32, Info]:
        no: Bools = np.zeros(len(worlds), np.bool_)
        pose, goal = self.robot.planar_pose(worlds), self.memory["goal"][worlds]
        where = self._place_info(worlds, distance_to(pose, goal))
        return super()._look(worlds)[0], {"is_success": no, "is_collision": no.copy(), **where}

    def _place_info(self, worlds: Worlds | None, distance: Floats) -> Info:
        rows = slice(None) if worlds is None else worlds
        return {
            "position": self.robot.planar_pose(worlds)[:, :2],
            "goal": self.memory["goal"][rows].copy(),
            "distance": distance,
            "collisions": self.memory["collisions"][rows].copy(),
            "waypoints": self.memory["point"][rows].copy(),
        }


def _between(corners: tuple[tuple[float, float], tuple[float, float]], shares: Floats) -> Floats:
    low, high = np.array(corners)
    places: Floats = low + (high - low) * shares
    return places


def _space(rules: KobukiRules, rays: int) -> gym.spaces.Box:
    low, high = [0.0, -np.pi], [rules.farthest, np.pi]
    if rules.sees_place:
        low += [-10.5, -13.5, -np.pi, -10.5, -13.5]
        high += [5.5, 13.5, np.pi, 5.5, 13.5]
    if rules.sees_ranges:
        low += [0.0] * rays
        high += [LASER_MAX] * rays
    return gym.spaces.Box(np.array(low, np.float32), np.array(high, np.float32), dtype=np.float32)

"""The TurtleBot3 DQN tasks in many worlds at once."""

from __future__ import annotations

from typing import Any

import gymnasium as gym
import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.array_types import Bools, Floats, Floats32, Worlds
from gazelle.envs.batched_task import BatchedTask, Info, TaskOutcome
from gazelle.envs.contract import PolicyContract
from gazelle.envs.decimals import round2
from gazelle.envs.floor_plan import FloorPlan
from gazelle.envs.goals import GoalTable
from gazelle.envs.options import NavigationSettings, check_name
from gazelle.envs.pictures import mark_square, take
from gazelle.envs.polar import distance_to
from gazelle.envs.scans import clean_ranges, nearest_obstacle
from gazelle.envs.turtlebot3.actions import (
    ACTIONS,
    continuous_command,
    discrete_command,
)
from gazelle.envs.turtlebot3.contract import turtlebot3_contract
from gazelle.envs.turtlebot3.layout import GoalLayout
from gazelle.envs.turtlebot3.observations import RobotViews, observation_space, sight
from gazelle.envs.turtlebot3.rewards import judge
from gazelle.envs.turtlebot3.rules import NO_GOAL, SHORTEST, STAGES, Rules
from gazelle.envs.turtlebot3.scene import COMMAND, TaskScene
from gazelle.errors import TaskError
from gazelle.sensors import SensorModel, View, look_at
from gazelle.simulation import Simulation
from gazelle.streams import Stream

_GOAL_BOX = 0.5


class TurtleBot3Task(BatchedTask):
    """One stage of the TurtleBot3 DQN tasks in ``nworld`` worlds.

    Args:
        stage: 1 to 4.
        nworld: Number of worlds.
        continuous: Whether actions are two real numbers instead of one of five.
        settings: Options of the user.

    Raises:
        TaskError: The stage, the robot or an option does not fit.
        FormatError: A file cannot be read.
        EngineError: The world or the robot cannot be simulated.
    """

    def __init__(
        self, stage: int, nworld: int, *, continuous: bool, settings: NavigationSettings
    ) -> None:
        super().__init__(nworld, settings.max_episode_steps)
        check_name("stage", str(stage), [str(known) for known in STAGES])
        self.rules = STAGES[stage]
        self.respawn = settings.respawn
        self._margin = settings.margin
        self.continuous = continuous
        self.control_period = self.rules.control_period
        self.scene = TaskScene(self.rules, settings, nworld)
        self.layout = GoalLayout(stage, settings)
        self.goals = self.layout.goals()
        self._starts = self.layout.starts(nworld)
        self._keeps_goals = self.respawn and not self.layout.has_free_goals
        self.observation_space = observation_space(
            self.rules,
            settings.lidar_samples,
            distance_max=_distance_max(self.rules, settings, self.goals),
        )
        self.action_space = _action_space(continuous=continuous)
        self._goal = np.full(nworld, NO_GOAL, dtype=np.intp)
        self._start_distance = np.ones(nworld)
        self._goals_reached = np.zeros(nworld, dtype=np.int64)
        self._start_over(self.scene.simulation.seed)

    @property
    def simulation(self) -> Simulation:
        """Running simulation."""
        return self.scene.simulation

    def render(self, world: int) -> NDArray[np.uint8]:
        """Return a picture of one world from behind and above, its goal as a red square of 0.5 m.

        The square lies on the ground: what stands before or on it hides it.
        """
        size = self.rules.arena_diagonal
        pose = look_at((-0.5 * size, 0.0, 0.85 * size), (-0.05 * size, 0.0, 0.0))
        view = View(pose, width=480, height=400, horizontal_fov=0.95, samples=1)
        picture, ranges = take(self.scene.simulation, view, world)
        x, y = self.goals.points[self._goal[world]]
        return mark_square(picture, view, ranges, (float(x), float(y)), _GOAL_BOX)

    def close(self) -> None:
        """Free the simulation; a second call does nothing."""
        self.scene.simulation.close()

    def _seed(self, seed: int) -> None:
        self.scene.restart(seed)
        self._start_over(seed)

    def _start_over(self, seed: int) -> None:
        """Restart the random numbers from a seed, in a scene that has just started."""
        self._stream = Stream(seed, "turtlebot3/goals", self.nworld)
        self._goal[:] = NO_GOAL
        if self._starts is not None:
            self._starts.seed(seed, self.scene.robot)

    def _begin(self, worlds: Worlds) -> None:
        self.scene.simulation.reset(worlds)
        self._new_goals(worlds)
        self._vary(worlds)

    def _vary(self, worlds: Worlds) -> None:
        """Randomise the poses of robot and obstacles, if requested."""
        if self._starts is not None:
            goals = self.goals.points[self._goal[worlds]]
            self._starts.begin(worlds, goals, self._nearest)

    @property
    def contract(self) -> PolicyContract:
        """Contract of its policies."""
        return turtlebot3_contract(
            self.rules,
            self.scene.lidar.lidar,
            self.observation_space,
            self.action_space,
            self.max_episode_steps,
        )

    @property
    def scenario_names(self) -> tuple[str, ...]:  # type: ignore[override]  # not fixed here
        """Names of the numbers that `scenario` returns."""
        phases = 0 if self._starts is None else self._starts.phases.shape[1]
        names = ("start_x", "start_y", "start_heading", "goal_x", "goal_y")
        return (*names, *(f"phase_{number}" for number in range(phases)))

    @property
    def floor_plan(self) -> FloorPlan | None:  # type: ignore[override]  # made at first access
        """Walls and pillars, seen from above; None where they cannot be laid in the plane."""
        try:
            return self.layout.plan
        except TaskError:
            return None

    def scenario(self, worlds: Worlds) -> NDArray[np.float64]:
        """Return start (x, y, heading), first goal (x, y), and times since scripts began."""
        count = len(worlds)
        start: Any = (*self.rules.start, 0.0)
        phases = np.zeros((count, 0))
        if self._starts is not None:
            start, phases = self._starts.poses[worlds], self._starts.phases[worlds]
        drawn = np.empty((count, 5 + phases.shape[1]))
        drawn[:, :3], drawn[:, 5:] = start, phases
        drawn[:, 3:5] = self.goals.places(self._goal[worlds])
        return drawn

    def _new_goals(self, worlds: Worlds) -> None:
        self._goals_reached[worlds] = 0
        if self._keeps_goals:
            # As published: a goal stays until it is reached, over collisions and time-outs.
            fresh = worlds[self._goal[worlds] == NO_GOAL]
            self._goal[fresh] = self.goals.start
        else:
            self._goal[worlds] = self.goals.first(self._draw(worlds))

    def _hold(self, worlds: Worlds) -> Any:
        noise = self._lidar_model.state()
        return self._stream.counters[worlds], {name: noise[name][worlds] for name in noise}

    def _release(self, worlds: Worlds, kept: Any) -> None:
        self._stream.counters[worlds], noise = kept
        state = self._lidar_model.state()
        for name, rows in noise.items():
            state[name][worlds] = rows
        self._lidar_model.restore(state)

    def _look(self, worlds: Worlds) -> tuple[Floats32, Info]:
        seen = self._see(worlds)
        self._set_start(worlds, seen.distance)
        no = np.zeros(len(worlds), dtype=np.bool_)
        return seen.state, self._info(seen, worlds, arrived=no, crashed=no.copy())

    def _act(self, actions: ArrayLike) -> TaskOutcome:
        linear, angular = self._command(actions)
        with self.scene.simulation.lock:  # once, not at every access
            self.scene.robot.inputs[COMMAND].send(linear, angular)
            self.scene.simulation.run(self.control_period)
            seen = self._see(None)
        reward, crashed, arrived = judge(
            self.rules, seen, angular, self._start_distance, self._margin
        )
        if np.count_nonzero(arrived):
            self._goals_reached += arrived
            if self.respawn:
                self._next_goals(np.flatnonzero(arrived), seen)
        terminated = crashed if self.respawn else crashed | arrived
        info = self._info(seen, slice(None), arrived=arrived, crashed=crashed > arrived)
        return TaskOutcome(seen.state, reward, terminated, info)

    @property
    def _lidar_model(self) -> SensorModel:
        return self.scene.robot.sensors[self.scene.lidar.sensor].model

    def _command(self, actions: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        if self.continuous:
            return continuous_command(actions, self.nworld)
        return discrete_command(actions, self.nworld)

    def _nearest(self, worlds: Worlds) -> Floats:
        """Return the shortest range in some worlds [m], as `_see` has it, without the rest."""
        lidar = self.scene.lidar
        ranges = self.scene.robot.sensors[lidar.sensor].measure(worlds)
        seen = clean_ranges(ranges, nearest=lidar.lidar.range_min, farthest=self.rules.range_max)
        return nearest_obstacle(seen)[0].astype(np.float64)

    def _see(self, worlds: Worlds | None) -> RobotViews:
        scene = self.scene
        rows = slice(None) if worlds is None else worlds
        return sight(
            self.rules,
            ranges=scene.robot.sensors[scene.lidar.sensor].measure(worlds),
            range_min=scene.lidar.lidar.range_min,
            pose=scene.robot.planar_pose(worlds),
            goal=self.goals.places(self._goal[rows]),
        )

    def _next_goals(self, worlds: Worlds, seen: RobotViews) -> None:
        """Set the next goals in these worlds, and show them; the view is of all worlds."""
        chosen = self.goals.after(self._goal[worlds], self._draw(worlds))
        goal = self.goals.places(chosen)
        self._goal[worlds], seen.goal[worlds] = chosen, goal
        self._set_start(worlds, round2(distance_to(seen.position.take(worlds, axis=0), goal)))

    def _set_start(self, worlds: Worlds, distance: NDArray[np.float64]) -> None:
        self._start_distance[worlds] = np.maximum(distance, SHORTEST)

    def _draw(self, worlds: Worlds) -> NDArray[np.float64]:
        """Return a number for each goal.

        Goal k of a world depends on the seed, the world and k alone.
        """
        return self._stream.uniform(1, worlds)[:, 0]

    def _info(
        self, seen: RobotViews, rows: Worlds | slice, *, arrived: Bools, crashed: Bools
    ) -> Info:
        return {
            "is_success": arrived,
            "is_collision": crashed,
            "distance": seen.distance,
            "heading": seen.heading,
            "goal": seen.goal,
            "position": seen.position,
            "goals_reached": self._goals_reached[rows].copy(),
        }

    def _state(self) -> dict[str, Any]:
        return {
            "seed": np.array(self.scene.simulation.seed),
            "goal": self._goal.copy(),
            "goal_draws": self._stream.counters.copy(),
            "goals_reached": self._goals_reached.copy(),
            "start_distance": self._start_distance.copy(),
            "simulation": self.scene.simulation.snapshot(),
            **({} if self._starts is None else self._starts.get_state()),
        }

    def _set_state(self, state: dict[str, Any]) -> None:
        self._seed(int(state["seed"]))
        self.scene.simulation.restore(bytes(state["simulation"]))
        self._stream.counters[:] = state["goal_draws"]
        self._goal[:] = state["goal"]
        self._goals_reached[:] = state["goals_reached"]
        self._start_distance[:] = state["start_distance"]
        if self._starts is not None:
            self._starts.set_state(state)


def _action_space(*, continuous: bool) -> gym.Space[Any]:
    if continuous:
        return gym.spaces.Box(-1.0, 1.0, (2,), np.float32)
    return gym.spaces.Discrete(ACTIONS)


def _distance_max(rules: Rules, settings: NavigationSettings, goals: GoalTable) -> float:
    """Return the longest distance to a goal [m]; without bound in a world of the user's."""
    if settings.world is not None:
        return float("inf")
    farthest = float(np.hypot(*goals.points.T).max())
    return max(rules.arena_diagonal, farthest + rules.arena_diagonal / 2.0)

"""The TurtleBot3 tasks on the planar engine, from action to observation in native code."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.envs.batched_task import Bool, Float32, Info, Verdict, Worlds
from gazelle.envs.options import NavigationSettings
from gazelle.envs.planar.swift import Swift
from gazelle.envs.turtlebot3 import kernels_judge
from gazelle.envs.turtlebot3.actions import ACTIONS, ANGULAR_STEP
from gazelle.envs.turtlebot3.observations import Sight
from gazelle.envs.turtlebot3.rules import Rules
from gazelle.envs.turtlebot3.task import TurtleBot3Task

Floats = NDArray[np.float64]


class SwiftTurtleBot3Task(TurtleBot3Task):
    """`TurtleBot3Task` on the planar engine: the same results, a hundred times as fast.

    It steps the same simulation with the same random numbers; where a user's world or robot has
    more to it than wheels, scripted bodies and one plain lidar, it does what its parent does.
    """

    def __init__(
        self, stage: int, nworld: int, *, continuous: bool, settings: NavigationSettings
    ) -> None:
        self._swift: Swift | None = None
        self._bound: object = None
        super().__init__(stage, nworld, continuous=continuous, settings=settings)
        size = self.observation_space.shape[0]
        self._rules = _row_of(self.rules)
        self._size = size
        self._distance, self._heading = np.zeros(nworld), np.zeros(nworld)
        self._nearest = np.zeros(nworld)
        self._everywhere = np.arange(nworld)
        self._seen, self._reward = np.zeros((nworld, size), np.float32), np.zeros(nworld)
        self._crashed, self._arrived = np.zeros((2, nworld), np.bool_)
        self._acts: tuple[Swift, tuple[Any, ...], tuple[Any, ...]] | None = None

    @property
    def swift(self) -> Swift | None:
        """What steps the simulation; None if it is stepped part by part."""
        return self._swift

    def _seed(self, seed: int) -> None:
        super()._seed(seed)
        scene = self.scene
        if self._bound is scene.simulation:
            if self._swift is not None:
                self._swift.pull()
            return
        self._bound = scene.simulation
        self._swift = Swift.of(
            scene.robot, scene.lidar.sensor, self.control_period, self.rules.range_max
        )
        scene.restart(seed)
        if self._swift is not None:
            self._swift.pull()

    def _begin(self, worlds: Worlds) -> None:
        if self._swift is None:
            super()._begin(worlds)
            return
        self._swift.begin(worlds)
        self._new_goals(worlds)

    def _look(self, worlds: Worlds) -> tuple[Float32, Info]:
        if self._swift is None:
            return super()._look(worlds)
        observation = np.zeros((len(worlds), self._size), np.float32)
        swift = self._swift
        cleaned = swift.measure(
            worlds, kernels_judge.look, self._observing(swift, worlds, observation)
        )
        seen = self._sight(cleaned, len(worlds))
        self._set_start(worlds, seen.distance)
        no = np.zeros(len(worlds), dtype=np.bool_)
        return observation, self._info(seen, worlds, arrived=no, crashed=no)

    def _act(self, actions: ArrayLike) -> Verdict:
        swift = self._swift
        if swift is None:
            return super()._act(actions)
        linear, angular = self._command(actions)
        swift.step(linear, angular, kernels_judge.act, *self._acting(swift))
        return self._verdict(
            self._seen.copy(), self._reward.copy(), self._crashed.copy(), self._arrived.copy()
        )

    def _acting(self, swift: Swift) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
        """What ``kernels_judge.act`` takes besides what ``Swift.step`` hands it."""
        if self._acts is None or self._acts[0] is not swift:
            judging = (
                self._distance, self._heading, self._nearest, swift.angular, ANGULAR_STEP,
                (ACTIONS - 1) / 2, self._start_distance, self._rules, self._reward,
                self._crashed, self._arrived,
            )  # fmt: skip
            observing = self._observing(swift, self._everywhere, self._seen)
            self._acts = (swift, observing, judging)
        return self._acts[1:]

    def _verdict(
        self, observation: Float32, reward: Floats, crashed: Bool, arrived: Bool
    ) -> Verdict:
        seen, everywhere = self._sight(observation, self.nworld), self._everywhere
        self._goals_reached += arrived
        if self.respawn and arrived.any():
            self._next_goals(np.flatnonzero(arrived))
        terminated = crashed if self.respawn else crashed | arrived
        info = self._info(seen, everywhere, arrived=arrived, crashed=crashed & ~arrived)
        return Verdict(observation, reward, terminated, info)

    def _see_distance(self, worlds: Worlds) -> Floats:
        if self._swift is None:
            return super()._see_distance(worlds)
        return self._distance_at(self._swift.poses(worlds)[0], worlds)

    def _observing(self, swift: Swift, worlds: Worlds, observation: Float32) -> tuple[Any, ...]:
        """What ``kernels_judge.observe`` takes after the range of worlds."""
        return (
            worlds, swift.cleaned, swift.fleet.rows, swift.fleet.nbody, swift.body,
            self.goals.points, self._goal, self._rules, observation, self._distance,
            self._heading, self._nearest,
        )  # fmt: skip

    def _sight(self, ranges: NDArray[Any], count: int) -> Sight:
        """What was seen, in arrays of its own."""
        return Sight(
            ranges,
            self._nearest[:count],
            np.zeros(0, np.intp),
            self._distance[:count].copy(),
            self._heading[:count].copy(),
        )

    def _state(self) -> dict[str, Any]:
        if self._swift is not None:
            self._swift.push()
        return super()._state()

    def _set_state(self, state: dict[str, Any]) -> None:
        super()._set_state(state)
        if self._swift is not None:
            self._swift.pull()


def _row_of(rules: Rules) -> Floats:
    row = np.zeros(7)
    row[kernels_judge.COLLISION_RANGE] = rules.collision_range
    row[kernels_judge.GOAL_DISTANCE] = rules.goal_distance
    row[kernels_judge.GOAL_REWARD] = rules.goal_reward
    row[kernels_judge.COLLISION_REWARD] = rules.collision_reward
    row[kernels_judge.OBSTACLE_RANGE] = rules.obstacle_range
    row[kernels_judge.OBSTACLE_REWARD] = rules.obstacle_reward
    row[kernels_judge.SEES_OBSTACLE] = rules.sees_obstacle
    return row


def make_task(
    stage: int, nworld: int, *, continuous: bool, settings: NavigationSettings
) -> TurtleBot3Task:
    """The task on the engine that the settings ask for."""
    kind = SwiftTurtleBot3Task if settings.engine == "planar" else TurtleBot3Task
    return kind(stage, nworld, continuous=continuous, settings=settings)

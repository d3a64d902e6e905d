"""The TurtleBot3 tasks on the planar engine, from action to observation in native code."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Floats, Floats32, Worlds
from gazelle.envs.batched_task import SCENARIO, Info, Step, Transition
from gazelle.envs.options import NavigationSettings
from gazelle.envs.planar.swift import Swift
from gazelle.envs.turtlebot3 import kernels_judge, kernels_step
from gazelle.envs.turtlebot3.actions import ACTIONS, ANGULAR_STEP
from gazelle.envs.turtlebot3.observations import Sight
from gazelle.envs.turtlebot3.outcome import Outcome
from gazelle.envs.turtlebot3.rules import Rules
from gazelle.envs.turtlebot3.task import TurtleBot3Task

_NOTHING, _NOWHERE = np.zeros((0, 0)), np.zeros(0, np.intp)


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
        self._rules = _row_of(self.rules)
        self._outcome = Outcome(nworld, self.observation_space.shape[0])
        self._goals_reached = self._outcome.counts[kernels_step.NOW]
        self._everywhere = np.arange(nworld)
        self._kept: tuple[object, tuple[Any, ...]] = (None, ())

    @property
    def _draws_anew(self) -> bool:
        """Whether a goal is drawn for each episode, and then for each one reached in it."""
        return self.respawn and not self._keeps_goals

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
        self._vary(worlds)
        if self._starts is not None:
            self._swift.take_paths(worlds)

    def _look(self, worlds: Worlds) -> tuple[Floats32, Info]:
        if self._swift is None:
            return super()._look(worlds)
        observation = np.zeros((len(worlds), self._outcome.observation.shape[1]), np.float32)
        swift = self._swift
        swift.measure(worlds, kernels_judge.look, self._observing(swift, worlds, observation))
        seen = self._sight(len(worlds))
        self._set_start(worlds, seen.distance)
        no = np.zeros(len(worlds), dtype=np.bool_)
        return observation, self._info(seen, worlds, arrived=no, crashed=no)

    def advance(self, actions: ArrayLike) -> Transition:
        """See `BatchedTask.advance`."""
        if self._swift is None:
            return super().advance(actions)
        return self._run(self._swift, actions, goes_on=False).transition

    def step(self, actions: ArrayLike) -> Step:
        """See `BatchedTask.step`."""
        if self._swift is None or self._starts is not None or self._draws_anew:
            return super().step(actions)
        step = self._run(self._swift, actions, goes_on=True)
        if step.finals is not None:
            scenario = self.scenario(step.finals.worlds)
            step.transition.info[SCENARIO] = np.zeros((self.nworld, scenario.shape[1]))
            step.transition.info[SCENARIO][step.finals.worlds] = scenario
        return step

    def _run(self, swift: Swift, actions: ArrayLike, *, goes_on: bool) -> Step:
        """A control step in native code, with the next episodes where it goes on."""
        swift.step(*self._command(actions), kernels_step.step, *self._arguments(swift), goes_on)
        return self._outcome.step(timed=self.max_episode_steps is not None)

    def _arguments(self, swift: Swift) -> tuple[Any, ...]:
        """What ``kernels_step.step`` takes after what is measured, but for the last."""
        if self._kept[0] is not self._stream:  # which a seed makes anew
            made, goals, fleet = self._outcome, self.goals, swift.fleet
            judging = (
                *made.numbers[kernels_step.NOW], made.nearest, swift.angular, ANGULAR_STEP,
                (ACTIONS - 1) / 2, self._start_distance, self._rules, made.reward, made.crashed,
                made.arrived,
            )  # fmt: skip
            stepping = (
                self._observing(swift, self._everywhere, made.observation), judging,
                swift.starting, fleet.rows, fleet.nbody, swift.body, goals.points,
                self._goal, goals.start, self.elapsed, self.max_episode_steps or 0, self.respawn,
                goals.counts, goals.successors, self._stream.keys, self._stream.counters,
                self._start_distance, made.crashed, made.arrived, made.observation,
                made.last_observation, made.ends, made.how, made.numbers, made.counts,
                made.points,
            )  # fmt: skip
            self._kept = (self._stream, stepping)
        return self._kept[1]

    def _observing(self, swift: Swift, worlds: Worlds, observation: Floats32) -> tuple[Any, ...]:
        """What ``kernels_judge.observe`` takes after the range of worlds."""
        made = self._outcome
        return (
            worlds, swift.cleaned, swift.fleet.rows, swift.fleet.nbody, swift.body,
            self.goals.points, self._goal, self._rules, observation,
            *made.numbers[kernels_step.NOW], made.nearest,
        )  # fmt: skip

    def _sight(self, count: int) -> Sight:
        """What was seen last, but for the ranges, in arrays of its own."""
        distance, heading = self._outcome.numbers[kernels_step.NOW, :, :count].copy()
        return Sight(_NOTHING, self._outcome.nearest[:count], _NOWHERE, distance, heading)

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

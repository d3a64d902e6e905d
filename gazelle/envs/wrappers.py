"""Tasks that change what another one shows or does: frames, time, delays, smoothing.

They wrap a task in all its worlds at once, so single and vector environments, every way of
autoreset, saved states, copies and pickles work as without them::

    env = wrapped(gym.make_vec("gazelle/CartPoleStayUp-v0", ...), FrameStackTask, count=4)
    env = TaskVectorEnv(ActionDelayTask(FrameStackTask(MyTask(64), 4), 2))
"""

from __future__ import annotations

from typing import Any

import gymnasium as gym
import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.array_types import Floats, Floats32, Worlds
from gazelle.envs.batched_task import SCENARIO, BatchedTask, Info, TaskOutcome
from gazelle.envs.floor_plan import FloorPlan
from gazelle.envs.options import check_integer
from gazelle.envs.single_env import TaskEnv
from gazelle.envs.vector_env import TaskVectorEnv
from gazelle.errors import TaskError

_INNER = "task/"


class TaskWrapper(BatchedTask):
    """Wrapper of a task; a subclass overrides what it changes.

    Args:
        task: The other one; this one closes it.

    Raises:
        TaskError: It shows something else than an array.

    Attributes:
        task: The other one.
        memory: Arrays that this one keeps between steps, by name, worlds first.
    """

    def __init__(self, task: BatchedTask) -> None:
        super().__init__(task.nworld, task.max_episode_steps)
        if not isinstance(task.observation_space, gym.spaces.Box):
            raise TaskError(f"{type(self).__name__} is for observations that are arrays")
        self.task = task
        self.observation_space = task.observation_space
        self.action_space = task.action_space
        self.control_period = task.control_period
        self.memory: dict[str, NDArray[Any]] = {}
        self._first: tuple[Floats32, Info] | None = None

    def changed_actions(self, actions: ArrayLike) -> ArrayLike:
        """Return the actions for the other task in place of these, shape (nworld, ...)."""
        return actions

    def changed_observation(self, observation: Floats32) -> Floats32:
        """Return the observation after a step in place of this, shape (nworld, ...)."""
        return observation

    def first_observation(self, observation: Floats32, worlds: Worlds) -> Floats32:
        """Return the observation in place of this where episodes begin, shape (n, ...)."""
        del worlds
        return observation

    def scenario(self, worlds: Worlds) -> Floats | None:
        """Return the scenario of the wrapped task."""
        return self.task.scenario(worlds)

    @property
    def scenario_names(self) -> tuple[str, ...]:  # type: ignore[override]  # the other task's
        """Names of the wrapped task's numbers."""
        return self.task.scenario_names

    @property
    def goal_places(self) -> Floats | None:
        """Goals of the wrapped task."""
        return self.task.goal_places

    @property
    def floor_plan(self) -> FloorPlan | None:  # type: ignore[override]  # the other task's
        """Floor plan of the wrapped task."""
        return self.task.floor_plan

    def render(self, world: int) -> NDArray[np.uint8]:
        """Return a picture of one world."""
        return self.task.render(world)

    def close(self) -> None:
        """Close the other task; a second call does nothing."""
        self.task.close()

    def _seed(self, seed: int) -> None:
        self.task.seed(seed)

    def _begin(self, worlds: Worlds) -> None:
        self._first = self.task.begin(worlds)

    def _look(self, worlds: Worlds) -> tuple[Floats32, Info]:
        assert self._first is not None  # `begin` calls `_begin` before this
        observation, info = self._first
        self._first = None
        info = {name: values for name, values in info.items() if name != SCENARIO}
        return self.first_observation(observation, worlds), info

    def _act(self, actions: ArrayLike) -> TaskOutcome:
        came = self.task.advance(self.changed_actions(actions))
        return TaskOutcome(
            self.changed_observation(came.observation), came.reward, came.terminated, came.info
        )

    def _hold(self, worlds: Worlds) -> Any:
        return self.task._hold(worlds)  # noqa: SLF001  # a task as this one is

    def _release(self, worlds: Worlds, kept: Any) -> None:
        self.task._release(worlds, kept)  # noqa: SLF001  # a task as this one is

    def _state(self) -> dict[str, Any]:
        inner = {_INNER + name: value for name, value in self.task.get_state().items()}
        return inner | {name: array.copy() for name, array in self.memory.items()}

    def _set_state(self, state: dict[str, Any]) -> None:
        inner = {
            name.removeprefix(_INNER): value
            for name, value in state.items()
            if name.startswith(_INNER)
        }
        self.task.set_state(inner)
        for name, array in self.memory.items():
            array[:] = state[name]


class FrameStackTask(TaskWrapper):
    """Shows the last observations side by side, the oldest first; at first all are the first one.

    `gymnasium.wrappers.FrameStackObservation` does this for single environments, in one more axis.

    Args:
        task: Task to wrap.
        count: Number of observations, 1 or more.
    """

    def __init__(self, task: BatchedTask, count: int) -> None:
        super().__init__(task)
        check_integer("count", count, 1)
        space = task.observation_space
        low, high = np.tile(space.low.reshape(-1), count), np.tile(space.high.reshape(-1), count)
        self.observation_space = gym.spaces.Box(low, high, dtype=np.float32)
        size = space.low.size
        self.memory["frames"] = np.zeros((task.nworld, count, size), np.float32)

    def changed_observation(self, observation: Floats32) -> Floats32:
        """Return the last frames, shape (nworld, count * size)."""
        frames = self.memory["frames"]
        frames[:, :-1] = frames[:, 1:]
        frames[:, -1] = observation.reshape(self.nworld, -1)
        seen: Floats32 = frames.reshape(self.nworld, -1).copy()
        return seen

    def first_observation(self, observation: Floats32, worlds: Worlds) -> Floats32:
        """Return the first frame over and over, shape (n, count * size)."""
        frames = self.memory["frames"]
        frames[worlds] = observation.reshape(len(worlds), 1, -1)
        seen: Floats32 = frames[worlds].reshape(len(worlds), -1)
        return seen


class TimeAwareTask(TaskWrapper):
    """Shows at the end of each observation which share of the episode's time is over, 0 to 1.

    Where an episode is truncated after a number of steps, what it is worth depends on that (Pardo et al. 2018,
    arXiv 1712.00378).

    Args:
        task: Task to wrap.

    Raises:
        TaskError: It has no step limit, or its observations are no vectors.
    """

    def __init__(self, task: BatchedTask) -> None:
        super().__init__(task)
        space = task.observation_space
        if task.max_episode_steps is None or len(space.shape) != 1:
            raise TaskError(
                "TimeAwareTask is for tasks with a step limit and vectors as observations",
                hint="give the task max_episode_steps",
            )
        low, high = np.append(space.low, 0.0), np.append(space.high, 1.0)
        self.observation_space = gym.spaces.Box(
            low.astype(np.float32), high.astype(np.float32), dtype=np.float32
        )

    def changed_observation(self, observation: Floats32) -> Floats32:
        """Return observations with the share of the time appended, shape (nworld, size + 1)."""
        # The base class counts this step only after it.
        return self._with_share(observation, self.elapsed + 1)

    def first_observation(self, observation: Floats32, worlds: Worlds) -> Floats32:
        """Return observations with the share of the time appended, shape (n, size + 1)."""
        return self._with_share(observation, np.zeros(len(worlds), np.int64))

    def _with_share(self, observation: Floats32, steps: NDArray[np.int64]) -> Floats32:
        limit = self.max_episode_steps or 1
        return np.column_stack((observation, (steps / limit).astype(np.float32)))


class ObservationDelayTask(TaskWrapper):
    """Shows what was seen some steps ago, and until then the first observation; rewards are not delayed.

    Args:
        task: Task to wrap.
        steps: Number of control steps, 0 or more.
    """

    def __init__(self, task: BatchedTask, steps: int) -> None:
        super().__init__(task)
        check_integer("steps", steps, 0)
        shape = (task.nworld, steps + 1, *task.observation_space.shape)
        self.memory["seen"] = np.zeros(shape, np.float32)

    def changed_observation(self, observation: Floats32) -> Floats32:
        """Return the one of some steps ago, shape (nworld, ...)."""
        seen = self.memory["seen"]
        seen[:, :-1] = seen[:, 1:]
        seen[:, -1] = observation
        old: Floats32 = seen[:, 0].copy()
        return old

    def first_observation(self, observation: Floats32, worlds: Worlds) -> Floats32:
        """Return the observation unchanged."""
        self.memory["seen"][worlds] = observation[:, None]
        return observation


class ActionDelayTask(TaskWrapper):
    """Does each action some steps later, and until then an idle one.

    Args:
        task: Task to wrap.
        steps: Number of control steps, 0 or more.
        idle: First action; None for the one nearest to zeros.

    Raises:
        TaskError: The idle action is none of the task's.
    """

    def __init__(self, task: BatchedTask, steps: int, idle: ArrayLike | None = None) -> None:
        super().__init__(task)
        check_integer("steps", steps, 0)
        self._idle = np.asarray(_still(task.action_space) if idle is None else idle)
        self._idle = self._idle.astype(task.action_space.dtype or np.float64)
        if not task.action_space.contains(_plain(task.action_space, self._idle)):
            raise TaskError(f"the idle action {idle!r} is not in {task.action_space}")
        shape = (task.nworld, steps + 1, *self._idle.shape)
        self.memory["waiting"] = np.broadcast_to(self._idle, shape).copy()

    def changed_actions(self, actions: ArrayLike) -> ArrayLike:
        """Return the actions of some steps ago."""
        waiting = self.memory["waiting"]
        waiting[:, :-1] = waiting[:, 1:]
        waiting[:, -1] = actions
        return waiting[:, 0].copy()

    def first_observation(self, observation: Floats32, worlds: Worlds) -> Floats32:
        """Return the observation unchanged; no action is delayed yet."""
        self.memory["waiting"][worlds] = self._idle
        return observation


class ActionSmoothingTask(TaskWrapper):
    """Does a moving average of actions: ``weight`` of the new one, the rest of what was done before.

    Args:
        task: Task to wrap; its actions must be real numbers.
        weight: Above 0 and up to 1, which changes nothing.

    Raises:
        TaskError: Actions are not real numbers, or the weight is invalid.
    """

    def __init__(self, task: BatchedTask, weight: float) -> None:
        super().__init__(task)
        if not isinstance(task.action_space, gym.spaces.Box):
            raise TaskError("ActionSmoothingTask is for tasks with real numbers as actions")
        if not 0.0 < weight <= 1.0:
            raise TaskError(f"weight must be above 0 and up to 1, not {weight!r}")
        self._weight = weight
        self._still = np.asarray(_still(task.action_space), np.float64)
        self.memory["done"] = np.broadcast_to(self._still, (task.nworld, *self._still.shape)).copy()

    def changed_actions(self, actions: ArrayLike) -> ArrayLike:
        """Return the moving average."""
        done = self.memory["done"]
        done += self._weight * (np.asarray(actions, np.float64) - done)
        return done.copy()

    def first_observation(self, observation: Floats32, worlds: Worlds) -> Floats32:
        """Return the observation unchanged; the average starts over."""
        self.memory["done"][worlds] = self._still
        return observation


def wrapped(
    env: gym.Env[Any, Any] | gym.vector.VectorEnv[Any, Any, Any],
    kind: type[TaskWrapper],
    **options: Any,
) -> TaskEnv | TaskVectorEnv:
    """Return a fresh environment of an environment's task with something around it.

    Args:
        env: Of a task of Gazelle's kind, single or vector, wrapped by Gymnasium or not. It is not to
            be used any more.
        kind: Class of the wrapper.
        options: Its arguments.

    Raises:
        TaskError: It is no environment of a `BatchedTask`.
    """
    inner = env.unwrapped
    if not isinstance(inner, TaskEnv | TaskVectorEnv):
        raise TaskError(f"{inner} is not an environment of a BatchedTask")
    spec, task = env.spec, inner.task
    if task.max_episode_steps is None and spec is not None:
        task.max_episode_steps = spec.max_episode_steps  # Gymnasium's TimeLimit knew it
    around = kind(task, **options)
    if isinstance(inner, TaskVectorEnv):
        mode = inner.autoreset_mode
        return TaskVectorEnv(around, render_mode=inner.render_mode, autoreset_mode=mode)
    return TaskEnv(around, render_mode=inner.render_mode)


def _still(space: gym.Space[Any]) -> ArrayLike:
    """Return the action nearest to zeros."""
    if isinstance(space, gym.spaces.Box):
        return np.clip(np.zeros(space.shape), space.low, space.high)
    if isinstance(space, gym.spaces.Discrete):
        return int(space.start)
    raise TaskError(f"say which action is idle: {space}", hint="with idle=...")


def _plain(space: gym.Space[Any], action: NDArray[Any]) -> Any:
    return action.item() if isinstance(space, gym.spaces.Discrete) else action

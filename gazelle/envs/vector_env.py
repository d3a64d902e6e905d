"""A batched task as a Gymnasium vector environment."""

from __future__ import annotations

from typing import Any, ClassVar

import gymnasium as gym
import numpy as np
from gymnasium.vector import AutoresetMode
from gymnasium.vector.utils import batch_space
from numpy.typing import ArrayLike, NDArray

from gazelle.array_types import Bools, Floats, Floats32, Worlds
from gazelle.envs.autoreset import autoreset_mode as mode_of
from gazelle.envs.batched_task import BatchedTask, BatchStep, FinalObservations, Info
from gazelle.envs.contract import PolicyContract
from gazelle.envs.errors import ResetNeededError, check_open, check_ready
from gazelle.envs.floor_plan import FloorPlan
from gazelle.envs.options import RENDER_MODES, check_name, checked_mapping, checked_seed
from gazelle.errors import TaskError


class TaskVectorEnv(gym.vector.VectorEnv[Any, Any, NDArray[Any]]):
    """A batched task as a Gymnasium vector environment.

    What happens where an episode ends is said by ``autoreset_mode``, as Gymnasium defines it:

    - ``SameStep``, the default: the next one begins in the same step, which returns its first
      observation; ``info["final_obs"]`` is the last one of the old, and ``info["final_info"]``
      its info, each with a mask (``_final_obs``, ``_final_info``) of the worlds it holds for.
    - ``NextStep``: the step returns the last observation. The next step begins the next episode
      there instead of doing the action, with a reward of 0. What comes after is the same.
    - ``Disabled``: ``reset(options={"reset_mask": mask})`` begins it, before the next step.

    It can be pickled and copied, and both continue with the same future.

    Args:
        task: Task to wrap; the environment closes it.
        seed: Of the first episodes when ``reset`` gets none.
        render_mode: ``rgb_array``, or None.
        autoreset_mode: One of Gymnasium's, or its name.

    Raises:
        TaskError: There is no such mode.

    Attributes:
        control_period: Simulated time of one step [s].
    """

    metadata: ClassVar[dict[str, Any]] = {  # type: ignore[misc]  # Gymnasium leaves out ClassVar
        "render_modes": list(RENDER_MODES),
        "autoreset_mode": AutoresetMode.SAME_STEP,
    }

    def __init__(
        self,
        task: BatchedTask,
        *,
        seed: int | None = None,
        render_mode: str | None = None,
        autoreset_mode: AutoresetMode | str = AutoresetMode.SAME_STEP,
    ) -> None:
        self.autoreset_mode = mode_of(autoreset_mode)
        self.task = task
        self.num_envs = task.nworld
        self.single_observation_space = task.observation_space
        self.single_action_space = task.action_space
        self.observation_space = batch_space(task.observation_space, task.nworld)
        self.action_space = batch_space(task.action_space, task.nworld)
        self.control_period = task.control_period
        self.render_mode = render_mode
        self.metadata = {  # type: ignore[misc]
            **type(self).metadata,
            "render_fps": 1.0 / task.control_period,
            "autoreset_mode": self.autoreset_mode,
        }
        self._first_seed = seed
        self._begun = False
        self._over = np.zeros(task.nworld, np.bool_)
        self._observation: Any = np.zeros(
            (task.nworld, *task.row_space.shape), task.row_space.dtype
        )

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Floats32, dict[str, Any]]:
        """Start new episodes.

        Args:
            seed: Starts all random numbers over. What world i meets depends on the seed, on i
                and on what was done in world i alone, never on ``num_envs``.
            options: ``{"reset_mask": mask}``, booleans of shape (num_envs,), resets only some.

        Raises:
            TaskError: An option that does not exist, or a mask of the wrong shape.
            ClosedEnvError: The environment is closed.
        """
        check_open("reset()", closed=self.closed)
        mapping = checked_mapping("reset options", options)
        for name in mapping:
            check_name("reset option", name, ["reset_mask"])
        worlds = _masked(mapping.get("reset_mask"), self.num_envs)
        if seed is None and self._np_random is None:
            seed = self._first_seed if self._first_seed is not None else _fresh_seed()
        if seed is not None:
            number = checked_seed(seed)
            super().reset(seed=number)
            self.task.seed(number)
        observation, info = self.task.begin(worlds)
        self._begun = True
        self._over[worlds] = False
        self._observation[worlds] = observation
        return self._observation.copy(), self._spread(info, worlds)

    def step(self, actions: ArrayLike) -> tuple[Floats32, Floats, Bools, Bools, dict[str, Any]]:
        """Step every world, and start over where an episode ended.

        Args:
            actions: Shape (num_envs, ...).

        Raises:
            TaskError: The actions have the wrong shape or values.
            ResetNeededError: Nothing was reset yet, or with ``Disabled`` a world with its episode
                over was not.
            ClosedEnvError: The environment is closed.
        """
        self.check_ready("step()")
        step = self._step(actions)
        result, final = step.transition, step.final
        self._observation = result.observation
        masks = np.ones((len(result.info), self.num_envs), dtype=np.bool_)
        names = (f"_{name}" for name in result.info)
        return (
            result.observation.copy(),
            result.reward,
            result.terminated,
            result.truncated,
            {
                **result.info,
                **dict(zip(names, masks, strict=True)),
                **({} if final is None else _final_infos(final, self.num_envs)),
            },
        )

    def check_ready(self, what: str) -> None:
        """Raise an error unless episodes continue.

        Raises:
            ResetNeededError: Nothing was reset yet.
            ClosedEnvError: The environment is closed.
        """
        check_ready(what, closed=self.closed, begun=self._begun)

    def _step(self, actions: ArrayLike) -> BatchStep:
        """Step the environment in its autoreset mode."""
        if self.autoreset_mode is AutoresetMode.SAME_STEP:
            return self.task.step(actions)
        over = np.flatnonzero(self._over)
        if self.autoreset_mode is AutoresetMode.DISABLED and len(over):
            raise ResetNeededError(
                f"the episode of world {over[0]} is over",
                hint='with autoreset_mode="Disabled" call reset(options={"reset_mask": mask}) first',
            )
        result = self.task.advance_or_begin(actions, over)
        self._over = result.terminated | result.truncated
        return BatchStep(result, None)

    @property
    def scenario_names(self) -> tuple[str, ...]:
        """Names of the numbers in ``info["scenario"]``, see `BatchedTask.scenario`."""
        return self.task.scenario_names

    @property
    def floor_plan(self) -> FloorPlan | None:
        """Obstacles of the world, seen from above; None if unknown."""
        return self.task.floor_plan

    @property
    def contract(self) -> PolicyContract:
        """Contract of this task's policies, see `BatchedTask.contract`."""
        return self.task.contract

    def render(self) -> tuple[NDArray[np.uint8], ...] | None:
        """Return a picture of every world, (height, width, 3) each; None without render mode."""
        check_open("render()", closed=self.closed)
        if self.render_mode is None:
            return None
        return tuple(self.task.render(world) for world in range(self.num_envs))

    def get_state(self) -> dict[str, Any]:
        """Return the whole state, a dict of arrays and bytes, for an exact continuation.

        Raises:
            ClosedEnvError: The environment is closed.
        """
        check_open("get_state()", closed=self.closed)
        return {**self.task.get_state(), "over": self._over.copy()}

    def set_state(self, state: dict[str, Any]) -> None:
        """Restore what ``get_state`` returned, in an environment made with the same options.

        Raises:
            TaskError: The state is of another task or number of worlds.
            ClosedEnvError: The environment is closed.
        """
        check_open("set_state()", closed=self.closed)
        over = np.asarray(state.get("over", self._over & False))
        if over.shape != self._over.shape:
            raise TaskError(f"the state is of {over.size} worlds, and there are {self.num_envs}")
        self.task.set_state(state)
        self._over[:] = over
        self._begun = True
        if self._np_random is None:
            super().reset(seed=int(state["seed"]) if "seed" in state else 0)

    def close_extras(self, **kwargs: Any) -> None:
        """Free the simulation."""
        del kwargs
        self.task.close()

    def _spread(self, info: Info, worlds: Worlds) -> dict[str, Any]:
        """Return info of some worlds as arrays over all, each with the mask of its worlds."""
        if len(worlds) == self.num_envs:
            mask = np.ones(self.num_envs, dtype=np.bool_)
            return {**info, **{f"_{name}": mask.copy() for name in info}}
        spread: dict[str, Any] = {}
        for name, values in info.items():
            whole = np.zeros((self.num_envs, *values.shape[1:]), dtype=values.dtype)
            whole[worlds] = values
            spread[name] = whole
            spread[f"_{name}"] = np.zeros(self.num_envs, dtype=np.bool_)
            spread[f"_{name}"][worlds] = True
        return spread


def _final_infos(final: FinalObservations, nworld: int) -> dict[str, Any]:
    """Return ``final_obs`` and ``final_info`` as in Gymnasium's vector environments."""
    observation = np.empty(nworld, dtype=np.object_)  # None where nothing is set
    observation[final.worlds] = np.fromiter(
        final.observation, dtype=np.object_, count=len(final.worlds)
    )
    ended = np.zeros(nworld, dtype=np.bool_)
    ended[final.worlds] = True
    masks = np.empty((len(final.info) + 2, nworld), dtype=np.bool_)
    masks[:] = ended
    names = (f"_{name}" for name in final.info)
    return {
        "final_obs": observation,
        "_final_obs": masks[0],
        "final_info": {**final.info, **dict(zip(names, masks[2:], strict=True))},
        "_final_info": masks[1],
    }


def _masked(mask: object, nworld: int) -> Worlds:
    """Return the worlds of a reset mask; all without one."""
    if mask is None:
        return np.arange(nworld)
    array = np.asarray(mask)
    if array.shape != (nworld,) or array.dtype != np.bool_ or not array.any():
        raise TaskError(
            f"reset_mask must hold {nworld} booleans, at least one of them True, not {mask!r}"
        )
    return np.flatnonzero(array)


def _fresh_seed() -> int:
    """Return a seed from the operating system's entropy."""
    return int(np.random.SeedSequence().generate_state(1)[0])

"""A trained policy at work, step by step, to be looked at."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from gazelle.array_types import Picture
from gazelle.errors import TaskError
from gazelle.training.actor import Actor
from gazelle.training.evaluation import resolve_policy
from gazelle.training.importing import load_all
from gazelle.training.stepper import Stepper
from gazelle.training.tasks import control_period, make_task
from gazelle_ros.base.closing import Closeable


class Playback(Closeable):
    """One episode after another of a policy that acts at its best.

    Args:
        run_or_policy: Folder of a run, a ``policy.npz``, or an actor.
        seed: Of the environment.
        task: The task; needed unless a run names it.
        imports: Modules or files to import first, which register the task.
        trust: Whether to import modules that the run names and ``imports`` does not.
        options: Of the environment, as ``evaluate`` takes them.

    Attributes:
        period: Simulated time of a step [s].

    Raises:
        TaskError: There is no such task, or it draws no pictures.
        FormatError: The policy is damaged.
    """

    def __init__(
        self,
        run_or_policy: str | Path | Actor,
        *,
        seed: int = 10_000,
        task: str | None = None,
        imports: Sequence[str] = (),
        trust: bool = False,
        **options: Any,
    ) -> None:
        self._actor, name, known = resolve_policy(
            run_or_policy,
            task,
            load_all(imports),
            {**options, "render_mode": "rgb_array"},
            trust=trust,
        )
        self._env = make_task(name, 1, **known)
        self.period = control_period(self._env) or 0.1
        self._stepper = Stepper(self._env)
        self._obs = self._stepper.reset(seed=seed)
        self._memory = self._actor.begin(1)

    def step(self) -> None:
        """Run the policy for one step; a new episode starts where one is over."""
        step = self._stepper.step(self._actor.act(self._obs, memory=self._memory))
        if self._memory is not None:
            self._memory.forget(step.begun)
        self._obs = step.obs

    def render(self) -> Picture:
        """Render the environment as it is now, shape (height, width, 3).

        Raises:
            TaskError: It draws nothing.
        """
        drawn = self._env.render()
        if not drawn:
            raise TaskError("this task draws no pictures", hint='it needs render_mode="rgb_array"')
        return np.asarray(drawn[0], np.uint8)

    def close(self) -> None:
        """Free the simulation."""
        self._env.close()

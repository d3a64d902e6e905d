"""Plan of a hyperparameter search, read from a file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from gazelle.errors import FormatError, TaskError, did_you_mean
from gazelle_ros.base import bounded_yaml
from gazelle_ros.base.text_files import read_text

METRICS = ("success", "return")
_KEYS = {"parameters", "trials", "workers", "steps", "episodes", "metric", "algo", "seed"}


@dataclass(frozen=True, kw_only=True)
class SweepPlan:
    """Plan of a hyperparameter search."""

    parameters: dict[str, dict[str, Any]]
    """By the name of a recipe's value, see `with_values`: ``{"choices": [...]}`` or
    ``{"low": a, "high": b}``, with ``"log": true`` for steps of equal ratio. Ints stay ints."""
    trials: int = 20
    """Number of all trials."""
    workers: int = 1
    """Processes."""
    steps: int | None = None
    """Control steps of each training; None for those of the recipe."""
    episodes: int = 100
    """Of each evaluation."""
    metric: str = "success"
    """``success`` (share of goals) or ``return`` (mean of episodes), the more the better."""
    algo: str | None = None
    """Algorithm; None for that of the recipe."""
    seed: int = 0
    """Of the first trial's training; the next ones have the next."""

    @classmethod
    def read(cls, file: Path) -> SweepPlan:
        """Read a plan from YAML or JSON.

        Raises:
            FormatError: The file cannot be read, or says something that is impossible.
        """
        try:
            values = bounded_yaml.safe_load(read_text(file))
        except (OSError, yaml.YAMLError) as error:
            raise FormatError(f"cannot read the sweep: {error}", file=str(file)) from error
        if not isinstance(values, dict) or not isinstance(values.get("parameters"), dict):
            hint = "expected 'parameters:' with low and high, or choices, of each"
            raise FormatError("this is not a sweep", file=str(file), hint=hint)
        for key in values:
            if key not in _KEYS:
                hint = did_you_mean(str(key), _KEYS)
                raise FormatError(f"a sweep has no '{key}'", file=str(file), hint=hint)
        try:
            plan = cls(**values)
            plan.check()
        except (TaskError, TypeError) as error:
            raise FormatError(f"this sweep is invalid: {error}", file=str(file)) from error
        return plan

    def check(self) -> None:
        """Check that the plan is feasible.

        Raises:
            TaskError: It cannot.
        """
        if self.metric not in METRICS:
            raise TaskError(f"no metric '{self.metric}'", hint=did_you_mean(self.metric, METRICS))
        if min(self.trials, self.workers, self.episodes) < 1:
            raise TaskError("trials, workers and episodes must be 1 or more")
        for name, space in self.parameters.items():
            if not isinstance(space, dict) or not (
                set(space) == {"choices"} or {"low", "high"} <= set(space) <= {"low", "high", "log"}
            ):
                raise TaskError(f"{name} needs low and high (and log), or choices")

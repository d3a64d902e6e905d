"""One trial of a search of hyperparameters, as a worker trains and evaluates it."""

from __future__ import annotations

import io
import tarfile
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from gazelle.training.evaluation import evaluate
from gazelle.training.importing import TaskModule
from gazelle.training.overrides import with_values
from gazelle.training.recipe_choice import task_recipe
from gazelle.training.session import train
from gazelle.training.sweep_plan import SweepPlan


@dataclass(frozen=True, kw_only=True)
class TrialJob:
    """Settings that all trials of a search share."""

    task: str
    """A task's id or name."""
    plan: SweepPlan
    """Plan of the search."""
    folder: Path
    """Of the search."""
    imports: tuple[TaskModule, ...] = ()
    """Modules or files that register the task."""
    options: dict[str, Any] = field(default_factory=dict)
    """Of the environment."""


@dataclass(frozen=True, slots=True)
class TrialValues:
    """Parameter values of one trial."""

    number: int
    """From 0."""
    values: dict[str, Any]
    """Of the parameters."""


@dataclass(frozen=True, slots=True)
class TrialOutcome:
    """Outcome of a trial."""

    score: float | None = None
    """None if it failed."""
    error: str = ""
    """Why it failed."""
    run: str = ""
    """Its run's folder, or only its name where the files come along."""
    files: bytes = b""
    """The run's folder as a tar archive, from a worker with other disks."""

    def unpacked(self, runs: Path) -> Path:
        """Return the run's folder, put among others if it comes along."""
        if not self.files:
            return Path(self.run)
        with tarfile.open(fileobj=io.BytesIO(self.files)) as archive:
            archive.extractall(runs, filter="data")
        return runs / self.run


class TrialHost:
    """A worker's side of a search: trains and evaluates.

    Args:
        job: Job of all trials.
        away: Whether the worker may be on another machine, so that it sends its files.
    """

    def __init__(self, job: TrialJob, away: bool) -> None:  # noqa: FBT001  # sent by position
        self._job = job
        self._away = away

    def call(self, values: TrialValues) -> TrialOutcome:
        """Run a trial with these values; a failure is returned, since it must not end the search."""
        try:
            if not self._away:
                return self._tried(values, self._job.folder / "runs")
            with tempfile.TemporaryDirectory() as scratch:
                outcome = self._tried(values, Path(scratch))
                # Two workers may begin runs in the same second.
                name = f"{Path(outcome.run).name}-{values.number}"
                return TrialOutcome(outcome.score, run=name, files=_packed(Path(outcome.run), name))
        except Exception as error:  # noqa: BLE001  # it is reported
            return TrialOutcome(error=f"{type(error).__name__}: {error}")

    def _tried(self, values: TrialValues, runs: Path) -> TrialOutcome:
        """Train and evaluate with some values."""
        job, plan = self._job, self._job.plan
        own = task_recipe(job.task, plan.algo, imports=job.imports, options=job.options)
        result = train(
            job.task,
            recipe=with_values(own, values.values),
            steps=plan.steps,
            seed=plan.seed + values.number,
            out=runs,
            imports=job.imports,
            **job.options,
        )
        found = evaluate(result.run.folder, episodes=plan.episodes)
        if plan.metric == "return" or found.success is None:
            score = found.mean_return
        else:
            score = found.success.value
        return TrialOutcome(float(score), run=str(result.run.folder))

    def close(self) -> None:
        """Do nothing: there is nothing to close."""


def _packed(folder: Path, name: str) -> bytes:
    """Return a folder as a tar archive in which it is called so."""
    buffer = io.BytesIO()
    with tarfile.open(fileobj=buffer, mode="w:gz") as archive:
        archive.add(folder, arcname=name)
    return buffer.getvalue()

"""Training runs of a folder, with the last row of their curves."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from gazelle.argument_checks import checked
from gazelle.errors import FormatError, TaskError
from gazelle.training.limits import MAX_ENTRIES
from gazelle.training.runs import Run
from gazelle.training.tables import rows_until

STEPS = "time/steps"


@dataclass(frozen=True, slots=True)
class RunSummary:
    """State of a training run.

    Attributes:
        run: The run.
        steps: Control steps done, from 0 to ``run.config.recipe.steps``.
        seconds: Wall time of the training [s].
        success: Success rate of the last episodes, 0 to 1; None for a task without one.
        mean_return: Their mean return; None before the first episode ended.
        resumable: Whether there is a checkpoint to go on from.
    """

    run: Run
    steps: int
    seconds: float
    success: float | None
    mean_return: float | None
    resumable: bool

    @property
    def finished(self) -> bool:
        """True if the training reached its last step."""
        return self.steps >= self.run.config.recipe.steps


@checked(TaskError)
def list_runs(folder: str | Path = "runs") -> list[RunSummary]:
    """Return the runs in a folder and in folders below it, oldest first.

    What is damaged or no run is left out.

    Raises:
        FormatError: There is no such folder, or it holds more than 200,000 files and folders
            besides those in runs.
        TaskError: No folder can have this name.
    """
    root = Path(folder)
    if not root.is_dir():
        raise FormatError(
            "there is no such folder", file=str(root), hint="'gazelle train TASK' makes runs"
        )
    found = sorted(_summaries(root), key=lambda pair: pair[0])
    return [summary for _, summary in found]


def _summaries(root: Path) -> Iterator[tuple[float, RunSummary]]:
    """Yield the states of runs, each with the time of its configuration."""
    seen = 0
    for folder, folders, files in os.walk(root):
        seen += len(folders) + len(files)
        if seen > MAX_ENTRIES:
            raise FormatError(
                f"there are more than {MAX_ENTRIES:,} files and folders to look at for runs",
                file=str(root),
                hint="name the folder that the runs are in",
            )
        config = Path(folder, "config.json")
        if config.name in files and config.is_file():  # no link to what is gone
            summary = _summary(config.parent)
            if summary is not None:
                yield config.stat().st_mtime, summary
                folders.clear()  # checkpoints


def _summary(folder: Path) -> RunSummary | None:
    """Return the state of a run; None if it is none, or damaged."""
    try:
        run = Run.open(folder)
        rows = rows_until(folder / "progress.csv", STEPS, sys.maxsize)
        checkpoints = run.checkpoints()
    except (FormatError, OSError):
        return None
    last = rows[-1] if rows else {}
    return RunSummary(
        run,
        int(_number(last, STEPS) or 0),
        _number(last, "time/seconds") or 0.0,
        _number(last, "episodes/success_rate"),
        _number(last, "episodes/return"),
        bool(checkpoints),
    )


def _number(row: dict[str, str], column: str) -> float | None:
    """Return a number of a row; None where there is none."""
    try:
        return float(row.get(column) or "")
    except ValueError:
        return None

"""Evaluations while a training continues, and the best policy of them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from gazelle.training.actor import Actor
from gazelle.training.evaluation import Evaluation, evaluate
from gazelle.training.runs import Run
from gazelle.training.tables import row_bytes, rows_until
from gazelle.training.tasks import evaluation_options
from gazelle_ros.base.writing import GrowingFile, replacing, write_bytes

SEED = 20_000
"""Of the environment of these evaluations: other episodes than those of ``gazelle eval``."""

_COLUMNS = ("steps", "success_rate", "collision_rate", "timeout_rate", "return", "length", "best")


class PeriodicEvaluation:
    """Evaluates now and then, writes ``evaluations.csv``, and keeps the best as ``best.npz``.

    Best is what reaches the greatest share of goals or, where tasks do not report that or shares
    are alike, has the greatest mean return. Evaluations have an environment and random
    numbers of their own, so that a training does the same with them as without.

    Args:
        run: Run of the files and settings of the evaluations.

    Attributes:
        evaluated_at: Control steps done at the last evaluation.
    """

    def __init__(self, run: Run) -> None:
        self.run = run
        self.evaluated_at = 0
        self._best: tuple[float, float] | None = None
        self._file = run.folder / "evaluations.csv"

    def due(self, steps: int) -> bool:
        """Return whether the next evaluation is due."""
        every = self.run.config.eval_every
        return every > 0 and steps - self.evaluated_at >= every

    def check(self, actor: Actor, steps: int) -> Evaluation:
        """Evaluate a policy after a given number of control steps, and keep it if it is the best."""
        config = self.run.config
        options = config.options | evaluation_options(config.task, config.options)
        found = evaluate(
            actor,
            episodes=config.eval_episodes,
            seed=SEED,
            task=config.task,
            **config.recipe.evaluated(options),
        )
        self.evaluated_at = steps
        merit = (0.0 if found.success is None else found.success.value, found.mean_return)
        best = self._best is None or merit > self._best
        if best:
            self._best = merit
            _replace(actor, self.run.folder / "best.npz")
        self._add_row(found, steps, best=best)
        return found

    def get_state(self) -> dict[str, Any]:
        """Return the state for a checkpoint."""
        return {"evaluated_at": self.evaluated_at, "best": self._best}

    def set_state(self, state: dict[str, Any], steps: int) -> None:
        """Restore a checkpoint made after a given number of steps; later rows are dropped."""
        self.evaluated_at = int(state["evaluated_at"])
        best = state["best"]
        self._best = None if best is None else (float(best[0]), float(best[1]))
        if self._file.exists():
            rows = rows_until(self._file, "steps", steps)
            write_bytes(self._file, row_bytes(rows, _COLUMNS, header=True))

    def _add_row(self, found: Evaluation, steps: int, *, best: bool) -> None:
        row = {
            "steps": steps,
            "success_rate": "" if found.success is None else found.success.value,
            "collision_rate": "" if found.collision is None else found.collision.value,
            "timeout_rate": found.timeout.value,
            "return": found.mean_return,
            "length": found.mean_length,
            "best": int(best),
        }
        fresh = not self._file.exists()
        with GrowingFile(self._file) as file:
            file.write(row_bytes([row], _COLUMNS, header=fresh))


def _replace(actor: Actor, file: Path) -> None:
    """Replace the file atomically."""
    with replacing(file) as draft:
        actor.save(draft)

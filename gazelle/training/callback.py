"""Training callback between rollouts: curves, checkpoints, stopping on request."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

from stable_baselines3.common.callbacks import BaseCallback
from stable_baselines3.common.logger import KVWriter, Logger

from gazelle.training.checkpoint import write_checkpoint
from gazelle.training.event_files import EventTable, trim_events
from gazelle.training.export import export_actor
from gazelle.training.learners import Learner
from gazelle.training.periodic import PeriodicEvaluation
from gazelle.training.progress import Progress
from gazelle.training.runs import Run
from gazelle.training.statistics import EpisodeLog
from gazelle.training.tables import row_bytes, rows_until
from gazelle_ros.base.interrupts import StopRequest, holding
from gazelle_ros.base.writing import GrowingFile, write_bytes

_COLUMNS = (
    "time/steps",
    "time/seconds",
    "time/steps_per_second",
    "episodes/total",
    "episodes/return",
    "episodes/length",
    "episodes/success_rate",
    "episodes/collision_rate",
    "episodes/timeout_rate",
    "train/learning_rate",
    "train/n_updates",
    "train/loss",
    "train/policy_gradient_loss",
    "train/value_loss",
    "train/entropy_loss",
    "train/approx_kl",
    "train/clip_fraction",
    "train/explained_variance",
    "train/std",
    "train/actor_loss",
    "train/critic_loss",
    "train/ent_coef",
)
_CURVE_POINTS = 200
_TIMEOUT_S = 1.0
"""Time for the update that runs when a stop is requested; then what was saved before it counts [s]."""
_LONG_S = 0.5
"""Updates that take longer begin with a checkpoint, so that a stop need not wait for their end [s]."""
_SAVING_SHARE = 0.05
"""Greatest share of the time that those checkpoints may take."""


class StopRequested(Exception):  # noqa: N818  # a signal to the loop, not a fault
    """A signal stopped the training, and everything is saved."""


class SuccessReached(Exception):  # noqa: N818  # a signal to the loop, not a fault
    """The policy succeeds as often as its recipe wants, and everything is saved."""


class CurveTable(KVWriter):  # type: ignore[misc]  # untyped base
    """The curves as ``progress.csv``, with the same columns in every run.

    Args:
        file: The table; rows beyond ``steps`` are dropped, so that a resumed run
            continues where its checkpoint was.
        steps: Control steps done so far.
    """

    def __init__(self, file: Path, steps: int) -> None:
        rows = rows_until(file, "time/steps", steps)
        write_bytes(file, row_bytes(rows, _COLUMNS, header=True))
        self._file = GrowingFile(file)

    def write(
        self, key_values: dict[str, Any], key_excluded: dict[str, Any], step: int = 0
    ) -> None:
        """Add a row."""
        del key_excluded
        self._file.write(row_bytes([{**key_values, "time/steps": step}], _COLUMNS))

    def close(self) -> None:
        """Close the file."""
        self._file.close()


class TrainingCallback(BaseCallback):  # type: ignore[misc]  # untyped base
    """Called by the learner between two rollouts.

    Args:
        run: Run for curves and checkpoints.
        episodes: The account of the latest episodes.
        progress: Shows how far the run is.
        stop: Returns whether the user wants to stop.
    """

    def __init__(
        self, run: Run, episodes: EpisodeLog, progress: Progress, stop: StopRequest
    ) -> None:
        super().__init__()
        self.run = run
        self.episodes = episodes
        self.progress = progress
        self.stop = stop
        if run.checkpoints():
            stop.timeout = _TIMEOUT_S
        self.saved_at = 0
        self.logged_at = 0
        self.evaluation = PeriodicEvaluation(run)
        self._began = self._update_began = time.monotonic()
        self._saving_s = self._seconds_before = 0.0

    def attach(self, learner: Learner) -> None:
        """Set the learner's logger; call after its checkpoint, if any, was read."""
        steps = learner.num_timesteps
        self._began = time.monotonic()
        folder = self.run.folder / "tensorboard"
        trim_events(folder, steps)
        table = CurveTable(self.run.folder / "progress.csv", steps)
        learner.set_logger(Logger(str(folder), [table, EventTable(folder)]))

    def get_state(self) -> dict[str, Any]:
        """Return the state of the callback for a checkpoint."""
        return {
            "episodes": self.episodes.get_state(),
            "logged_at": self.logged_at,
            "evaluation": self.evaluation.get_state(),
            "seconds": self._seconds,
        }

    def set_state(self, state: dict[str, Any], steps: int) -> None:
        """Restore a checkpoint made after a given number of steps."""
        self.episodes.set_state(state["episodes"])
        self.logged_at, self.saved_at = int(state["logged_at"]), steps
        self._seconds_before = float(state["seconds"])
        if "evaluation" in state:  # runs of before have none
            self.evaluation.set_state(state["evaluation"], steps)

    @property
    def _seconds(self) -> float:
        """Wall time of the training so far, without that between a stop and a resume [s]."""
        return self._seconds_before + time.monotonic() - self._began

    def finish(self) -> None:
        """Write the last point of the curves and the last checkpoint."""
        if self.run.config.eval_every and self.evaluation.evaluated_at != self.model.num_timesteps:
            self._evaluate()
        if self.logged_at != self.model.num_timesteps:
            self._log()
        if self.saved_at != self.model.num_timesteps or not self.run.checkpoints():
            self._save()

    def _on_rollout_start(self) -> None:
        steps = self.model.num_timesteps
        self.progress.update(steps, self.episodes.summary())
        if self.evaluation.due(steps):
            self._save()  # a stop does not wait for an evaluation: the next run makes it again
            self._raise_if_asked()
            self._evaluate()
        if steps - self.logged_at >= self.run.config.recipe.steps / _CURVE_POINTS:
            self._log()
        due = steps - self.saved_at >= self.run.config.checkpoint_every
        wanted = self.run.config.recipe.success_to_finish
        reached = wanted is not None and self.episodes.succeeds(wanted)
        if self.stop.is_set() or due or reached or self._is_slow() or not self.run.checkpoints():
            self._save()
        self._raise_if_asked()
        if reached:
            raise SuccessReached
        self._update_began = time.monotonic()

    def _raise_if_asked(self) -> None:
        if self.stop.is_set():
            raise StopRequested

    def _is_slow(self) -> bool:
        """Return whether the last update took so long that saving before each is worth it."""
        took = time.monotonic() - self._update_began
        return took > _LONG_S and self._saving_s < _SAVING_SHARE * took

    def _on_step(self) -> bool:
        return True

    def _evaluate(self) -> None:
        steps = self.model.num_timesteps
        found = self.evaluation.check(export_actor(self.model.policy), steps)
        if found.success is not None:
            self.logger.record("evaluation/success_rate", found.success.value)
        self.logger.record("evaluation/return", found.mean_return)

    def _log(self) -> None:
        steps = self.model.num_timesteps
        seconds = self._seconds
        for name, value in self.episodes.summary().items():
            self.logger.record(f"episodes/{name}", value)
        self.logger.record("episodes/total", self.episodes.total)
        self.logger.record("time/seconds", round(seconds, 3))
        rate = steps / max(seconds, 1e-9)
        self.logger.record("time/steps_per_second", round(rate, 1))
        self.logger.dump(steps)
        self.logged_at = steps

    def _save(self) -> None:
        began, state = time.monotonic(), self.get_state()
        with holding():
            self.run.add_checkpoint(
                self.model.num_timesteps, lambda folder: write_checkpoint(folder, self.model, state)
            )
            self.saved_at = self.model.num_timesteps
        self.stop.timeout = _TIMEOUT_S  # before the first checkpoint a stop waits for it
        self._saving_s = time.monotonic() - began

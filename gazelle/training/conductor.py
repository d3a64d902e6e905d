"""What happens between two rollouts: curves, checkpoints, stopping on request."""

from __future__ import annotations

import csv
import signal
import threading
import time
from pathlib import Path
from types import FrameType
from typing import Any, Self

from stable_baselines3.common.callbacks import BaseCallback
from stable_baselines3.common.logger import KVWriter, Logger, TensorBoardOutputFormat

from gazelle.training.checkpoint import write_checkpoint
from gazelle.training.learners import Learner
from gazelle.training.progress import Progress
from gazelle.training.runs import Run
from gazelle.training.statistics import EpisodeLog

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


class StopRequested(Exception):  # noqa: N818  # a signal to the loop, not a fault
    """Ctrl-C was pressed, and everything is saved."""


class StopOnInterrupt:
    """While active, the first Ctrl-C only asks to stop; the second interrupts at once.

    Args:
        progress: Tells the user that the request was heard.
    """

    def __init__(self, progress: Progress) -> None:
        self.requested = False
        self._progress = progress
        self._before: Any = None

    def __enter__(self) -> Self:
        if threading.current_thread() is threading.main_thread():
            self._before = signal.signal(signal.SIGINT, self._heard)
        return self

    def __exit__(self, *exception: object) -> None:
        if self._before is not None:
            signal.signal(signal.SIGINT, self._before)

    def _heard(self, number: int, frame: FrameType | None) -> None:
        del number, frame
        if self.requested:
            raise KeyboardInterrupt
        self.requested = True
        self._progress.say("stopping after this update (Ctrl-C again stops at once) ...")


class CurveTable(KVWriter):  # type: ignore[misc]  # untyped base
    """The curves as ``progress.csv``, with the same columns in every run.

    Args:
        file: The table; rows beyond ``steps`` are dropped, so that a resumed run
            continues where its checkpoint was.
        steps: Control steps done so far.
    """

    def __init__(self, file: Path, steps: int) -> None:
        rows: list[dict[str, str]] = []
        if file.exists():
            with file.open(newline="", encoding="utf-8") as old:
                rows = [row for row in csv.DictReader(old) if int(row["time/steps"]) <= steps]
        self._file = file.open("w", newline="", encoding="utf-8")
        self._writer = csv.DictWriter(self._file, _COLUMNS, restval="", extrasaction="ignore")
        self._writer.writeheader()
        self._writer.writerows(rows)

    def write(
        self, key_values: dict[str, Any], key_excluded: dict[str, Any], step: int = 0
    ) -> None:
        """Add a row."""
        del key_excluded
        self._writer.writerow({**key_values, "time/steps": step})
        self._file.flush()

    def close(self) -> None:
        """Close the file."""
        self._file.close()


class Conductor(BaseCallback):  # type: ignore[misc]  # untyped base
    """Called by the learner between two rollouts.

    Args:
        run: Where curves and checkpoints go.
        total: Control steps of the whole training.
        episodes: The account of the latest episodes.
        progress: Shows how far the run is.
        stop: Tells whether the user wants to stop.
    """

    def __init__(
        self, run: Run, total: int, episodes: EpisodeLog, progress: Progress, stop: StopOnInterrupt
    ) -> None:
        super().__init__()
        self.run = run
        self.total = total
        self.episodes = episodes
        self.progress = progress
        self.stop = stop
        self.saved_at = 0
        self.logged_at = 0
        self._began = (time.monotonic(), 0)

    def attach(self, learner: Learner) -> None:
        """Give the learner a logger; call after its checkpoint, if any, was read."""
        steps = learner.num_timesteps
        self._began = (time.monotonic(), steps)
        folder = str(self.run.folder / "tensorboard")
        table = CurveTable(self.run.folder / "progress.csv", steps)
        learner.set_logger(Logger(folder, [table, TensorBoardOutputFormat(folder)]))

    def get_state(self) -> dict[str, Any]:
        """What a checkpoint must remember of the conductor."""
        return {"episodes": self.episodes.get_state(), "logged_at": self.logged_at}

    def set_state(self, state: dict[str, Any], steps: int) -> None:
        """Continue from a checkpoint made after so many steps."""
        self.episodes.set_state(state["episodes"])
        self.logged_at, self.saved_at = int(state["logged_at"]), steps

    def finish(self) -> None:
        """Write the last point of the curves and the last checkpoint."""
        if self.logged_at != self.model.num_timesteps:
            self._log()
        if self.saved_at != self.model.num_timesteps or not self.run.checkpoints():
            self._save()

    def _on_rollout_start(self) -> None:
        steps = self.model.num_timesteps
        self.progress.update(steps, self.episodes.summary())
        if steps - self.logged_at >= self.total / _CURVE_POINTS:
            self._log()
        due = steps - self.saved_at >= self.run.config.checkpoint_every
        if self.stop.requested or due:
            self._save()
        if self.stop.requested:
            raise StopRequested

    def _on_step(self) -> bool:
        return True

    def _log(self) -> None:
        steps = self.model.num_timesteps
        seconds = time.monotonic() - self._began[0]
        for name, value in self.episodes.summary().items():
            self.logger.record(f"episodes/{name}", value)
        self.logger.record("episodes/total", self.episodes.total)
        self.logger.record("time/seconds", round(seconds, 3))
        rate = (steps - self._began[1]) / max(seconds, 1e-9)
        self.logger.record("time/steps_per_second", round(rate, 1))
        self.logger.dump(steps)
        self.logged_at = steps

    def _save(self) -> None:
        state = self.get_state()
        self.run.add_checkpoint(
            self.model.num_timesteps, lambda folder: write_checkpoint(folder, self.model, state)
        )
        self.saved_at = self.model.num_timesteps

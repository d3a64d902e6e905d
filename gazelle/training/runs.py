"""The folder of a training run: configuration, checkpoints, logs, policy.

::

    runs/TurtleBot3Stage1-ppo-20261105-140302/
        config.json          everything that shaped the run, and the versions used
        progress.csv         the curves as a table
        tensorboard/         the curves for TensorBoard
        checkpoints/000000500000/   state to resume from, named by control steps
        policy.npz           the newest policy, for evaluation without torch
        evaluations.csv      evaluations during the training, if there were any
        best.npz             the policy that did best in them
        contract.json        what the policy sees and does, see `PolicyContract`
"""

from __future__ import annotations

import dataclasses
import json
import os
import platform
import shutil
from collections.abc import Callable
from dataclasses import dataclass, field
from datetime import datetime
from importlib import metadata
from pathlib import Path
from typing import Any

import numpy as np

from gazelle.argument_checks import checked
from gazelle.errors import FormatError, TaskError, did_you_mean
from gazelle.training.importing import TaskModule, modules_from_list, modules_to_list
from gazelle.training.recipes import Recipe, recipe_from_dict, recipe_to_dict, task_name
from gazelle_ros.base.writing import naming, replacing, write_text

_FORMAT = "gazelle-run-1"
_PACKAGES = ("gazelle", "gymnasium", "mujoco-core", "numpy", "stable-baselines3", "torch")
_KEPT = 3


@dataclass(frozen=True, kw_only=True)
class RunConfig:
    """Everything that shapes a run."""

    task: str
    """Gymnasium id of the task."""
    recipe: Recipe
    """Recipe of the training."""
    seed: int
    """Seed of everything random."""
    options: dict[str, Any] = field(default_factory=dict)
    """Options of the environment."""
    checkpoint_every: int = 100_000
    """Control steps between two checkpoints."""
    eval_every: int = 0
    """Control steps between two evaluations during the training; 0 for none."""
    eval_episodes: int = 100
    """Episodes of each of them."""
    callbacks: tuple[str, ...] = ()
    """Callbacks of Stable-Baselines3 that are called too, each as ``module:Class``."""
    imports: tuple[TaskModule, ...] = ()
    """Modules that register the task, where that is not one of Gazelle's."""
    sharded: bool = False
    """True if workers play its rollouts, see `gazelle.training.workers`."""


@checked(TaskError)
@dataclass(frozen=True)
class Run:
    """A run on disk."""

    folder: Path
    """Folder of its files."""
    config: RunConfig
    """Configuration of the run."""

    @staticmethod
    def create(config: RunConfig, out: Path) -> Run:
        """Create a folder under ``out`` and write the configuration into it.

        Raises:
            TaskError: The folder cannot be made.
        """
        stamp = datetime.now().astimezone().strftime("%Y%m%d-%H%M%S")
        name = f"{task_name(config.task)}-{config.recipe.algo}-{stamp}"
        try:
            folder = new_folder(out, name)
            try:
                (folder / "checkpoints").mkdir()
                _write_config(folder, config)
            except OSError:
                shutil.rmtree(folder, ignore_errors=True)
                raise
        except OSError as error:
            hint = "give another folder with --out"
            raise TaskError(f"cannot write the run: {error}", hint=hint) from error
        return Run(folder, config)

    def changed(self, **values: Any) -> Run:
        """Return the run with another configuration, which takes the old one's place on disk.

        Args:
            values: Fields of `RunConfig` that change.

        Raises:
            TaskError: A configuration has no such field, or the folder cannot be written.
        """
        known = {each.name for each in dataclasses.fields(self.config)}
        for name in sorted(values.keys() - known):
            hint = did_you_mean(name, known)
            raise TaskError(f"the configuration of a run has no field '{name}'", hint=hint)
        config = dataclasses.replace(self.config, **values)
        try:
            _write_config(self.folder, config)
        except OSError as error:
            raise TaskError(f"cannot write the run: {error}") from error
        return Run(self.folder, config)

    @staticmethod
    def open(folder: Path) -> Run:
        """Read a run from its folder.

        Raises:
            FormatError: There is no run, or its configuration is damaged.
        """
        file = folder / "config.json"
        if not os.path.isfile(file):  # noqa: PTH113  # False, too, where it may not be looked
            hint = "expected the folder of a training run, such as runs/TASK-ppo-DATE"
            raise FormatError("no run here: there is no config.json", file=str(folder), hint=hint)
        try:
            return Run(folder, _config_from_dict(json.loads(file.read_text(encoding="utf-8"))))
        except (ArithmeticError, LookupError, OSError, TypeError, ValueError, TaskError) as error:
            raise FormatError(f"not a run's configuration: {error}", file=str(file)) from error

    def checkpoints(self) -> list[Path]:
        """Return the complete checkpoints, oldest first."""
        return sorted(
            path for path in (self.folder / "checkpoints").iterdir() if path.name.isdigit()
        )

    def newest_checkpoint(self) -> Path:
        """Return the checkpoint to resume from.

        Raises:
            FormatError: There is none yet.
        """
        found = self.checkpoints()
        if not found:
            hint = "it stopped before its first checkpoint; train again"
            raise FormatError("the run has no checkpoint", file=str(self.folder), hint=hint)
        return found[-1]

    def policy_file(self, *, best: bool = False) -> Path:
        """Return the newest policy, or the best of the evaluations during the training.

        Raises:
            FormatError: There is none.
        """
        file = self.folder / ("best.npz" if best else "policy.npz")
        if best and not file.is_file():
            hint = "train with --eval-every N to have the best policy kept"
            raise FormatError("the run has no best policy", file=str(self.folder), hint=hint)
        if not file.is_file():
            hint = "it stopped before its first checkpoint; train again"
            raise FormatError("the run has no policy", file=str(self.folder), hint=hint)
        return file

    def add_checkpoint(self, steps: int, write: Callable[[Path], None]) -> Path:
        """Write a checkpoint, all or nothing, and remove the oldest beyond three.

        Args:
            steps: Control steps done so far.
            write: Writes the files into the folder it is given.

        Returns:
            The checkpoint's folder.

        Raises:
            OSError: It cannot be written.
        """
        place = self.folder / "checkpoints" / f"{steps:012d}"
        draft = place.with_name(place.name + ".part")
        shutil.rmtree(draft, ignore_errors=True)
        draft.mkdir()
        try:
            with naming(place):
                write(draft)
        except BaseException:
            shutil.rmtree(draft, ignore_errors=True)
            raise
        shutil.rmtree(place, ignore_errors=True)
        draft.rename(place)
        if (place / "policy.npz").is_file():
            with replacing(self.folder / "policy.npz") as fresh:
                shutil.copyfile(place / "policy.npz", fresh)
        for old in self.checkpoints()[:-_KEPT]:
            shutil.rmtree(old)
        return place


def new_folder(out: Path, name: str) -> Path:
    """Return a folder that did not exist, also when two runs start in the same second."""
    for suffix in ("", *(f"-{i}" for i in range(2, 100))):
        folder = out / f"{name}{suffix}"
        try:
            folder.mkdir(parents=True)
        except FileExistsError:
            continue
        return folder
    raise FileExistsError(f"{out / name} and 98 like it exist")


def _write_config(folder: Path, config: RunConfig) -> None:
    """Write the configuration atomically, so that a run is never without one."""
    write_text(
        folder / "config.json", json.dumps(_config_to_dict(config), indent=2, default=_plain) + "\n"
    )


def _plain(value: Any) -> Any:
    """Return a number of NumPy as one of Python."""
    if isinstance(value, np.generic):
        return value.item()
    raise TypeError(f"a run keeps no {type(value).__name__}")


def _config_to_dict(config: RunConfig) -> dict[str, Any]:
    return {
        "format": _FORMAT,
        "task": config.task,
        "seed": config.seed,
        "options": config.options,
        "checkpoint_every": config.checkpoint_every,
        "eval_every": config.eval_every,
        "eval_episodes": config.eval_episodes,
        "callbacks": list(config.callbacks),
        "imports": modules_to_list(config.imports),
        "sharded": config.sharded,
        "recipe": recipe_to_dict(config.recipe),
        "versions": versions(),
        "machine": platform.machine(),
    }


def _config_from_dict(values: dict[str, Any]) -> RunConfig:
    if values["format"] != _FORMAT:
        raise ValueError(f"format {values['format']!r}, expected {_FORMAT!r}")
    return RunConfig(
        task=str(values["task"]),
        recipe=recipe_from_dict(values["recipe"]),
        seed=int(values["seed"]),
        options=dict(values["options"]),
        checkpoint_every=int(values["checkpoint_every"]),
        eval_every=int(values.get("eval_every", 0)),
        eval_episodes=int(values.get("eval_episodes", 100)),
        callbacks=tuple(map(str, values.get("callbacks", ()))),
        imports=modules_from_list(values.get("imports", [])),
        sharded=bool(values.get("sharded", False)),
    )


def versions() -> dict[str, str]:
    """Return versions of Python and of the packages that influence a run."""
    found = {"python": platform.python_version()}
    for package in _PACKAGES:
        try:
            found[package] = metadata.version(package)
        except metadata.PackageNotFoundError:
            continue
    return found

"""Search hyperparameters with Optuna, over processes; a search goes on where it was stopped.

Trials are kept in a journal file. The driver starts workers, each a process that trains and
evaluates one trial after another. Workers end with the driver, however it ends; what they were at is
tried again when the search goes on.
"""

from __future__ import annotations

import multiprocessing
import os
import threading
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from multiprocessing.synchronize import Lock
from pathlib import Path
from typing import Any

import yaml

from gazelle.errors import FormatError, MissingExtraError, TaskError, did_you_mean
from gazelle.training.evaluation import evaluate
from gazelle.training.overrides import with_values
from gazelle.training.recipes import recipe_for, task_name
from gazelle.training.session import train

try:
    import optuna
    from optuna.storages import JournalStorage
    from optuna.storages.journal import JournalFileBackend
    from optuna.trial import Trial, TrialState
except ModuleNotFoundError as error:
    raise MissingExtraError("optuna", "sweep") from error

METRICS = ("success", "return")
_KEYS = {"parameters", "trials", "workers", "steps", "episodes", "metric", "algo", "seed"}
_RETRY = "retry of"


@dataclass(frozen=True, kw_only=True)
class SweepPlan:
    """What a search tries."""

    parameters: dict[str, dict[str, Any]]
    """By the name of a recipe's value, see `with_values`: ``{"choices": [...]}`` or
    ``{"low": a, "high": b}``, with ``"log": true`` for steps of equal ratio. Ints stay ints."""
    trials: int = 20
    """How many in all."""
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
            FormatError: The file cannot be read, or says something that cannot be.
        """
        try:
            values = yaml.safe_load(file.read_text(encoding="utf-8"))
        except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
            raise FormatError(f"cannot read the sweep: {error}", file=str(file)) from error
        if not isinstance(values, dict) or not isinstance(values.get("parameters"), dict):
            hint = "expected 'parameters:' with low and high, or choices, of each"
            raise FormatError("this is no sweep", file=str(file), hint=hint)
        for key in values:
            if key not in _KEYS:
                hint = did_you_mean(str(key), _KEYS)
                raise FormatError(f"a sweep has no '{key}'", file=str(file), hint=hint)
        try:
            plan = cls(**values)
            plan.check()
        except (TaskError, TypeError) as error:
            raise FormatError(f"this sweep cannot be: {error}", file=str(file)) from error
        return plan

    def check(self) -> None:
        """Make sure that it can be done.

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


@dataclass(frozen=True, slots=True)
class SweepTrial:
    """One trial of a search."""

    number: int
    """From 0."""
    values: dict[str, Any]
    """Of the parameters."""
    score: float | None
    """What it reached; None if it failed."""
    run: str
    """Folder of its run; empty if it failed."""


@dataclass(frozen=True, slots=True)
class SweepResult:
    """What a search found."""

    folder: Path
    """Where its journal and runs are."""
    trials: tuple[SweepTrial, ...]
    """Those that ended, the best first."""
    new: int = 0
    """How many of them in this call."""


@dataclass(frozen=True, kw_only=True)
class _Job:
    """What a worker needs."""

    task: str
    plan: SweepPlan
    folder: Path
    imports: tuple[str, ...] = ()
    options: dict[str, Any] = field(default_factory=dict)


def sweep(
    task: str,
    plan: SweepPlan,
    *,
    out: str | Path = "runs",
    imports: tuple[str, ...] = (),
    **options: Any,
) -> SweepResult:
    """Search, or go on with a search of the same task in the same folder.

    Args:
        task: A task's id or name, as `train` takes it.
        plan: What is tried.
        out: Folder in which the search's folder, ``TASK-sweep``, is made.
        imports: Modules or files that register the task.
        options: Options of the environment.

    Raises:
        TaskError: A parameter is not part of the recipe, or all trials of this call failed.
        MissingExtraError: Optuna is not installed.
    """
    plan.check()
    name = task_name(task.rpartition(":")[2])
    with_values(recipe_for(name, plan.algo), dict.fromkeys(plan.parameters, 1) | {"net_arch": ()})
    folder = Path(out) / f"{name}-sweep"
    folder.mkdir(parents=True, exist_ok=True)
    job = _Job(
        task=task, plan=plan, folder=folder.resolve(), imports=imports, options=dict(options)
    )
    study = _open(job.folder)
    _try_again(study)
    before = _ended(study)
    if before < plan.trials:
        _work(job)
    study = _open(job.folder)
    new = _ended(study) - before
    result = SweepResult(folder, _trials(study), new)
    if new and not any(trial.score is not None for trial in result.trials):
        raise TaskError("all trials failed", hint=f"see the log in {folder / 'errors.log'}")
    return result


def _open(folder: Path) -> optuna.Study:
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the journal is called experimental
        storage = JournalStorage(JournalFileBackend(str(folder / "journal.log")))
    return optuna.create_study(
        study_name="sweep", storage=storage, direction="maximize", load_if_exists=True
    )


def _ended(study: optuna.Study) -> int:
    states = (TrialState.COMPLETE, TrialState.FAIL)
    return sum(
        _RETRY not in trial.user_attrs for trial in study.get_trials(deepcopy=False, states=states)
    )


def _try_again(study: optuna.Study) -> None:
    """Trials that nobody works on any more, as the driver was killed, come first."""
    for trial in study.get_trials(states=(TrialState.RUNNING,)):
        study._storage.set_trial_user_attr(trial._trial_id, _RETRY, True)  # noqa: SLF001
        study.tell(trial.number, state=TrialState.FAIL)
        study.enqueue_trial(trial.params)


def _work(job: _Job) -> None:
    """Let workers do what is left, and end with them."""
    context = multiprocessing.get_context("spawn")
    # Nothing is sent: the pipe ends with this process, and so do the workers.
    theirs, ours = context.Pipe(duplex=False)
    lock = context.Lock()
    workers = [
        context.Process(target=_serve, args=(job, theirs, lock)) for _ in range(job.plan.workers)
    ]
    try:
        for worker in workers:
            worker.start()
        theirs.close()
        for worker in workers:
            worker.join()
    finally:
        ours.close()
        for worker in workers:
            if worker.is_alive():
                worker.terminate()
                worker.join()


def _serve(job: _Job, alive: Connection, lock: Lock) -> None:
    """A worker: one trial after another until all are done."""
    threading.Thread(target=_end_with, args=(alive,), daemon=True).start()
    study = _open(job.folder)
    while True:
        with lock:
            if _claimed(study) >= job.plan.trials:
                return
            trial = study.ask()
        try:
            score = _try(trial, job)
        except Exception as error:  # noqa: BLE001  # one that fails must not end the search
            with (job.folder / "errors.log").open("a", encoding="utf-8") as log:
                log.write(f"trial {trial.number}, {trial.user_attrs.get('values')}: {error}\n")
            study.tell(trial, state=TrialState.FAIL)
        else:
            study.tell(trial, score)


def _claimed(study: optuna.Study) -> int:
    """Trials that ended or that somebody works on."""
    trials = study.get_trials(deepcopy=False)
    return sum(
        _RETRY not in trial.user_attrs and trial.state is not TrialState.WAITING for trial in trials
    )


def _end_with(alive: Connection) -> None:
    try:
        alive.recv()
    except (EOFError, OSError):
        os._exit(1)


def _try(trial: Trial, job: _Job) -> float:
    """Train and evaluate with the values of a trial."""
    plan = job.plan
    values = {name: _draw(trial, name, space) for name, space in plan.parameters.items()}
    trial.set_user_attr("values", values)
    recipe = with_values(recipe_for(task_name(job.task.rpartition(":")[2]), plan.algo), values)
    result = train(
        job.task,
        recipe=recipe,
        steps=plan.steps,
        seed=plan.seed + trial.number,
        out=job.folder / "runs",
        imports=job.imports,
        **job.options,
    )
    if result.interrupted:
        raise KeyboardInterrupt  # the search is to stop; this is tried again when it goes on
    found = evaluate(result.run.folder, episodes=plan.episodes)
    trial.set_user_attr("run", str(result.run.folder))
    if plan.metric == "return" or found.success is None:
        return found.mean_return
    return found.success.value


def _draw(trial: Trial, name: str, space: Mapping[str, Any]) -> Any:
    if "choices" in space:
        # Optuna keeps plain values alone: lists are chosen by their place.
        place = trial.suggest_categorical(name, list(range(len(space["choices"]))))
        return space["choices"][place]
    low, high, log = space["low"], space["high"], bool(space.get("log", False))
    if isinstance(low, int) and isinstance(high, int):
        return trial.suggest_int(name, low, high, log=log)
    return trial.suggest_float(name, float(low), float(high), log=log)


def _trials(study: optuna.Study) -> tuple[SweepTrial, ...]:
    states = (TrialState.COMPLETE, TrialState.FAIL)
    found = [
        SweepTrial(
            trial.number,
            dict(trial.user_attrs.get("values", {})),
            trial.value,
            str(trial.user_attrs.get("run", "")),
        )
        for trial in study.get_trials(states=states)
        if _RETRY not in trial.user_attrs
    ]
    return tuple(sorted(found, key=lambda trial: (trial.score is None, -(trial.score or 0.0))))

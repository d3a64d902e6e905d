"""Search hyperparameters with Optuna, over processes or a cluster; a stopped search resumes.

The driver requests one trial after another from Optuna, has workers train and evaluate them, and keeps
all in a journal file. Workers end with the driver, however it ends; what they were at is tried
again when the search continues.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gazelle.errors import MissingExtraError, TaskError
from gazelle.training.importing import TaskModule
from gazelle.training.overrides import with_values
from gazelle.training.recipe_choice import task_recipe
from gazelle.training.recipes import task_name
from gazelle.training.sweep_plan import SweepPlan
from gazelle.training.trials import TrialHost, TrialJob, TrialOutcome, TrialValues
from gazelle.training.workers.callers import TRIES, call_all, workers_at
from gazelle_ros.base.writing import naming

try:
    import optuna
    from optuna.storages import JournalStorage
    from optuna.storages.journal import JournalFileBackend
    from optuna.trial import Trial, TrialState
except ModuleNotFoundError as error:
    raise MissingExtraError("optuna", "sweep") from error

_RETRY = "retry of"


@dataclass(frozen=True, slots=True)
class SweepTrial:
    """One trial of a search."""

    number: int
    """From 0."""
    values: dict[str, Any]
    """Of the parameters."""
    score: float | None
    """Score; None if it failed."""
    run: str
    """Folder of its run; empty if it failed."""


@dataclass(frozen=True, slots=True)
class SweepResult:
    """Result of a hyperparameter search."""

    folder: Path
    """Folder of its journal and runs."""
    trials: tuple[SweepTrial, ...]
    """Those that ended, the best first."""
    new: int = 0
    """Number of those in this call."""


def sweep(
    task: str,
    plan: SweepPlan,
    *,
    out: str | Path = "runs",
    imports: tuple[str, ...] = (),
    workers: int | None = None,
    ray: str | None = None,
    **options: Any,
) -> SweepResult:
    """Start a search, or resume one of the same task in the same folder.

    Args:
        task: A task's id or name, as `train` takes it.
        plan: Plan of the search.
        out: Folder in which the search's folder, ``TASK-sweep``, is made.
        imports: Modules or files that register the task.
        workers: Number of parallel trainings; None for the plan's.
        ray: Address of the Ray cluster of the workers, ``local`` for one on this machine; None
            for processes here.
        options: Options of the environment.

    Raises:
        TaskError: A parameter is not part of the recipe, there is no such cluster, or all trials
            of this call failed.
        MissingExtraError: Optuna is not installed, or Ray where it is requested.
    """
    plan.check()
    name = task_name(task.rpartition(":")[2])
    own = task_recipe(task, plan.algo, imports=imports, options=options)
    with_values(own, dict.fromkeys(plan.parameters, 1) | {"net_arch": ()})
    folder = Path(out) / f"{name}-sweep"
    folder.mkdir(parents=True, exist_ok=True)
    job = TrialJob(
        task=task,
        plan=plan,
        folder=folder.resolve(),
        imports=tuple(TaskModule.find(each) for each in imports),
        options=dict(options),
    )
    study = _open(job.folder)
    _try_again(study)
    before = _ended(study)
    if before < plan.trials:
        _work(job, study, workers=workers, ray=ray)
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
    """Queue first the trials that were interrupted when the driver was killed."""
    for trial in study.get_trials(states=(TrialState.RUNNING,)):
        study._storage.set_trial_user_attr(trial._trial_id, _RETRY, True)  # noqa: SLF001
        study.tell(trial.number, state=TrialState.FAIL)
        study.enqueue_trial(trial.params)


def _work(job: TrialJob, study: optuna.Study, *, workers: int | None, ray: str | None) -> None:
    """Run the remaining trials on workers, and stop them."""
    plan = job.plan
    runs = job.folder / "runs"
    count, start = workers_at(ray, workers or plan.workers, TrialHost, job, ray is not None)

    def done(values: TrialValues, outcome: TrialOutcome | None) -> None:
        trial = trials.pop(values.number)
        if outcome is None:
            outcome = TrialOutcome(error=f"its worker was lost {TRIES} times")
        if outcome.score is None:
            errors = job.folder / "errors.log"
            with naming(errors), errors.open("a", encoding="utf-8") as log:
                log.write(f"trial {values.number}, {values.values}: {outcome.error}\n")
            study.tell(trial, state=TrialState.FAIL)
            return
        trial.set_user_attr("run", str(outcome.unpacked(runs)))
        study.tell(trial, outcome.score)

    trials: dict[int, Trial] = {}
    left = plan.trials - _ended(study)
    call_all(_requested_trials(study, plan, trials, left), start, done, workers=min(count, left))


def _requested_trials(
    study: optuna.Study, plan: SweepPlan, trials: dict[int, Trial], left: int
) -> Iterator[TrialValues]:
    """Yield the values Optuna wants to try next, which depend on the results so far."""
    for _ in range(left):
        trial = study.ask()
        values = {name: _draw(trial, name, space) for name, space in plan.parameters.items()}
        trial.set_user_attr("values", values)
        trials[trial.number] = trial
        yield TrialValues(trial.number, values)


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

"""Training sessions: train a policy for a task, or resume a stopped run."""

from __future__ import annotations

import dataclasses
import time
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import torch

from gazelle.argument_checks import checked
from gazelle.errors import TaskError, TaskWarning
from gazelle.training.callback import StopRequested, SuccessReached, TrainingCallback
from gazelle.training.checkpoint import read_checkpoint, usable
from gazelle.training.contracts import contract_of, save_contract
from gazelle.training.demonstrations import with_demonstrator_found
from gazelle.training.importing import TaskModule, load_all
from gazelle.training.learners import Learner, build_learner
from gazelle.training.progress import NoProgress, Progress, Watched
from gazelle.training.recipe import NEED_CONTINUOUS_ACTIONS, Recipe
from gazelle.training.recipe_choice import task_recipe
from gazelle.training.runs import Run, RunConfig
from gazelle.training.statistics import EpisodeLog
from gazelle.training.tasks import (
    find_task,
    make_task,
    plain_options,
    split_module,
    with_continuous_actions,
)
from gazelle.training.threads import limit_threads
from gazelle.training.trust import require_trust
from gazelle.training.user_callbacks import find_callbacks, make_callbacks
from gazelle.training.vecenv import VectorEnvAdapter
from gazelle.training.workers.joining import join_workers
from gazelle_ros.base.interrupts import Interrupted, stopping

_CHECKPOINTS = 10
_STOPPING = "stopping after this update (Ctrl-C again stops at once) ..."


@dataclass(frozen=True, slots=True)
class TrainResult:
    """Result of a call of `train` or `resume`."""

    run: Run
    """The run on disk."""
    steps: int
    """Control steps of the whole run so far, all copies together."""
    new_steps: int
    """Control steps done in this call."""
    wall_seconds: float
    """Wall time of this call's training [s]."""
    sim_seconds: float | None
    """Simulated time of this call, all copies together [s]; None when the task has no period."""
    interrupted: bool
    """True if a signal ended it early; everything is saved then, see `resume`."""
    stop_signal: int | None
    """The signal that ended it early, such as `signal.SIGINT`, or None."""
    summary: dict[str, float]
    """Means over the latest episodes: ``return``, ``length``, ``success_rate`` ..."""


@checked(TaskError)
def train(
    task: str,
    *,
    algo: str | None = None,
    recipe: Recipe | None = None,
    steps: int | None = None,
    num_envs: int | None = None,
    seed: int = 0,
    out: str | Path = "runs",
    checkpoint_every: int | None = None,
    eval_every: int = 0,
    eval_episodes: int = 100,
    callbacks: Sequence[str] = (),
    progress: Progress | None = None,
    threads: int = 1,
    imports: Sequence[str | TaskModule] = (),
    workers: int | None = None,
    ray: str | None = None,
    **options: Any,
) -> TrainResult:
    """Train a policy from scratch.

    Args:
        task: A task's id or name, or ``module:id`` for one that a module registers.
        algo: ``ppo``, ``dqn``, ``sac``, ``td3`` or ``ddpg``; by default what the recipe says.
        recipe: Recipe; by default the task's own, see `task_recipe`.
        steps: Control steps in total, instead of the recipe's; all of them are done.
        num_envs: Copies that run at once, instead of the recipe's.
        seed: Seed of everything random.
        out: Folder in which the run's folder is made.
        checkpoint_every: Control steps between two checkpoints; by default a tenth of the total.
        eval_every: Control steps between two evaluations, of which the best policy is kept; 0 for
            none. See `PeriodicEvaluation`.
        eval_episodes: Episodes of each evaluation.
        callbacks: Callbacks of Stable-Baselines3 to be called as well, each as ``module:Class``.
        progress: Shows how far it is; by default nothing is shown.
        threads: Threads for torch and BLAS.
        imports: Modules or files to import first, which register tasks; the run remembers them.
        workers: Processes that play rollouts, see `gazelle.training.workers`; the result is the
            same with any number of them, and another than without.
        ray: Address of the Ray cluster of the workers, ``local`` for one on this machine; by
            default as many as it has processors.
        options: Options of the environment; those that the recipe sets are taken from it.

    Raises:
        TaskError: The task, the algorithm or an option does not exist, or they do not fit.
        MissingExtraError: torch or Stable-Baselines3 is not installed.
    """
    module, task = split_module(task)
    homes, names = find_callbacks(callbacks)
    modules = load_all([*imports, *([] if module is None else [module]), *homes])
    task = _fitting(find_task(task), algo if recipe is None else recipe.algo)
    recipe = recipe or task_recipe(task, algo, options=options)
    recipe = dataclasses.replace(recipe, num_envs=recipe.num_envs if num_envs is None else num_envs)
    recipe = recipe if steps is None else recipe.with_steps(steps)
    recipe, shown = with_demonstrator_found(recipe)
    if not 0 <= seed < 2**32:
        raise TaskError(f"seed must be between 0 and 4294967295, not {seed}")
    if checkpoint_every is not None and checkpoint_every < 1:
        raise TaskError(f"checkpoint_every must be above 0, not {checkpoint_every}")
    if eval_every < 0 or eval_episodes < 1:
        raise TaskError("eval_every must be 0 or more, eval_episodes 1 or more")
    config = RunConfig(
        task=task,
        recipe=recipe,
        seed=seed,
        options=plain_options({**recipe.training_options, **options}),
        checkpoint_every=checkpoint_every or max(1, recipe.steps // _CHECKPOINTS),
        eval_every=eval_every,
        eval_episodes=eval_episodes,
        callbacks=names,
        imports=(*modules, *shown),
        sharded=workers is not None or ray is not None,
    )
    limit_threads(threads)
    session = _Session(config, progress or NoProgress(), workers, ray)
    try:
        run = Run.create(config, Path(out))
        save_contract(contract_of(session.env.contract, config), run.folder)
        return session.go(run)
    finally:
        session.close()


@checked(TaskError)
def resume(
    run: str | Path,
    *,
    steps: int | None = None,
    progress: Progress | None = None,
    threads: int = 1,
    imports: Sequence[str | TaskModule] = (),
    trust: bool = False,
    workers: int | None = None,
    ray: str | None = None,
) -> TrainResult:
    """Resume a run, until its number of steps or another.

    The result is the same, bit for bit, as without the break, if the environment can save
    its state (else a warning says so). With more steps than the run had, a step size that
    falls to zero goes back to where it is at this point of the longer training.

    Args:
        run: The run's folder.
        steps: Control steps in total, instead of those that it was started with.
        progress: Shows how far it is; by default nothing is shown.
        threads: Threads for torch and BLAS.
        imports: Modules or files that register the task, if not those that the run names.
        trust: Whether to import modules that the run names and ``imports`` does not.
        workers: For a run that was begun with workers: how many, by default one.
        ray: Ray address, see `train`.

    Raises:
        FormatError: There is no run, no checkpoint, or it is damaged.
        TaskError: The run has more steps already, its task is not there, or it names code that is
            not trusted.
    """
    found = Run.open(Path(run))
    checkpoint = found.newest_checkpoint()
    modules = load_all(imports)
    if modules:
        found = found.changed(imports=modules)
    require_trust(found, modules, trust=trust)
    load_all(found.config.imports)
    if steps is not None and steps != found.config.recipe.steps:
        done = int(checkpoint.name)
        if steps < done:
            raise TaskError(
                f"the run has {done:,} steps already, more than {steps:,}",
                hint="--steps is the total, not how many more",
            )
        found = found.changed(recipe=found.config.recipe.with_steps(steps))
    if not found.config.sharded and (workers is not None or ray is not None):
        raise TaskError(
            "the run was started without workers", hint="leave out --workers and --ray to go on"
        )
    limit_threads(threads)
    session = _Session(found.config, progress or NoProgress(), workers, ray)
    try:
        return session.go(found, checkpoint)
    finally:
        session.close()


def _fitting(task: str, algo: str | None) -> str:
    """Return the task, or its twin where an algorithm needs continuous actions."""
    twin = with_continuous_actions(task)
    if algo not in NEED_CONTINUOUS_ACTIONS or twin == task:
        return task
    text = f"{algo} needs continuous actions: it learns {twin} instead of {task}"
    warnings.warn(TaskWarning(text), stacklevel=3)
    return twin


class _Session:
    """The living parts of a run: environment and learner."""

    def __init__(
        self, config: RunConfig, progress: Progress, workers: int | None, ray: str | None
    ) -> None:
        self.progress = progress
        self.episodes = EpisodeLog()
        self.env = (
            join_workers(config, workers, ray, self.episodes.add)
            if config.sharded
            else _alone(config, self.episodes)
        )
        if isinstance(progress, Watched) and isinstance(self.env, VectorEnvAdapter):
            progress.attach(self.env.env)
        try:
            self.learner: Learner = build_learner(config.recipe, self.env, config.seed)
        except BaseException:
            self.env.close()
            raise

    def close(self) -> None:
        self.env.close()

    def go(self, run: Run, checkpoint: Path | None = None) -> TrainResult:
        """Train until the total; from the checkpoint if there is one."""
        with stopping(lambda: self.progress.say(_STOPPING)) as stop:
            callback = TrainingCallback(run, self.episodes, self.progress, stop)
            if checkpoint is not None:
                extra = read_checkpoint(checkpoint, self.learner)
                with usable(checkpoint):
                    callback.set_state(extra, self.learner.num_timesteps)
            before = self.learner.num_timesteps
            callback.attach(self.learner)
            self.callbacks = [callback, *make_callbacks(run.config.callbacks)]
            self.progress.start(before, run.config.recipe.steps)
            start = time.perf_counter()
            try:
                interrupted = self._learn(callback, fresh=checkpoint is None)
            finally:
                stop.over.set()
                self.progress.close()
                self.learner.logger.close()
            seconds = time.perf_counter() - start
        steps = callback.saved_at if interrupted else self.learner.num_timesteps
        new = steps - before
        period = self.env.control_period
        return TrainResult(
            run=callback.run,
            steps=steps,
            new_steps=new,
            wall_seconds=seconds,
            sim_seconds=None if period is None else new * period,
            interrupted=interrupted,
            stop_signal=stop.signal if interrupted else None,
            summary=self.episodes.summary(),
        )

    def _learn(self, callback: TrainingCallback, *, fresh: bool) -> bool:
        """Run the learner; returns whether it was interrupted."""
        left = callback.run.config.recipe.steps - self.learner.num_timesteps
        if not fresh and left <= 0:
            return False
        try:
            self.learner.learn(
                left, callback=self.callbacks, log_interval=None, reset_num_timesteps=fresh
            )
        except StopRequested:
            return True
        except SuccessReached:
            self._go_over_to_the_end(callback)
            return self._learn(callback, fresh=False)
        except Interrupted:
            if not callback.stop.timed_out:
                raise
            return True
        except ValueError as error:
            self._check_weights(error)
            raise
        self._check_weights(None)
        callback.finish()
        self.progress.update(self.learner.num_timesteps, self.episodes.summary())
        return False

    def _go_over_to_the_end(self, callback: TrainingCallback) -> None:
        """Shorten the training, see `Recipe.success_to_finish`."""
        done, recipe = self.learner.num_timesteps, callback.run.config.recipe
        total = recipe.steps_after_success(done)
        callback.run = callback.run.changed(recipe=recipe.with_steps(total))
        self.progress.say(
            f"{recipe.success_to_finish:.0%} succeed after {done:,} steps: ends at {total:,}"
        )
        self.progress.start(done, total)

    def _check_weights(self, cause: ValueError | None) -> None:
        """Raise an error if weights are no longer finite."""
        if all(torch.isfinite(weight).all() for weight in self.learner.policy.parameters()):
            return
        raise TaskError(
            f"the weights became infinite within {self.learner.num_timesteps:,} steps",
            hint="lower the learning rate or the reward_scale; does the task give NaN?",
        ) from cause


def _alone(config: RunConfig, episodes: EpisodeLog) -> VectorEnvAdapter:
    """Return all copies in this process."""
    return VectorEnvAdapter(
        make_task(config.task, config.recipe.num_envs, **config.options),
        reward_scale=config.recipe.reward_scale,
        goal_reward=config.recipe.goal_reward,
        on_episodes=episodes.add,
    )

"""Train a policy for a task in parallel environments, or resume a stopped run.
Ctrl-C and SIGTERM save a checkpoint.

  gazelle train TurtleBot3Stage1
  gazelle train TurtleBot3Stage4 --steps 2e6 --seed 3
  gazelle train --resume runs/TurtleBot3Stage1-ppo-20261105-140302 [--steps 4e6]
  gazelle train TurtleBot3Stage4 --workers 2     (or --ray auto, on a cluster)
  gazelle train my/Task-v0 --import my_tasks.py
  gazelle train my_package.tasks:my/Task-v0
  gazelle train TurtleBot3Stage2 --sweep search.yaml
"""  # noqa: D205  # this is the text of --help

from __future__ import annotations

import argparse
import shlex
import signal
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from gazelle.cli import showing
from gazelle.cli.viewing import COPIES, add_view, watched
from gazelle_ros.base.argument_types import positive_int
from gazelle_ros.cli.parsing import (
    add_environment_options,
    add_file_options,
    add_import_option,
    add_scenario_options,
    add_worker_options,
    environment_options,
    key_value,
)

if TYPE_CHECKING:
    from gazelle.training import Recipe, TrainResult


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "task", nargs="?", metavar="TASK", help="task from 'gazelle tasks', or MODULE:ID"
    )
    parser.add_argument(
        "--algo", metavar="NAME", help="algorithm: ppo, dqn, sac, td3, ddpg, a2c, tqc, trpo, ..."
    )
    parser.add_argument(
        "--steps", metavar="N", type=positive_int, help="total number of environment steps"
    )
    parser.add_argument(
        "--num-envs", metavar="N", type=positive_int, help="number of parallel environments"
    )
    parser.add_argument("--seed", metavar="N", type=int, help="random seed (default 0)")
    parser.add_argument("--resume", metavar="RUN", type=Path, help="resume this run")
    parser.add_argument(
        "--checkpoint-every", metavar="N", type=positive_int, help="steps between checkpoints"
    )
    parser.add_argument(
        "--eval-every",
        metavar="N",
        type=positive_int,
        help="steps between evaluations; the best policy is saved",
    )
    parser.add_argument(
        "--set",
        dest="values",
        metavar="NAME=VALUE",
        action="append",
        type=key_value,
        default=[],
        help="hyperparameter, such as net_arch=[128,128] or batch_size=512 (repeatable)",
    )
    parser.add_argument(
        "--callback",
        metavar="MODULE:CLASS",
        action="append",
        default=[],
        help="Stable-Baselines3 callback class to add (repeatable)",
    )
    parser.add_argument(
        "--sweep",
        metavar="FILE",
        type=Path,
        help="search hyperparameters as this file says, or resume the search",
    )
    parser.add_argument(
        "--out", metavar="DIR", type=Path, help="parent folder of the run (default runs)"
    )
    add_worker_options(parser, "number of rollout processes; results do not depend on it")
    add_view(parser, COPIES)
    add_import_option(parser)
    add_file_options(parser)
    add_scenario_options(parser)
    add_environment_options(parser)
    parser.set_defaults(parser=parser)


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    _check(args)
    if args.sweep is not None:
        return _sweep(args)
    return report(_begin(args) if args.resume is None else _resume(args))


def _begin(args: argparse.Namespace) -> TrainResult:
    """Train from scratch."""
    from gazelle.training import choose_progress, task_recipe, with_values

    _require_task(args)
    options = environment_options(args)
    own = task_recipe(args.task, args.algo, imports=args.imports, options=options)
    recipe = with_values(own, dict(args.values))
    planned = replace(recipe, num_envs=args.num_envs or recipe.num_envs)
    planned = planned if args.steps is None else planned.with_steps(args.steps)
    seed = args.seed or 0
    engine = {**recipe.training_options, **options}.get("engine")
    where = "" if engine is None else f", engine {engine}"
    sys.stderr.write(
        f"{recipe.algo}: {_most(planned)}, {planned.num_envs} environments, "
        f"seed {seed}{where}\n{_rounding(planned)}"
    )
    from gazelle.training import train  # imports torch, which takes seconds

    return train(
        args.task,
        recipe=planned,
        seed=seed,
        out=args.out or Path("runs"),
        checkpoint_every=args.checkpoint_every,
        callbacks=args.callback,
        eval_every=args.eval_every or 0,
        progress=watched(choose_progress(), args),
        imports=args.imports,
        workers=args.workers,
        ray=args.ray,
        **options,
    )


def _resume(args: argparse.Namespace) -> TrainResult:
    """Resume a run."""
    from gazelle.training import Run, choose_progress

    config = Run.open(args.resume).config
    planned = config.recipe if args.steps is None else config.recipe.with_steps(args.steps)
    sys.stderr.write(f"{config.task}, {planned.algo}: to {_most(planned)}\n")
    sys.stderr.write(_rounding(planned))
    from gazelle.training import resume  # imports torch, which takes seconds

    return resume(
        args.resume,
        steps=args.steps,
        progress=watched(choose_progress(), args),
        imports=args.imports,
        trust=args.trust,
        workers=args.workers,
        ray=args.ray,
    )


def _sweep(args: argparse.Namespace) -> int:
    """Search hyperparameters; returns the exit code."""
    from gazelle.training.sweep_plan import SweepPlan

    _require_task(args)
    plan = SweepPlan.read(args.sweep)
    sys.stderr.write(f"{args.task}: {plan.trials} trials in all\n")
    from gazelle.training.sweep import sweep  # imports torch, which takes seconds

    found = sweep(
        args.task,
        plan,
        out=args.out or Path("runs"),
        imports=tuple(args.imports),
        workers=args.workers,
        ray=args.ray,
        **environment_options(args),
    )
    rows = [("TRIAL", "SCORE", "VALUES", "RUN")]
    for trial in found.trials:
        values = ", ".join(f"{name}={_short(value)}" for name, value in trial.values.items())
        score = "failed" if trial.score is None else f"{trial.score:.4g}"
        rows.append((str(trial.number), score, values, trial.run))
    sys.stdout.write(showing.table(rows))
    sys.stdout.write(f"{found.new} new trials; all is in {found.folder}\n")
    return 0


def _require_task(args: argparse.Namespace) -> None:
    """Raise an error for an unknown task, before anything slow."""
    from gazelle.training.importing import load_all
    from gazelle.training.tasks import find_task

    load_all(args.imports)
    find_task(args.task)


def _most(recipe: Recipe) -> str:
    """Return the steps of a training, and at which share of successes it does fewer."""
    steps, share = f"{recipe.rounded_steps:,} steps", recipe.success_to_finish
    return steps if share is None else f"at most {steps}, fewer once {share:.0%} succeed"


def _rounding(recipe: Recipe) -> str:
    """Return a line that says why more steps than requested are trained; empty if they are not."""
    if recipe.rounded_steps == recipe.steps:
        return ""
    size = f"{recipe.num_envs} x {recipe.rollout_steps or 1}"
    return f"  {recipe.steps:,} steps, rounded up to whole rollouts of {size}\n"


def _short(value: object) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def report(result: TrainResult) -> int:
    """Print what came out and what to type next; returns the exit code."""
    folder = result.run.folder
    imports = "".join(
        f" --import {shlex.quote(module.text())}" for module in result.run.config.imports
    )
    if result.interrupted:
        total = result.run.config.recipe.steps
        sys.stderr.write(
            f"stopped at {result.steps:,} of {total:,} steps; everything is saved\n"
            f"  go on with: {showing.program()} train --resume {folder}{imports}\n"
        )
        return 128 + (result.stop_signal or signal.SIGINT)
    if not result.new_steps:
        sys.stdout.write(
            f"nothing left to do: the run has its {result.steps:,} steps "
            "(--steps N trains on to more)\n"
        )
    else:
        sys.stdout.write(f"trained: {showing.training(result, indent=9)}\n")
    sys.stdout.write(
        f"the run: {folder}\n"
        f"next:    {showing.program()} eval {folder}{imports}\n"
        f"         tensorboard --logdir {folder}\n"
    )
    return 0


def _check(args: argparse.Namespace) -> None:
    """Check for options that exclude each other."""
    parser: argparse.ArgumentParser = args.parser
    if args.view is not None and (args.workers is not None or args.ray is not None):
        parser.error("--view cannot be used with --workers or --ray")
    if args.resume is None:
        if args.task is None:
            parser.error("a task, or a run with --resume, is required")
        return
    fixed = ["task", "algo", "num_envs", "seed", "checkpoint_every", "eval_every", "out"]
    fixed += ["engine", "world", "robot", "goals", "starts"]
    given = [name for name in fixed if getattr(args, name) is not None]
    given += ["set"] if args.values else []
    given += ["callback"] if args.callback else []
    if given or args.option:
        name = (given or ["option"])[0].replace("_", "-")
        name = name if name == "task" else f"--{name}"
        parser.error(f"a resumed run keeps its settings; leave out {name}")

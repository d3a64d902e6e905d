"""List the tasks that 'gazelle train' knows; or show one with its recipe,
commands, success rates, seeds and intervals.

  gazelle tasks
  gazelle tasks --long
  gazelle tasks TurtleBot3Stage4
"""  # noqa: D205  # this is the text of --help

from __future__ import annotations

import argparse
import sys
import textwrap
from collections.abc import Sequence
from typing import TYPE_CHECKING

from gazelle.cli import showing

if TYPE_CHECKING:
    from gazelle.training import Claim, Task

_HEAD = ("TASK", "SUCCESS", "DESCRIPTION")
_LEGEND = """\
SUCCESS: goals reached after 'gazelle train TASK', on starts and goals that were
not trained on; - where no figure is published. 'gazelle tasks --long' lists
algorithms, engines and times, 'gazelle tasks TASK' shows all about one task.
"""
_LONG_HEAD = ("TASK", "ALGO", "ENGINE", "PLANAR", "MUJOCO", "CPU", "WALL")
_ENGINES = ("planar", "mujoco")
_LONG_LEGEND = """\
PLANAR, MUJOCO: goals reached after 'gazelle train TASK', on starts and goals
that were not trained on, by 'gazelle eval RUN --engine ENGINE'. CPU: processor
time of the training [s], which is the most that it takes where nothing else
runs. WALL: on a clock [s]; * beside other programs, - not measured. 'gazelle
tasks TASK' shows commands, each seed, and the interval in which one more seed
lies at 95 %; 'gazelle bench recipes' measures again. For gym.make a TASK is
gazelle/TASK-v0.
"""
_QUIET = 0.1  # processors that others kept busy at most, for a wall time to be of a quiet machine


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("task", nargs="?", metavar="TASK", help="show this task")
    parser.add_argument(
        "--long", action="store_true", help="show figures and times instead of descriptions"
    )


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    from gazelle.training import find_task, list_tasks

    tasks = list_tasks()
    if args.task is not None:
        id_ = find_task(args.task)
        (task,) = [each for each in tasks if each.id == id_] or [_unlisted(id_)]
        sys.stdout.write(_details(task))
        return 0
    sys.stdout.write(_figures_of(tasks) if args.long else _descriptions_of(tasks))
    return 0


def _descriptions_of(tasks: Sequence[Task]) -> str:
    """Return the list of tasks with a sentence about each."""
    from gazelle.training import describe_task

    rows = [(_typed(task), _success(task), describe_task(task.id)) for task in tasks]
    return f"{showing.table([_HEAD, *rows])}\n{_LEGEND}"


def _figures_of(tasks: Sequence[Task]) -> str:
    """Return the list of tasks with what their recipes reach and cost."""
    without = [(_typed(task), why) for task in tasks if (why := _why_not(task))]
    listed = [task for task in tasks if not _why_not(task)]
    text = f"{showing.table([_LONG_HEAD, *map(_row, listed)])}\n{_LONG_LEGEND}"
    if without:
        text += "\n" + showing.table([("TASK", "WHY IT HAS NO FIGURE"), *without])
    return text


def _success(task: Task) -> str:
    """Return the success rate of a task, in the engine that its recipe trains in."""
    from gazelle.training import listed_recipe

    rates = {claim.engine: claim.success for claim in _claims(task) if claim.success}
    if not rates:
        return "-"
    engine = str(listed_recipe(task.id).training_options.get("engine"))
    return percent(rates.get(engine, next(iter(rates.values()))).value)


def _row(task: Task) -> tuple[str, ...]:
    from gazelle.training import listed_recipe

    claims = _claims(task)
    recipe = listed_recipe(task.id)
    reached = {claim.engine: claim.success for claim in claims}
    times = [claim for claim in claims if claim.trials]
    return (
        _typed(task),
        recipe.algo,
        str(recipe.training_options.get("engine", "-")),
        *("-" if (rate := reached.get(name)) is None else percent(rate.value) for name in _ENGINES),
        f"{times[0].cpu:.0f}" if times else "-",
        _wall(times[0]) if times else "-",
    )


def _details(task: Task) -> str:
    """Return the recipe, commands and figures of one task."""
    from gazelle.training import describe_task, listed_recipe, published_claims

    recipe = listed_recipe(task.id)
    engine = recipe.training_options.get("engine")
    where = "" if engine is None else f", engine {engine}"
    most = "" if recipe.success_to_finish is None else "at most "
    steps = f"{most}{recipe.steps:,} control steps"
    own = _claims(task)
    rows = [
        ("train", f"gazelle train {_typed(task)}"),
        ("recipe", f"{recipe.algo}, {steps}, {recipe.num_envs} environments{where}"),
        *(_figures(own) if own else [("figure", _why_not(task) or "none is known of this task")]),
    ]
    for train in published_claims().other_trainings(task.name) if _is_own(task) else ():
        rows += [("or", train), *_figures(published_claims().of_training(train))]
    description = "".join(f"{line}\n" for line in textwrap.wrap(describe_task(task.id), 80))
    return f"{task.id}\n{description}" + showing.table([("  " + name, text) for name, text in rows])


def _figures(claims: Sequence[Claim]) -> list[tuple[str, str]]:
    """Return what a training reaches in each engine, and what it costs."""
    rows: list[tuple[str, str]] = []
    for claim in claims:
        rows += [(claim.engine, reached(claim)), ("", claim.evaluate)]
    measured = [claim for claim in claims if claim.trials]
    if not measured:
        return rows
    first = measured[0]
    rows.append(("seeds", f"{', '.join(map(str, first.seeds))}; {_source(first)}"))
    rows.append(("time", f"{first.cpu:.0f} s of one processor for each training"))
    if first.wall is not None:
        busy = "" if first.others is None else f", others kept {first.others:.1f} busy"
        rows.append(
            ("wall", f"{first.wall:.0f} s; of {first.trials[0].processors} processors{busy}")
        )
    return rows


def reached(claim: Claim) -> str:
    """Return the success rate of all seeds, that of each, and the 95 % interval of one more."""
    success, interval = claim.success, claim.predicted
    if success is None:
        return "not measured yet"
    if interval is None:
        return f"{percent(success.value)}; one seed ({success.count} of {success.total})"
    low, high = interval
    each = ", ".join(f"{100.0 * trial.rate.value:.1f}" for trial in claim.trials)
    return f"{percent(success.value)} ({each}); one more seed {100.0 * low:.1f} to {percent(high)}"


def percent(share: float) -> str:
    """Return ``96.6 %``."""
    return f"{100.0 * share:.1f} %"


def _source(claim: Claim) -> str:
    return f"measured {' and '.join(claim.dates)} at {' and '.join(claim.commits)}"


def _claims(task: Task) -> tuple[Claim, ...]:
    from gazelle.training import published_claims

    return published_claims().of(task.name) if _is_own(task) else ()


def _why_not(task: Task) -> str | None:
    from gazelle.training import published_claims

    return published_claims().unverified.get(task.name) if _is_own(task) else None


def _is_own(task: Task) -> bool:
    return task.id == f"gazelle/{task.name}-v0"


def _typed(task: Task) -> str:
    return task.name if _is_own(task) else task.id


def _unlisted(id_: str) -> Task:
    """Return a task of Gymnasium's own."""
    from gazelle.training import Task

    return Task(id_, id_)


def _wall(claim: Claim) -> str:
    """Return ``59``, ``59*`` where other programs ran beside it, ``-`` where it was not measured."""
    if claim.wall is None:
        return "-"
    return f"{claim.wall:.0f}{'*' if (claim.others or 0.0) > _QUIET else ''}"

"""List the tasks that 'gazelle train' knows, and what their policies were found
to reach; or tell all about one: recipe, commands, figures with intervals.

  gazelle tasks
  gazelle tasks TurtleBot3Stage4
"""  # noqa: D205  # this is the text of --help

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

from gazelle.cli import showing

if TYPE_CHECKING:
    from gazelle.training import Task, Verified

_HEAD = ("TASK", "ALGO", "ENGINE", "PLANAR", "MUJOCO", "CPU", "WALL")
_LEGEND = """\
PLANAR, MUJOCO: goals reached after 'gazelle train TASK', on starts and goals
that were not trained on, by 'gazelle eval RUN --engine ENGINE'. CPU: processor
time of the training [s], which is the most that it takes where nothing else
runs. WALL: on a clock [s]; * beside other programs, - not measured. 'gazelle
tasks TASK' tells commands, intervals and how busy it was, 'gazelle bench
recipes' measures again. For gym.make a TASK of Gazelle's is gazelle/TASK-v0.
"""
_EPISODES = 1000
_QUIET = 0.1  # processors that others kept busy at most, for a wall time to be of a quiet machine


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("task", nargs="?", metavar="TASK", help="all about one of them")


def run(args: argparse.Namespace) -> int:
    """Do it; returns the exit code."""
    from gazelle.training import VERIFIED, find_task, list_tasks

    tasks = list_tasks()
    if args.task is not None:
        id_ = find_task(args.task)
        (task,) = [each for each in tasks if each.id == id_] or [_unlisted(id_)]
        sys.stdout.write(_told(task))
        return 0
    listed = [task for task in tasks if task.name in VERIFIED or not _why_not(task)]
    sys.stdout.write(showing.table([_HEAD, *map(_row, listed)]))
    sys.stdout.write(f"\n{_LEGEND}")
    without = [(_typed(task), why) for task in tasks if (why := _why_not(task))]
    if without:
        sys.stdout.write("\n" + showing.table([("TASK", "WHY IT HAS NO FIGURE"), *without]))
    return 0


def _row(task: Task) -> tuple[str, ...]:
    from gazelle.training import VERIFIED, listed_recipe

    found = VERIFIED.get(task.name)
    recipe = listed_recipe(task.id)
    return (
        _typed(task),
        recipe.algo,
        str(recipe.training_options.get("engine", "-")),
        _reached(found, "planar"),
        _reached(found, "mujoco"),
        "-" if found is None else f"{found.seconds:.0f}",
        "-" if found is None else _wall(found),
    )


def _told(task: Task) -> str:
    """All about one task."""
    from gazelle.training import VERIFIED, VERIFIED_WITH, listed_recipe

    found = VERIFIED.get(task.name)
    recipe = listed_recipe(task.id)
    engine = recipe.training_options.get("engine")
    where = "" if engine is None else f", engine {engine}"
    rows = [
        ("train", f"gazelle train {_typed(task)}"),
        (
            "recipe",
            f"{recipe.algo}, {recipe.steps:,} control steps, {recipe.num_envs} copies{where}",
        ),
    ]
    if found is None:
        rows.append(("figure", _why_not(task) or "none is known of this task"))
    else:
        rows += _figures(found)
    for (name, algo), other in VERIFIED_WITH.items():
        if _is_own(task) and name == task.name:
            rows += _with_algorithm(name, algo, other)
    return f"{task.id}\n" + showing.table([("  " + name, text) for name, text in rows])


def _figures(found: Verified) -> list[tuple[str, str]]:
    rows: list[tuple[str, str]] = []
    for engine, rate in found.success.items():
        rows.append((engine, showing.rate(rate).lstrip()))
        rows.append(("", f"gazelle eval RUN --engine {engine} --episodes {_EPISODES}"))
    rows.append(("seeds", ", ".join(map(str, range(found.seeds)))))
    rows.append(("time", f"{found.seconds:.0f} s of one processor for each training"))
    wall = found.wall
    if wall is not None:
        where = f"of {wall.processors} processors, others kept {wall.others:.1f} busy"
        rows.append(("wall", f"{wall.seconds:.0f} s; {where}"))
    return rows


def _with_algorithm(task: str, algo: str, found: Verified) -> list[tuple[str, str]]:
    """What an algorithm reaches that is not the recipe's."""
    rows = [("or", f"gazelle train {task} --algo {algo}")]
    for engine, reached in found.success.items():
        rows.append((engine, showing.rate(reached).lstrip()))
    return [*rows, ("time", f"{found.seconds:.0f} s")]


def _why_not(task: Task) -> str | None:
    from gazelle.training import UNVERIFIED

    return UNVERIFIED.get(task.name) if _is_own(task) else None


def _is_own(task: Task) -> bool:
    return task.id == f"gazelle/{task.name}-v0"


def _typed(task: Task) -> str:
    return task.name if _is_own(task) else task.id


def _unlisted(id_: str) -> Task:
    """Of Gymnasium's own."""
    from gazelle.training import Task

    return Task(id_, id_)


def _wall(found: Verified) -> str:
    """``59``, ``59*`` where other programs ran beside it, ``-`` where it was not measured."""
    if found.wall is None:
        return "-"
    return f"{found.wall.seconds:.0f}{'*' if found.wall.others > _QUIET else ''}"


def _reached(found: Verified | None, engine: str) -> str:
    """``99.9 %``; ``-`` where nothing was verified."""
    rate = None if found is None else found.success.get(engine)
    return "-" if rate is None else f"{100.0 * rate.value:.1f} %"

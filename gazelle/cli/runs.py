"""List the training runs of a folder: task, steps, success, time; newest last.

  gazelle runs
  gazelle runs runs other/runs
  gazelle runs --import run.zip      # of 'gazelle export RUN --format run'

Importing an archive executes nothing in it. If the run names Python modules of
its own, 'gazelle eval' and 'gazelle train' need --trust.
"""  # this is the text of --help

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from gazelle.cli import showing

if TYPE_CHECKING:
    from gazelle.training import RunSummary

_HEAD = ("RUN", "SEED", "STEPS", "SUCCESS", "RETURN", "TIME")
_LEGEND = """\
SUCCESS, RETURN: means of the last training episodes. 'gazelle eval RUN' evaluates
on starts and goals that were not trained on, 'gazelle train --resume RUN' continues
an unfinished run, 'gazelle plot RUN RUN curves.png' compares runs.
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "folders",
        nargs="*",
        metavar="FOLDER",
        type=Path,
        default=[Path("runs")],
        help="folder with runs (default runs)",
    )
    parser.add_argument(
        "--import",
        dest="archives",
        metavar="FILE",
        type=Path,
        action="append",
        default=[],
        help="first unpack an exported run into the first folder (repeatable)",
    )


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    from gazelle.training import list_runs, unpack_run

    for archive in args.archives:
        unpacked = unpack_run(archive, args.folders[0])
        sys.stdout.write(f"{archive} is in {unpacked.folder}\n")
    rows = [_row(each, folder) for folder in args.folders for each in list_runs(folder)]
    if not rows:
        sys.stdout.write("there are no runs; 'gazelle train TASK' makes one\n")
        return 0
    sys.stdout.write(showing.table([_HEAD, *rows]))
    sys.stdout.write(f"\n{_LEGEND}")
    return 0


def _row(summary: RunSummary, folder: Path) -> tuple[str, ...]:
    """Return the cells of a run."""
    from gazelle.training.recipes import task_name

    run, total = summary.run, summary.run.config.recipe.steps
    name = run.folder.relative_to(folder).as_posix()
    name = run.folder.name if name == "." else name
    task, algo = task_name(run.config.task), run.config.recipe.algo
    if not run.folder.name.startswith(f"{task}-{algo}-"):
        name = f"{name} ({task}, {algo})"
    steps = _short(summary.steps)
    return (
        name,
        str(run.config.seed),
        steps if summary.finished else f"{steps} of {_short(total)}",
        "-" if summary.success is None else f"{100.0 * summary.success:.1f} %",
        "-" if summary.mean_return is None else f"{summary.mean_return:.4g}",
        f"{summary.seconds:,.0f} s",
    )


def _short(steps: int) -> str:
    """Return a number of steps in thousands or millions."""
    if steps < 1_000_000:
        return f"{steps / 1e3:.0f}k"
    return f"{steps / 1e6:.1f}M"

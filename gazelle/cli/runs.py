"""List the training runs of a folder: task, steps, success, time; newest last.

gazelle runs
gazelle runs runs other/runs
"""

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
SUCCESS, RETURN: of the last episodes of the training; 'gazelle eval RUN' tries
starts and goals that were not trained on. 'gazelle train --resume RUN' goes on
with one that is not finished; 'gazelle plot RUN RUN curves.png' compares them.
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "folders",
        nargs="*",
        metavar="FOLDER",
        type=Path,
        default=[Path("runs")],
        help="where they are (default runs)",
    )


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    from gazelle.training import list_runs

    rows = [_row(each, folder) for folder in args.folders for each in list_runs(folder)]
    if not rows:
        sys.stdout.write("there are no runs; 'gazelle train TASK' makes one\n")
        return 0
    sys.stdout.write(showing.table([_HEAD, *rows]))
    sys.stdout.write(f"\n{_LEGEND}")
    return 0


def _row(summary: RunSummary, folder: Path) -> tuple[str, ...]:
    """Return the cells of a run."""
    run, total = summary.run, summary.run.config.recipe.steps
    name = run.folder.relative_to(folder).as_posix()
    steps = _short(summary.steps)
    return (
        run.folder.name if name == "." else name,
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

"""Formatting of results for a terminal."""

from __future__ import annotations

import os
import shutil
import sys
import textwrap
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from gazelle.training import Evaluation, SuccessRate, TrainResult


_WIDEST_NAME = 30
"""Characters of a name that a text stands beside; below a longer one, as in argparse's help."""


def table(rows: Sequence[Sequence[str]], width: int = 80) -> str:
    """Return rows in aligned columns, each line ended; a long last column is wrapped at spaces."""
    columns = [max(len(cell) for cell in column) for column in zip(*rows, strict=True)][:-1]
    if len(columns) == 1:
        columns = [min(columns[0], _WIDEST_NAME)]
    indent = sum(columns) + 2 * len(columns)
    lines: list[str] = []
    for row in rows:
        head = "".join(f"{cell:<{size + 2}}" for cell, size in zip(row, columns, strict=False))
        if any(len(cell) > size for cell, size in zip(row, columns, strict=False)):
            lines.append(head.rstrip())
            head = " " * indent
        lines += textwrap.wrap(
            row[-1],
            width=max(width, indent + 20),
            initial_indent=head,
            subsequent_indent=" " * indent,
            break_long_words=False,
            break_on_hyphens=False,
        ) or [head.rstrip()]
    return "".join(f"{line}\n" for line in lines)


def evaluation(result: Evaluation) -> str:
    """Return rates with their intervals, then the means and the speed."""
    rows = [
        ("success", rate(result.success)),
        ("collision", rate(result.collision)),
        ("time-out", rate(result.timeout)),
        *([("other end", rate(result.other))] if result.other.count else []),
        ("mean return", f"{result.mean_return:.2f}"),
        ("mean length", f"{result.mean_length:.1f} control steps"),
        ("speed", speed(result.wall_seconds, result.sim_seconds)),
    ]
    return table([("  " + name, text) for name, text in rows])


def rate(value: SuccessRate | None) -> str:
    """Return a rate as ``97.0 % (95 % interval 91.5 to 99.0 %, 97 of 100)``."""
    if value is None:
        return "not reported by this task"
    low, high = value.interval
    return (
        (
            f"{value.value:6.1%}   95 % interval {low:.1%} to {high:.1%}"
            f"   ({value.count} of {value.total})"
        )
        .replace("%", " %")
        .replace("95  %", "95 %")
    )


def training(result: TrainResult, indent: int = 0) -> str:
    """Return a summary of a training in two lines without a final newline.

    Args:
        result: Result of the training.
        indent: Spaces before the second line.
    """
    pace = result.new_steps / max(result.wall_seconds, 1e-9)
    return (
        f"{result.new_steps:,} control steps, {pace:,.0f} a second\n{' ' * indent}"
        f"{speed(result.wall_seconds, result.sim_seconds)}"
    )


def speed(wall: float, simulated: float | None) -> str:
    """Return wall time, simulated time of all copies, and their ratio."""
    if simulated is None:
        return f"{wall:.1f} s"
    return f"{wall:.1f} s for {duration(simulated)} simulated, RTF {simulated / wall:,.0f}"


def duration(seconds: float) -> str:
    """Return a duration as ``45.0 s``, ``12.5 min`` or ``27.8 h``."""
    if seconds < 120:
        return f"{seconds:.1f} s"
    if seconds < 7200:
        return f"{seconds / 60:.1f} min"
    return f"{seconds / 3600:.1f} h"


def program() -> str:
    """Return the command for this program: its name, or its path where the shell would not find it."""
    called = Path(sys.argv[0])
    if called.name != "gazelle" or shutil.which("gazelle") is not None:
        return "gazelle"
    return os.path.relpath(called)

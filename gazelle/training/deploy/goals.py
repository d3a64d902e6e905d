"""Goals of a deployed policy and their results."""

from __future__ import annotations

import csv
import math
from dataclasses import dataclass
from pathlib import Path

from gazelle.argument_checks import checked
from gazelle.errors import FormatError
from gazelle_ros.base.text_files import read_text


@checked(FormatError)
@dataclass(frozen=True, slots=True)
class GoalPlace:
    """A place to go to."""

    x: float
    """Goal, x [m]"""
    y: float
    """Goal, y [m]"""
    frame: str = ""
    """Of the place; empty for that of the odometry."""


@dataclass(frozen=True, slots=True)
class GoalResult:
    """Result of a goal; the distance is NaN where it was never measured."""

    goal: GoalPlace
    outcome: str
    """``reached``, ``collision``, ``time-out`` or ``replaced`` by another goal."""
    seconds: float
    """Duration [s of the node's clock]."""
    distance: float
    """Distance of the robot from it then [m]."""


@checked(FormatError)
def read_goals(file: Path) -> list[GoalPlace]:
    """Read goals from a text file: one ``x, y`` [m] a line, with an optional frame.

    Empty lines, and what follows a ``#``, are left out.

    Raises:
        FormatError: A line is not a goal, or the file cannot be read.
    """
    goals = []
    try:
        lines = read_text(file).splitlines()
    except OSError as error:
        raise FormatError(f"cannot read the goals: {error}", file=str(file)) from error
    for number, line in enumerate(lines, 1):
        text = line.partition("#")[0].strip()
        if not text:
            continue
        try:
            goals.append(parse_goal(text))
        except ValueError as error:
            hint = "expected x, y in metres, such as: 1.5, -0.5"
            raise FormatError(str(error), file=str(file), line=number, hint=hint) from error
    return goals


def parse_goal(text: str) -> GoalPlace:
    """Return a goal from ``x,y`` or ``x,y,frame``.

    Raises:
        ValueError: It is not of that form.
    """
    try:
        (fields,) = csv.reader([text], skipinitialspace=True)
    except csv.Error:  # such as a line break
        raise ValueError(f"'{text}' is not a goal") from None
    if len(fields) not in {2, 3}:
        raise ValueError(f"'{text}' is not a goal")
    try:
        x, y = float(fields[0]), float(fields[1])
    except ValueError:
        raise ValueError(f"'{text}' is not a goal") from None
    if not (math.isfinite(x) and math.isfinite(y)):
        raise ValueError(f"'{text}' is not a goal")
    return GoalPlace(x, y, fields[2].strip() if len(fields) == 3 else "")

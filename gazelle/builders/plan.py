"""Floor plans drawn with letters.

A plan is text: one letter a square cell, rows from north (+y) to south, columns from west to
east (+x)::

    ##########
    #   d    #
    #        #
    #### #####

``#`` is wall. Every other letter is free floor; letters can mark where things go.
"""

from __future__ import annotations

from gazelle.argument_checks import checked
from gazelle.builders.errors import BuildError, positive
from gazelle.builders.paint import Paint
from gazelle.builders.solids import ORIGIN, assemble, slab
from gazelle.description import Model, Pose

_WALL = "#"


@checked(BuildError)
def plan_walls(
    plan: str,
    *,
    name: str = "walls",
    cell: float = 0.5,
    height: float = 2.5,
    color: Paint = "plaster",
    pose: Pose = ORIGIN,
) -> Model:
    """Return the walls of a floor plan, its middle at the frame's origin.

    Neighbouring cells become one box, as large as it can be.

    Args:
        plan: See the text of the module.
        name: Of the model.
        cell: Side of a cell [m].
        height: Of the walls [m].
        color: As ``material`` takes it.
        pose: Of the model in the world.

    Raises:
        BuildError: The plan has no walls.
    """
    positive(cell, "the side of a cell")
    positive(height, "the height of a wall")
    rows = _rows(plan)
    blocks = _blocks(rows)
    if not blocks:
        raise BuildError("the floor plan has no walls", hint="draw them with '#'")
    parts = []
    for number, (row, column, down, across) in enumerate(blocks):
        x, y = _place(rows, row + (down - 1) / 2.0, column + (across - 1) / 2.0, cell)
        size = (across * cell, down * cell, height)
        parts.append(slab(f"wall_{number}", size, (x, y, height / 2.0), color))
    return assemble(name, parts, pose=pose)


@checked(BuildError)
def plan_places(plan: str, letter: str, *, cell: float = 0.5) -> list[tuple[float, float]]:
    """Return the positions of a letter in a plan: (x, y) of the cells [m], row by row.

    Raises:
        BuildError: ``letter`` is not one letter, or the cell has no size.
    """
    positive(cell, "the side of a cell")
    if len(letter) != 1:
        raise BuildError(f"expected one letter, found '{letter}'")
    rows = _rows(plan)
    return [
        _place(rows, row, column, cell)
        for row, line in enumerate(rows)
        for column, found in enumerate(line)
        if found == letter
    ]


@checked(BuildError)
def plan_size(plan: str, *, cell: float = 0.5) -> tuple[float, float]:
    """Return length along x and width along y of a plan [m]."""
    rows = _rows(plan)
    return (len(rows[0]) * cell, len(rows) * cell)


def _rows(plan: str) -> list[str]:
    """Return lines of equal length, without blank lines and indentation around the drawing."""
    lines = [line.rstrip() for line in plan.expandtabs().splitlines()]
    while lines and not lines[0]:
        lines.pop(0)
    while lines and not lines[-1]:
        lines.pop()
    if not lines:
        raise BuildError("the floor plan is empty")
    indent = min(len(line) - len(line.lstrip()) for line in lines if line)
    width = max(len(line) for line in lines)
    return [line.ljust(width)[indent:] for line in lines]


def _place(rows: list[str], row: float, column: float, cell: float) -> tuple[float, float]:
    x = (column + 0.5 - len(rows[0]) / 2.0) * cell
    y = (len(rows) / 2.0 - row - 0.5) * cell
    return (x, y)


def _blocks(rows: list[str]) -> list[tuple[int, int, int, int]]:
    """Return rectangles that cover the walls once: row, column, rows down, columns across."""
    left = {(r, c) for r, line in enumerate(rows) for c, cell in enumerate(line) if cell == _WALL}
    blocks = []
    for row, column in sorted(left):
        if (row, column) not in left:
            continue
        across = _run(left, (row, column), (0, 1))
        down = _run(left, (row, column), (1, 0))
        if across >= down:
            down = _grow(left, (row, column), (1, 0), (0, 1), across)
        else:
            across = _grow(left, (row, column), (0, 1), (1, 0), down)
        left -= {(row + r, column + c) for r in range(down) for c in range(across)}
        blocks.append((row, column, down, across))
    return blocks


def _run(left: set[tuple[int, int]], start: tuple[int, int], step: tuple[int, int]) -> int:
    """Count the wall cells that follow one another from a start."""
    count = 0
    while (start[0] + count * step[0], start[1] + count * step[1]) in left:
        count += 1
    return count


def _grow(
    left: set[tuple[int, int]],
    start: tuple[int, int],
    step: tuple[int, int],
    along: tuple[int, int],
    length: int,
) -> int:
    """Count the lines of that length, each one ``step`` further, that are all wall."""
    count = 1
    while all(
        (
            start[0] + count * step[0] + i * along[0],
            start[1] + count * step[1] + i * along[1],
        )
        in left
        for i in range(length)
    ):
        count += 1
    return count

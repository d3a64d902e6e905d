"""Places in a world where a robot can be, as its lidar and its base meet the world."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bools, Floats
from gazelle.engines.planar import PlanarEngine, outline_of
from gazelle.envs.floor_plan import FloorPlan
from gazelle.errors import TaskError
from gazelle.navigation.grid import dilate
from gazelle.plugins.scripted_motion import ScriptedMotion
from gazelle.simulation import Robot

PASSAGE = 0.2
"""A robot can pass where its middle is farther than this from everything [m]."""

_GROUND = 0.02  # what is lower does not stop a robot [m]
_FINEST, _MOST_CELLS = 0.025, 800  # of the map: side of a cell [m], cells along a side
_CLOSEST, _MOST_PLACES = 0.1, 1000  # of places: spacing [m], about how many
_AROUND = 2.0  # ground about the start that is always on the map [m]


def floor_plan_of(robot: Robot, height: float) -> FloorPlan:
    """Return everything a lone robot can hit or see, except models that follow a script.

    Args:
        robot: In a simulation with ``engine="planar"``, at its start.
        height: Up to which it is there [m].

    Raises:
        TaskError: The simulation is not in the plane.
    """
    simulation = robot.simulation
    engine = simulation.engine
    if not isinstance(engine, PlanarEngine):
        raise TaskError("a floor plan is of a simulation in the plane")
    fleet = engine.fleet
    scripted = {
        entry.plugin.robot.name
        for entry in simulation.plugins
        if isinstance(entry.plugin, ScriptedMotion)
    }
    tables = [fleet.scene.table]
    for name, body in engine.bodies.items():
        if name == robot.name or name in scripted:
            continue
        tables.append(outline_of(fleet, body))
    found = [table.between(_GROUND, height) for table in tables]
    segments = np.vstack([table.segments for table in found])
    return FloorPlan(segments, np.vstack([table.discs for table in found]))


class FreeSpace:
    """The part of a floor that a robot can get to.

    Args:
        plan: Plan of the obstacles.
        start: From where it sets out (x, y) [m].

    Raises:
        TaskError: The start itself is too near to something.
    """

    def __init__(self, plan: FloorPlan, start: tuple[float, float]) -> None:
        points = _outline(plan, _FINEST)
        corners = np.vstack((points, np.array(start) - _AROUND, np.array(start) + _AROUND))
        low, high = corners.min(axis=0) - _CLOSEST, corners.max(axis=0) + _CLOSEST
        self._cell = max(_FINEST, float((high - low).max()) / _MOST_CELLS)
        self._low = low
        shape = np.ceil((high - low) / self._cell).astype(int)
        self._taken = np.zeros(shape, np.bool_)
        points = _outline(plan, self._cell / 2.0)
        self._taken[tuple(self._cells_of(points).T)] = True
        passable = ~dilate(self._taken, PASSAGE / self._cell + 1.0)
        first = self._cells_of(np.array([start]))[0]
        if not passable[tuple(first)]:
            raise TaskError(
                f"the start at ({start[0]:g}, {start[1]:g}) is within {PASSAGE} m of something",
                hint='goals and starts as published (goals="published", starts="published") '
                "need no free space",
            )
        self._within = _flooded(passable, first)

    def places(self, margin: float, *, between: bool = False) -> Floats:
        """Return places on a square lattice, shape (n, 2) [m]; about a thousand at most.

        Args:
            margin: Smallest distance from everything [m].
            between: Those in the middles of the squares of the others.
        """
        cell = self._cell
        free = self._within & ~dilate(self._taken, margin / cell + 1.0)
        area = free.sum() * cell**2
        spacing = max(_CLOSEST, math.sqrt(area / _MOST_PLACES))
        high = self._low + np.array(free.shape) * cell
        ticks = [
            (np.arange(math.ceil(a / spacing), math.floor(b / spacing)) + 0.5 * between) * spacing
            for a, b in zip(self._low, high, strict=True)
        ]
        lattice = np.stack(np.meshgrid(*ticks, indexing="ij"), axis=-1).reshape(-1, 2)
        chosen: Floats = lattice[free[tuple(self._cells_of(lattice).T)]]
        return chosen

    def _cells_of(self, points: Floats) -> NDArray[np.intp]:
        cells: NDArray[np.intp] = np.floor((points - self._low) / self._cell).astype(np.intp)
        return cells


def _outline(plan: FloorPlan, step: float) -> Floats:
    """Return points along all obstacles, at most so far apart [m], shape (n, 2)."""
    starts, along = plan.segments[:, :2], plan.segments[:, 2:] - plan.segments[:, :2]
    counts = np.ceil(np.hypot(*along.T) / step).astype(int) + 1
    which = np.repeat(np.arange(len(counts)), counts)
    index = np.arange(len(which)) - np.repeat(np.cumsum(counts) - counts, counts)
    share = index / np.maximum(counts[which] - 1, 1)
    lines = starts[which] + share[:, None] * along[which]
    turns = np.ceil(2.0 * np.pi * plan.discs[:, 2] / step).astype(int) + 3
    which = np.repeat(np.arange(len(turns)), turns)
    index = np.arange(len(which)) - np.repeat(np.cumsum(turns) - turns, turns)
    angle = 2.0 * np.pi * index / turns[which]
    rim = np.stack((np.cos(angle), np.sin(angle)), axis=1) * plan.discs[which, 2:]
    return np.vstack((lines, plan.discs[which, :2] + rim))


def _flooded(passable: Bools, first: NDArray[np.intp]) -> Bools:
    """Return the cells that hang together with the first, side by side."""
    reached = np.zeros(passable.size, np.bool_)
    rows = passable.shape[1]
    front = np.array([first[0] * rows + first[1]])
    open_ = np.pad(passable, 0).ravel()
    reached[front] = True
    while len(front):
        around = (front[:, None] + np.array([-rows, rows, -1, 1])).ravel()
        column = np.repeat(front % rows, 4)
        # Cells that are neighbours only because a row of the map ends there are not.
        inside = (around >= 0) & (around < len(open_)) & (abs(around % rows - column) <= 1)
        around = around[inside]
        front = np.unique(around[open_[around] & ~reached[around]])
        reached[front] = True
    return reached.reshape(passable.shape)

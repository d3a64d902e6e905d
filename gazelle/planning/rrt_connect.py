"""A bidirectional planner that needs no other package, also on constraints.

Method: Kuffner and LaValle, "RRT-Connect: an efficient approach to single-query path planning",
2000. With path constraints each step is projected onto them, as in Berenson, Srinivasa and
Kuffner, "Task space regions", 2011.
"""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

from gazelle.array_types import Floats
from gazelle.planning.state_validity import StateValidity, extent_of

Projection = Callable[[Floats], "Floats | None"]
_RANGE = 0.2
"""Longest edge of a tree, as a fraction of the extent of all positions."""
_PROJECTED_RANGE = 0.01
_REACHED = 1e-9


class RrtTree:
    """Positions that are joined by valid motions.

    Args:
        roots: Shape (k, n).
    """

    def __init__(self, roots: Floats) -> None:
        self._points = np.array(roots, np.float64)
        self._parents = [-1] * len(roots)
        self._size = len(roots)

    def nearest(self, point: Floats) -> int:
        """Return index of the position that is nearest to a point."""
        away = self._points[: self._size] - point
        return int(np.argmin(np.einsum("ij,ij->i", away, away)))

    def point(self, index: int) -> Floats:
        """Return a position."""
        found: Floats = self._points[index]
        return found

    def add(self, point: Floats, parent: int) -> int:
        """Add a position; returns its index."""
        if self._size == len(self._points):
            self._points = np.concatenate((self._points, np.empty_like(self._points)))
        self._points[self._size] = point
        self._parents.append(parent)
        self._size += 1
        return self._size - 1

    def back(self, index: int) -> list[Floats]:
        """Return positions from one to its root."""
        found = []
        while index >= 0:
            found.append(self._points[index].copy())
            index = self._parents[index]
        return found


def rrt_connect(
    start: Floats,
    goals: Floats,
    validity: StateValidity,
    random: np.random.Generator,
    *,
    until: float,
    project: Projection | None = None,
    edge: float = 0.0,
) -> Floats | None:
    """Return a path from a start to one of some goals.

    Args:
        start: Valid positions, shape (n,).
        goals: Valid positions, shape (k, n).
        validity: Check of states and motions.
        random: Draws positions.
        until: Deadline, on ``time.monotonic``'s clock [s].
        project: Projects positions onto the path constraints; None where there are none.
        edge: Longest edge of a tree; a fifth of the extent if zero.

    Returns:
        Positions on the path, shape (m, n); None if none was found.
    """
    fraction = _RANGE if project is None else _PROJECTED_RANGE
    longest = edge or fraction * extent_of(validity.group)
    growing, other = RrtTree(start[None]), RrtTree(goals)
    forwards = True
    while time.monotonic() < until:
        drawn = validity.group.sample(random, 1)[0]
        drawn = _near(drawn, start, validity)
        added = _grow(growing, drawn, longest, validity, project)
        if added >= 0:
            reached = growing.point(added).copy()
            met = _connect(other, reached, longest, validity, project, until)
            if met >= 0:
                path = growing.back(added)[::-1] + other.back(met)[1:]
                return np.array(path if forwards else path[::-1])
        growing, other, forwards = other, growing, not forwards
    return None


def _near(drawn: Floats, start: Floats, validity: StateValidity) -> Floats:
    """Return continuous joints within half a turn of their start."""
    return np.where(validity.group.endless, start + validity.group.difference(start, drawn), drawn)


def _grow(
    tree: RrtTree,
    towards: Floats,
    longest: float,
    validity: StateValidity,
    project: Projection | None,
) -> int:
    """Add one edge towards a point; returns the index of its end, -1 if that is impossible."""
    nearest = tree.nearest(towards)
    here = tree.point(nearest)
    offset = towards - here
    length = float(np.linalg.norm(offset))
    if length < _REACHED:
        return -1
    there = here + offset * min(1.0, longest / length)
    if project is not None:
        projected = project(there)
        # A projection back to the start leads nowhere.
        if projected is None or np.linalg.norm(projected - here) < 0.05 * longest:
            return -1
        if np.linalg.norm(projected - here) > 2.0 * longest:
            return -1
        there = projected
    return tree.add(there, nearest) if validity.motion(here, there) else -1


def _connect(
    tree: RrtTree,
    point: Floats,
    longest: float,
    validity: StateValidity,
    project: Projection | None,
    until: float,
) -> int:
    """Extend the tree towards a point until it is reached; returns the index, -1 if it is not."""
    before = np.inf
    while time.monotonic() < until:
        added = _grow(tree, point, longest, validity, project)
        if added < 0:
            return -1
        away = float(np.linalg.norm(tree.point(added) - point))
        if away < _REACHED:
            return added
        if away >= before:
            return -1
        before = away
    return -1

"""Goals drawn from a finite list of places, one uniform number a goal, without rejection."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gazelle.array_types import Bools, Floats, Indices
from gazelle.errors import TaskError


class GoalTable:
    """Places a goal can be at, and which of them may follow which.

    Drawing again until a rule is met and drawing once among the places that meet it give
    the same distribution; the second needs one number, so a world's goals do not depend on
    how often it had to try.

    Args:
        points: Places in the world frame [m], shape (m, 2).
        follows: ``follows[i, j]``: place j may come after place i, shape (m, m); by default
            any other place. A row without any place keeps the goal.
        start: Index of the place of the very first goal, where a task wants a fixed one.

    Raises:
        TaskError: No points, points that are not pairs of finite numbers, or another shape.

    Attributes:
        points: Places in the world frame [m], shape (m, 2).
        start: Index of the place of the very first goal.
        counts: Number of successors of each place, shape (m,).
        successors: Successors: the first ``counts[i]`` numbers of row i, shape (m, m).
    """

    def __init__(
        self,
        points: Sequence[tuple[float, float]] | Floats,
        follows: Bools | None = None,
        *,
        start: int = 0,
    ) -> None:
        self.points = _checked(points)
        self.start = start
        count = len(self.points)
        if not 0 <= start < count:
            raise TaskError(f"the first of {count} goals cannot be number {start}")
        allowed = ~np.eye(count, dtype=np.bool_) if follows is None else np.array(follows, bool)
        if allowed.shape != (count, count):
            raise TaskError(f"follows must have the shape {(count, count)}, not {allowed.shape}")
        stuck = ~allowed.any(axis=1)
        allowed[stuck, stuck] = True
        self.counts = allowed.sum(axis=1)
        self.successors = np.argsort(~allowed, axis=1, kind="stable")

    def places(self, goals: Indices) -> Floats:
        """Return the positions of goals [m], shape (n, 2).

        Args:
            goals: Indices into ``points``, shape (n,).

        Raises:
            TaskError: There is no such place.
        """
        try:
            return self.points.take(goals, axis=0)  # several times as fast as indexing
        except (IndexError, TypeError) as error:
            raise TaskError(f"there are {len(self.points)} goals, not {goals!r:.60}") from error

    def first(self, uniform: Floats) -> Indices:
        """Return any place as a first goal.

        Args:
            uniform: Numbers in [0, 1), shape (n,).

        Returns:
            Indices into ``points``, shape (n,).
        """
        return (uniform * len(self.points)).astype(np.intp)

    def after(self, last: Indices, uniform: Floats) -> Indices:
        """Return any place that may follow the last one.

        Args:
            last: Indices of the last goals, shape (n,).
            uniform: Numbers in [0, 1), shape (n,).

        Returns:
            Indices into ``points``, shape (n,).

        Raises:
            TaskError: There is no such place, or a number is not in that range.
        """
        try:
            choice = (uniform * self.counts[last]).astype(np.intp)
            following: Indices = self.successors[last, choice]
        except (IndexError, ValueError) as error:
            raise TaskError(f"no goal follows {last!r:.60} by {uniform!r:.60}") from error
        return following


def _checked(points: Sequence[tuple[float, float]] | Floats) -> Floats:
    """Return a copy of the points, or an error that describes the fault."""
    try:
        array = np.array(points, dtype=np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise TaskError(
            f"goals must be pairs of numbers (x, y) in metres, not {points!r}"
        ) from error
    if array.ndim != 2 or array.shape[1] != 2 or not len(array) or not np.isfinite(array).all():
        raise TaskError(
            f"goals must be one or more pairs of finite numbers (x, y) in metres, not {points!r}"
        )
    return array

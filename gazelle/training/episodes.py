"""Outcomes of episodes, and the attempts at goals counted from them."""

from __future__ import annotations

import dataclasses
import functools
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from gazelle.array_types import Bools, Floats, Ints64

OUTCOMES = ("is_success", "is_collision", "is_timeout")
"""The outcome of an episode, as boolean arrays in ``info["final_info"]``."""


def begins_early(steps: Ints64, limit: int) -> Bools:
    """Return a mask of attempts that begin early enough in their episodes [control steps] to count."""
    early: Bools = 2 * steps < limit
    return early


@dataclass(frozen=True, kw_only=True)
class Episodes:
    """Episodes that ended in one step, in the order of their slots. Arrays have shape (k,).

    An episode is a row of attempts at goals, one after the other. Each ends in one of four
    ways: the goal is reached, there is a collision, time runs out, or the episode ends
    otherwise. Those that begin in the first half of the time limit count, as each of them has the other half
    to end. Of later ones mostly the short ones would be counted, above all collisions,
    and little of what takes its time, so none of them counts.
    """

    slots: npt.NDArray[np.intp]
    """Indices of the environment's copies they ran in."""
    returns: Floats
    """Sums of rewards."""
    lengths: Ints64
    """Control steps."""
    outcomes: dict[str, Bools]
    """For each name in `OUTCOMES` that the environment reports: whether it holds at the end."""
    goals: Ints64
    """Goals reached: ``goals_reached`` of the last info, else as often as ``is_success`` became
    true. More than one where an episode continues to the next goal."""
    since_goal: Ints64
    """Control steps since the last goal on the way was reached, or since the start."""
    truncated: Bools
    """True where the episode was cut off."""
    limit: int | None = None
    """Control steps after which an episode is cut off; None where that is not known. Then an attempt
    is left out where time runs out after less than half of the episode."""
    late_goals: Ints64 | None = None
    """Number of goals of attempts that began too late to count; None for none."""
    scenarios: Floats | None = None
    """Initial conditions that the environment reports, shape (k, size)."""
    info: dict[str, Floats] = field(default_factory=dict)
    """Numbers of their last info, shapes (k,) or (k, few), if they were requested."""

    @functools.cached_property
    def succeeded(self) -> Bools:
        """True where the last step reached a goal or stayed at it."""
        return self._outcome("is_success")

    @functools.cached_property
    def collisions(self) -> Bools:
        """True where the last attempt ended in a collision."""
        return self._outcome("is_collision")

    @functools.cached_property
    def timeouts(self) -> Bools:
        """True where the last attempt ran out of time."""
        late = self.outcomes.get("is_timeout", self.truncated)
        on_the_way = (self.goals > 0) & (2 * self.since_goal <= self.lengths)
        return late & ~self.collisions & ~self.succeeded & ~on_the_way

    @functools.cached_property
    def counted(self) -> Bools:
        """True where the last attempt began early enough to count."""
        if self.limit is None:
            return np.ones(len(self.slots), np.bool_)
        early = begins_early(self.lengths - self.since_goal, self.limit)
        counted: Bools = (self.goals == 0) | early
        return counted

    @functools.cached_property
    def counted_goals(self) -> Ints64:
        """Goals reached in attempts that count."""
        return self.goals if self.late_goals is None else self.goals - self.late_goals

    @functools.cached_property
    def others(self) -> Bools:
        """True where the last attempt ended in a way that the environment has no name for."""
        late = self.outcomes.get("is_timeout", self.truncated)
        return ~late & ~self.collisions & ~self.succeeded

    @functools.cached_property
    def attempts(self) -> Ints64:
        """Goals that were tried, but for those that were left out."""
        failed = (self.collisions | self.timeouts | self.others) & self.counted
        return self.counted_goals + failed.astype(np.int64)

    def moved(self, shift: int) -> Episodes:
        """Return the episodes with the indices of their copies shifted."""
        return dataclasses.replace(self, slots=self.slots + shift)

    def _outcome(self, name: str) -> Bools:
        return self.outcomes.get(name, np.zeros(len(self.slots), np.bool_))

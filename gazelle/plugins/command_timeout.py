"""Bases that stand without a command for too long: one, or many at once."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.engines.limits import NANOSECONDS
from gazelle.simulation import TwistInput
from gazelle.simulation.clock import Clock


@dataclass(frozen=True, slots=True)
class CommandTables:
    """Commands of some bases, and their times; used in place.

    Attributes:
        linear: Commanded velocities [m/s], shape (nworld, n, 3).
        angular: Commanded turning rates [rad/s], likewise.
        revision: Counts commands, shape (n,).
        seen: The last of them that was seen, likewise.
        since_ns: Time of that [ns], likewise.
    """

    linear: Floats
    angular: Floats
    revision: NDArray[np.int64]
    seen: NDArray[np.int64]
    since_ns: NDArray[np.int64]

    @classmethod
    def empty(cls, nworld: int, count: int) -> CommandTables:
        """Return tables of ``count`` bases, all zero."""
        linear, angular = np.zeros((2, nworld, count, 3))
        return cls(linear, angular, *np.zeros((3, count), np.int64))

    def clear_old(self, now_ns: int, longest: Floats) -> None:
        """Stop robots with an expired command.

        Args:
            now_ns: Simulated time [ns].
            longest: Duration of a command [s], shape (n,).
        """
        new = self.revision != self.seen
        long = (now_ns - self.since_ns) / NANOSECONDS > longest
        if not (new.any() or long.any()):
            return
        old = long & ~new
        self.linear[:, old] = self.angular[:, old] = 0.0
        self.revision[old] += 1
        changed = new | old
        self.seen[changed], self.since_ns[changed] = self.revision[changed], now_ns


class CommandTimeout:
    """Command of one base, and its timeout.

    Args:
        clock: Gives the age of the command.
        command: Its command.
        longest: Duration of a command [s]; may be infinite.
    """

    def __init__(self, clock: Clock, command: TwistInput, longest: float) -> None:
        self._clock, self._command, self._longest = clock, command, np.array([longest])
        self._ends = math.isfinite(longest)
        self._tables = CommandTables.empty(len(command.linear), 1)
        self._keep()
        self.restart()

    @property
    def longest(self) -> float:
        """Duration for which a command is valid [s]."""
        return float(self._longest[0])

    @property
    def since_ns(self) -> int:
        """Time of the last command [ns]."""
        return int(self._tables.since_ns[0])

    def restart(self, since_ns: int | None = None) -> None:
        """Set the time [ns] of the present command; now if None."""
        self._tables.seen[:] = self._tables.revision
        self._tables.since_ns[:] = self._clock.now_ns if since_ns is None else since_ns

    def clear_old(self) -> None:
        """Stop if the last command is too old."""
        if self._ends:
            self._tables.clear_old(self._clock.now_ns, self._longest)

    def join(self, tables: CommandTables, part: int) -> None:
        """Store the state in a column of other tables from now on."""
        own, old = slice(part, part + 1), self._tables
        self._tables = CommandTables(
            tables.linear[:, own],
            tables.angular[:, own],
            tables.revision[own],
            tables.seen[own],
            tables.since_ns[own],
        )
        self._tables.seen[:], self._tables.since_ns[:] = old.seen, old.since_ns
        self._keep()

    def _keep(self) -> None:
        tables = self._tables
        self._command.store_in(tables.linear[:, 0], tables.angular[:, 0], tables.revision)


class CommandGroup:
    """Commands of some bases of one simulation, which are in common tables from then on.

    Args:
        clock: Of the simulation.
        commands: Of each base.
        nworld: Number of worlds.

    Attributes:
        linear: Commands [m/s], shape (nworld, n, 3).
        angular: Likewise [rad/s].
    """

    def __init__(self, clock: Clock, commands: Sequence[CommandTimeout], nworld: int) -> None:
        self._clock, self._tables = clock, CommandTables.empty(nworld, len(commands))
        for part, each in enumerate(commands):
            each.join(self._tables, part)
        self.linear, self.angular = self._tables.linear, self._tables.angular
        self._longest = np.array([each.longest for each in commands])
        self._ends = bool(np.isfinite(self._longest).any())

    def clear_old(self) -> None:
        """Stop robots with an expired command."""
        if self._ends:
            self._tables.clear_old(self._clock.now_ns, self._longest)

"""Touch: which collisions meet some collisions of a link, where, and how hard."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Indices, Worlds
from gazelle.engines import Contacts, ContactTable, Engine
from gazelle.errors import SimulationError
from gazelle.sensors.limits import check_interval, check_worlds
from gazelle.sensors.model import NoisySensor, PythonSensors, SystemMaker

# Values of one contact: two names, position, normal, depth, force, torque.
_WIDTH = 15


@dataclass(frozen=True, slots=True)
class ContactReading:
    """Contacts of the watched collisions of one world.

    Attributes:
        stamp: Simulated time [ns].
        contacts: Every point of contact, in the world frame.
    """

    stamp: int
    contacts: Contacts


@checked(SimulationError, after=True)
class ContactModel(NoisySensor):
    """Watches some collisions in every world.

    A measurement has room for ``most`` contacts a world, the rest is left out; the room not
    used is NaN. Contacts of each world are listed at the price of two steps of the physics, so
    a batch that only has to know whether something is touched is better served by a lidar or
    by positions.

    Args:
        engine: Knows the contacts.
        collisions: Scoped names, ``model::link::collision``.
        most: Contacts kept of each world.

    Attributes:
        by_system: No: Python measures many in one call.
    """

    by_system = False

    def __init__(self, engine: Engine, collisions: Sequence[str], most: int = 20) -> None:
        super().__init__({}, 0, "", engine.nworld)
        self.collisions = tuple(collisions)
        self._engine = engine
        self._most = most
        self._names: list[str] = []
        self._alone = ContactGroup((self,))

    def measure(self, worlds: Worlds | None = None, interval: float = 0.0) -> Floats:
        """Return contacts now, shape (n, most * 15); see ``reading``.

        Args:
            worlds: Worlds; all if None.
            interval: Time since the last measurement [s], for sensors with drifts.
        """
        check_interval(interval)
        check_worlds(worlds, self.engine.nworld)
        return self._alone.measure_all(interval, worlds)[:, 0]

    def system(self) -> SystemMaker:
        """Return what measures it with others that have room for as many contacts."""
        return SystemMaker(ContactGroup, self._most)

    @property
    def engine(self) -> Engine:
        """Engine that reports the contacts."""
        return self._engine

    @property
    def most(self) -> int:
        """Contacts kept of each world."""
        return self._most

    def reading(self, values: Floats, stamp: int) -> ContactReading:
        """Return the contacts of one world's measurement, shape (most * 15,)."""
        table = values.reshape(-1, _WIDTH)
        table = table[~np.isnan(table[:, 0])]
        names = [[self._names[int(i)] for i in table[:, column]] for column in (0, 1)]
        return ContactReading(
            stamp,
            Contacts(
                collisions=tuple(names[0]),
                others=tuple(names[1]),
                position=table[:, 2:5],
                normal=table[:, 5:8],
                depth=table[:, 8],
                force=table[:, 9:12],
                torque=table[:, 12:15],
            ),
        )

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return the names that numbers in measurements stand for."""
        return {"names": np.asarray(self._names, np.str_)}

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._names = [str(name) for name in state["names"]]
        self._alone = ContactGroup((self,))  # it has the numbers of the former names

    def number(self, name: str) -> float:
        """Return the number of a name, for a measurement."""
        if name not in self._names:
            self._names.append(name)
        return float(self._names.index(name))


class ContactGroup(PythonSensors):
    """Contact sensors of many robots, measured at once: forces are computed once for all.

    Args:
        models: Of one kind.

    Raises:
        TypeError: Their engine looks at one sensor at a time.
    """

    def __init__(self, models: Sequence[ContactModel]) -> None:
        self._engine = models[0].engine
        self._models, self._most = models, models[0].most
        self._sets = tuple(each.collisions for each in models)
        self._names: Sequence[str] = ()
        self._codes = self._numbers = np.zeros(0, np.intp)

    def measure_all(self, interval: float, worlds: Worlds | None = None) -> Floats:  # noqa: ARG002  touch has no drift
        """Return contacts now, shape (n, sensors, most * 15); see ``ContactModel.measure``."""
        chosen = np.arange(self._engine.nworld) if worlds is None else np.asarray(worlds)
        found = self._engine.contacts(self._sets, chosen)
        shape = len(chosen), len(self._sets), self._most
        values = np.full((*shape, _WIDTH), np.nan)
        if len(found.sets):
            # Contacts come set by set and world by world: each one's place in its world.
            run = found.sets * self._engine.nworld + found.worlds
            first = np.flatnonzero(np.diff(run, prepend=-1))
            place = np.arange(len(run)) - np.repeat(first, np.diff(first, append=len(run)))
            kept = place < self._most
            order = np.argsort(chosen)
            row = order[np.searchsorted(chosen, found.worlds, sorter=order)]
            rows = np.column_stack((*self._named(found), found.terms))
            values[row[kept], found.sets[kept], place[kept]] = rows[kept]
        return values.reshape(*shape[:2], -1)

    def _named(self, found: ContactTable) -> tuple[Indices, Indices]:
        """Return each sensor's numbers of its collisions, and of what touches them."""
        if self._names is not found.names:
            self._names = found.names
            self._codes = self._numbers = np.zeros(0, np.intp)
        owners = np.concatenate((found.sets, found.sets))
        codes = owners * len(self._names) + np.concatenate((found.collisions, found.others))
        new = ~np.isin(codes, self._codes)
        if new.any():
            self._learn(codes[new][np.argsort(owners[new], kind="stable")])
        numbers = self._numbers[np.searchsorted(self._codes, codes)]
        return numbers[: len(found.sets)], numbers[len(found.sets) :]

    def _learn(self, codes: Indices) -> None:
        """Add numbers of names that sensors meet for the first time."""
        numbers = dict(zip(self._codes.tolist(), self._numbers.tolist(), strict=True))
        for code in codes.tolist():
            owner, name = divmod(code, len(self._names))
            numbers[code] = int(self._models[owner].number(self._names[name]))
        self._codes = np.array(sorted(numbers), np.intp)
        self._numbers = np.array([numbers[code] for code in self._codes.tolist()], np.intp)

"""A world in the plane as a page in a browser wants it: numbers for JSON."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.engines.planar import Fleet, Scanner
from gazelle.engines.planar import columns as c
from gazelle.errors import Error
from gazelle.simulation import Simulation
from gazelle.viewer.plan import colour_of, extent_of, fleet_of, rays_of
from gazelle.viewer.plan_scans import scanners_of

_FEW = 8  # sensors up to which what they see is shown whole
_MANY = 100  # sensors beyond which scans are not shown
_BEAMS = (180, 24)  # most beams that are told of one sensor, of few and of many
_PLACES = 3  # decimals of metres


class LiveWorld:
    """Looks at one world; called between two steps only.

    Args:
        simulation: Of a world with ``engine="planar"``.
        world: Which world of a batch.

    Raises:
        Error: The simulation is not in the plane, or there is no such world.
    """

    def __init__(self, simulation: Simulation, world: int) -> None:
        self._simulation, self._world = simulation, world
        self._fleet = fleet_of(simulation)
        if not 0 <= world < self._fleet.nworld:
            raise Error(f"there is no world {world}; there are {self._fleet.nworld}")
        self._version = 0
        self._scanners: list[Scanner] | None = None

    def scenery(self) -> dict[str, Any]:
        """What stands still, and what the bodies look like."""
        fleet = self._current()
        rows = fleet.scene.table.rows
        circle = (rows[:, c.KIND].astype(int) & int(c.CIRCLE)) != 0
        return {
            "version": self._version,
            "extent": _rounded(np.array(extent_of(fleet, self._world))),
            "lines": _rounded(rows[~circle][:, [c.X0, c.Y0, c.X1, c.Y1]]),
            "circles": _rounded(rows[circle][:, [c.X0, c.Y0, c.X1]]),
            "bodies": [
                {"color": "#{:02x}{:02x}{:02x}".format(*colour_of(k)), "parts": _parts(fleet, k)}
                for k in range(fleet.nbody)
            ],
        }

    def state(self) -> dict[str, Any]:
        """Where everything is now, and what is seen."""
        fleet = self._current()
        return {
            "version": self._version,
            "time": round(self._simulation.time, _PLACES),
            "paused": bool(self._simulation.paused),
            "poses": _rounded(fleet.pose[self._world]),
            "stalled": np.flatnonzero(fleet.stalled[self._world]).tolist(),
            "scans": self._scans(fleet),
        }

    def _current(self) -> Fleet:
        """The fleet as it is; models that come or go make it another one."""
        fleet = fleet_of(self._simulation)
        if fleet is not self._fleet:
            self._fleet, self._scanners = fleet, None
            self._version += 1
        return fleet

    def _scans(self, fleet: Fleet) -> list[dict[str, Any]]:
        if self._scanners is None:
            self._scanners = scanners_of(self._simulation, fleet)
        count = sum(len(scanner.mounts) for scanner in self._scanners)
        if count > _MANY:
            return []
        most = _BEAMS[0] if count <= _FEW else _BEAMS[1]
        found = []
        for scanner in self._scanners:
            each = max(1, -(-scanner.fan.count // most))
            for eye, ends, met in zip(*rays_of(scanner, self._world), strict=True):
                found.append(
                    {
                        "eye": _rounded(eye),
                        "ends": _rounded(ends[::each]),
                        "met": met[::each].astype(int).tolist(),
                        "whole": count <= _FEW,
                    }
                )
        return found


def _parts(fleet: Fleet, body: int) -> list[list[float]]:
    """Of each piece its corners, or of a disc its middle and radius."""
    kind = fleet.kinds[body]
    found = []
    for piece in fleet.pieces[int(kind[c.FIRST_PIECE]) : int(kind[c.LAST_PIECE])]:
        if piece[c.COUNT] == 0:
            found.append(_rounded(piece[[c.CENTRE_X, c.CENTRE_Y, c.BOUND]]))
            continue
        first = int(piece[c.FIRST])
        found.append(_rounded(fleet.corners[first : first + int(piece[c.COUNT])]))
    return found


def _rounded(values: Floats) -> list[float]:
    flat: list[float] = np.round(values, _PLACES).ravel().tolist()
    return flat

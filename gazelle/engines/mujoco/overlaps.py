"""What overlaps at first is let out slowly, as SDF's ``max_vel`` says.

A contact corrects its depth within some steps, however deep it is: a box that a file puts
1 m into the ground would leave it at 90 m/s. ODE limits the velocity of the correction. Here
the surface of what overlaps starts as deep as it is and rises at that velocity: a contact
margin below zero, that grows to zero.
"""

from __future__ import annotations

from collections.abc import Iterator

import mujoco
import numpy as np
from mujoco.batch import Batch
from numpy.typing import NDArray

from gazelle.description import Contact, World
from gazelle.engines.engine import Floats, Worlds
from gazelle.engines.mujoco.compiler import Compiled

# Physics steps between two rises of a surface, at most.
PIECE = 10

# Least depth that is let out slowly [m]: a contact pushes out gently what is less deep.
_SHALLOW = 2e-4

_STATE = mujoco.mjtState.mjSTATE_INTEGRATION.value


class Overlaps:
    """Contact margins of what overlaps, in each world.

    Args:
        compiled: The model that runs, as compiled.
        world: Its description.
        nworld: Number of worlds.
    """

    def __init__(self, compiled: Compiled, world: World, nworld: int) -> None:
        model = self._model = compiled.model
        ode = world.profile.ode
        self._allowed = np.full(model.ngeom, max(ode.contact_surface_layer, _SHALLOW))
        self._speed = np.zeros(model.ngeom)
        for geom, contact in _contacts_of(compiled):
            self._allowed[geom] = max(self._allowed[geom], contact.min_depth)
            self._speed[geom] = min(contact.max_vel, ode.contact_max_correcting_vel)
        ends = np.stack((model.pair_geom1, model.pair_geom2), axis=1)
        self._pairs = {tuple(sorted(map(int, pair))): i for i, pair in enumerate(ends)}
        # A column for every geom, then one for every pair.
        self._rates = np.zeros(model.ngeom + model.npair)
        self._start = np.zeros(model.ngeom + model.npair)
        self._margins = np.zeros((nworld, model.ngeom + model.npair))
        self.any = False

    def begin(self, batch: Batch) -> None:
        """Find what overlaps in the initial state, the same in all worlds."""
        self._start = self._depths(batch.state[0])
        self._margins[:] = self._start
        self._show(batch)

    def find(self, batch: Batch) -> None:
        """Find what overlaps now."""
        alike = bool((batch.state == batch.state[0]).all())
        states = batch.state[:1] if alike else batch.state
        self._margins[:] = np.stack([self._depths(state) for state in states])
        self._show(batch)

    def reset(self, batch: Batch, worlds: Worlds | None) -> None:
        """Take up the margins of the initial state again."""
        if self.any or self._start.any():
            self._margins[slice(None) if worlds is None else worlds] = self._start
            self._show(batch)

    def rise(self, batch: Batch, seconds: float) -> None:
        """Let out what overlaps for a time [s]."""
        np.minimum(self._margins + self._rates * seconds, 0.0, out=self._margins)
        self._show(batch)

    def _show(self, batch: Batch) -> None:
        was, self.any = self.any, bool(self._margins.any())
        if was or self.any:
            ngeom = self._model.ngeom
            batch.expand("geom_margin")[:] = self._margins[:, :ngeom]
            if self._pairs:
                batch.expand("pair_margin")[:] = self._margins[:, ngeom:]

    def _depths(self, state: Floats) -> Floats:
        """Margins at which nothing of a state is too deep, shape (geoms + pairs,)."""
        model, margins = self._model, np.zeros_like(self._rates)
        if not model.nv:
            return margins
        data = mujoco.MjData(model)
        mujoco.mj_setState(model, data, state, _STATE)
        mujoco.mj_fwdPosition(model, data)
        ends: NDArray[np.int32] = data.contact.geom.reshape(-1, 2)
        for (one, two), distance in zip(ends.tolist(), data.contact.dist.tolist(), strict=True):
            if -distance <= max(self._allowed[one], self._allowed[two]):
                continue
            column = self._column(one, two)
            margins[column] = min(margins[column], distance)
            self._rates[column] = min(self._speed[one], self._speed[two])
        return margins

    def _column(self, one: int, two: int) -> int:
        """The column of a contact between two geoms: of their pair, or of one that moves."""
        pair = self._pairs.get((min(one, two), max(one, two)))
        if pair is not None:
            return int(self._model.ngeom) + pair
        moves = bool(self._model.body_weldid[self._model.geom_bodyid[two]] != 0)
        return two if moves else one


def _contacts_of(compiled: Compiled) -> Iterator[tuple[int, Contact]]:
    """Every geom of the description, and its terms of contact."""
    for parts in compiled.bodies.values():
        for body in parts:
            for collision in body.link.collisions:
                for name in compiled.geoms.get(f"{body.name}::{collision.name}", ()):
                    yield compiled.model.geom(name).id, collision.surface.contact

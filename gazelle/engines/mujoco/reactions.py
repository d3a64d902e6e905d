"""What joints carry, and what touches what: forces, measured without moving anything.

MuJoCo has both only after the constraint forces of a state are known. They are computed
when asked for, so that a step costs nothing more.
"""

from __future__ import annotations

from collections.abc import Sequence

import mujoco
import numpy as np
from mujoco.batch import Batch
from numpy.typing import NDArray

from gazelle.engines.engine import Floats, Worlds
from gazelle.engines.mujoco.access import rows_of
from gazelle.engines.mujoco.bodies import BodyAccess
from gazelle.engines.mujoco.layout import LoopSlot, look_up
from gazelle.engines.mujoco.options import SENSORS_OFF
from gazelle.engines.reactions import Contacts, Wrench
from gazelle.rotations import cross

_STATE = int(mujoco.mjtState.mjSTATE_INTEGRATION)
_FIELDS = ("cfrc_int", "subtree_com", "xipos", "xpos", "xmat")


class ForceAccess(BodyAccess):
    """The part of ``gazelle.engines.engine.Engine`` that measures forces."""

    _carried: tuple[Batch, Floats] | None = None
    """The batch and its states for which the forces between bodies were computed last."""

    _probed: tuple[Batch, mujoco.MjModel, mujoco.MjData] | None = None
    """A world apart from the batch, for what only a single world of MuJoCo has."""

    def joint_wrench(self, joint: str, worlds: Worlds | None = None) -> Wrench:
        """What the child of a joint exerts on the parent; see the protocol."""
        layout = self._now()
        if joint in layout.loops:
            return self._loop_wrench(layout.loops[joint], worlds)
        slot = look_up("joint between moving links", joint, layout.reactions)
        batch = self._compute_forces()
        rows, body = rows_of(worlds), slot.body
        force = batch.cfrc_int[rows, body, 3:]
        turn = batch.xmat[rows, body].reshape(-1, 3, 3)
        anchor = batch.xpos[rows, body] + turn @ np.asarray(slot.anchor)
        centre = batch.subtree_com[rows, int(batch.model.body_rootid[body])]
        torque = batch.cfrc_int[rows, body, :3] + cross(centre - anchor, force)
        for part in self._weightless(body):
            weight, arm = self._lifted(part, rows), batch.xipos[rows, part] - anchor
            force, torque = force + weight, torque + cross(arm, weight)
        return Wrench(-force, -torque)

    def _compute_forces(self) -> Batch:
        """Know the forces between bodies of the state as it is now."""
        batch = self._batch
        self._refresh()
        known = self._carried
        if known is None or known[0] is not batch or not np.array_equal(known[1], batch.state):
            for field in _FIELDS:
                batch.bind(field)
            flags = batch.expand("opt.disableflags")
            state = batch.state.copy()
            flags &= ~SENSORS_OFF
            try:
                with self._forced():
                    batch.forward()
            finally:
                flags |= SENSORS_OFF
                batch.state[:] = state
            self._carried = (batch, state)
        return batch

    def _refresh(self) -> None:
        if self._stale:
            self._carried = None
        super()._refresh()

    def _weightless(self, body: int) -> list[int]:
        """Bodies on a joint that gravity does not pull in some world.

        MuJoCo takes their weight off at the joints, and forgets it in the forces it reports.
        """
        model = self._batch.model
        shares = self._of_worlds("body_gravcomp")
        found = []
        for part in np.flatnonzero(shares.any(axis=0)):
            above = int(part)
            while above > body:  # parents come before their children
                above = int(model.body_parentid[above])
            if above == body:
                found.append(int(part))
        return found

    def _lifted(self, body: int, rows: slice | Worlds) -> Floats:
        """The part of a body's weight that does not pull it, shape (n, 3)."""
        nworld = self._nworld
        share = np.broadcast_to(self._of_worlds("body_gravcomp")[:, body], nworld)
        mass = np.broadcast_to(self._of_worlds("body_mass")[:, body], nworld)
        lifted: Floats = (share * mass)[:, None] * self._of_worlds("opt.gravity")
        return np.broadcast_to(lifted, (nworld, 3))[rows]

    def _of_worlds(self, field: str) -> NDArray[np.float64]:
        """A field of the model, shape (nworld, ...), or (1, ...) where worlds share it."""
        own = self._batch.expanded(field)
        if own is not None:
            return np.asarray(own)
        model = self._batch.model
        shared = model.opt.gravity if field == "opt.gravity" else getattr(model, field)
        return np.asarray(shared)[None]

    def _loop_wrench(self, slot: LoopSlot, worlds: Worlds | None) -> Wrench:
        """The same of a joint that closes a loop, which constraints hold: world by world."""
        chosen = range(self._nworld) if worlds is None else worlds
        with self._forced():
            carried = [_tied(slot, *self._probe(int(world))) for world in chosen]
        return Wrench(np.array([c[0] for c in carried]), np.array([c[1] for c in carried]))

    # -- contacts ----------------------------------------------------------------------

    def contacts(self, collisions: Sequence[str], world: int = 0) -> Contacts:
        """The points where some collisions touch others in one world; see the protocol."""
        layout = self._now()
        wanted = {
            geom: rank
            for rank, name in enumerate(collisions)
            for geom in look_up("collision", name, layout.collisions)
        }
        with self._forced():
            model, data = self._probe(world)
        found = data.contact
        ranks = np.array([wanted.get(geom, len(wanted)) for geom in range(model.ngeom)])
        rank = ranks[found.geom].reshape(-1, 2)
        acts = (rank.min(axis=1, initial=len(wanted)) < len(wanted)) & (found.efc_address >= 0)
        chosen = np.flatnonzero(acts)
        mine = rank[chosen].argmin(axis=1)
        # MuJoCo's normals and forces are those from the first geom on the second.
        sign = np.where(mine == 1, 1.0, -1.0)[:, None]
        axes = found.frame[chosen].reshape(-1, 3, 3)
        wrench = _contact_forces(model, data, chosen)
        names = {geom: name for name, geoms in layout.collisions.items() for geom in geoms}
        pairs = found.geom[chosen].reshape(-1, 2)
        return Contacts(
            collisions=tuple(names[int(pair[one])] for pair, one in zip(pairs, mine, strict=True)),
            others=tuple(names[int(pair[1 - one])] for pair, one in zip(pairs, mine, strict=True)),
            position=found.pos[chosen].reshape(-1, 3),
            normal=sign * axes[:, 0],
            depth=-found.dist[chosen],
            force=sign * np.einsum("kij,ki->kj", axes, wrench[:, :3]),
            torque=sign * np.einsum("kij,ki->kj", axes, wrench[:, 3:]),
        )

    def _probe(self, world: int) -> tuple[mujoco.MjModel, mujoco.MjData]:
        """One world with all its forces computed, apart from the batch."""
        batch, known = self._batch, self._probed
        if known is None or known[0] is not batch:
            model = batch.get_model(world)
            data = mujoco.MjData(model)
            self._probed = (batch, model, data)
        else:
            _, model, data = known
            batch.get_model(world, model)
        mujoco.mj_setState(model, data, batch.state[world], _STATE)
        mujoco.mj_forward(model, data)
        return model, data


def _tied(slot: LoopSlot, model: mujoco.MjModel, data: mujoco.MjData) -> tuple[Floats, Floats]:
    """Force and torque that the child exerts on what the constraints tie it to."""
    turn, here = data.xmat[slot.body].reshape(3, 3), data.xpos[slot.body]
    origin = here + turn @ np.asarray(slot.anchor)
    force, torque = np.zeros(3), np.zeros(3)
    for equality in slot.equalities:
        rows = (data.efc_type == mujoco.mjtConstraint.mjCNSTR_EQUALITY) & (data.efc_id == equality)
        pull = data.efc_force[rows]
        given = model.eq_data[equality]
        if model.eq_type[equality] == mujoco.mjtEq.mjEQ_WELD:
            parent = int(model.eq_obj2id[equality])
            point = data.xpos[parent] + data.xmat[parent].reshape(3, 3) @ given[:3]
            # A weld measures a turn by half the sine of half of it, in the child's axes.
            torque -= 0.5 * given[10] * (turn @ pull[3:])
        else:
            point = here + turn @ given[:3]
        force -= pull[:3]
        torque -= np.cross(point - origin, pull[:3])
    return force, torque


def _contact_forces(
    model: mujoco.MjModel, data: mujoco.MjData, indices: NDArray[np.intp]
) -> Floats:
    """Force and torque of contacts, each in its own frame, shape (k, 6)."""
    wrenches = np.zeros((len(indices), 6))
    for row, index in zip(wrenches, indices, strict=True):
        mujoco.mj_contactForce(model, data, index, row)
    return wrenches

"""What joints carry, and what touches what: forces, measured without moving anything.

MuJoCo has both only after the constraint forces of a state are known. They are computed
when asked for, so that a step costs nothing more.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np
from mujoco.batch import Batch
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.engines.mujoco.access import rows_of
from gazelle.engines.mujoco.bodies import BodyAccess
from gazelle.engines.mujoco.layout import LoopSlot, MujocoLayout, look_up
from gazelle.engines.mujoco.options import SENSORS_OFF
from gazelle.engines.mujoco.order import xyzw_from_wxyz
from gazelle.engines.reactions import Contacts, Wrench
from gazelle.rotations import cross, rotate

_STATE = int(mujoco.mjtState.mjSTATE_INTEGRATION)
_FIELDS = ("cfrc_int", "subtree_com", "xipos", "xpos", "xmat")


# What ``_read_contacts`` says of a world where nothing touches.
_NOTHING = tuple(
    np.zeros(shape, kind)
    for shape, kind in (
        ((0, 2), np.int32),
        (0, np.int32),
        (0, np.int32),
        ((0, 3), np.float64),
        (0, np.float64),
        ((0, 9), np.float64),
        ((0, 5), np.float64),
        (0, np.float64),
    )
)


class _GeomList:
    """What MuJoCo's geoms stand for.

    Attributes:
        names: Scoped names of their collisions.
    """

    def __init__(self, layout: MujocoLayout, count: int) -> None:
        self.names = np.empty(count, np.object_)
        for name, geoms in layout.collisions.items():
            self.names[geoms] = name
        self._ranks: dict[tuple[str, ...], NDArray[np.intp]] = {}

    def ranks(self, layout: MujocoLayout, collisions: tuple[str, ...]) -> NDArray[np.intp]:
        """How early each geom's collision is named; the last number is that of those that are not.

        Raises:
            EngineError: There is no such collision.
        """
        known = self._ranks.get(collisions)
        if known is None:
            known = np.full(len(self.names) + 1, len(collisions))
            for rank, name in enumerate(collisions):
                known[look_up("collision", name, layout.collisions)] = rank
            self._ranks[collisions] = known
        return known


class ForceAccess(BodyAccess):
    """The part of ``gazelle.engines.engine.Engine`` that measures forces."""

    _carried: tuple[Batch, Floats] | None = None
    """The batch and its states for which the forces between bodies were computed last."""

    _probed: tuple[Batch, mujoco.MjModel, mujoco.MjData] | None = None
    """A world apart from the batch, for what only a single world of MuJoCo has."""

    _listed: tuple[MujocoLayout, _GeomList] | None = None
    """The layout for which geoms were listed last, and the list."""

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
        """The same of a joint that closes a loop, which constraints hold.

        MuJoCo keeps the forces of constraints for one world at a time.
        """
        chosen = np.arange(self._nworld) if worlds is None else np.asarray(worlds)
        pulls = np.zeros((len(chosen), len(slot.equalities), 6))
        with self._forced():
            for pull, world in zip(pulls, chosen.tolist(), strict=True):
                _read_pulls(slot, self._probe(world)[1], pull)
        return self._tied(slot, pulls, chosen)

    def _tied(self, slot: LoopSlot, pulls: Floats, worlds: Worlds) -> Wrench:
        """What the child exerts by the pulls of its constraints, shape (n, constraints, 6)."""
        self._refresh()
        given, model = self._of_worlds("eq_data"), self._batch.model
        here, turn = self._frame(slot.body, worlds)
        origin = here + rotate(turn, np.broadcast_to(slot.anchor, here.shape))
        force, torque = np.zeros_like(here), np.zeros_like(here)
        for pull, equality in zip(pulls.swapaxes(0, 1), slot.equalities, strict=True):
            terms = np.broadcast_to(given, (self._nworld, *given.shape[1:]))[worlds, equality]
            base = here, turn
            if model.eq_type[equality] == mujoco.mjtEq.mjEQ_WELD:
                base = self._frame(int(model.eq_obj2id[equality]), worlds)
                # A weld measures a turn by half the sine of half of it, in the child's axes.
                torque -= 0.5 * terms[:, 10:11] * rotate(turn, pull[:, 3:])
            point = base[0] + rotate(base[1], terms[:, :3])
            force -= pull[:, :3]
            torque -= cross(point - origin, pull[:, :3])
        return Wrench(force, torque)

    def _frame(self, body: int, worlds: Worlds) -> tuple[Floats, Floats]:
        """Where a body of MuJoCo's is, and how it is turned (x, y, z, w), as ``_refresh`` left it."""
        return self._batch.xpos[worlds, body], xyzw_from_wxyz(self._batch.xquat[worlds, body])

    # -- contacts ----------------------------------------------------------------------

    def contacts(self, collisions: Sequence[str], world: int = 0) -> Contacts:
        """The points where some collisions touch others in one world; see the protocol."""
        return self.touching(collisions, np.array([world]))[1]

    def touching(
        self, collisions: Sequence[str], worlds: Worlds | None = None
    ) -> tuple[Worlds, Contacts]:
        """The same in many worlds; see the protocol."""
        layout = self._now()
        listed = self._list_of(layout)
        ranks = listed.ranks(layout, tuple(collisions))
        chosen = np.arange(self._nworld) if worlds is None else np.asarray(worlds)
        with self._forced():
            found = [_read_contacts(self._probe(world)[1]) for world in chosen.tolist()]
        every = [np.concatenate(part) for part in zip(*(found or [_NOTHING]), strict=True)]
        geoms, address, dims, points, depth, axes, rubs, forces = every
        counts = np.array([(len(each[0]), len(each[-1])) for each in found], np.intp).reshape(-1, 2)
        where = np.repeat(chosen, counts[:, 0])
        starts = np.repeat(counts[:, 1].cumsum() - counts[:, 1], counts[:, 0])
        acts = (ranks[geoms].min(axis=1, initial=ranks[-1]) < ranks[-1]) & (address >= 0)
        address = address + starts
        where, pairs, points, depth = where[acts], geoms[acts], points[acts], -depth[acts]
        axes = axes[acts].reshape(-1, 3, 3)
        cone = self._batch.model.opt.cone == mujoco.mjtCone.mjCONE_ELLIPTIC
        wrench = _contact_forces(forces, address[acts], dims[acts], None if cone else rubs[acts])
        rows, mine = np.arange(len(where)), ranks[pairs].argmin(axis=1)
        # MuJoCo's normals and forces are those from the first geom on the second.
        sign = np.where(mine == 1, 1.0, -1.0)[:, None]
        return where, Contacts(
            collisions=tuple(listed.names[pairs[rows, mine]]),
            others=tuple(listed.names[pairs[rows, 1 - mine]]),
            position=points,
            normal=sign * axes[:, 0],
            depth=depth,
            force=sign * (wrench[:, None, :3] @ axes)[:, 0],
            torque=sign * (wrench[:, None, 3:] @ axes)[:, 0],
        )

    def _list_of(self, layout: MujocoLayout) -> _GeomList:
        if self._listed is None or self._listed[0] is not layout:
            self._listed = (layout, _GeomList(layout, int(self._batch.model.ngeom)))
        return self._listed[1]

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


def _read_pulls(slot: LoopSlot, data: mujoco.MjData, out: Floats) -> None:
    """Forces of the constraints that hold a joint, shape (constraints, 6), where there are any."""
    tied = data.efc_type == mujoco.mjtConstraint.mjCNSTR_EQUALITY
    for row, equality in zip(out, slot.equalities, strict=True):
        pull = data.efc_force[tied & (data.efc_id == equality)]
        row[: len(pull)] = pull


def _read_contacts(data: mujoco.MjData) -> tuple[NDArray[Any], ...]:
    """All contacts of one world: geoms, addresses, widths, points, distances, axes, coefficients.

    Last come the forces of all constraints. Copies: the next world is computed in the same
    memory.
    """
    found = data.contact
    return (
        found.geom.reshape(-1, 2).copy(),
        found.efc_address.copy(),
        found.dim.copy(),
        found.pos.reshape(-1, 3).copy(),
        found.dist.copy(),
        found.frame.reshape(-1, 9).copy(),
        found.friction.reshape(-1, 5).copy(),
        data.efc_force.copy(),
    )


def _contact_forces(
    forces: Floats, address: NDArray[Any], dims: NDArray[Any], rubs: Floats | None
) -> Floats:
    """Force and torque of contacts, each in its own frame, shape (k, 6).

    Args:
        forces: Of all constraints.
        address: Of each contact's first, shape (k,).
        dims: How many directions each contact acts in, shape (k,).
        rubs: Coefficients of friction where friction is a pyramid, shape (k, 5); each of its
            edges is the normal and one direction times its coefficient. None for a cone.
    """
    wrench = np.zeros((len(address), 6))
    for width in sorted(set(dims.tolist())):
        rows = np.flatnonzero(dims == width)
        edges = None if width == 1 else rubs
        count = width if edges is None else 2 * (width - 1)
        values = forces[address[rows, None] + np.arange(count)]
        if edges is not None:
            wrench[rows, 0] = values.sum(axis=1)
            lean = values[:, 0::2] - values[:, 1::2]
            wrench[rows[:, None], np.arange(1, width)] = lean * edges[rows, : width - 1]
        else:
            wrench[rows[:, None], np.arange(width)] = values
    return wrench

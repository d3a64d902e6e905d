"""Reactions of joints and contacts: forces, measured without moving anything.

MuJoCo has both only after the constraint forces of a state are known. They are computed
on request, so that a step costs nothing more.
"""

from __future__ import annotations

import mujoco
import numpy as np
from mujoco.batch import Batch

from gazelle.array_types import Floats, Worlds
from gazelle.engines.mujoco.compiler.options import SENSORS_OFF
from gazelle.engines.mujoco.layout import LoopSlot, look_up
from gazelle.engines.mujoco.quaternions import xyzw_from_wxyz
from gazelle.engines.mujoco.state import rows_of
from gazelle.engines.mujoco.step_forces import ForcedSteps
from gazelle.engines.mujoco.worlds import RunningWorlds
from gazelle.engines.reactions import Wrench
from gazelle.rotations import cross, rotate

_STATE = int(mujoco.mjtState.mjSTATE_INTEGRATION)
_FIELDS = ("cfrc_int", "subtree_com", "xipos", "xpos", "xmat")


class JointReactions:
    """The part of ``gazelle.engines.engine.Engine`` that measures joint wrenches.

    Args:
        run: Running worlds.
        stepper: Applies the forces of a moment.
    """

    def __init__(self, run: RunningWorlds, stepper: ForcedSteps) -> None:
        self._run, self._stepper = run, stepper
        # The batch, its states and how often they had been computed when forces between bodies were.
        self._computed: tuple[Batch, Floats, int] | None = None
        # A world apart from the batch, for what only a single world of MuJoCo has.
        self._probed: tuple[Batch, mujoco.MjModel, mujoco.MjData] | None = None

    def joint_wrench(self, joint: str, worlds: Worlds | None = None) -> Wrench:
        """Return the wrench of a joint's child on its parent; see the protocol."""
        layout = self._run.up_to_date()
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
        """Compute the forces between bodies for the present state."""
        batch = self._run.batch
        self._run.refresh()
        known = self._computed
        count = self._run.computed
        if (
            known is None
            or known[0] is not batch
            or known[2] != count
            or not np.array_equal(known[1], batch.state)
        ):
            for field in _FIELDS:
                batch.bind(field)
            flags = batch.expand("opt.disableflags")
            state = batch.state.copy()
            flags &= ~SENSORS_OFF
            try:
                with self._stepper.forced():
                    batch.forward()
            finally:
                flags |= SENSORS_OFF
                batch.state[:] = state
            self._computed = (batch, state, count)
        return batch

    def _weightless(self, body: int) -> list[int]:
        """Return bodies on a joint that gravity does not pull in some world.

        MuJoCo takes their weight off at the joints, and forgets it in the forces it reports.
        """
        model = self._run.batch.model
        shares = self._run.of_worlds("body_gravcomp")
        found = []
        for part in np.flatnonzero(shares.any(axis=0)):
            above = int(part)
            while above > body:  # parents come before their children
                above = int(model.body_parentid[above])
            if above == body:
                found.append(int(part))
        return found

    def _lifted(self, body: int, rows: slice | Worlds) -> Floats:
        """Return the part of a body's weight that does not pull it, shape (n, 3)."""
        nworld = self._run.nworld
        share = np.broadcast_to(self._run.of_worlds("body_gravcomp")[:, body], nworld)
        mass = np.broadcast_to(self._run.of_worlds("body_mass")[:, body], nworld)
        lifted: Floats = (share * mass)[:, None] * self._run.of_worlds("opt.gravity")
        return np.broadcast_to(lifted, (nworld, 3))[rows]

    def _loop_wrench(self, slot: LoopSlot, worlds: Worlds | None) -> Wrench:
        """Return the wrench of a joint that closes a loop, which constraints hold.

        MuJoCo keeps the forces of constraints for one world at a time.
        """
        chosen = np.arange(self._run.nworld) if worlds is None else np.asarray(worlds)
        pulls = np.zeros((len(chosen), len(slot.equalities), 6))
        with self._stepper.forced():
            for pull, world in zip(pulls, chosen.tolist(), strict=True):
                _read_pulls(slot, self.probe(world)[1], pull)
        return self._tied(slot, pulls, chosen)

    def _tied(self, slot: LoopSlot, pulls: Floats, worlds: Worlds) -> Wrench:
        """Return the child's wrench from its constraints' forces, shape (n, constraints, 6)."""
        self._run.refresh()
        given, model = self._run.of_worlds("eq_data"), self._run.batch.model
        here, turn = self._frame(slot.body, worlds)
        origin = here + rotate(turn, np.broadcast_to(slot.anchor, here.shape))
        force, torque = np.zeros_like(here), np.zeros_like(here)
        for pull, equality in zip(pulls.swapaxes(0, 1), slot.equalities, strict=True):
            terms = np.broadcast_to(given, (self._run.nworld, *given.shape[1:]))[worlds, equality]
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
        """Return a body's position and orientation (x, y, z, w) as ``_refresh`` left them."""
        return self._run.batch.xpos[worlds, body], xyzw_from_wxyz(
            self._run.batch.xquat[worlds, body]
        )

    def probe(self, world: int) -> tuple[mujoco.MjModel, mujoco.MjData]:
        """Return one world with all its forces computed, apart from the batch."""
        batch, known = self._run.batch, self._probed
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
    """Read the forces of the constraints that hold a joint, shape (constraints, 6)."""
    tied = data.efc_type == mujoco.mjtConstraint.mjCNSTR_EQUALITY
    for row, equality in zip(out, slot.equalities, strict=True):
        pull = data.efc_force[tied & (data.efc_id == equality)]
        row[: len(pull)] = pull

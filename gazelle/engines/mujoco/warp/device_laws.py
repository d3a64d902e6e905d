"""Contact laws of a compiled model in MuJoCo Warp's step."""

from __future__ import annotations

from typing import Any

import mujoco
import mujoco_warp
import numpy as np
import warp as wp

from gazelle.engines.mujoco.contact_laws.law_data_indices import (
    ALIKE,
    BIAS_HEAD,
    COUNT,
    EXIT,
    GEOM_NUMBERS,
    HEAD,
    HINGES,
    MARK,
    MIDDLE,
    TREAD,
)
from gazelle.engines.mujoco.warp.bias_forces import (
    find_swings,
    go_half_way,
    keep_turning,
    sum_forces,
)
from gazelle.engines.mujoco.warp.constraint_rows import ConstraintRows
from gazelle.engines.mujoco.warp.contact_data import ContactLaws, ContactList
from gazelle.engines.mujoco.warp.contact_rows import correct_contacts
from gazelle.engines.mujoco.warp.velocity_motors import drive_motors

_ROUNDS = 3  # as in ``contact_laws.bias_forces``


class DeviceLaws:
    """The laws beyond MuJoCo's of one model, as MuJoCo Warp's control callback.

    Args:
        host: The compiled model.
        model: The same on the device.
        data: The worlds.

    Attributes:
        too_fast: Becomes one where something turns too fast for the step, shape (1,).
    """

    def __init__(self, host: mujoco.MjModel, model: Any, data: Any) -> None:
        self.too_fast = wp.zeros(1, dtype=int)
        self._host = host
        head = host.numeric_data[:HEAD] if host.nnumeric else np.zeros(HEAD)
        if head[0] != MARK:
            head = np.zeros(HEAD)
        tumbling, self._motors = int(head[2]), int(head[3])
        bounces = bool((host.pair_solreffriction[:, 1] < 0.0).any())
        self._contacts = bool(head[4] or head[5] or head[6] or bounces)
        pairs = host.numeric_data[HEAD : HEAD + 2 * tumbling].reshape(-1, 2)
        self._tumbling = wp.array(pairs.astype(np.int32), dtype=wp.vec2i)
        self._swinging = self._hinges = 0
        if head[7]:
            numbers = host.numeric_data[HEAD + 2 * tumbling :]
            self._swinging, self._hinges = int(numbers[COUNT]), int(numbers[HINGES])
            watched = numbers[BIAS_HEAD : BIAS_HEAD + self._swinging].astype(np.int32)
            self._watched = wp.array(watched, dtype=int)
        self._swings = wp.zeros(data.nworld, dtype=int)
        self._kept = wp.zeros((data.nworld, max(host.nv, 1)), dtype=float)
        self._laws = self._contact_laws(head, model)
        if self._contacts or self._motors or tumbling or self._swinging:
            model.callback.control = self

    def _contact_laws(self, head: Any, model: Any) -> Any:
        host, laws = self._host, ContactLaws()
        laws.directional_friction, laws.wheel_geoms, laws.touches = (
            int(bool(head[each])) for each in (4, 5, 6)
        )
        laws.cone = int(host.opt.cone == mujoco.mjtCone.mjCONE_ELLIPTIC)
        laws.disabled = int(host.opt.disableflags)
        users = np.zeros((host.ngeom, GEOM_NUMBERS))
        users[:, : host.nuser_geom] = host.geom_user
        laws.direction_kind = wp.array(users[:, 0].astype(np.int32), dtype=int)
        laws.direction = wp.array(users[:, 1:4].astype(np.float32), dtype=wp.vec3)
        laws.coefficient = wp.array(users[:, 4].astype(np.float32), dtype=float)
        laws.tread = wp.array(users[:, TREAD].astype(np.int32), dtype=int)
        laws.middle = wp.array(users[:, MIDDLE].astype(np.float32), dtype=float)
        laws.exit_speed = wp.array(users[:, EXIT].astype(np.float32), dtype=float)
        laws.alike = wp.array(users[:, ALIKE].astype(np.int32), dtype=int)
        laws.step, laws.gravity = model.opt.timestep, model.opt.gravity
        laws.body_gravcomp = model.body_gravcomp
        for name in (
            "geom_bodyid",
            "body_rootid",
            "body_parentid",
            "body_dofnum",
            "body_dofadr",
            "body_jntnum",
            "body_jntadr",
            "jnt_type",
            "dof_parentid",
        ):
            setattr(laws, name, getattr(model, name))
        return laws

    def share(self, model: Any) -> None:
        """Set time step, gravity and gravity compensation to those of the model."""
        self._laws.step, self._laws.gravity = model.opt.timestep, model.opt.gravity
        self._laws.body_gravcomp = model.body_gravcomp

    def __call__(self, model: Any, data: Any) -> None:
        """Apply the laws, the state being known and its constraints set up."""
        if self._swinging:
            self._take_bias_midway(model, data)
        if self._tumbling.shape[0]:
            wp.launch(
                keep_turning,
                (data.nworld, self._tumbling.shape[0]),
                inputs=[
                    self._tumbling,
                    model.opt.timestep,
                    model.body_inertia,
                    model.body_iquat,
                    self._swings,
                    data.qvel,
                ],
                outputs=[data.qfrc_passive, self.too_fast],
            )
        if self._motors:
            self._drive(model, data)
        if self._contacts:
            wp.launch(
                correct_contacts,
                data.naconmax,
                inputs=[_rows_of(model, data), _contacts_of(data), self._laws],
            )

    def _drive(self, model: Any, data: Any) -> None:
        rows = data.efc
        wp.launch(
            drive_motors,
            (data.nworld, data.njmax),
            inputs=[
                self._motors,
                model.opt.timestep,
                data.nefc,
                rows.type,
                rows.id,
                rows.vel,
                rows.D,
                rows.frictionloss,
            ],
            outputs=[data.userdata, rows.aref],
        )

    def _take_bias_midway(self, model: Any, data: Any) -> None:
        """Set the step to use the forces of its middle, where something turns fast enough."""
        shape = (data.nworld, self._host.nv)
        wp.launch(
            find_swings,
            data.nworld,
            inputs=[self._hinges, self._watched, model.opt.timestep, data.qvel],
            outputs=[self._kept, self._swings, self.too_fast],
        )
        mujoco_warp.factor_m(model, data)
        for _ in range(_ROUNDS):
            wp.launch(
                sum_forces,
                shape,
                inputs=[data.qfrc_passive, data.qfrc_applied, data.qfrc_bias],
                outputs=[data.qfrc_smooth],
            )
            mujoco_warp.solve_m(model, data, data.qacc_smooth, data.qfrc_smooth)
            wp.launch(
                go_half_way,
                shape,
                inputs=[model.opt.timestep, self._swings, self._kept, data.qacc_smooth],
                outputs=[data.qvel],
            )
            mujoco_warp.com_vel(model, data)
            mujoco_warp.rne(model, data)
        wp.copy(data.qvel, self._kept)
        mujoco_warp.com_vel(model, data)


def _rows_of(model: Any, data: Any) -> Any:
    rows, own = data.efc, ConstraintRows()
    own.sparse, own.nv = int(model.is_sparse), int(model.nv)
    own.jacobian, own.count, own.address = rows.J, rows.J_rownnz, rows.J_rowadr
    own.column_index, own.velocity, own.reference = rows.J_colind, rows.vel, rows.aref
    own.before = data.qacc_warmstart
    return own


def _contacts_of(data: Any) -> Any:
    contact, own = data.contact, ContactList()
    own.total, own.kind, own.world = data.nacon, contact.type, contact.worldid
    own.dim, own.geom, own.address = contact.dim, contact.geom, contact.efc_address
    own.distance, own.margin = contact.dist, contact.includemargin
    own.position, own.frame, own.friction = contact.pos, contact.frame, contact.friction
    own.solref, own.solreffriction = contact.solref, contact.solreffriction
    own.solimp = contact.solimp
    for name in ("geom_xpos", "geom_xmat", "xaxis", "cdof", "qvel"):
        setattr(own, name, getattr(data, name))
    return own

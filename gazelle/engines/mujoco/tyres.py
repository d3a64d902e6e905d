"""Tyres that slip in proportion to the force on them.

ODE lets a contact slip: a velocity of ``slip`` times the friction force, within the friction.
MuJoCo's contacts have no such term, but its joints can: the shapes of a wheel are put on a body
of their own, which may slide along the wheel's axle and turn about it against the wheel, held
by a constraint on the velocity v alone. In a step of h it is solved for v = -h R f, where R is
the constraint's regularisation and f its force; so R = slip / h. The solver takes it together
with the contacts, which makes it as stable as a rigid wheel.

Where the tyre is on its wheel does not matter, as contacts remember nothing: it is put back
before every step.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
from mujoco.batch import Batch

from gazelle.array_types import Floats
from gazelle.description import Inertial
from gazelle.engines.tree import TreeLink
from gazelle.errors import EngineError

# MuJoCo's bounds of an impedance.
_LEAST, _MOST = 1e-4, 0.9999

# What a tyre itself weighs [kg]; its inertia against the wheel is an armature.
_MASS, _MOMENT = 1e-6, 1e-9


@dataclass(frozen=True, slots=True)
class TyreSlot:
    """Where a tyre is in MuJoCo's arrays: first along the axle, then about it.

    Attributes:
        positions: Columns in ``qpos``.
        dofs: Columns in ``qvel``.
        equalities: Of the constraints that hold it.
    """

    positions: tuple[int, int]
    dofs: tuple[int, int]
    equalities: tuple[int, int]


def tyre_name(link: str) -> str:
    """The name of MuJoCo's body of a tyre."""
    return f"{link}#tyre"


def add_tyre(wheel: Any, body: TreeLink) -> Any:
    """Put a tyre on a wheel; returns MuJoCo's body of it, in the same place as the wheel's.

    Raises:
        EngineError: The link does not turn on an axle.
    """
    joint = body.joint
    if joint is None or not joint.axes or joint.type not in {"continuous", "revolute"}:
        raise EngineError(
            f"link '{body.name}' is no wheel: it needs a revolute joint to its parent",
            source=body.link.source,
        )
    axis = np.array(joint.pose.rotate(joint.axes[0].xyz))
    tyre = wheel.add_body(name=tyre_name(body.name))
    tyre.explicitinertial = True
    tyre.mass, tyre.inertia = _MASS, [_MOMENT] * 3
    tyre.ipos = list(joint.pose.position)
    inertial = body.link.inertial or Inertial()
    for name, kind, armature in (
        (_slide(body.name), mujoco.mjtJoint.mjJNT_SLIDE, inertial.mass),
        (_turn(body.name), mujoco.mjtJoint.mjJNT_HINGE, _moment_about(axis, inertial)),
    ):
        tyre.add_joint(
            name=name,
            type=kind,
            axis=axis.tolist(),
            pos=list(joint.pose.position),
            armature=armature,
        )
    return tyre


def hold_tyres(spec: mujoco.MjSpec, links: Iterable[str], time_step: float) -> None:
    """Hold tyres on their wheels, rigidly until ``set_slip``."""
    for link in sorted(links):
        for name in (_slide(link), _turn(link)):
            held = spec.add_equality(name=name, type=mujoco.mjtEq.mjEQ_JOINT, name1=name)
            held.objtype = mujoco.mjtObj.mjOBJ_JOINT
            held.solref = [0.0, -_MOST / time_step]
            held.solimp = [_MOST, _MOST, 0.001, 0.5, 2.0]


def tyre_slot(model: mujoco.MjModel, link: str) -> TyreSlot | None:
    """Where the tyre of a link is; None if it has none."""
    names = (_slide(link), _turn(link))
    joints = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, name) for name in names]
    if min(joints) < 0:
        return None
    one, two = joints
    held = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_EQUALITY, name) for name in names]
    return TyreSlot(
        (int(model.jnt_qposadr[one]), int(model.jnt_qposadr[two])),
        (int(model.jnt_dofadr[one]), int(model.jnt_dofadr[two])),
        (held[0], held[1]),
    )


def set_slip(batch: Batch, slot: TyreSlot, slip: Floats) -> None:
    """Let a tyre slip by so much a force, shape (nworld, 2): [m/s/N] and [rad/s/(N m)]."""
    step, dofs = float(batch.model.opt.timestep), list(slot.dofs)
    own = batch.expanded("dof_invweight0")
    mobility = batch.model.dof_invweight0[dofs] if own is None else own[:, dofs]
    share = _share(slip, step, mobility)
    limits, held = batch.expand("eq_solimp"), list(slot.equalities)
    limits[:, held, 0] = limits[:, held, 1] = share
    batch.expand("eq_solref")[:, held, 1] = -share / step


def tune_slips(model: mujoco.MjModel, slips: Mapping[str, tuple[float, float]]) -> None:
    """Let the tyres of a compiled model slip by so much: [m/s/N] and [rad/s/(N m)]."""
    step = float(model.opt.timestep)
    for link, slip in slips.items():
        slot = tyre_slot(model, link)
        if slot is not None and any(slip):
            share = _share(np.array(slip), step, model.dof_invweight0[list(slot.dofs)])
            held = list(slot.equalities)
            model.eq_solimp[held, 0] = model.eq_solimp[held, 1] = share
            model.eq_solref[held, 1] = -share / step


def compiled_slip(model: mujoco.MjModel, slot: TyreSlot) -> Floats:
    """By how much a tyre of a compiled model slips a force: [m/s/N] and [rad/s/(N m)]."""
    share = model.eq_solimp[list(slot.equalities), 0]
    mobility = model.dof_invweight0[list(slot.dofs)]
    slip: Floats = (1.0 / share - 1.0) * float(model.opt.timestep) * mobility
    return np.where(share < _MOST, slip, 0.0)


def _share(slip: Floats, step: float, mobility: Floats) -> Floats:
    """The impedance of a slip, which is R = slip / step."""
    return np.clip(1.0 / (1.0 + slip / (step * mobility)), _LEAST, _MOST)


def _slide(link: str) -> str:
    return f"{link}#slide"


def _turn(link: str) -> str:
    return f"{link}#turn"


def _moment_about(axis: Floats, inertial: Inertial) -> float:
    """A wheel's moment of inertia about its axle [kg m²]."""
    turned = np.asarray(inertial.pose.matrix())[:3, :3].T @ axis
    return float(turned @ inertial.inertia.matrix() @ turned)

"""Wheel slip in proportion to force: SDF's ``<slip1>`` and ``<slip2>`` as extra bodies on wheels.

ODE lets a contact slip: a velocity of ``slip`` times the friction force, within the friction.
MuJoCo's contacts have no such term, but its joints can: the shapes of a wheel are put on a body
of their own, which may slide along the wheel's axle and turn about it against the wheel, held
by a constraint on the velocity v alone. In a step of h it is solved for v = -h R f, where R is
the constraint's regularisation and f its force; so R = slip / h. The solver takes it together
with the contacts, which makes it as stable as a rigid wheel.

Where the slip body is on its wheel does not matter, as contacts remember nothing: it is put back
before every step.

In ODE a contact slips at ``slip1`` times the friction force along its first direction and at
``slip2`` across it. A slip body knows the directions of its axle only: along it and the way that the
wheel rolls.
"""

from __future__ import annotations

import warnings
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
from mujoco.batch import Batch

from gazelle.array_types import Floats
from gazelle.description import (
    Capsule,
    Collision,
    Cylinder,
    Inertial,
    Pose,
    Sphere,
    TorsionalFriction,
)
from gazelle.errors import EngineError, EngineWarning
from gazelle.kinematics.tree import TreeLink

# MuJoCo's bounds of an impedance.
_LEAST, _MOST = 1e-4, 0.9999

# What a slip body itself weighs [kg]; its inertia against the wheel is an armature.
_MASS, _MOMENT = 1e-6, 1e-9


@dataclass(frozen=True, slots=True)
class SlipSlot:
    """Indices of a slip body in MuJoCo's arrays: first along the axle, then about it.

    Attributes:
        positions: Columns in ``qpos``.
        dofs: Columns in ``qvel``.
        equalities: Of the constraints that hold it.
    """

    positions: tuple[int, int]
    dofs: tuple[int, int]
    equalities: tuple[int, int]


def slip_body_name(link: str) -> str:
    """Return the name of a slip body."""
    return f"{link}#slip"


def add_slip_body(wheel: Any, body: TreeLink) -> Any:
    """Add a slip body to a wheel; returns it, at the wheel's pose.

    Raises:
        EngineError: The link does not turn on an axle.
    """
    joint = body.joint
    if joint is None or not joint.axes or joint.type not in {"continuous", "revolute"}:
        raise EngineError(
            f"link '{body.name}' is not a wheel: it needs a revolute joint to its parent",
            source=body.link.source,
        )
    axis = np.array(joint.pose.rotate(joint.axes[0].xyz))
    slip_body = wheel.add_body(name=slip_body_name(body.name))
    slip_body.explicitinertial = True
    slip_body.mass, slip_body.inertia = _MASS, [_MOMENT] * 3
    slip_body.ipos = list(joint.pose.position)
    inertial = body.link.inertial or Inertial()
    for name, kind, armature in (
        (_slide(body.name), mujoco.mjtJoint.mjJNT_SLIDE, inertial.mass),
        (_turn(body.name), mujoco.mjtJoint.mjJNT_HINGE, _moment_about(axis, inertial)),
    ):
        slip_body.add_joint(
            name=name,
            type=kind,
            axis=axis.tolist(),
            pos=list(joint.pose.position),
            armature=armature,
        )
    return slip_body


def constrain_slip_bodies(spec: mujoco.MjSpec, links: Iterable[str], time_step: float) -> None:
    """Constrain slip bodies to their wheels, rigidly until ``set_slip``."""
    for link in sorted(links):
        for name in (_slide(link), _turn(link)):
            held = spec.add_equality(name=name, type=mujoco.mjtEq.mjEQ_JOINT, name1=name)
            held.objtype = mujoco.mjtObj.mjOBJ_JOINT
            held.solref = [0.0, -_MOST / time_step]
            held.solimp = [_MOST, _MOST, 0.001, 0.5, 2.0]


def slip_slot(model: mujoco.MjModel, link: str) -> SlipSlot | None:
    """Return the slot of a link's slip body; None if it has none."""
    names = (_slide(link), _turn(link))
    joints = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, name) for name in names]
    if min(joints) < 0:
        return None
    one, two = joints
    held = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_EQUALITY, name) for name in names]
    return SlipSlot(
        (int(model.jnt_qposadr[one]), int(model.jnt_qposadr[two])),
        (int(model.jnt_dofadr[one]), int(model.jnt_dofadr[two])),
        (held[0], held[1]),
    )


def set_slip(batch: Batch, slot: SlipSlot, slip: Floats) -> None:
    """Set the slip of a slip body per force, shape (nworld, 2): [m/s/N] and [rad/s/(N m)]."""
    step, dofs = float(batch.model.opt.timestep), list(slot.dofs)
    own = batch.expanded("dof_invweight0")
    mobility = batch.model.dof_invweight0[dofs] if own is None else own[:, dofs]
    share = _share(slip, step, mobility)
    limits, held = batch.expand("eq_solimp"), list(slot.equalities)
    limits[:, held, 0] = limits[:, held, 1] = share
    batch.expand("eq_solref")[:, held, 1] = -share / step


def tune_slips(model: mujoco.MjModel, slips: Mapping[str, tuple[float, float]]) -> None:
    """Set the slip of slip bodies of a compiled model: [m/s/N] and [rad/s/(N m)]."""
    step = float(model.opt.timestep)
    for link, slip in slips.items():
        slot = slip_slot(model, link)
        if slot is not None and any(slip):
            share = _share(np.array(slip), step, model.dof_invweight0[list(slot.dofs)])
            held = list(slot.equalities)
            model.eq_solimp[held, 0] = model.eq_solimp[held, 1] = share
            model.eq_solref[held, 1] = -share / step


def compiled_slip(model: mujoco.MjModel, slot: SlipSlot) -> Floats:
    """Return the slip of a slip body of a compiled model per force: [m/s/N] and [rad/s/(N m)]."""
    share = model.eq_solimp[list(slot.equalities), 0]
    mobility = model.dof_invweight0[list(slot.dofs)]
    slip: Floats = (1.0 / share - 1.0) * float(model.opt.timestep) * mobility
    return np.where(share < _MOST, slip, 0.0)


def _share(slip: Floats, step: float, mobility: Floats) -> Floats:
    """Return the impedance of a slip, which is R = slip / step."""
    return np.clip(1.0 / (1.0 + slip / (step * mobility)), _LEAST, _MOST)


def _slide(link: str) -> str:
    return f"{link}#slide"


def _turn(link: str) -> str:
    return f"{link}#turn"


def _moment_about(axis: Floats, inertial: Inertial) -> float:
    """Return a wheel's moment of inertia about its axle [kg m²]."""
    turned = np.asarray(inertial.pose.matrix())[:3, :3].T @ axis
    return float(turned @ inertial.inertia.matrix() @ turned)


Slip = tuple[float, float]

# Cosines of the angle from the axle at which a direction is along it, or across it.
_ALONG, _ACROSS = 0.99, 0.14


def described_slips(models: Iterable[Sequence[TreeLink]]) -> dict[str, Slip]:
    """Return the slip of wheels by their collisions: by scoped link, [m/s/N] and [rad/s/(N m)].

    The first number is along the axle, the second about it. Without ``fdir1`` the first
    direction is world y, as ODE's on level ground, with the wheel as it stands at the start.

    Args:
        models: The bodies of each, parents before children.
    """
    slips = {}
    for bodies in models:
        for body, pose in _placed(bodies):
            if body.joint is not None and body.joint.type in {"continuous", "revolute"}:
                found = {_slip_of(each, body, pose) for each in body.link.collisions}
                if len(found) == 1 and (slip := found.pop()) is not None and any(slip):
                    slips[body.name] = slip
    return slips


def warn_of_losses(models: Iterable[Sequence[TreeLink]], known: Collection[str]) -> None:
    """Warn of friction that is not simulated: slip of anything but wheels, and patches.

    Args:
        models: The bodies of each.
        known: Links whose slip is simulated.
    """
    bodies = [body for bodies in models for body in bodies]
    _warn(
        "slip1 and slip2",
        [
            f"{body.name}::{collision.name}"
            for body in bodies
            for collision in body.link.collisions
            if _has_slip(collision) and body.name not in known
        ],
        "they need a wheel (one revolute joint, a cylinder, capsule or sphere) and an fdir1 along "
        "its axle or across it",
    )
    _warn(
        "surface_radius and slip of <torsional>",
        [
            f"{body.name}::{collision.name}"
            for body in bodies
            for collision in body.link.collisions
            if _is_lost(collision.surface.friction.torsional)
        ],
        "rigid bodies have no depth for a patch to grow with; give a <patch_radius>",
    )


def _warn(what: str, lost: Sequence[str], why: str) -> None:
    if lost:
        others = f" and {len(lost) - 1} others" if len(lost) > 1 else ""
        text = f"{what} of collision '{lost[0]}'{others} have no effect: {why}"
        warnings.warn(EngineWarning(text), stacklevel=3)


def _is_lost(torsional: TorsionalFriction | None) -> bool:
    if torsional is None or torsional.coefficient <= 0.0:
        return False
    return torsional.slip > 0.0 or (not torsional.use_patch_radius and torsional.surface_radius > 0)


def _placed(bodies: Sequence[TreeLink]) -> Iterator[tuple[TreeLink, Pose]]:
    """Yield bodies with their initial poses in the world."""
    poses: dict[str, Pose] = {}
    for body in bodies:
        poses[body.name] = body.pose if body.parent is None else poses[body.parent] * body.pose
        yield body, poses[body.name]


def _has_slip(collision: Collision) -> bool:
    friction = collision.surface.friction
    has_friction = friction.mu > 0.0 or friction.mu2 > 0.0
    return has_friction and (friction.slip1 > 0.0 or friction.slip2 > 0.0)


def _slip_of(collision: Collision, body: TreeLink, pose: Pose) -> Slip | None:
    """Return the slip of a wheel's shape; None if it is undetermined."""
    friction = collision.surface.friction
    if not _has_slip(collision):
        return 0.0, 0.0
    slips = max(friction.slip1, 0.0), max(friction.slip2, 0.0)
    first_is_along = slips[0] == slips[1] or _first_is_along(collision, body, pose)
    if first_is_along is None:
        return None
    lateral, rolling = slips if first_is_along else slips[::-1]
    if not rolling:
        return lateral, 0.0
    shape = collision.geometry
    if not isinstance(shape, Capsule | Cylinder | Sphere):
        return None
    # The force acts at the radius, and so does the velocity.
    return lateral, rolling / shape.radius**2


def _first_is_along(collision: Collision, body: TreeLink, pose: Pose) -> bool | None:
    """Return whether a wheel's first friction direction is its axle; None if it is oblique."""
    if body.joint is None:
        return None
    axle = np.array(body.joint.pose.rotate(body.joint.axes[0].xyz))
    fdir1 = np.array(collision.surface.friction.fdir1, np.float64)
    size = float(np.linalg.norm(fdir1))
    if size == 0.0:
        x, y, _ = pose.rotate((float(axle[0]), float(axle[1]), float(axle[2])))
        return bool(abs(y) >= abs(x))
    x, y, z = (fdir1 / size).tolist()
    cosine = abs(float(np.dot(axle, collision.pose.rotate((x, y, z)))))
    return True if cosine >= _ALONG else False if cosine <= _ACROSS else None


def slipping(slips: Mapping[str, Slip], slip_links: Collection[str]) -> dict[str, Slip]:
    """Return all slip bodies of a world with their slips: none where only the run may set one."""
    return {name: slips.get(name, (0.0, 0.0)) for name in sorted({*slips, *slip_links})}

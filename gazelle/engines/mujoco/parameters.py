"""Physical parameters that each world can have of its own.

MuJoCo keeps one model for all worlds; a field that differs is *expanded* to a row a world.
What was set is kept here by name, so that it survives spawning, deleting and recompiling.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import mujoco
import numpy as np
from mujoco.batch import Batch
from numpy.typing import ArrayLike

from gazelle.array_types import Floats
from gazelle.engines.mujoco.compiler.inertia import matrices, principal, tensor
from gazelle.engines.mujoco.compiler.joints import rigid_stop
from gazelle.engines.mujoco.compiler.motors import stiffen_worlds
from gazelle.engines.mujoco.compiler.options import PASSIVE_OFF
from gazelle.engines.mujoco.compiler.rotors import soften_rotors_of_worlds
from gazelle.engines.mujoco.compiler.surfaces import LARGEST_FRICTION, LEAST_FRICTION
from gazelle.engines.mujoco.compiler.wheel_slip import compiled_slip, set_slip
from gazelle.engines.mujoco.compliance import retune
from gazelle.engines.mujoco.layout import MujocoLayout, look_up
from gazelle.engines.mujoco.quaternions import wxyz_from_xyzw, xyzw_from_wxyz
from gazelle.errors import EngineError

Key = tuple[str, str]

# MuJoCo has no infinite limits.
_FAR = 1e10

# Directions of a contact that rubs but does not resist turning about its normal.
_SLIDING = 3


@dataclass(frozen=True, slots=True)
class _Target:
    """A batch, and where things are in it."""

    batch: Batch
    layout: MujocoLayout

    def body(self, link: str) -> int:
        """Return the body of a moving link."""
        if self.is_held(link):
            raise EngineError(f"link '{link}' does not move; it has no mass to change")
        return self.layout.link(link).body

    def is_held(self, link: str) -> bool:
        """Return whether a link moves only when it is placed."""
        slot = self.layout.link(link)
        return slot.body == 0 or slot.mocap is not None

    def dofs(self, joint: str) -> list[slice]:
        """Return the degrees of freedom of a joint, one slice an axis."""
        return [slot.velocity for slot in self.layout.joint(joint)]

    def joint_ids(self, joint: str) -> list[int]:
        """Return MuJoCo's joints, one an axis."""
        return [int(self.batch.model.dof_jntid[dofs.start]) for dofs in self.dofs(joint)]

    def geoms(self, collision: str) -> list[int]:
        """Return MuJoCo's geoms of a collision."""
        return look_up("collision", collision, self.layout.collisions)


# -- reading what was compiled -----------------------------------------------------------


def _read_inertia(target: _Target, name: str) -> Floats:
    model, body = target.batch.model, target.body(name)
    return tensor(model.body_inertia[body], model.body_iquat[body])


def _read_attachment(target: _Target, name: str) -> Floats:
    column = look_up("attachment", name, target.layout.attachments)
    data = target.batch.model.eq_data[column]
    return np.concatenate((data[3:6], xyzw_from_wxyz(data[6:10])))


def _read_limit(target: _Target, name: str, side: int) -> Floats:
    model, ids = target.batch.model, target.joint_ids(name)
    values = np.where(model.jnt_limited[ids] != 0, model.jnt_range[ids, side], np.inf)
    bounds: Floats = np.where(np.abs(values) >= _FAR, np.inf, values)
    return np.where(np.isinf(bounds), -np.inf if side == 0 else np.inf, bounds)


def _read_friction(target: _Target, name: str) -> Floats:
    geoms = target.geoms(name)
    if not geoms:
        raise EngineError(f"collision '{name}' has no contact geometry")
    return np.array([target.batch.model.geom_friction[geoms[0], 0]])


def _read_slip(target: _Target, name: str) -> Floats:
    target.layout.link(name)
    slot = target.layout.slip_links.get(name)
    return np.zeros(2) if slot is None else compiled_slip(target.batch.model, slot)


def _read_contact(target: _Target, name: str) -> Floats:
    target.geoms(name)
    return np.ones(1)


_READERS: dict[str, Callable[[_Target, str], Floats]] = {
    "attachment": _read_attachment,
    "collision_contact": _read_contact,
    "collision_friction": _read_friction,
    "gravity": lambda t, _: np.array(t.batch.model.opt.gravity),
    "joint_damping": lambda t, n: np.array([t.batch.model.dof_damping[d.start] for d in t.dofs(n)]),
    "joint_friction": lambda t, n: np.array(
        [t.batch.model.dof_frictionloss[d.start] for d in t.dofs(n)]
    ),
    "joint_lower": lambda t, n: _read_limit(t, n, 0),
    "joint_upper": lambda t, n: _read_limit(t, n, 1),
    "link_centre": lambda t, n: np.array(t.batch.model.body_ipos[t.body(n)]),
    "link_gravity": lambda t, n: np.array([1.0 - t.batch.model.body_gravcomp[t.body(n)]]),
    "link_inertia": _read_inertia,
    "link_mass": lambda t, n: np.array([t.batch.model.body_mass[t.body(n)]]),
    "motor_effort": lambda t, n: np.array(
        t.batch.model.tendon_frictionloss[t.layout.motor(n).targets]
    ),
    "wheel_slip": _read_slip,
}


# -- writing -----------------------------------------------------------------------------


def _write_mass(target: _Target, name: str, values: Floats) -> None:
    target.batch.expand("body_mass")[:, target.body(name)] = values[:, 0]


def _write_centre(target: _Target, name: str, values: Floats) -> None:
    _free_frames(target, target.body(name))
    target.batch.expand("body_ipos")[:, target.body(name)] = values


def _write_inertia(target: _Target, name: str, values: Floats) -> None:
    moments, axes = principal(matrices(values))
    body = target.body(name)
    _free_frames(target, body)
    target.batch.expand("body_inertia")[:, body] = moments
    target.batch.expand("body_iquat")[:, body] = axes


def _free_frames(target: _Target, body: int) -> None:
    """Free shapes from the inertial frame, which MuJoCo uses for those that agree with it."""
    target.batch.expand("body_sameframe")[:, body] = 0
    of_body = target.batch.model.geom_bodyid == body
    target.batch.expand("geom_sameframe")[:, of_body] = 0


def _write_gravity_share(target: _Target, name: str, values: Floats) -> None:
    target.batch.expand("opt.disableflags")[:] &= ~PASSIVE_OFF
    target.batch.expand("body_gravcomp")[:, target.body(name)] = 1.0 - values[:, 0]


def _write_damping(target: _Target, name: str, values: Floats) -> None:
    option = target.batch.model.opt
    implicit = option.integrator == mujoco.mjtIntegrator.mjINT_EULER
    for axis, dofs in enumerate(target.dofs(name)):
        damping = target.batch.expand("dof_damping")
        if implicit:  # as ``damp_implicitly`` has it
            change = values[:, axis : axis + 1] - damping[:, dofs]
            target.batch.expand("dof_armature")[:, dofs] += option.timestep * change
        damping[:, dofs] = values[:, axis : axis + 1]


def _write_joint_friction(target: _Target, name: str, values: Floats) -> None:
    for axis, dofs in enumerate(target.dofs(name)):
        target.batch.expand("dof_frictionloss")[:, dofs] = values[:, axis : axis + 1]


def _write_limit(target: _Target, name: str, values: Floats, side: int) -> None:
    batch, ids = target.batch, target.joint_ids(name)
    bounds = batch.expand("jnt_range")
    never = batch.model.jnt_limited[ids] == 0
    fresh = never & ~(batch.expand("jnt_limited")[:, ids] != 0).any(axis=0)
    reference, impedance = rigid_stop(float(batch.model.opt.timestep))
    for joint in np.asarray(ids)[fresh]:
        bounds[:, joint] = (-_FAR, _FAR)
        batch.expand("jnt_solref")[:, joint] = reference
        batch.expand("jnt_solimp")[:, joint] = impedance
    bounds[:, ids, side] = np.clip(values, -_FAR, _FAR)
    batch.expand("jnt_limited")[:, ids] = (np.abs(bounds[:, ids]) < _FAR).any(axis=2)


def _write_motor(target: _Target, name: str, values: Floats) -> None:
    target.batch.expand("tendon_frictionloss")[:, target.layout.motor(name).targets] = values


def _write_friction(target: _Target, name: str, values: Floats) -> None:
    friction, geoms = target.batch.expand("geom_friction"), target.geoms(name)
    friction[:, geoms, 0] = np.minimum(values, LARGEST_FRICTION)
    # The slipperier of two surfaces decides: the finer their order, the better.
    slipperiness = (LARGEST_FRICTION - friction[:, :, 0]) * 1e6
    target.batch.expand("geom_priority")[:] = slipperiness.astype(np.int32)
    model = target.batch.model
    spins = model.geom_condim[geoms] > _SLIDING
    condim = np.where(values > LEAST_FRICTION, _SLIDING, 1)
    target.batch.expand("geom_condim")[:, geoms] = np.where(spins, model.geom_condim[geoms], condim)
    touched = np.isin(model.pair_geom1, geoms) | np.isin(model.pair_geom2, geoms)
    own = values[:, 0] != model.geom_friction[geoms[0], 0] if geoms else []
    if touched.any() and np.any(own):
        # A world that has a coefficient of its own has it in all directions.
        ends = friction[:, model.pair_geom1, 0], friction[:, model.pair_geom2, 0]
        changed = np.ix_(own, touched, np.arange(2))
        target.batch.expand("pair_friction")[changed] = np.minimum(*ends)[changed[:2]]
        pairs = np.ix_(own, touched)
        dims = np.where(np.minimum(*ends)[pairs] > LEAST_FRICTION, _SLIDING, 1)
        target.batch.expand("pair_dim")[pairs] = np.maximum(model.pair_dim[touched], dims)


def _write_contact(target: _Target, name: str, values: Floats) -> None:
    geoms, model, off = target.geoms(name), target.batch.model, values[:, 0] == 0.0
    for mask in ("geom_contype", "geom_conaffinity"):
        target.batch.expand(mask)[:, geoms] = np.where(off[:, None], 0, getattr(model, mask)[geoms])
    # Pairs that the model names go by no mask: they touch where they are deeper than their gap.
    masks = target.batch.expand("geom_contype")
    off = (masks[:, model.pair_geom1] == 0) | (masks[:, model.pair_geom2] == 0)
    if off.size:
        target.batch.expand("pair_gap")[:] = np.where(off, _FAR, model.pair_gap)


def _write_gravity(target: _Target, _: str, values: Floats) -> None:
    target.batch.expand("opt.gravity")[:] = values


def _write_attachment(target: _Target, name: str, values: Floats) -> None:
    column = look_up("attachment", name, target.layout.attachments)
    data = target.batch.expand("eq_data")[:, column]
    data[:] = 0.0
    data[:, 3:6] = values[:, :3]
    data[:, 6:10] = wxyz_from_xyzw(values[:, 3:])
    data[:, 10] = 1.0  # how much a turn counts against a shift [m]


def _write_slip(target: _Target, name: str, values: Floats) -> None:
    slot = target.layout.slip_links.get(name)
    if slot is not None:  # a model that is only placed has none
        set_slip(target.batch, slot, values)


_WRITERS: dict[str, Callable[[_Target, str, Floats], None]] = {
    "attachment": _write_attachment,
    "collision_contact": _write_contact,
    "collision_friction": _write_friction,
    "gravity": _write_gravity,
    "joint_damping": _write_damping,
    "joint_friction": _write_joint_friction,
    "joint_lower": lambda t, n, v: _write_limit(t, n, v, 0),
    "joint_upper": lambda t, n, v: _write_limit(t, n, v, 1),
    "link_centre": _write_centre,
    "link_gravity": _write_gravity_share,
    "link_inertia": _write_inertia,
    "link_mass": _write_mass,
    "motor_effort": _write_motor,
    "wheel_slip": _write_slip,
}

_NOT_NEGATIVE = frozenset(
    {"collision_friction", "joint_damping", "joint_friction", "motor_effort", "wheel_slip"}
)

# What MuJoCo derives other constants from, by ``mj_setConst``.
_DERIVED_FROM = frozenset(
    {"joint_damping", "link_centre", "link_gravity", "link_inertia", "link_mass"}
)


_CONSTANT = {"joint_lower", "joint_upper"}
"""Parameters that are fixed for a layout's life; placed joints read them in every step."""


class ParameterStore:
    """All that worlds have of their own.

    Args:
        nworld: Number of worlds.

    Attributes:
        writes: Number of writes.
    """

    def __init__(self, nworld: int) -> None:
        self._nworld = nworld
        self.writes = 0
        self._values: dict[Key, Floats] = {}
        self._compiled: dict[Key, Floats] = {}
        self._compiled_for: MujocoLayout | None = None

    @property
    def values(self) -> Mapping[Key, Floats]:
        """Parameters that were set, by kind and name, shape (nworld, width)."""
        return self._values

    def read(self, batch: Batch, layout: MujocoLayout, kind: str, name: str) -> Floats:
        """Return values of all worlds, shape (nworld, width)."""
        if (kind, name) in self._values:
            return self._values[kind, name].copy()
        reader = look_up("parameter", kind, _READERS)
        if kind not in _CONSTANT:
            return np.tile(reader(_Target(batch, layout), name), (self._nworld, 1))
        if self._compiled_for is not layout:
            self._compiled.clear()
            self._compiled_for = layout
        if (kind, name) not in self._compiled:
            compiled = reader(_Target(batch, layout), name)
            self._compiled[kind, name] = np.tile(compiled, (self._nworld, 1))
        return self._compiled[kind, name].copy()

    def write(self, batch: Batch, layout: MujocoLayout, key: Key, values: Floats) -> None:
        """Set values of all worlds, shape (nworld, width)."""
        self.writes += 1
        _WRITERS[key[0]](_Target(batch, layout), key[1], values)
        self._values[key] = values
        if key[0] in _DERIVED_FROM:
            self._derive(batch, layout)

    def apply(self, batch: Batch, layout: MujocoLayout) -> None:
        """Apply all values to a new batch."""
        target = _Target(batch, layout)
        for (kind, name), values in self._values.items():
            if not (kind.startswith("link_") and target.is_held(name)):
                _WRITERS[kind](target, name, values)
        if any(kind in _DERIVED_FROM for kind, _ in self._values):
            self._derive(batch, layout)

    def _derive(self, batch: Batch, layout: MujocoLayout) -> None:
        """Derive terms that depend on masses and inertias: springs and slips keep their values."""
        batch.set_const()
        stiffen_worlds(batch)
        soften_rotors_of_worlds(batch)
        retune(batch, layout.springs)
        for link, slot in layout.slip_links.items():
            set_slip(batch, slot, self.read(batch, layout, "wheel_slip", link))

    def drop(self, model: str) -> None:
        """Discard the values of a deleted model."""
        inside = f"{model}::"
        self._values = {
            (kind, name): values
            for (kind, name), values in self._values.items()
            if not name.startswith(inside) and f">{inside}" not in name
        }

    def forget(self, kind: str, name: str) -> None:
        """Discard one parameter; a batch made from now on has the description's."""
        self._values.pop((kind, name), None)

    def copy(self) -> ParameterStore:
        """Return an independent copy."""
        other = ParameterStore(self._nworld)
        other._values = dict(self._values)  # its own class
        return other


def as_rows(kind: str, name: str, shape: tuple[int, ...], values: ArrayLike) -> Floats:
    """Return values of some worlds, shape (n, width).

    Raises:
        EngineError: They are not numbers, or too many or too few.
    """
    try:
        rows: Floats = np.broadcast_to(np.asarray(values, np.float64), shape)
    except (TypeError, ValueError, OverflowError):
        raise EngineError(
            f"the {kind} of '{name}' must be numbers of the shape ({shape[1]},) or {shape}, "
            f"not {' '.join(str(values).split())[:60]}"
        ) from None
    return rows


def check(kind: str, name: str, values: Floats) -> None:
    """Check values of a parameter.

    Raises:
        EngineError: A value is not finite, not positive where it must be, or no tensor.
    """
    limits = kind in {"joint_lower", "joint_upper"}
    if np.isnan(values).any() or not (limits or np.isfinite(values).all()):
        raise EngineError(f"the {kind} of '{name}' must be finite")
    if kind == "link_mass" and not (values > 0.0).all():
        raise EngineError(f"the {kind} of '{name}' must be positive, not {values.min():g}")
    if kind in _NOT_NEGATIVE and (values < 0.0).any():
        raise EngineError(f"the {kind} of '{name}' must not be negative, not {values.min():g}")
    if kind == "link_inertia" and not (np.linalg.eigvalsh(matrices(values)) > 0.0).all():
        raise EngineError(f"the inertia of '{name}' must be positive definite")

"""Additional laws that a model needs, written into the model."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import mujoco
import numpy as np
from numpy.typing import NDArray

from gazelle.engines.mujoco.compiler.geom_names import geom_names
from gazelle.engines.mujoco.compiler.gyroscopic_forces import unbalanced_dofs
from gazelle.engines.mujoco.compiler.wheel_contacts import middle_of
from gazelle.engines.mujoco.contact_laws.law_data_indices import (
    ALIKE,
    BIAS_HEAD,
    BY_THE_NORMAL,
    EXIT,
    GEOM_NUMBERS,
    HEAD,
    ITS_OWN,
    MARK,
    MIDDLE,
    TREAD,
)
from gazelle.engines.mujoco.library import address_of
from gazelle.rotations import conjugate, rotate

Direction = tuple[float, float, float]

# Becomes one when a step of any model is too long for a spin. It lives as long as the process:
# models have its address.
spun = np.zeros(1)

# Name of the custom numbers of a model that say what holds for it.
_NAME = "gazelle_laws"


@dataclass(frozen=True, slots=True)
class DirectionalFriction:
    """Friction of a geom that differs by direction.

    Attributes:
        along: The first direction in the frame of MuJoCo's body; None if the normal gives it.
        coefficient: Of friction along it: of two surfaces the slipperier one's counts.
    """

    along: Direction | None
    coefficient: float


@dataclass(frozen=True, slots=True)
class LawSelection:
    """Laws that a model needs beyond MuJoCo's.

    Attributes:
        bounces: Whether some contacts bounce.
        directional_friction: Directional friction of geoms, by name.
        tumbling: Names of free bodies that tumble freely.
        motors: Number of motors that hold a velocity.
        slides: Whether a moving geom has friction.
        wheel_geoms: Wheel joints by the names of geoms that may be wheel surfaces.
        exits: Velocities at which geoms leave overlaps, by name [m/s].
        swings: Whether joints get their bias forces at the middle of a step.
        hooks: Address of what takes commands within steps; 0 for none.
    """

    bounces: bool = False
    directional_friction: Mapping[str, DirectionalFriction] = field(default_factory=dict)
    tumbling: Sequence[str] = ()
    motors: int = 0
    slides: bool = False
    wheel_geoms: Mapping[str, str] = field(default_factory=dict)
    exits: Mapping[str, float] = field(default_factory=dict)
    swings: bool = False
    hooks: int = 0

    @property
    def any(self) -> bool:
        """True if any is needed."""
        return self.touches or bool(self.tumbling) or self.swings or self.vital

    @property
    def touches(self) -> bool:
        """True if there are contacts that slide or that leave an overlap."""
        return self.slides or bool(self.exits)

    @property
    def vital(self) -> bool:
        """True if one is needed without which the world would move quite differently."""
        return bool(self.bounces or self.directional_friction or self.motors or self.hooks)


def prepare(spec: mujoco.MjSpec, extras: LawSelection) -> None:
    """Allocate room in a model for the data of ``finish``."""
    if not extras.any:
        return
    size = HEAD + 2 * len(extras.tumbling)
    if extras.swings:
        size += BIAS_HEAD + 3 * len(spec.joints)
    spec.add_numeric(name=_NAME, data=[0.0] * size, size=size)
    if extras.directional_friction or extras.touches:
        spec.nuser_geom = GEOM_NUMBERS


def finish(model: mujoco.MjModel, extras: LawSelection) -> None:
    """Write the laws into a compiled model, and have MuJoCo apply them.

    Raises:
        EngineError: Another program in this process has MuJoCo's callback.
    """
    kinds = {int(kind) for kind in model.geom_type}
    if {int(mujoco.mjtGeom.mjGEOM_PLANE), int(mujoco.mjtGeom.mjGEOM_CYLINDER)} <= kinds:
        # It takes the compiled modules.
        from gazelle.engines.mujoco.contact_laws.collision_table import replace_plane_cylinder

        replace_plane_cylinder()
    if not extras.any:
        return
    from gazelle.engines.mujoco.contact_laws.control_callback import install

    # The first of the custom numbers: nothing else here adds any.
    numbers = model.numeric_data
    wheel_geoms = _write_wheel_geoms(model, extras.wheel_geoms)
    hinges, spins = unbalanced_dofs(model) if extras.swings else ([], [])
    swinging = hinges + spins
    numbers[:HEAD] = (
        MARK,
        mujoco.mj_isSparse(model),
        len(extras.tumbling),
        extras.motors,
        bool(extras.directional_friction),
        wheel_geoms,
        extras.touches,
        len(swinging),
        spun.ctypes.data,
        extras.hooks,
        0.0,
    )
    if swinging:
        after = HEAD + 2 * len(extras.tumbling)
        functions = [address_of(name) for name in ("mj_comVel", "mj_rne", "mj_solveM")]
        values = [*functions, len(swinging), len(hinges), *swinging]
        numbers[after : after + len(values)] = values
    for place, name in enumerate(extras.tumbling):
        body = model.body(name)
        numbers[HEAD + 2 * place :][:2] = body.id, body.dofadr[0]
    for name, rub in extras.directional_friction.items():
        geom = model.geom(name).id
        along = np.zeros(3) if rub.along is None else np.array(rub.along)
        w, x, y, z = model.geom_quat[geom]
        local = rotate(conjugate(np.array([x, y, z, w])), along)
        kind = BY_THE_NORMAL if rub.along is None else ITS_OWN
        model.geom_user[geom, :TREAD] = kind, *local, rub.coefficient
    if extras.exits:
        model.geom_user[:, EXIT] = [extras.exits.get(name, 0.0) for name in geom_names(model)]
    if extras.touches:
        model.geom_user[:, ALIKE] = _alike(model)
    install(vital=extras.vital)


def _write_wheel_geoms(model: mujoco.MjModel, wheel_geoms: Mapping[str, str]) -> bool:
    """Mark the geoms that are wheel surfaces; returns whether there are any."""
    found = False
    for name, on in wheel_geoms.items():
        geom, joint = model.geom(name).id, model.joint(on).id
        middle = middle_of(model, geom, joint)
        if middle is not None:
            model.geom_user[geom, [TREAD, MIDDLE]] = joint + 1, middle
            found = True
    return found


def _alike(model: mujoco.MjModel) -> NDArray[np.bool_]:
    """Return which geoms stand still or are of a free body of one friction, shape (ngeom,).

    A mesh of several pieces is hollow and may be caught, so that it is held by more than its weight.
    """
    roots = model.body_rootid[model.geom_bodyid]
    joints = np.bincount(model.body_rootid, model.body_jntnum, model.nbody)
    free = joints[roots] == 1
    first = model.body_jntadr[roots[free]]
    free[free] = model.jnt_type[first] == int(mujoco.mjtJoint.mjJNT_FREE)
    touching = (model.geom_contype | model.geom_conaffinity) != 0
    meshes = touching & (model.geom_type == int(mujoco.mjtGeom.mjGEOM_MESH))
    free &= np.bincount(roots, meshes, model.nbody)[roots] < 2
    least, most = np.full(model.nbody, np.inf), np.full(model.nbody, -np.inf)
    np.minimum.at(least, roots[touching], model.geom_friction[touching, 0])
    np.maximum.at(most, roots[touching], model.geom_friction[touching, 0])
    alike: NDArray[np.bool_] = model.body_weldid[model.geom_bodyid] == 0
    alike |= free & (least == most)[roots]
    return alike

"""SDF surfaces as MuJoCo contact parameters.

The derivations and their limits are written down in ``docs/explanation/contact-laws.md``.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

import mujoco

from gazelle.description import Collision

# Files say "never slip" with 1e5 and more. At 100 nothing slips on slopes of up to 89 degrees.
LARGEST_FRICTION = 100.0

# Less friction is none: in a pyramid it would be as stiff as it is small, and throw what lies.
LEAST_FRICTION = 1e-4

# From here on a direction does not matter: nothing slips in either [-].
_NEVER_SLIPS = 10.0

# Above this coefficient MuJoCo's friction pyramid throws standing cylinders about; its cone
# does not. Below, the pyramid is ODE's own model, faster, and lets wheels creep less.
_LARGEST_IN_A_PYRAMID = 1.0

# Share of the constraint force that acts at first touch, and from a penetration [m] on. What
# lies stays well above it; what is pressed that deep, by thousands of times its weight, meets a
# surface that gives way no further (tests/engines/mujoco/test_mechanics.py).
_IMPEDANCE = (0.9, 0.9999, 0.001, 0.5, 2.0)

# How many times stiffer friction is than the normal direction, or what is held creeps: in a
# pyramid, and in a cone, where the share at first touch may be this, too. In a pyramid so much
# makes wheels shake; in a cone it costs nothing (docs/explanation/contact-laws.md, "Creep of held contacts").
_RATIO_IN_A_PYRAMID, _RATIO_IN_A_CONE = 100.0, 10_000.0
_SHARE_IN_A_CONE = 0.99

TOUCHING = 5e-7
"""Margin around a geom at which contacts begin [m]; those of two geoms add up.

What a file puts exactly on a surface touches with all its corners then, wherever their places are
rounded to, and rests a thousandth of a millimetre higher.
"""

# A little more than critical. Less would bounce; twice as much rocks cylinders up.
_DAMPING_RATIO = 1.25

# Time constant of a contact, in physics steps. MuJoCo needs 2 to be stable; ODE's usual
# error reduction of 0.2 a step would be 5, which lets wheels creep at large steps.
_TIME_CONSTANT_STEPS = 3.0


def friction_of(collision: Collision) -> float:
    """Return the sliding friction coefficient of a collision, along its first direction."""
    return min(collision.surface.friction.mu, LARGEST_FRICTION)


def second_friction_of(collision: Collision) -> float:
    """Return the friction coefficient along the second direction; the first one's by default."""
    friction = collision.surface.friction
    if min(friction.mu, friction.mu2) >= _NEVER_SLIPS:
        return friction_of(collision)
    return min(friction.mu2, LARGEST_FRICTION)


def torsional_friction_of(collision: Collision) -> float:
    """Return the largest torque about the normal of a contact over its force [m].

    That of a round patch of radius a under Hertz's pressure, 3 pi / 16 mu a, as in Gazebo's
    tutorial on torsional friction. A patch that grows with the depth is not known here.
    """
    torsional = collision.surface.friction.torsional
    if torsional is None or not torsional.use_patch_radius:
        return 0.0
    return 3.0 * math.pi / 16.0 * torsional.coefficient * torsional.patch_radius


def rigid_terms(time_step: float) -> dict[str, list[float]]:
    """Return MuJoCo's terms for the error correction of a rigid contact."""
    return {
        "solref": [_TIME_CONSTANT_STEPS * time_step, _DAMPING_RATIO],
        "solimp": list(_IMPEDANCE),
    }


def stiffen_friction(model: mujoco.MjModel) -> None:
    """Set friction to creep as little as the solver can do."""
    if model.opt.cone == mujoco.mjtCone.mjCONE_PYRAMIDAL:
        model.opt.impratio = _RATIO_IN_A_PYRAMID
        return
    model.opt.impratio = _RATIO_IN_A_CONE
    for shares in (model.geom_solimp, model.pair_solimp):
        rigid = (shares == _IMPEDANCE).all(axis=1)
        shares[rigid, 0] = _SHARE_IN_A_CONE


def friction_ranks(collisions: Iterable[Collision]) -> dict[float, int]:
    """Return a contact priority for each friction coefficient, the slipperiest the highest.

    ODE uses the smaller coefficient of two surfaces, MuJoCo that of the geom with the higher
    priority. With priorities in the reverse order of coefficients both use the smaller one.
    """
    values = {friction_of(collision) for collision in collisions}
    return {value: rank for rank, value in enumerate(sorted(values, reverse=True))}


def needs_cone(moving: Iterable[float], resting: Iterable[float]) -> bool:
    """Return whether some contact has more friction than a pyramid bears.

    Args:
        moving: Coefficients of the surfaces that move.
        resting: Of those that do not.
    """
    fast, slow = sorted(moving, reverse=True), sorted(resting, reverse=True)
    if not fast:
        return False
    other = max([*fast[1:2], *slow[:1]], default=0.0)
    return min(fast[0], other) > _LARGEST_IN_A_PYRAMID


def condim_of(mu: float, spin: float) -> int:
    """Return the number of contact directions, by sliding and torsional friction."""
    return 4 if spin > 0.0 else 3 if mu > LEAST_FRICTION else 1


def surface_options(
    collision: Collision, time_step: float, ranks: dict[float, int]
) -> dict[str, Any]:
    """Return the arguments of ``add_geom`` that hold the surface."""
    surface = collision.surface
    mu, spin = friction_of(collision), torsional_friction_of(collision)
    touches = not surface.contact.collide_without_contact
    mask = _signed(surface.contact.collide_bitmask) if touches else 0
    return {
        "friction": [mu, spin, 0.0],
        "condim": condim_of(mu, spin),
        "margin": TOUCHING,
        "priority": ranks[mu],
        "contype": mask,
        "conaffinity": mask,
        **rigid_terms(time_step),
    }


def _signed(mask: int) -> int:
    """Return the lower 32 bits of a mask as MuJoCo's signed integer."""
    low = mask & 0xFFFFFFFF
    return low - (1 << 32) if low >> 31 else low

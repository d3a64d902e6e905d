"""SDF surfaces as MuJoCo contact parameters.

The derivations and their limits are written down in ``docs/physics.md``.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterable
from typing import Any

from gazelle.description import Collision
from gazelle.errors import EngineWarning

# MuJoCo's friction pyramid is ill-conditioned for the "never slip" coefficients (1e5 and
# more) of many files. At 10 nothing slips on slopes of up to 84 degrees.
_LARGEST_FRICTION = 10.0

# Share of the constraint force that acts at first touch, and from a penetration [m] on.
# Stiffer ones drive no better (tests/engines/test_burger.py) and take the solver longer.
_IMPEDANCE = (0.9, 0.95, 0.001, 0.5, 2.0)

# Contacts are damped three times as much as critically: nothing rocks itself up.
_DAMPING_RATIO = 3.0

# Time constant of a contact, in physics steps. MuJoCo needs 2 to be stable; ODE's usual
# error reduction of 0.2 a step would be 5, which lets wheels creep at large steps.
_TIME_CONSTANT_STEPS = 3.0


def friction_of(collision: Collision) -> float:
    """The sliding friction coefficient that is used for a collision."""
    friction = collision.surface.friction
    if friction.mu != friction.mu2 and min(friction.mu, friction.mu2) < _LARGEST_FRICTION:
        warnings.warn(
            EngineWarning(
                f"collision '{collision.name}': friction differs by direction "
                f"(mu {friction.mu:g}, mu2 {friction.mu2:g}); mu is used for both"
            ),
            stacklevel=2,
        )
    return min(friction.mu, _LARGEST_FRICTION)


def friction_ranks(collisions: Iterable[Collision]) -> dict[float, int]:
    """A contact priority for each friction coefficient in use, the slipperiest the highest.

    ODE takes the smaller coefficient of two surfaces, MuJoCo that of the geom with the
    higher priority, so the order by slipperiness makes the second do what the first does.
    """
    values = {friction_of(collision) for collision in collisions}
    return {value: rank for rank, value in enumerate(sorted(values, reverse=True))}


def surface_options(
    collision: Collision, time_step: float, ranks: dict[float, int]
) -> dict[str, Any]:
    """Arguments of ``add_geom`` that hold the surface."""
    surface = collision.surface
    mu = friction_of(collision)
    torsional = surface.friction.torsional
    spin = 0.0
    if torsional is not None and torsional.use_patch_radius:
        spin = torsional.coefficient * torsional.patch_radius
    mask = 0 if surface.contact.collide_without_contact else surface.contact.collide_bitmask
    return {
        "friction": [mu, spin, 0.0],
        "condim": 4 if spin > 0.0 else 3,
        "priority": ranks[mu],
        "contype": mask & 0xFFFF,
        "conaffinity": mask & 0xFFFF,
        "solref": [_TIME_CONSTANT_STEPS * time_step, _DAMPING_RATIO],
        "solimp": list(_IMPEDANCE),
    }

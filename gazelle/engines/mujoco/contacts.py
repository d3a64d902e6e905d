"""Contacts between two surfaces that MuJoCo would mix wrongly: bouncing and springy ones.

MuJoCo decides most contacts by the surface of one of the two geoms. Where both matter, as
for restitution and for stiffness, the two get a contact pair of their own, with terms that
follow from ODE's rules for two surfaces:

* restitution: the smaller coefficient;
* stiffness: 1 / (1 / kp1 + 1 / kp2), damping: kd1 + kd2;
* friction: the smaller coefficient.
"""

from __future__ import annotations

import functools
import itertools
import math
import warnings
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np

from gazelle.description import Collision
from gazelle.engines.mujoco.surfaces import friction_of
from gazelle.errors import EngineWarning

# Above this speed no file means its bounce threshold seriously [m/s]; SDF's default is 1e5.
_LARGEST_THRESHOLD = 1000.0

# Half a period of a bounce, in physics steps. More would let bodies sink deeper while they
# bounce, fewer would let the height depend more on when in a step the contact begins.
_BOUNCE_STEPS = 20

# Impact speed at which the coefficient comes out best: a fall from 0.8 m [m/s].
_USUAL_SPEED = 4.0

# Stiffer springs than this are as good as rigid [N/m]; SDF's default is 1e12.
_STIFFEST = 1e9

# A spring is felt when its period with the body on it takes at least so many steps.
_FEWEST_STEPS_A_PERIOD = 10.0

_MOST_PAIRS = 2000


@dataclass(frozen=True, slots=True)
class Solid:
    """One geom that may touch others.

    Attributes:
        geom: Its name in MuJoCo.
        body: Scoped name of its body; empty for the world.
        model: Name of its top-level model.
        mass: Of that model [kg]; infinite when it does not move.
        collides_with_own: Whether it collides with its own model.
        collision: The description.
    """

    geom: str
    body: str
    model: str
    mass: float
    collides_with_own: bool
    collision: Collision


@dataclass(frozen=True, slots=True)
class Spring:
    """A contact pair that is a spring and damper; its terms need the compiled inertias.

    Attributes:
        pair: Index of the pair in MuJoCo.
        stiffness: [N/m].
        damping: [N s/m].
    """

    pair: int
    stiffness: float
    damping: float


def add_pairs(spec: mujoco.MjSpec, solids: Iterable[Solid], time_step: float) -> list[Spring]:
    """Add a contact pair for every two surfaces that bounce or give way.

    Returns:
        The springs, to be tuned by ``tune_springs`` when the model is compiled.
    """
    special = [s for s in solids if _bounce_of(s.collision) > 0.0 or _is_soft(s.collision)]
    everything = list(solids)
    springs: list[Spring] = []
    seen: set[tuple[str, str]] = set()
    count = 0
    for first, second in itertools.product(special, everything):
        names = (min(first.geom, second.geom), max(first.geom, second.geom))
        if names in seen or not _may_touch(first, second):
            continue
        seen.add(names)
        law = _law(first, second, time_step)
        if law is None:
            continue
        if count == _MOST_PAIRS:
            warnings.warn(
                EngineWarning(
                    f"more than {_MOST_PAIRS} pairs of surfaces bounce or are springy; "
                    "the others are rigid"
                ),
                stacklevel=2,
            )
            break
        options, spring = law
        mu = min(friction_of(first.collision), friction_of(second.collision))
        spec.add_pair(
            geomname1=first.geom,
            geomname2=second.geom,
            condim=3 if mu > 0.0 else 1,
            friction=[mu, mu, 0.0, 0.0, 0.0],
            **options,
        )
        if spring is not None:
            springs.append(Spring(count, *spring))
        count += 1
    return springs


def tune_springs(model: mujoco.MjModel, springs: Iterable[Spring]) -> None:
    """Give springs the terms of ODE's implicit spring and damper.

    ODE solves, for the velocity v after a step of h, v = -erp / h * depth - cfm * force with
    erp = h kp / (h kp + kd) and cfm = 1 / (h kp + kd). In MuJoCo's terms that is a reference
    acceleration of -v / h - erp / h² * depth and a regularisation of cfm / h, which is
    expressed by the impedance: R = (1 - d) / d * (inverse inertia of both bodies), times
    mu² (1 + mu²) / 2 for a friction pyramid of four sides, 1 for a cone.
    """
    h = float(model.opt.timestep)
    pyramidal = model.opt.cone == mujoco.mjtCone.mjCONE_PYRAMIDAL
    for spring in springs:
        give = 1.0 / (h * spring.stiffness + spring.damping)
        erp = h * spring.stiffness * give
        bodies = [int(model.geom_bodyid[g]) for g in _geoms(model, spring.pair)]
        mobility = float(sum(model.body_invweight0[b, 0] for b in bodies))
        mu = float(model.pair_friction[spring.pair, 0])
        flat = bool(pyramidal and model.pair_dim[spring.pair] > 1)
        pyramid = mu * mu * (1.0 + mu * mu) / 2.0 if flat else 1.0
        ratio = give / h / max(mobility * pyramid, 1e-12)
        d = min(max(1.0 / (1.0 + ratio), 1e-4), 0.9999)
        model.pair_solimp[spring.pair] = (d, d, 0.001, 0.5, 2.0)
        model.pair_solref[spring.pair] = (-d * erp / h**2, -d / h)


def _geoms(model: mujoco.MjModel, pair: int) -> tuple[int, int]:
    return int(model.pair_geom1[pair]), int(model.pair_geom2[pair])


def _may_touch(first: Solid, second: Solid) -> bool:
    if first.geom == second.geom or first.body == second.body:
        return False
    if math.isinf(first.mass) and math.isinf(second.mass):
        return False
    if first.model == second.model and not (first.collides_with_own and second.collides_with_own):
        return False
    a, b = first.collision.surface.contact, second.collision.surface.contact
    if a.collide_without_contact or b.collide_without_contact:
        return False
    return bool(a.collide_bitmask & b.collide_bitmask)


def _law(
    first: Solid, second: Solid, time_step: float
) -> tuple[dict[str, Any], tuple[float, float] | None] | None:
    """Options of the pair, and stiffness and damping of a spring; None for a rigid contact."""
    e = min(_bounce_of(first.collision), _bounce_of(second.collision))
    if e > 0.0:
        omega = math.pi / (_BOUNCE_STEPS * time_step)
        ratio = damping_ratio_for(min(e, 1.0), time_step)
        d = 0.999
        options = {
            "solref": [-(omega**2), -2.0 * ratio * omega],
            "solimp": [d, d, 0.001, 0.5, 2.0],
        }
        return options, None
    a, b = first.collision.surface.contact, second.collision.surface.contact
    stiffness = 1.0 / (1.0 / max(a.kp, 1e-9) + 1.0 / max(b.kp, 1e-9))
    mass = min(first.mass, second.mass)
    period = 2.0 * math.pi * math.sqrt(mass / stiffness)
    if stiffness > _STIFFEST or period < _FEWEST_STEPS_A_PERIOD * time_step:
        return None
    return {}, (stiffness, a.kd + b.kd)


def _bounce_of(collision: Collision) -> float:
    bounce = collision.surface.bounce
    if bounce.threshold > _LARGEST_THRESHOLD:
        return 0.0
    return bounce.restitution_coefficient


def _is_soft(collision: Collision) -> bool:
    return collision.surface.contact.kp <= _STIFFEST


@functools.cache
def damping_ratio_for(restitution: float, time_step: float) -> float:
    """The damping ratio with which a stepped spring contact bounces by a coefficient.

    Found by bisection on the very recursion that the engine makes: semi-implicit Euler with
    a force that only pushes, averaged over where in a step the contact begins.
    """
    if restitution >= 1.0:
        return 0.0
    low, high = 0.0, 2.0
    for _ in range(40):
        middle = (low + high) / 2.0
        if _stepped_restitution(middle, time_step) > restitution:
            low = middle
        else:
            high = middle
    return (low + high) / 2.0


def _stepped_restitution(ratio: float, time_step: float) -> float:
    """Root mean square of the coefficient over phases, for an impact at a usual speed.

    Lengths are in distances that the body falls in a step, times in steps. Gravity acts
    once the contact no longer pushes, while the body is still in it.
    """
    omega = math.pi / _BOUNCE_STEPS
    gravity = 9.8 * time_step / _USUAL_SPEED
    depth = -(np.arange(64) + 0.5) / 64.0
    speed = -np.ones(64)
    for _ in range(6 * _BOUNCE_STEPS):
        force = -2.0 * ratio * omega * speed - omega**2 * depth
        inside = depth < 0.0
        speed = speed + np.where(inside, np.maximum(force, -gravity), 0.0)
        depth = depth + speed
    return float(np.sqrt((np.clip(speed, 0.0, None) ** 2).mean()))

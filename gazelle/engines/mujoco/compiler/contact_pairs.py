"""Contacts between two surfaces that MuJoCo would mix wrongly, by pairs.

MuJoCo decides most contacts by the surface of one of the two geoms. Where both matter, as
for restitution, for stiffness and for friction that differs by direction, the two get a
contact pair of their own, with terms that follow from ODE's rules for two surfaces:

* restitution: the smaller coefficient;
* stiffness: 1 / (1 / kp1 + 1 / kp2), damping: kd1 + kd2;
* friction: the smaller coefficient, in each direction.
"""

from __future__ import annotations

import itertools
import math
import warnings
from collections import defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import mujoco

from gazelle.description import Capsule, Collision, Contact, Ellipsoid, Pose, Sphere, World
from gazelle.engines.mujoco.compiler.anisotropic_friction import (
    directional_friction_of,
    friction_between,
    is_directional,
)
from gazelle.engines.mujoco.compiler.surfaces import (
    TOUCHING,
    condim_of,
    friction_of,
    needs_cone,
    rigid_terms,
    torsional_friction_of,
)
from gazelle.engines.mujoco.contact_laws.law_data import DirectionalFriction
from gazelle.errors import EngineWarning

# Above this speed no file means its bounce threshold seriously [m/s]; SDF's default is 1e5.
# What falls that fast fell from 45 m.
_LARGEST_THRESHOLD = 30.0

# Speed over which a deep contact at rest recovers, times 1 - e² over e [m/s].
_USUAL_SPEED = 4.0

# Softest correction of a bouncing contact, as a share of the depth a step. With none at all
# what lies would sink without end.
_LEAST_CORRECTION = 1e-4

# Share of the force of a bouncing contact that acts: MuJoCo's most.
_FULL = 0.9999

# Stiffer springs than this are as good as rigid [N/m]; SDF's default is 1e12.
_STIFFEST = 1e9

# A spring is felt when its period with the mass on it takes at least this number of steps. With all
# springs below a body together, or an impact would put more energy into them than it had.
_FEWEST_STEPS_A_PERIOD = 10.0

_MOST_PAIRS = 2000

# Contact points of a shape that lies on another; others have four.
_POINTS = {Sphere: 1, Ellipsoid: 1, Capsule: 2}


@dataclass(frozen=True, slots=True)
class ContactGeom:
    """One geom that may touch others.

    Attributes:
        geom: Its name in MuJoCo.
        body: Scoped name of its body; empty for the world.
        model: Name of its top-level model.
        mass: Of that model [kg]; infinite when it does not move.
        share: Share of that mass on one contact point if all of its springs touch [kg].
        collides_with_own: Whether it collides with its own model.
        collision: The description.
        placed: Pose in the frame of its body in MuJoCo.
    """

    geom: str
    body: str
    model: str
    mass: float
    collides_with_own: bool
    collision: Collision
    placed: Pose = field(default_factory=Pose)
    share: float = math.inf


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


@dataclass(frozen=True, slots=True)
class Pairs:
    """Requirements of a world's contact pairs.

    Attributes:
        springs: To be tuned by ``tune_springs`` when the model is compiled.
        bounces: Whether some bounce.
        directional_friction: Directional friction by geom, if some have it.
    """

    springs: list[Spring]
    bounces: bool
    directional_friction: Mapping[str, DirectionalFriction]


def add_pairs(
    spec: mujoco.MjSpec, solids: Iterable[ContactGeom], time_step: float, gravity: float
) -> Pairs:
    """Add a contact pair for every two surfaces that MuJoCo would mix wrongly.

    Args:
        spec: Specification to add to.
        solids: All geoms that may touch others.
        time_step: Physics step [s].
        gravity: Its size [m/s²].
    """
    everything = _with_shares(list(solids))
    springs: list[Spring] = []
    bounces = directional = False
    for count, (first, second) in enumerate(_special_pairs(everything, time_step)):
        if count == _MOST_PAIRS:
            warnings.warn(
                EngineWarning(
                    f"more than {_MOST_PAIRS} contact pairs have restitution, compliance or directional "
                    "friction; the others are rigid with isotropic friction"
                ),
                stacklevel=2,
            )
            break
        e, spring = _restitution(first, second), _spring_between(first, second, time_step)
        terms: dict[str, Any] = rigid_terms(time_step)
        if e > 0.0:
            terms, bounces = bouncing_terms(e, time_step, gravity), True
        elif spring is not None:
            springs.append(Spring(count, *spring))
        along, across = friction_between(first.collision, second.collision)
        directional |= along != across
        spec.add_pair(
            geomname1=first.geom,
            geomname2=second.geom,
            margin=2.0 * TOUCHING,
            **_friction_terms(first, second),
            **terms,
        )
    return Pairs(springs, bounces, _directional_frictions_of(everything) if directional else {})


def world_needs_cone(solids: Iterable[ContactGeom]) -> bool:
    """Return whether some contact may have more friction than a pyramid bears."""
    frictions = [(friction_of(solid.collision), math.isfinite(solid.mass)) for solid in solids]
    return needs_cone(
        (mu for mu, moves in frictions if moves), (mu for mu, moves in frictions if not moves)
    )


def may_slide(solids: Iterable[ContactGeom]) -> bool:
    """Return whether any moving surface has friction."""
    return any(friction_of(each.collision) and math.isfinite(each.mass) for each in solids)


def recovery_velocities_of(solids: Iterable[ContactGeom], world: World) -> dict[str, float]:
    """Return the velocities at which geoms leave what they overlap, by name [m/s]."""
    solids = list(solids)
    if not any(math.isfinite(each.mass) for each in solids):
        return {}
    most = world.profile.ode.contact_max_correcting_vel
    return {each.geom: min(each.collision.surface.contact.max_vel, most) for each in solids}


def _directional_frictions_of(solids: Iterable[ContactGeom]) -> dict[str, DirectionalFriction]:
    found = (
        (solid.geom, directional_friction_of(solid.collision, solid.placed)) for solid in solids
    )
    return {geom: rub for geom, rub in found if rub is not None}


def _with_shares(solids: list[ContactGeom]) -> list[ContactGeom]:
    """Return the geoms with the share of their mass that a spring below a model bears."""
    points: dict[str, int] = defaultdict(int)
    for solid in solids:
        if _is_soft(solid):
            points[solid.model] += _POINTS.get(type(solid.collision.geometry), 4)
    return [
        s if math.isinf(s.mass) else replace(s, share=s.mass / max(1, points[s.model]))
        for s in solids
    ]


def _special_pairs(
    solids: list[ContactGeom], time_step: float
) -> Iterable[tuple[ContactGeom, ContactGeom]]:
    """Yield pairs of geoms that need their own terms.

    All pieces of a collision share one surface.
    """
    pieces = [list(each) for _, each in itertools.groupby(solids, _collision_of)]
    seen: set[tuple[str, str]] = set()
    for own in pieces:
        if not _may_be_special(own[0]):
            continue
        others = [other for other in pieces if _is_special(own[0], other[0], time_step)]
        for first, second in itertools.product(own, itertools.chain.from_iterable(others)):
            names = (min(first.geom, second.geom), max(first.geom, second.geom))
            if names not in seen:
                seen.add(names)
                yield first, second


def _collision_of(solid: ContactGeom) -> tuple[str, str, int]:
    return solid.model, solid.body, id(solid.collision)


def _may_be_special(solid: ContactGeom) -> bool:
    return _bounces(solid) or _is_soft(solid) or is_directional(solid.collision)


def _is_special(first: ContactGeom, second: ContactGeom, time_step: float) -> bool:
    return _may_touch(first, second) and (
        is_directional(first.collision)
        or is_directional(second.collision)
        or _restitution(first, second) > 0.0
        or _spring_between(first, second, time_step) is not None
    )


def tune_springs(model: mujoco.MjModel, springs: Iterable[Spring]) -> None:
    """Set springs to the terms of ODE's implicit spring and damper.

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
        d = min(max(1.0 / (1.0 + ratio), 1e-4), _FULL)
        model.pair_solimp[spring.pair] = (d, d, 0.001, 0.5, 2.0)
        model.pair_solref[spring.pair] = (-d * erp / h**2, -d / h)


def bouncing_terms(e: float, time_step: float, gravity: float) -> dict[str, list[float]]:
    """Return the terms of a contact that bounces by a coefficient, in one step, as ODE's.

    MuJoCo's reference acceleration is -B v - K depth. With B = (1 + e) / h the velocity v of
    approach becomes -e v in the step h that finds the bodies in each other. How deep they are
    by then, ``contact_laws.kernel`` takes into account in the step of an impact. For what rests, K lets it
    out of what depth is left, by g (1 - e²) / (e v) times the depth in a step. What rubs stops,
    in the same step.
    """
    h = time_step
    correction = gravity * (1.0 - e * e) / (e * _USUAL_SPEED) * h
    stiffness = min(max(correction, _LEAST_CORRECTION), 1.0) / h**2
    return {
        "solref": [-_FULL * stiffness, -_FULL * (1.0 + e) / h],
        "solreffriction": [0.0, -_FULL / h],
        "solimp": [_FULL, _FULL, 0.001, 0.5, 2.0],
    }


def _friction_terms(first: ContactGeom, second: ContactGeom) -> dict[str, Any]:
    one, two = friction_between(first.collision, second.collision)
    spin = max(torsional_friction_of(first.collision), torsional_friction_of(second.collision))
    return {"condim": condim_of(max(one, two), spin), "friction": [one, two, spin, 0.0, 0.0]}


def _geoms(model: mujoco.MjModel, pair: int) -> tuple[int, int]:
    return int(model.pair_geom1[pair]), int(model.pair_geom2[pair])


def _may_touch(first: ContactGeom, second: ContactGeom) -> bool:
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


def _spring_between(
    first: ContactGeom, second: ContactGeom, time_step: float
) -> tuple[float, float] | None:
    """Return stiffness and damping of a contact; None for one that is practically rigid."""
    a, b = first.collision.surface.contact, second.collision.surface.contact
    (kp1, kd1), (kp2, kd2) = _stiffness_of(a, time_step), _stiffness_of(b, time_step)
    stiffness = 1.0 / (1.0 / max(kp1, 1e-9) + 1.0 / max(kp2, 1e-9))
    mass = min(first.share, second.share)
    period = 2.0 * math.pi * math.sqrt(mass / stiffness)
    if stiffness > _STIFFEST or period < _FEWEST_STEPS_A_PERIOD * time_step:
        return None
    return stiffness, kd1 + kd2


def _stiffness_of(contact: Contact, time_step: float) -> tuple[float, float]:
    """Return stiffness and damping of one surface, from its ERP and CFM if it gives those.

    With erp = h kp / (h kp + kd) and cfm = 1 / (h kp + kd), ODE's manual, kp is erp / (h cfm)
    and kd is (1 - erp) / cfm.
    """
    if contact.soft_cfm > 0.0 and contact.kp > _STIFFEST:
        kp = contact.soft_erp / (time_step * contact.soft_cfm)
        return kp, max(0.0, 1.0 - contact.soft_erp) / contact.soft_cfm
    return contact.kp, contact.kd


def _restitution(first: ContactGeom, second: ContactGeom) -> float:
    e = min(_bounce_of(first.collision), _bounce_of(second.collision))
    return min(e, 1.0)


def _bounces(solid: ContactGeom) -> bool:
    return _bounce_of(solid.collision) > 0.0


def _bounce_of(collision: Collision) -> float:
    bounce = collision.surface.bounce
    if bounce.threshold > _LARGEST_THRESHOLD:
        return 0.0
    return bounce.restitution_coefficient


def _is_soft(solid: ContactGeom) -> bool:
    contact = solid.collision.surface.contact
    return contact.kp <= _STIFFEST or contact.soft_cfm > 0.0

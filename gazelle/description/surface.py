"""Contact properties of a collision: friction, contact stiffness, bounce.

Defaults are SDF 1.7's.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from gazelle.description.nan_refusal import refuses_nan
from gazelle.description.parameters import Parameters
from gazelle.description.pose import Vector3


@refuses_nan
@dataclass(frozen=True, slots=True)
class TorsionalFriction:
    """Friction about the contact normal.

    Attributes:
        coefficient: Dimensionless.
        use_patch_radius: Use ``patch_radius``; else the contact radius of a sphere.
        patch_radius: Radius of the contact patch [m].
        surface_radius: Radius of the surface at the contact [m].
        slip: Force dependent slip [1/(N s)].
    """

    coefficient: float = 1.0
    use_patch_radius: bool = True
    patch_radius: float = 0.0
    surface_radius: float = 0.0
    slip: float = 0.0


@refuses_nan
@dataclass(frozen=True, slots=True)
class Friction:
    """Coulomb friction in two directions.

    Attributes:
        mu: Coefficient along the first friction direction.
        mu2: Coefficient along the second.
        fdir1: First friction direction in the collision frame; zero means "any".
        slip1: Force dependent slip along the first direction [m/(N s)].
        slip2: Along the second.
        torsional: Friction about the normal; None when the file has none.
    """

    mu: float = 1.0
    mu2: float = 1.0
    fdir1: Vector3 = (0.0, 0.0, 0.0)
    slip1: float = 0.0
    slip2: float = 0.0
    torsional: TorsionalFriction | None = None


@refuses_nan
@dataclass(frozen=True, slots=True)
class Contact:
    """Contact as a spring and damper, or as ODE's error reduction terms.

    Attributes:
        kp: Stiffness [N/m].
        kd: Damping [N s/m].
        soft_cfm: Constraint force mixing, used when kp is not given.
        soft_erp: Error reduction per step, used when kp is not given.
        max_vel: Largest velocity that correcting a penetration may cause [m/s].
        min_depth: Penetration that is left uncorrected [m].
        collide_bitmask: Two collisions touch when their masks share a bit.
        category_bitmask: SDF 1.7: the groups this collision is in.
        collide_without_contact: Report touching, but push nothing.
        collide_without_contact_bitmask: Mask for ``collide_without_contact``.
    """

    kp: float = 1e12
    kd: float = 1.0
    soft_cfm: float = 0.0
    soft_erp: float = 0.2
    max_vel: float = 0.01
    min_depth: float = 0.0
    collide_bitmask: int = 0xFFFF
    category_bitmask: int = 0xFFFF
    collide_without_contact: bool = False
    collide_without_contact_bitmask: int = 1


@refuses_nan
@dataclass(frozen=True, slots=True)
class Bounce:
    """Restitution: coefficient, and the approach speed above which it acts [m/s]."""

    restitution_coefficient: float = 0.0
    threshold: float = 100000.0


@dataclass(frozen=True, slots=True)
class Surface:
    """All contact properties of one collision.

    Attributes:
        friction: Friction.
        contact: Stiffness and masks.
        bounce: Restitution.
        extras: Elements without effect, kept as in the file: Bullet's terms, DART's
            ``<soft_contact>``, ...
    """

    friction: Friction = field(default_factory=Friction)
    contact: Contact = field(default_factory=Contact)
    bounce: Bounce = field(default_factory=Bounce)
    extras: tuple[Parameters, ...] = field(default=(), hash=False)

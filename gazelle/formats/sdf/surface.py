"""``<surface>``: friction, contact and bounce."""

from __future__ import annotations

from gazelle.description import (
    Bounce,
    Contact,
    Friction,
    Parameters,
    Surface,
    TorsionalFriction,
)
from gazelle.formats import values
from gazelle.formats.sdf.leftover import Pattern, leftover

NO_SLIP = 1e9

_PATTERN: Pattern = {
    "friction": {
        "ode": dict.fromkeys(("mu", "mu2", "fdir1", "slip1", "slip2")),
        "torsional": {
            **dict.fromkeys(("coefficient", "use_patch_radius", "patch_radius", "surface_radius")),
            "ode": {"slip": None},
        },
    },
    "contact": {
        "ode": dict.fromkeys(("kp", "kd", "soft_cfm", "soft_erp", "max_vel", "min_depth")),
        **dict.fromkeys(("collide_bitmask", "category_bitmask", "collide_without_contact")),
        "collide_without_contact_bitmask": None,
    },
    "bounce": dict.fromkeys(("restitution_coefficient", "threshold")),
}


def read_surface(node: Parameters | None) -> Surface:
    """Read all contact properties of a collision; SDF's defaults for missing ones."""
    if node is None:
        return Surface()
    return Surface(
        friction=read_friction(node.find("friction")),
        contact=read_contact(node.find("contact")),
        bounce=read_bounce(node.find("bounce")),
        extras=leftover(node, _PATTERN).children,
    )


def read_friction(node: Parameters | None) -> Friction:
    """Read ``<friction>``, of which ODE's terms and the torsional ones are kept."""
    if node is None:
        return Friction()
    return Friction(
        mu=_coefficient(node, "ode/mu", "bullet/friction"),
        mu2=_coefficient(node, "ode/mu2", "bullet/friction2"),
        fdir1=values.vector(node, "ode/fdir1", (0.0, 0.0, 0.0)),
        slip1=values.real(node, "ode/slip1", 0.0),
        slip2=values.real(node, "ode/slip2", 0.0),
        torsional=read_torsional(node.find("torsional")),
    )


def _coefficient(node: Parameters, ode: str, bullet: str) -> float:
    """Return a coefficient of friction; Gazebo takes a negative one as "no slip"."""
    value = values.real(node, ode, values.real(node, bullet, 1.0))
    return NO_SLIP if value < 0.0 else value


def read_torsional(node: Parameters | None) -> TorsionalFriction | None:
    """Read ``<torsional>``."""
    if node is None:
        return None
    return TorsionalFriction(
        coefficient=values.real(node, "coefficient", 1.0),
        use_patch_radius=values.flag(node, "use_patch_radius", default=True),
        patch_radius=values.real(node, "patch_radius", 0.0),
        surface_radius=values.real(node, "surface_radius", 0.0),
        slip=values.real(node, "ode/slip", 0.0),
    )


def read_contact(node: Parameters | None) -> Contact:
    """Read ``<contact>``: masks and ODE's terms (Bullet's where ODE's are missing)."""
    if node is None:
        return Contact()
    own = next((tag for tag in ("ode", "bullet") if tag in node), "ode")
    return Contact(
        kp=values.real(node, f"{own}/kp", 1e12),
        kd=values.real(node, f"{own}/kd", 1.0),
        soft_cfm=values.real(node, f"{own}/soft_cfm", 0.0),
        soft_erp=values.real(node, f"{own}/soft_erp", 0.2),
        max_vel=values.real(node, "ode/max_vel", 0.01),
        min_depth=values.real(node, "ode/min_depth", 0.0),
        collide_bitmask=values.whole(node, "collide_bitmask", 0xFFFF),
        category_bitmask=values.whole(node, "category_bitmask", 0xFFFF),
        collide_without_contact=values.flag(node, "collide_without_contact", default=False),
        collide_without_contact_bitmask=values.whole(node, "collide_without_contact_bitmask", 1),
    )


def read_bounce(node: Parameters | None) -> Bounce:
    """Read ``<bounce>``."""
    if node is None:
        return Bounce()
    return Bounce(
        restitution_coefficient=values.real(node, "restitution_coefficient", 0.0),
        threshold=values.real(node, "threshold", 100000.0),
    )

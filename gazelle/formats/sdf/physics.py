"""``<physics>`` of a world."""

from __future__ import annotations

from dataclasses import replace

from gazelle.description import Ode, Parameters, Physics
from gazelle.formats import values
from gazelle.formats.sdf.leftover import Pattern, leftover

_SOLVER = ("type", "min_step_size", "iters", "precon_iters", "sor", "friction_model")
_CONSTRAINTS = ("cfm", "erp", "contact_max_correcting_vel", "contact_surface_layer")
_STEPS = ("max_step_size", "real_time_factor", "real_time_update_rate", "max_contacts")
_PATTERN: Pattern = {
    **dict.fromkeys(("@name", "@default", "@type", *_STEPS, "gravity", "magnetic_field")),
    "ode": {"solver": dict.fromkeys(_SOLVER), "constraints": dict.fromkeys(_CONSTRAINTS)},
}
"""Pattern of the elements that are read here, and by the world up to SDF 1.5."""


def read_physics(node: Parameters) -> Physics:
    """Read one physics profile; defaults are SDF 1.7's.

    Raises:
        FormatError: The step is not positive.
    """
    step = values.real(node, "max_step_size", 0.001)
    values.positive(node.find("max_step_size") or node, step, "<max_step_size>")
    default = node.attributes.get("default", "")
    return Physics(
        name=node.attributes.get("name", "") or "default_physics",
        default=bool(default) and values.parse_flag(node, default, "attribute 'default'"),
        type=node.attributes.get("type", "ode"),
        max_step_size=step,
        real_time_factor=values.real(node, "real_time_factor", 1.0),
        real_time_update_rate=values.real(node, "real_time_update_rate", 1000.0),
        max_contacts=values.whole(node, "max_contacts", 20),
        ode=read_solver(node),
        extras=leftover(node, _PATTERN).children,
        source=node.source,
    )


def read_solver(node: Parameters) -> Ode:
    """Read ODE's terms; without them Bullet's of the same names."""
    bullet = node.find("bullet")
    if "ode" in node or bullet is None:
        return read_ode(node.find("ode"))
    return replace(read_ode(bullet), solver="quick")


def read_ode(node: Parameters | None) -> Ode:
    """Read ``<ode>``."""
    if node is None:
        return Ode()
    return Ode(
        solver=values.word(node, "solver/type", "quick"),
        min_step_size=values.real(node, "solver/min_step_size", 0.0001),
        iters=values.whole(node, "solver/iters", 50),
        precon_iters=values.whole(node, "solver/precon_iters", 0),
        sor=values.real(node, "solver/sor", 1.3),
        friction_model=values.word(node, "solver/friction_model") or None,
        cfm=values.real(node, "constraints/cfm", 0.0),
        erp=values.real(node, "constraints/erp", 0.2),
        contact_max_correcting_vel=values.real(
            node, "constraints/contact_max_correcting_vel", 100.0
        ),
        contact_surface_layer=values.real(node, "constraints/contact_surface_layer", 0.001),
    )

"""``<surface>``: what differs from SDF's defaults."""

from __future__ import annotations

from gazelle.description import Bounce, Contact, Friction, Parameters, Surface, TorsionalFriction
from gazelle.formats.write.element import element, group, leaf, overlay


def write_surface(surface: Surface) -> Parameters | None:
    """Write friction, contact and bounce; None if all are the defaults."""
    known = group(
        "surface",
        write_friction(surface.friction),
        write_contact(surface.contact),
        write_bounce(surface.bounce),
    )
    if not surface.extras:
        return known
    kept = element("surface", *surface.extras)
    return kept if known is None else overlay(kept, known)


def write_friction(friction: Friction) -> Parameters | None:
    """Write ``<friction>``."""
    usual = Friction()
    return group(
        "friction",
        group(
            "ode",
            leaf("mu", friction.mu, usual.mu),
            leaf("mu2", friction.mu2, usual.mu2),
            leaf("fdir1", friction.fdir1, usual.fdir1),
            leaf("slip1", friction.slip1, usual.slip1),
            leaf("slip2", friction.slip2, usual.slip2),
        ),
        None if friction.torsional is None else write_torsional(friction.torsional),
    )


def write_torsional(torsional: TorsionalFriction) -> Parameters:
    """Write ``<torsional>``."""
    return element(
        "torsional",
        leaf("coefficient", torsional.coefficient),
        leaf("use_patch_radius", torsional.use_patch_radius),
        leaf("patch_radius", torsional.patch_radius, 0.0),
        leaf("surface_radius", torsional.surface_radius, 0.0),
        group("ode", leaf("slip", torsional.slip, 0.0)),
    )


def write_contact(contact: Contact) -> Parameters | None:
    """Write ``<contact>``."""
    usual = Contact()
    masks = (
        "collide_bitmask",
        "category_bitmask",
        "collide_without_contact",
        "collide_without_contact_bitmask",
    )
    terms = ("kp", "kd", "soft_cfm", "soft_erp", "max_vel", "min_depth")
    return group(
        "contact",
        *(leaf(name, getattr(contact, name), getattr(usual, name)) for name in masks),
        group("ode", *(leaf(name, getattr(contact, name), getattr(usual, name)) for name in terms)),
    )


def write_bounce(bounce: Bounce) -> Parameters | None:
    """Write ``<bounce>``."""
    usual = Bounce()
    names = ("restitution_coefficient", "threshold")
    return group(
        "bounce", *(leaf(name, getattr(bounce, name), getattr(usual, name)) for name in names)
    )

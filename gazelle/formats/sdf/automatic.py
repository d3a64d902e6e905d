"""``<inertial auto="true">`` (SDF 1.11): mass and inertia from the shapes that collide."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from gazelle.description import Collision, Inertial, Parameters
from gazelle.formats import values
from gazelle.formats.reading import Reading
from gazelle.formats.sdf.inertial import read_inertial
from gazelle.formats.solids import WATER, inertial_of, solid_of
from gazelle.geometry.solids import UnitSolid, joined


def is_automatic(node: Parameters) -> bool:
    """Return whether an ``<inertial>`` is to be computed automatically."""
    text = node.attributes.get("auto", "")
    return bool(text) and values.parse_flag(node, text, "attribute 'auto'")


def automatic_inertial(
    link: Parameters, collisions: tuple[Collision, ...], reading: Reading
) -> Inertial:
    """Return the inertial of all collisions together, each of its own density or the link's.

    A ``<mass>`` in the file decides over the densities, which then only share it out.

    Raises:
        FormatError: A density or the mass is not greater than zero, or a mesh is broken.
    """
    node = link.find("inertial") or link
    usual = _density(node, WATER)
    parts: list[UnitSolid] = []
    for child, collision in zip(link.find_all("collision"), collisions, strict=True):
        solid = solid_of(collision.geometry)
        if solid is not None:
            parts.append(solid.placed(collision.pose.matrix()).scaled(_density(child, usual)))
    with np.errstate(over="ignore", invalid="ignore"):
        whole = joined(parts)
    if whole is None or not whole.is_body():
        reading.note(
            "the inertia cannot be computed: no collision of the link has a volume; "
            "the default of 1 kg is used",
            node,
        )
        return read_inertial(replace(node, children=())) or Inertial()
    mass = values.real(node, "mass", 0.0)
    if mass > 0.0:
        whole = whole.scaled(mass / whole.volume)
    return replace(inertial_of(whole), source=node.source)


def _density(node: Parameters, default: float) -> float:
    return values.positive(node, values.real(node, "density", default), "<density>")

"""Selection and order of the ``<gazebo>`` elements for each collision or visual.

libsdformat goes by names: the elements of a link that others are lumped into count for parts
that do not bear the mark of a lumped one, those of a lumped link for parts called after it. So
they are lost where a lumped part has a name of its own, as they are in Gazebo.
"""

from __future__ import annotations

from dataclasses import replace

from gazelle.description import Material, Parameters, Surface
from gazelle.formats import values
from gazelle.formats.reading import Reading
from gazelle.formats.sdf.material import read_material
from gazelle.formats.sdf.surface import read_surface
from gazelle.formats.urdf.extensions import Extensions, text
from gazelle.formats.urdf.tree import LumpedLink

LUMP = "_fixed_joint_lump__"

_TERMS = {"fdir1", "kd", "kp", "maxVel", "minDepth", "mu1", "mu2"}


def applied(body: LumpedLink, extensions: Extensions, tag: str, name: str) -> list[Parameters]:
    """Return the ``<gazebo>`` elements for one part of a body.

    Args:
        body: The body.
        extensions: All elements of the robot.
        tag: ``collision`` or ``visual``.
        name: The part's name in SDF.
    """
    found: list[Parameters] = []
    for member in body.members:
        link = member.link.name
        counts = LUMP not in name if link == body.name else f"{LUMP}{link}_{tag}" in name
        if counts:
            found.extend(extensions.by_reference.get(link, ()))
    return found


def blob(elements: list[Parameters], tag: str) -> Parameters:
    """Return all SDF that the elements add to a ``<collision>`` or ``<visual>``, in file order."""
    children = (
        inner
        for element in elements
        for child in element.children
        if child.tag == tag
        for inner in child.children
    )
    return Parameters(tag, children=tuple(children))


def surface(elements: list[Parameters]) -> Surface:
    """Return the surface. A whole ``<surface>`` replaces earlier ones, a single term its value."""
    whole: Parameters | None = None
    terms: dict[str, Parameters] = {}
    for element in elements:
        for child in blob([element], "collision").find_all("surface"):
            whole = child
            terms.clear()
        terms |= {child.tag: child for child in element.children if child.tag in _TERMS}
    return _with_terms(read_surface(whole), terms)


def _with_terms(found: Surface, terms: dict[str, Parameters]) -> Surface:
    friction, contact = found.friction, found.contact
    fdir1 = terms.get("fdir1")
    x, y, z = friction.fdir1
    if fdir1 is not None and text(fdir1):
        x, y, z = values.parse_reals(fdir1, text(fdir1), "<fdir1>", 3)
    return replace(
        found,
        friction=replace(
            friction,
            mu=_term(terms, "mu1", friction.mu),
            mu2=_term(terms, "mu2", friction.mu2),
            fdir1=(x, y, z),
        ),
        contact=replace(
            contact,
            kp=_term(terms, "kp", contact.kp),
            kd=_term(terms, "kd", contact.kd),
            max_vel=_term(terms, "maxVel", contact.max_vel),
            min_depth=_term(terms, "minDepth", contact.min_depth),
        ),
    )


def _term(terms: dict[str, Parameters], tag: str, default: float) -> float:
    return _number(terms[tag]) if tag in terms else default


def _number(node: Parameters) -> float:
    return values.parse_real(node, text(node), f"<{node.tag}>")


def real(elements: list[Parameters], tag: str, default: float) -> float:
    """Return the number of the last element with such a child."""
    found = [child for element in elements for child in element.children if child.tag == tag]
    return _number(found[-1]) if found else default


def material(elements: list[Parameters], reading: Reading) -> Material | None:
    """Return a visual's material from the elements, as written; None without one.

    A whole ``<material>`` replaces earlier values; the name of a script goes into it.
    """
    found: Material | None = None
    for element in elements:
        for child in blob([element], "visual").find_all("material"):
            found = read_material(child, reading)
        for child in element.find_all("material"):
            if text(child):
                found = replace(found or Material(), script=text(child), script_uris=())
    return found

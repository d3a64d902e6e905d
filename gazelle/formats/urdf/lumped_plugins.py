"""Plugins of a URDF with a ``<bodyName>`` or ``<frameName>`` that was lumped into another link.

libsdformat writes the name of the body there and adds the offset to it to ``<xyzOffset>`` and
``<rpyOffset>``, once for each of the two tags; Gazebo's plugins know links only.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from types import MappingProxyType

from gazelle.description import Parameters, Pose
from gazelle.formats import values
from gazelle.formats.urdf.extensions import Extensions, text
from gazelle.formats.urdf.tree import LumpedLink
from gazelle.formats.urdf.upright import upright

_NAMES = ("bodyName", "frameName")


@dataclass(frozen=True, slots=True)
class _LumpedStep:
    """One link that goes into its parent, at a pose."""

    link: str
    parent: str
    origin: Pose


def plugins(lumped: list[LumpedLink], extensions: Extensions) -> tuple[Parameters, ...]:
    """Return the ``<plugin>`` elements of a robot: those of the model, then those of its links."""
    steps = list(_steps(lumped))
    references = ["", *(name for name in extensions.by_reference if name)]
    return tuple(
        _moved(node, reference, steps)
        for reference in references
        for node in extensions.of(reference)
        if node.tag == "plugin"
    )


def _steps(lumped: list[LumpedLink]) -> Iterator[_LumpedStep]:
    """Yield the lumped links, the outermost first."""
    for body in lumped:
        for member in reversed(body.members):
            if member.joint is not None:
                yield _LumpedStep(member.link.name, member.joint.parent, member.joint.origin)


def _moved(plugin: Parameters, reference: str, steps: list[_LumpedStep]) -> Parameters:
    reduction = Pose()
    for step in steps:
        if reference == step.link:
            reference, reduction = step.parent, step.origin * reduction
        for tag in _NAMES:
            name = plugin.find(tag)
            if name is not None and text(name) == step.link:
                plugin = _renamed(plugin, name, step, reduction)
    return plugin


def _renamed(
    plugin: Parameters, name: Parameters, step: _LumpedStep, reduction: Pose
) -> Parameters:
    place = step.origin * _offset(plugin, reduction)
    changed = {name.tag, "xyzOffset", "rpyOffset"}
    kept = tuple(child for child in plugin.children if child.tag not in changed)
    added = (
        replace(name, text=step.parent, attributes=MappingProxyType({})),
        _numbers("xyzOffset", place.position, name),
        _numbers("rpyOffset", upright(place).rpy, name),
    )
    return replace(plugin, children=(*kept, *added))


def _offset(plugin: Parameters, reduction: Pose) -> Pose:
    """Return the plugin's own offset, else the pose its link had in the lumped body."""
    place = reduction
    xyz, rpy = plugin.find("xyzOffset"), plugin.find("rpyOffset")
    if xyz is not None:
        position = values.parse_reals(xyz, text(xyz), "<xyzOffset>", 3)
        place = Pose.from_quaternion(position, place.quaternion)
    if rpy is not None:
        place = Pose(*place.position, *values.parse_reals(rpy, text(rpy), "<rpyOffset>", 3))
    return place


def _numbers(tag: str, numbers: tuple[float, ...], source: Parameters) -> Parameters:
    return Parameters(tag, " ".join(f"{n:.6g}" for n in numbers), source=source.source)

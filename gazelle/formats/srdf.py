"""SRDF: what MoveIt knows of a robot besides its URDF.

The elements are those of the ``srdfdom`` package (wiki.ros.org/srdf).
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from graphlib import CycleError, TopologicalSorter
from pathlib import Path
from types import MappingProxyType
from typing import Protocol, TypeVar

from gazelle.description import (
    DisabledCollision,
    EndEffector,
    JointGroup,
    JointGroupState,
    Parameters,
    Semantics,
    Vector3,
    VirtualJoint,
)
from gazelle.description.srdf import VirtualJointType
from gazelle.errors import did_you_mean
from gazelle.formats import values, xacro, xml
from gazelle.formats.reading import Reading
from gazelle.formats.resolve import Resolver
from gazelle_ros.base.path_texts import existing_file

PathLike = str | os.PathLike[str]

_VIRTUAL: dict[str, VirtualJointType] = {
    "fixed": "fixed",
    "floating": "floating",
    "planar": "planar",
}


class _Named(Protocol):
    """Anything with a name."""

    @property
    def name(self) -> str:
        """The name."""


T = TypeVar("T", bound=_Named)


def load_srdf(
    path: PathLike,
    *,
    paths: Sequence[PathLike] = (),
    xacro_args: Mapping[str, str] | None = None,
) -> Semantics:
    """Load an SRDF file; one that uses xacro is expanded.

    Args:
        path: The file.
        paths: Folders to search for packages that it includes files of.
        xacro_args: Values of ``<xacro:arg>``.

    Raises:
        FormatError: The file cannot be read, or its content is invalid.
        ResolveError: There is no such file.
    """
    file = existing_file(path)
    reading = Reading(Resolver(paths, file=file), xacro_args=dict(xacro_args or {}))
    with reading.inside(file):
        semantics = read_semantics(read_root(file, reading), reading)
    reading.report(strict=False)
    return semantics


def read_root(file: Path, reading: Reading) -> Parameters:
    """Read the root element of an SRDF file, expanded if it uses xacro.

    Raises:
        FormatError: The file is not XML, or no valid xacro.
    """
    root = xml.read_file(file, reading.misread)
    return xacro.expand(file, reading) if xacro.is_xacro(root) else root


def is_srdf(root: Parameters) -> bool:
    """Return whether a ``<robot>`` has elements of SRDF, and no link as a URDF does."""
    return "link" not in root and any(child.tag in _KNOWN for child in root.children)


def load_srdf_string(text: str | bytes, *, name: str = "string") -> Semantics:
    """Load SRDF text, such as the parameter ``robot_description_semantic``.

    Raises:
        FormatError: The text cannot be read, or its content is invalid.
    """
    reading = Reading(Resolver())
    root = xml.parse(text, name=name, report=reading.misread)
    if xacro.is_xacro(root):
        root = xacro.expand_text(text, name, reading)
    semantics = read_semantics(root, reading)
    reading.report(strict=False)
    return semantics


def read_semantics(root: Parameters, reading: Reading) -> Semantics:
    """Read a ``<robot>`` element of SRDF.

    Raises:
        FormatError: Its content is invalid.
    """
    if root.tag != "robot":
        raise values.fail(root, f"expected <robot>, found <{root.tag}>")
    _note_unknown(root, reading)
    groups = _unique(root, "group", read_group)
    names = [group.name for group in groups]
    _check_groups(groups, names, root)
    return Semantics(
        robot=values.attribute(root, "name"),
        groups=groups,
        states=tuple(read_state(node, names) for node in root.find_all("group_state")),
        end_effectors=_unique(root, "end_effector", lambda node: read_end_effector(node, names)),
        virtual_joints=_unique(root, "virtual_joint", read_virtual_joint),
        passive_joints=_attributes(root, "passive_joint", "name"),
        disabled_collisions=tuple(map(read_pair, root.find_all("disable_collisions"))),
        enabled_collisions=tuple(map(read_pair, root.find_all("enable_collisions"))),
        unchecked_links=_attributes(root, "disable_default_collisions", "link"),
        spheres=_spheres(root),
        joint_properties=_joint_properties(root),
        source=root.source,
    )


def read_group(node: Parameters) -> JointGroup:
    """Read ``<group>``."""
    return JointGroup(
        name=values.attribute(node, "name"),
        joints=_attributes(node, "joint", "name"),
        links=_attributes(node, "link", "name"),
        chains=tuple(
            (values.attribute(chain, "base_link"), values.attribute(chain, "tip_link"))
            for chain in node.find_all("chain")
        ),
        groups=_attributes(node, "group", "name"),
        source=node.source,
    )


def read_state(node: Parameters, groups: Iterable[str]) -> JointGroupState:
    """Read ``<group_state>``: one value for each degree of freedom of a joint."""
    joints = {}
    for child in node.find_all("joint"):
        text = values.attribute(child, "value")
        joints[values.attribute(child, "name")] = values.parse_reals(
            child, text, "attribute 'value'", None
        )
    return JointGroupState(
        name=values.attribute(node, "name"),
        group=_group_name(node, "group", groups),
        joints=MappingProxyType(joints),
        source=node.source,
    )


def read_end_effector(node: Parameters, groups: Iterable[str]) -> EndEffector:
    """Read ``<end_effector>``."""
    named = bool(node.attributes.get("parent_group"))
    return EndEffector(
        name=values.attribute(node, "name"),
        group=_group_name(node, "group", groups),
        parent_link=values.attribute(node, "parent_link"),
        parent_group=_group_name(node, "parent_group", groups) if named else "",
        source=node.source,
    )


def read_virtual_joint(node: Parameters) -> VirtualJoint:
    """Read ``<virtual_joint>``."""
    kind = values.attribute(node, "type").lower()
    if kind not in _VIRTUAL:
        raise values.fail(
            node, f"unknown type of virtual joint '{kind}'", hint=did_you_mean(kind, _VIRTUAL)
        )
    return VirtualJoint(
        name=values.attribute(node, "name"),
        type=_VIRTUAL[kind],
        parent_frame=values.attribute(node, "parent_frame"),
        child_link=values.attribute(node, "child_link"),
        source=node.source,
    )


def read_pair(node: Parameters) -> DisabledCollision:
    """Read ``<disable_collisions>`` or ``<enable_collisions>``."""
    return DisabledCollision(
        link1=values.attribute(node, "link1"),
        link2=values.attribute(node, "link2"),
        reason=node.attributes.get("reason", ""),
    )


def _spheres(root: Parameters) -> Mapping[str, tuple[tuple[Vector3, float], ...]]:
    found: dict[str, tuple[tuple[Vector3, float], ...]] = {}
    for node in root.find_all("link_sphere_approximation"):
        found[values.attribute(node, "link")] = tuple(
            (
                values.attribute_vector(child, "center", (0.0, 0.0, 0.0)),
                values.attribute_real(child, "radius"),
            )
            for child in node.find_all("sphere")
        )
    return MappingProxyType(found)


def _joint_properties(root: Parameters) -> Mapping[str, Mapping[str, str]]:
    found: dict[str, dict[str, str]] = {}
    for node in root.find_all("joint_property"):
        own = found.setdefault(values.attribute(node, "joint_name"), {})
        own[values.attribute(node, "property_name")] = values.attribute(node, "value")
    return MappingProxyType({name: MappingProxyType(own) for name, own in found.items()})


def _attributes(node: Parameters, tag: str, name: str) -> tuple[str, ...]:
    return tuple(values.attribute(child, name) for child in node.find_all(tag))


def _unique(root: Parameters, tag: str, read: Callable[[Parameters], T]) -> tuple[T, ...]:
    found: dict[str, T] = {}
    for node in root.find_all(tag):
        item = read(node)
        if item.name in found:
            raise values.fail(node, f"there is already a <{tag}> named '{item.name}'")
        found[item.name] = item
    return tuple(found.values())


def _group_name(node: Parameters, attribute: str, groups: Iterable[str]) -> str:
    name = values.attribute(node, attribute)
    if name not in groups:
        raise values.fail(node, f"there is no group '{name}'", hint=did_you_mean(name, groups))
    return name


def _check_groups(groups: Sequence[JointGroup], names: list[str], root: Parameters) -> None:
    for group in groups:
        for inner in group.groups:
            if inner not in names:
                node = Parameters("group", source=group.source or root.source)
                hint = did_you_mean(inner, names)
                raise values.fail(node, f"there is no group '{inner}'", hint=hint)
    try:
        TopologicalSorter({group.name: group.groups for group in groups}).prepare()
    except CycleError as error:
        name = error.args[1][0]
        node = Parameters("group", source=next(g.source for g in groups if g.name == name))
        raise values.fail(node, f"the group '{name}' is part of itself") from None


_KNOWN = {
    "disable_collisions",
    "disable_default_collisions",
    "enable_collisions",
    "end_effector",
    "group",
    "group_state",
    "joint_property",
    "link_sphere_approximation",
    "passive_joint",
    "virtual_joint",
}


def _note_unknown(root: Parameters, reading: Reading) -> None:
    for child in root.children:
        if child.tag not in _KNOWN and ":" not in child.tag:
            hint = did_you_mean(child.tag, _KNOWN)
            reading.note(f"<{child.tag}> is not an element of SRDF and was ignored", child, hint)

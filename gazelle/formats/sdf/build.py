"""Elements made by code, where one element of a file stands for others."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from gazelle.description import Parameters, Pose


def made(
    tag: str,
    text: str = "",
    *children: Parameters,
    like: Parameters,
    attributes: Mapping[str, str] | None = None,
) -> Parameters:
    """Return an element at the place of another one."""
    return Parameters(tag, text, dict(attributes or {}), children, like.source)


def pose_element(pose: Pose, like: Parameters, relative_to: str = "") -> Parameters:
    """Return a ``<pose>`` with all digits."""
    numbers = " ".join(map(repr, (*pose.position, *pose.quaternion)))
    attributes = {"rotation_format": "quat_xyzw"}
    if relative_to:
        attributes["relative_to"] = relative_to
    return made("pose", numbers, like=like, attributes=attributes)


def with_child(node: Parameters, child: Parameters) -> Parameters:
    """Return the element with a child in place of all of the same tag, first of its children."""
    others = (other for other in node.children if other.tag != child.tag)
    return replace(node, children=(child, *others))


def with_attributes(node: Parameters, **attributes: str) -> Parameters:
    """Return the element with some attributes set."""
    return replace(node, attributes={**node.attributes, **attributes})

"""Joints of types that SDF or Gazebo Classic does not have, in Gazelle's own namespace.

Other programs refuse a ``<joint>`` of an unknown type, but pass over an element or attribute
with a prefix.
"""

from __future__ import annotations

from dataclasses import replace

from gazelle.description import Parameters

JOINT = "gazelle:joint"
"""A joint of a type that SDF does not have: ``floating`` or ``planar``."""

TYPE = "gazelle:type"
"""Attribute of a revolute joint without limits that was a ``continuous`` one."""


def with_own_joints(node: Parameters) -> Parameters:
    """Return the model or world with joints of Gazelle's own namespace as plain ones."""
    if JOINT not in node:
        return node
    children = (replace(c, tag="joint") if c.tag == JOINT else c for c in node.children)
    return replace(node, children=tuple(children))

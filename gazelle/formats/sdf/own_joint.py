"""Joints of types that SDF does not have, ``floating`` and ``planar``, in Gazelle's own namespace.

Other programs refuse a ``<joint>`` of an unknown type, but pass over an element with a prefix.
"""

from __future__ import annotations

from dataclasses import replace

from gazelle.description import Parameters

JOINT = "gazelle:joint"


def with_own_joints(model: Parameters) -> Parameters:
    """The model with joints of Gazelle's own namespace as plain ones."""
    if JOINT not in model:
        return model
    children = (replace(c, tag="joint") if c.tag == JOINT else c for c in model.children)
    return replace(model, children=tuple(children))

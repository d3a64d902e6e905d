"""``<imu><noise>`` of SDF up to 1.5 as it is written since 1.6: for each axis.

By SDF's own rules of conversion (``1_5.convert``). What stands in a newer file, or in the
``<gazebo>`` of a URDF, which Gazebo takes for today's SDF, has no effect there.
"""

from __future__ import annotations

from dataclasses import replace
from types import MappingProxyType

from gazelle.description import Parameters

SINCE = (1, 6)

_GROUPS = {"rate": "angular_velocity", "accel": "linear_acceleration"}


def with_noise_by_axis(node: Parameters) -> Parameters:
    """Return the element with the noise of all IMUs below it written for each axis."""
    if node.tag == "plugin":
        return node
    children = tuple(map(with_noise_by_axis, node.children))
    changed = any(new is not old for new, old in zip(children, node.children, strict=True))
    node = replace(node, children=children) if changed else node
    return _imu(node) if node.tag == "imu" else node


def _imu(node: Parameters) -> Parameters:
    noise = node.find("noise")
    if noise is None or not any(tag in noise for tag in _GROUPS):
        return node
    kind = noise.find("type")
    name = noise.attributes.get("type", "gaussian") if kind is None else kind.text
    groups = (
        _group(group, noise.find(tag), name) for tag, group in _GROUPS.items() if group not in node
    )
    kept = (child for child in node.children if child is not noise)
    return replace(node, children=(*kept, *(group for group in groups if group is not None)))


def _group(tag: str, values: Parameters | None, kind: str) -> Parameters | None:
    if values is None:
        return None
    noise = replace(values, tag="noise", attributes=MappingProxyType({"type": kind}))
    axes = (Parameters(axis, children=(noise,), source=values.source) for axis in "xyz")
    return Parameters(tag, children=tuple(axes), source=values.source)

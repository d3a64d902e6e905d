"""Files of SDF 1.0 to 1.3 as they are written since 1.4.

In 1.0 nearly all values were attributes: ``<box size="1 1 1"/>``. Since 1.2 they are
elements. The schema lists the attributes. What else moved is in SDF's own
rules of conversion (``1_3.convert``) and in the files of that time. What moved later is in ``old_noise``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from gazelle.description import Parameters
from gazelle.formats.sdf import old_noise
from gazelle.formats.sdf.old_noise import with_noise_by_axis
from gazelle.formats.sdf.schema import types

Version = tuple[int, int]

SINCE: Version = (1, 4)

_RENAMED = {"origin": "pose"}
_RENAMED_IN = {
    ("fog", "rgba"): "color",
    ("heightmap", "filename"): "uri",
    ("heightmap", "origin"): "pos",
    ("link", "damping"): "velocity_decay",
    ("mesh", "filename"): "uri",
    ("physics", "update_rate"): "real_time_update_rate",
}
_VALUE_ATTRIBUTES = {"enabled", "link", "pose", "rgba", "xyz"}


def upgraded(root: Parameters, version: Version) -> Parameters:
    """Return the root element of an old file, upgraded to the present version."""
    root = _element(root, "root") if version < SINCE else root
    return with_noise_by_axis(root) if version < old_noise.SINCE else root


def _element(node: Parameters, kind: str) -> Parameters:
    """Return an element and all below it; ``kind`` is its entry in the schema."""
    entry = types().get(kind)
    if node.tag == "plugin" or entry is None:
        return node
    node = _without_values(node, entry)
    children = []
    for child in node.children:
        tag = _RENAMED_IN.get((node.tag, child.tag), _RENAMED.get(child.tag, child.tag))
        known = entry["children"].get(tag)
        renamed = replace(child, tag=tag)
        children.append(_element(renamed, known[0]) if known else _values_only(renamed))
    node = replace(node, children=tuple(children))
    mover = _MOVERS.get(node.tag)
    return node if mover is None else mover(node)


def _without_values(node: Parameters, entry: dict[str, Any]) -> Parameters:
    """Return the element with former attributes, or its text, turned into children."""
    attributes, text, made = {}, node.text, []
    for name, value in node.attributes.items():
        if name in entry["attributes"]:
            attributes[name] = value
        elif name in _VALUE_ATTRIBUTES and not entry["children"].get(name):
            text = text or value
        elif entry["children"] and ":" not in name:
            tag = _RENAMED_IN.get((node.tag, name), name)
            made.append(Parameters(tag, value, source=node.source))
        else:
            attributes[name] = value
    return replace(node, text=text, attributes=attributes, children=(*made, *node.children))


def _values_only(node: Parameters) -> Parameters:
    """Return an element that the schema does not know: all its attributes become children."""
    made = (Parameters(name, text, source=node.source) for name, text in node.attributes.items())
    return replace(node, attributes={}, children=(*made, *node.children))


def _moved_up(node: Parameters, inner: str, tag: str, new: str) -> Parameters:
    """Return the element with a grandchild made its own child, under a new tag."""
    holder = node.find(inner)
    moved = None if holder is None else holder.find(tag)
    if holder is None or moved is None:
        return node
    kept = _dropped(node, inner, holder, moved)
    if kept.find(new) is not None:
        return kept
    return replace(kept, children=(*kept.children, replace(moved, tag=new)))


def _dropped(node: Parameters, path: str, holder: Parameters, inner: Parameters) -> Parameters:
    """Return the element without one child of the element at a path below it."""
    head, _, rest = path.partition("/")
    if not head:
        return replace(node, children=tuple(c for c in node.children if c is not inner))
    return replace(
        node,
        children=tuple(
            _dropped(child, rest, holder, inner) if child is node.find(head) else child
            for child in node.children
        ),
    )


def _link(node: Parameters) -> Parameters:
    return _moved_up(node, "inertial", "damping", "velocity_decay")


def _scene(node: Parameters) -> Parameters:
    return _moved_up(node, "background", "sky", "sky")


def _physics(node: Parameters) -> Parameters:
    node = _moved_up(node, "ode/solver", "dt", "max_step_size")
    return _moved_up(node, "bullet", "dt", "max_step_size")


def _include(node: Parameters) -> Parameters:
    uri = node.attributes.get("filename", "")
    if not uri or "uri" in node:
        return node
    return replace(
        node, children=(Parameters("uri", uri, source=node.source), *node.children), attributes={}
    )


def _sky(node: Parameters) -> Parameters:
    """Return the sky without its material, which was always that of clouds."""
    return replace(node, children=tuple(c for c in node.children if c.tag != "material"))


_MOVERS: dict[str, Callable[[Parameters], Parameters]] = {
    "include": _include,
    "link": _link,
    "physics": _physics,
    "scene": lambda node: replace(
        _scene(node),
        children=tuple(_sky(c) if c.tag == "sky" else c for c in _scene(node).children),
    ),
}

"""``<include merge="true">``: the parts of a model as parts of the one that includes it.

As in libsdformat, a frame ``_merged__NAME__model__`` stands where the included model's own
frame was, and what was written in that is written in this.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from gazelle.description import Parameters
from gazelle.formats import values
from gazelle.formats.reading import Reading
from gazelle.formats.sdf.build import made, pose_element, with_attributes, with_child
from gazelle.formats.sdf.frames import MODEL, WORLD
from gazelle.formats.sdf.model_frames import Includer, ModelFrames, Version
from gazelle.formats.sdf.pose import frame_of

_OWN = {"allow_auto_disable", "enable_wind", "pose", "self_collide", "static"}
_IN_WORLDS = {"frame", "include", "joint", "light", "model", "plugin"}
_POSED = {"include", "link", "model"}
_FILES = {"uri", "filename"}


def with_merges(
    node: Parameters, version: Version, reading: Reading, include: Includer
) -> Parameters:
    """Return a model or world with its merged includes expanded; those not found stay.

    Raises:
        FormatError: A world includes what it cannot hold.
    """
    if not any(map(is_merge, node.find_all("include"))):
        return node
    children: list[Parameters] = []
    for child in node.children:
        draft = include(child, version, reading) if is_merge(child) else None
        if draft is None:
            children.append(child)
        elif draft.model is not None:
            reading.note("a URDF cannot be merged: it becomes a nested model", child)
            children.append(child)
        else:
            children += _parts(draft, child, node, reading)
    return replace(node, children=tuple(children))


def is_merge(node: Parameters) -> bool:
    """Return whether an element is an include with parts merged into its parent."""
    text = node.attributes.get("merge", "")
    return (
        node.tag == "include" and bool(text) and values.parse_flag(node, text, "attribute 'merge'")
    )


def _parts(
    draft: ModelFrames, include: Parameters, outer: Parameters, reading: Reading
) -> Iterator[Parameters]:
    frame = f"_merged__{draft.name}__model__"
    in_world = outer.tag == WORLD
    relative_to = draft.relative_to or (WORLD if in_world else MODEL)
    attached = draft.scope.canonical if not in_world else _first_of(draft)
    yield made(
        "frame",
        "",
        pose_element(draft.placed, include, relative_to),
        like=include,
        attributes={"name": frame, "attached_to": attached},
    )
    for child in (*draft.node.children, *draft.plugins):
        if child.tag in _OWN:
            continue
        if in_world and child.tag not in _IN_WORLDS:
            raise values.fail(include, f"a world cannot merge a model with a <{child.tag}>")
        yield _Mover(frame, draft, reading).part(child)


def _first_of(draft: ModelFrames) -> str:
    """Return the model that a frame of the world is attached to: that of the canonical link."""
    return draft.scope.canonical.rpartition("::")[0]


class _Mover:
    """Writes parts of an included model so that they hold in the model around it."""

    def __init__(self, frame: str, draft: ModelFrames, reading: Reading) -> None:
        self._frame = frame
        self._version = draft.version
        self._folder = None if draft.file is None else draft.file.parent
        self._resolver = reading.resolver

    def part(self, node: Parameters) -> Parameters:
        """Return a child of the included model."""
        node = self._inside(node)
        if node.tag in _POSED:
            pose = node.find("pose") or made("pose", like=node)
            if not frame_of(pose):
                node = with_child(node, with_attributes(pose, relative_to=self._frame))
        if node.tag == "frame" and node.attributes.get("attached_to", "") in {"", MODEL}:
            node = with_attributes(node, attached_to=self._frame)
        return self._joint(node, self._frame) if node.tag == "joint" else node

    def _inside(self, node: Parameters, *, nested: bool = False) -> Parameters:
        """Return an element with the names of frames and files in it changed, all below it too."""
        if node.tag == "plugin":
            return node
        if node.tag in _FILES:
            return self._file(node)
        deeper = nested or node.tag in {"model", "include"}
        children = tuple(self._inside(child, nested=deeper) for child in node.children)
        node = replace(node, children=children)
        if nested and node.tag == "joint":
            return self._joint(node, MODEL)
        if node.tag == "pose" and not nested and frame_of(node) == MODEL:
            return with_attributes(node, relative_to=self._frame)
        return node

    def _file(self, node: Parameters) -> Parameters:
        """Return a relative name as one from the folder of the included file."""
        if self._folder is None or re.match(r"\w+://|/", node.text):
            return node
        path = self._folder / node.text
        return replace(node, text=str(path)) if self._resolver.readable(path) else node

    def _joint(self, node: Parameters, model: str) -> Parameters:
        """Return a joint with its axes written as since SDF 1.7."""
        return replace(node, children=tuple(self._in_joint(c, model) for c in node.children))

    def _in_joint(self, node: Parameters, model: str) -> Parameters:
        if node.tag in {"parent", "child"} and node.text == MODEL:
            return replace(node, text=model)
        if node.tag not in {"axis", "axis2"}:
            return node
        direction = node.find("xyz") or made("xyz", "0 0 1", like=node)
        in_model = values.flag(node, "use_parent_model_frame", default=self._version <= (1, 4))
        named = direction.attributes.get("expressed_in", "")
        if named == MODEL or (in_model and self._version <= (1, 6)):
            direction = with_attributes(direction, expressed_in=model)
        kept = (child for child in node.children if child.tag != "use_parent_model_frame")
        return with_child(replace(node, children=tuple(kept)), direction)

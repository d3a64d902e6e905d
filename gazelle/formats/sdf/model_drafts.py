"""The first pass over a model file: all frames of a model and of the models in it."""

from __future__ import annotations

from gazelle.description import Parameters
from gazelle.errors import did_you_mean
from gazelle.formats import values
from gazelle.formats.reading import Reading
from gazelle.formats.sdf.build import with_attributes
from gazelle.formats.sdf.duplicates import MODEL_PARTS, FreeNames, with_own_names
from gazelle.formats.sdf.frames import ANY, MODEL, Scope
from gazelle.formats.sdf.merge import is_merge, with_merges
from gazelle.formats.sdf.model_frames import (
    Includer,
    ModelFrames,
    Version,
    add_model,
    draft_part,
)
from gazelle.formats.sdf.own_joint import with_own_joints
from gazelle.formats.sdf.pose import frame_of, read_pose


def draft_model(
    node: Parameters, version: Version, reading: Reading, include: Includer
) -> ModelFrames:
    """Return the draft of a ``<model>`` and all models in it.

    Raises:
        FormatError: A name is missing, or one that SDF keeps for itself.
    """
    node = with_own_joints(with_merges(node, version, reading, include))
    node = with_own_names(node, MODEL_PARTS, reading)
    pose = node.find("pose")
    draft = ModelFrames(
        node,
        version,
        values.attribute(node, "name"),
        read_pose(pose),
        frame_of(pose),
        node.attributes.get("placement_frame", ""),
        scope=Scope(MODEL, reading=reading),
    )
    names = FreeNames(set())
    for child in node.children:
        draft_part(child, draft.scope)
        if child.tag in {"model", "include"}:
            inner = (
                draft_model(child, version, reading, include)
                if child.tag == "model"
                else include(child, version, reading)
            )
            if inner is None:
                draft.scope.missing |= missing_names(child)
            else:
                _rename_second(inner, names, reading)
                draft.nested.append(inner)
                add_model(draft.scope, inner)
    draft.scope.canonical = _canonical(draft, reading)
    draft.scope.name = draft.name
    return draft


def _rename_second(inner: ModelFrames, names: FreeNames, reading: Reading) -> None:
    """Rename another model of one name: Gazebo loads both."""
    if inner.name in names.taken:
        free = names.after(inner.name)
        reading.fault(
            f"there is already a model named '{inner.name}': this one is called '{free}'",
            inner.node,
        )
        inner.name = free
    names.taken.add(inner.name)


def missing_names(node: Parameters) -> set[str]:
    """Return possible names of an include that was not found; empty stands for any name."""
    if is_merge(node):
        return {ANY}
    name = values.word(node, "name")
    return {name} if name else {"", values.word(node, "uri").rstrip("/").rpartition("/")[2]}


def _canonical(draft: ModelFrames, reading: Reading) -> str:
    named = draft.node.attributes.get("canonical_link", "")
    if named and (draft.scope.has(named) or draft.scope.lacks(named)):
        return named
    if named:
        reading.fault(
            f"the canonical link '{named}' is not there: the first link was taken",
            draft.node,
            did_you_mean(named, draft.scope.entries),
        )
        draft.node = with_attributes(draft.node, canonical_link="")
    first = draft.node.find("link")
    if first is not None:
        return first.attributes.get("name", "")
    for inner in draft.nested:
        if inner.scope.canonical:
            return f"{inner.name}::{inner.scope.canonical}"
    return ""

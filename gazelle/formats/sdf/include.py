"""``<include>``: a model, light or actor from another file."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from gazelle.description import Model, Parameters
from gazelle.errors import FormatError
from gazelle.formats import urdf, values, xml
from gazelle.formats.model_config import entry_file
from gazelle.formats.reading import Miss, Reading
from gazelle.formats.sdf import schema
from gazelle.formats.sdf.actor import as_model
from gazelle.formats.sdf.model_drafts import draft_model
from gazelle.formats.sdf.model_frames import ModelFrames, Version, name_frames
from gazelle.formats.sdf.param_passing import TAG, with_params
from gazelle.formats.sdf.pose import frame_of, read_pose
from gazelle.formats.sdf.upgrade import upgraded

KINDS = ("model", "light", "actor")


@dataclass(frozen=True, slots=True)
class Included:
    """Result of an include: the element, and the file and version it comes from."""

    node: Parameters
    file: Path
    version: Version
    model: Model | None = None


def open_include(node: Parameters, reading: Reading) -> Included | None:
    """Return the element that an include names; None when its file is not found.

    Raises:
        FormatError: It names a file that holds nothing to include.
    """
    uri = values.word(node, "uri")
    if not uri:
        reading.fault("an <include> needs a <uri>: it is left out", node)
        return None
    found = reading.find(uri, node.find("uri") or node)
    if found is None:
        return None
    file = _file_of(found)
    if file is None:
        reading.misses.append(Miss(uri, node.source, f"the folder {found} names no model file"))
        return None
    with reading.inside(file, node):
        root = xml.read_file(file, reading.misread)
        if root.tag == "robot":
            model = urdf.read_robot(root, reading)
            if TAG not in node:
                return Included(root, file, (1, 11), model)
            root = _written(model, file)
        if root.tag not in {"sdf", "gazebo"}:
            raise values.fail(root, f"expected <sdf> or <robot>, found <{root.tag}>")
        version = version_of(root, reading)
        root = _with_params(upgraded(root, version), node, reading)
        root = schema.checked(root, "root", reading)
        for child in root.children:
            if child.tag in KINDS:
                return Included(child if child.tag != "actor" else as_model(child), file, version)
    raise values.fail(root, "there is no model, light or actor to include")


def _with_params(root: Parameters, include: Parameters, reading: Reading) -> Parameters:
    """Return a file with the include's ``<experimental:params>`` applied to its model."""
    if TAG not in include:
        return root

    def name_of(inner: Parameters) -> str:
        found = None if "name" in inner else open_include(inner, reading)
        own = found.node.attributes.get("name", "") if found is not None else ""
        return values.word(inner, "name", own)

    for index, child in enumerate(root.children):
        if child.tag in KINDS:
            changed = with_params(child, include, reading, name_of)
            children = (*root.children[:index], changed, *root.children[index + 1 :])
            return replace(root, children=children)
    return root


def _written(model: Model, file: Path) -> Parameters:
    """Return a model that is read already, as the SDF file of it."""
    from gazelle.formats.write.sdf import write_sdf  # it imports what reads worlds
    from gazelle.formats.write.writing import Writing

    return write_sdf(model, Writing(file.parent))


def _file_of(found: Path) -> Path | None:
    try:
        file = entry_file(found)
    except FormatError:
        return None
    return file if file.is_file() else None


def include_model(node: Parameters, version: Version, reading: Reading) -> ModelFrames | None:
    """Return the draft of an included model; None when it is not found."""
    _ = version  # the included file has its own
    included = open_include(node, reading)
    if included is None:
        return None
    if included.node.tag not in {"model", "robot"}:
        raise values.fail(node, f"a model cannot include a <{included.node.tag}>")
    return draft_included(node, included, reading)


def draft_included(node: Parameters, included: Included, reading: Reading) -> ModelFrames:
    """Return the draft of a model, with the name, pose and so on that the include gives it."""
    with reading.inside(included.file, node):
        if included.model is None:
            draft = draft_model(included.node, included.version, reading, include_model)
        else:
            draft = draft_read(included.node, included.model)
    draft.file = included.file
    draft.name = values.word(node, "name", draft.name)
    # a model's own <pose> holds only in its file's own world: the include's replaces it
    pose = node.find("pose")
    if pose is not None:
        draft.pose, draft.relative_to = read_pose(pose), frame_of(pose)
    draft.placement_frame = values.word(node, "placement_frame", draft.placement_frame)
    if node.find("static") is not None:
        draft.static = values.flag(node, "static", default=False)
    draft.plugins = list(node.find_all("plugin"))
    return draft


def draft_read(node: Parameters, model: Model) -> ModelFrames:
    """Return the draft of a model that is already read: its frames under their names."""
    draft = ModelFrames(node, (1, 11), model.name, model.pose, model=model)
    name_frames(draft.scope, model)
    draft.scope.canonical = model.canonical_link or (model.links[0].name if model.links else "")
    return draft


def version_of(root: Parameters, reading: Reading) -> Version:
    """Return the version of an ``<sdf>`` element.

    Raises:
        FormatError: It is not of the form 1.6.
    """
    text = values.attribute(root, "version")
    parts = text.split(".")
    if len(parts) < 2 or not all(part.isdigit() for part in parts[:2]):
        raise values.fail(root, f"expected a version such as 1.6, found '{text}'")
    version = (int(parts[0]), int(parts[1]))
    if version > (1, 12):
        reading.note(f"SDF {text} is newer than 1.12 and was read as that", root)
    return version

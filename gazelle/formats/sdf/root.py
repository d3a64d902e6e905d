"""The root element of an SDF file: a world, or models and lights by themselves."""

from __future__ import annotations

from collections.abc import Iterator

from gazelle.description import Model, Parameters, World
from gazelle.formats.reading import Reading
from gazelle.formats.sdf import schema
from gazelle.formats.sdf.actor import as_model
from gazelle.formats.sdf.frames import WORLD, Scope
from gazelle.formats.sdf.include import include_model, version_of
from gazelle.formats.sdf.light import read_light
from gazelle.formats.sdf.model import read_model
from gazelle.formats.sdf.model_drafts import draft_model
from gazelle.formats.sdf.model_frames import Version
from gazelle.formats.sdf.pose import read_pose
from gazelle.formats.sdf.upgrade import upgraded
from gazelle.formats.sdf.world import read_world


def read_sdf(root: Parameters, reading: Reading) -> World:
    """Read the first world of a file; without one, a world of just the models.

    Raises:
        FormatError: The content of the file is invalid.
    """
    version = version_of(root, reading)
    root = upgraded(root, version)
    root = schema.checked(root, "root", reading)
    worlds = list(root.find_all("world"))
    if len(worlds) > 1:
        reading.note(f"the file has {len(worlds)} worlds: only the first is used", worlds[1])
    if worlds:
        return read_world(worlds[0], version, reading)
    return World(
        models=tuple(_models(root, version, reading)),
        lights=tuple(
            read_light(node, read_pose(node.find("pose"))) for node in root.find_all("light")
        ),
        bare=True,
        source=root.source,
    )


def _models(root: Parameters, version: Version, reading: Reading) -> Iterator[Model]:
    names = set()
    for node in root.children:
        if node.tag in {"actor", "model"}:
            model = _model(as_model(node) if node.tag == "actor" else node, version, reading)
            if model.name in names:
                reading.fault(
                    f"there is already a model named '{model.name}': this one is left out", node
                )
                continue
            names.add(model.name)
            yield model


def _model(node: Parameters, version: Version, reading: Reading) -> Model:
    draft = draft_model(node, version, reading, include_model)
    return read_model(draft, Scope(WORLD, reading=reading), reading)

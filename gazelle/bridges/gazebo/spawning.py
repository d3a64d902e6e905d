"""Read what ``spawn_sdf_model`` and ``spawn_urdf_model`` are given."""

from __future__ import annotations

import re
from dataclasses import replace

from gazelle import formats
from gazelle.description import Light, Model, World
from gazelle.errors import Error, FormatError

# What may stand before the first element.
_BEFORE = re.compile(r"<\?.*?\?>|<!--.*?-->|<!DOCTYPE[^>]*>", re.DOTALL)
_ELEMENT = re.compile(r"<([^\s/>]+)")
_ROOTS = frozenset({"sdf", "gazebo", "robot"})

NEITHER = (
    "GazeboRosApiPlugin SpawnModel Failure: input model_xml not SDF or URDF, or cannot be "
    "converted to Gazebo compatible format."
)
"""Gazebo's answer to a text that is neither SDF nor URDF."""
TAKEN = "SpawnModel: Failure - entity already exists."
"""Gazebo's answer to a name that is taken."""


def is_urdf(text: str) -> bool:
    """Return whether the first element is URDF's."""
    return _root(text) == "robot"


def is_model(text: str) -> bool:
    """Return whether the first element is SDF's or URDF's."""
    return _root(text) in _ROOTS


def _root(text: str) -> str:
    found = _ELEMENT.search(_BEFORE.sub("", text))
    return found[1] if found else ""


def read_entity(text: str, name: str) -> Model | Light | str:
    """Return the model or light of a request, or the status message of a failure."""
    if not is_model(text):
        return NEITHER
    try:
        return read(text, name)
    except Error as error:
        return failure(error)


def read(text: str, name: str) -> Model | Light:
    """Return the model of a request, or the light if it holds nothing else.

    Raises:
        Error: The text cannot be read.
    """
    world = formats.load_string(text, name=f"model_xml of '{name}'")
    if world.lights and not world.models:
        return replace(world.lights[0], name=name or world.lights[0].name)
    model = _only_model(world)
    return replace(model, name=name or model.name)


def _only_model(world: World) -> Model:
    if len(world.models) != 1:
        raise FormatError(f"expected one model, found {len(world.models)}")
    return world.models[0]


def failure(error: Error) -> str:
    """Return the status message for a text that cannot be read."""
    return f"SpawnModel: Failure - {error}"

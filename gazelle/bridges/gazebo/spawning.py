"""Read what ``spawn_sdf_model`` and ``spawn_urdf_model`` are given."""

from __future__ import annotations

from dataclasses import replace

from gazelle import formats
from gazelle.description import Light, Model, World
from gazelle.errors import Error
from gazelle.ros.errors import ServiceError


def read_model(text: str, name: str) -> Model:
    """The model of a request.

    Raises:
        ServiceError: The text cannot be read; the call fails, as Gazebo's does.
    """
    world = _read(text, name)
    if len(world.models) != 1:
        raise ServiceError(f"SpawnModel: expected one model, found {len(world.models)}")
    return replace(world.models[0], name=name or world.models[0].name)


def read_light(text: str, name: str) -> Light | None:
    """The light of a request that holds nothing else; None if there is a model.

    Raises:
        ServiceError: The text cannot be read.
    """
    if "<light" not in text:
        return None
    world = _read(text, name)
    if world.models or not world.lights:
        return None
    return replace(world.lights[0], name=name or world.lights[0].name)


def _read(text: str, name: str) -> World:
    try:
        return formats.load_string(text, name=f"model_xml of '{name}'")
    except Error as error:
        raise ServiceError(f"SpawnModel: {error}") from error

"""``<state>``: poses that Gazebo saved, in the world frame."""

from __future__ import annotations

from dataclasses import replace

from gazelle.description import Model, Parameters, Pose, World
from gazelle.formats.reading import Reading
from gazelle.formats.sdf.pose import read_pose


def apply(world: World, reading: Reading) -> World:
    """The world with the poses of its first state, which is the one that Gazebo restores."""
    if not world.states:
        return world
    state = world.states[0]
    for tag in ("insertions", "deletions"):
        part = state.find(tag)
        if part is not None and part.children:
            reading.note(f"<{tag}> of a <state> is not supported yet and was ignored", part)
    saved = {node.attributes.get("name", ""): node for node in state.find_all("model")}
    lights = {node.attributes.get("name", ""): node for node in state.find_all("light")}
    return replace(
        world,
        models=tuple(
            _restore(model, saved[model.name], Pose()) if model.name in saved else model
            for model in world.models
        ),
        lights=tuple(
            replace(light, pose=_pose(lights[light.name], light.pose))
            if light.name in lights
            else light
            for light in world.lights
        ),
    )


def _pose(node: Parameters, default: Pose) -> Pose:
    place = node.find("pose")
    return default if place is None or not place.text else read_pose(place)


def _restore(model: Model, node: Parameters, outer: Pose) -> Model:
    """The model with its saved pose and those of its links; ``outer`` is its parent's pose."""
    placed = _pose(node, outer * model.pose)
    links = {child.attributes.get("name", ""): child for child in node.find_all("link")}
    inner = {child.attributes.get("name", ""): child for child in node.find_all("model")}
    back = placed.inverse()
    return replace(
        model,
        pose=outer.inverse() * placed,
        links=tuple(
            replace(link, pose=back * _pose(links[link.name], placed * link.pose))
            if link.name in links
            else link
            for link in model.links
        ),
        models=tuple(
            _restore(nested, inner[nested.name], placed) if nested.name in inner else nested
            for nested in model.models
        ),
    )

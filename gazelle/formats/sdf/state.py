"""``<state>``: poses that Gazebo saved, in the world frame."""

from __future__ import annotations

from dataclasses import replace

from gazelle.description import Link, Model, Parameters, Pose, World
from gazelle.formats.sdf.pose import read_pose


def apply(world: World) -> World:
    """Return the world with the poses of its first state, the one that Gazebo restores."""
    if not world.states:
        return world
    state = world.states[0]
    saved = {node.attributes.get("name", ""): node for node in state.find_all("model")}
    lights = {node.attributes.get("name", ""): node for node in state.find_all("light")}
    return replace(
        world,
        models=tuple(
            _restore(model, saved[model.name], Pose()) if model.name in saved else model
            for model in world.models
        ),
        lights=tuple(
            light if saved is None else replace(light, pose=saved)
            for light in world.lights
            for saved in [_saved(lights.get(light.name))]
        ),
        unrestored=world,
    )


def unapplied(world: World) -> World | None:
    """Return the world as its file has it, the inverse of ``apply``; None if they differ."""
    if not world.states:
        return world
    before = world.unrestored
    if before is not None:
        known = replace(world, models=before.models, lights=before.lights)
        if apply(known) == world:
            return known
    return world if apply(world) == world else None


def _saved(node: Parameters | None) -> Pose | None:
    place = None if node is None else node.find("pose")
    return None if place is None or not place.text else read_pose(place)


def _restore(model: Model, node: Parameters, outer: Pose) -> Model:
    """Return the model with its saved pose and those of its links.

    ``outer`` is its parent's pose.
    """
    saved = _saved(node)
    placed = outer * model.pose if saved is None else saved
    links = {child.attributes.get("name", ""): child for child in node.find_all("link")}
    inner = {child.attributes.get("name", ""): child for child in node.find_all("model")}
    return replace(
        model,
        pose=model.pose if saved is None else outer.inverse() * placed,
        links=tuple(_restore_link(link, links.get(link.name), placed) for link in model.links),
        models=tuple(
            _restore(nested, inner[nested.name], placed) if nested.name in inner else nested
            for nested in model.models
        ),
    )


def _restore_link(link: Link, node: Parameters | None, model: Pose) -> Link:
    saved = _saved(node)
    return link if saved is None else replace(link, pose=model.inverse() * saved)

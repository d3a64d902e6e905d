"""Handles of all links and joints of a model, and its frames and joints by their names."""

from __future__ import annotations

from collections.abc import Mapping

from gazelle.description import Joint, Model, Pose
from gazelle.errors import SimulationError, did_you_mean
from gazelle.simulation.joints import JointHandle
from gazelle.simulation.links import LinkHandle
from gazelle.simulation.mappings import Named
from gazelle.simulation.running_state import RunningState


def link_handles(simulation: RunningState, model: Model) -> dict[str, LinkHandle]:
    """Return the links of a model, by name within it."""
    return {
        name_within(placed.scope, model.name, link.name): LinkHandle(
            simulation, f"{placed.scope}::{link.name}", link
        )
        for placed in model.walk()
        for link in placed.model.links
    }


def joint_handles(simulation: RunningState, model: Model) -> dict[str, JointHandle]:
    """Return the movable joints of a model, by name within it."""
    moving = simulation.engine.joints
    return {
        name_within(placed.scope, model.name, joint.name): JointHandle(
            simulation, f"{placed.scope}::{joint.name}"
        )
        for placed in model.walk()
        for joint in placed.model.joints
        if f"{placed.scope}::{joint.name}" in moving
    }


def joint_description(model: Model, name: str) -> Joint:
    """Return a joint's description in the file, of fixed ones too.

    Raises:
        SimulationError: There is no joint of that name.
    """
    found = {
        name_within(placed.scope, model.name, joint.name): joint
        for placed in model.walk()
        for joint in placed.model.joints
    }
    return Named("joint", found, model.name)[name]


def frame_of(model: Model, links: Mapping[str, LinkHandle], name: str) -> tuple[LinkHandle, Pose]:
    """Return the link that a frame of a model moves with, and the frame's pose in it.

    Raises:
        SimulationError: There is no frame of that name.
    """
    name = name.removeprefix(f"{model.name}::")
    for placed in model.walk():
        for frame in placed.model.frames:
            if frame.name == name and frame.attached_to in links:
                return links[frame.attached_to], frame.pose
    known = [*links, *(frame.name for frame in model.frames)]
    raise SimulationError(
        f"'{model.name}' has no link or frame '{name}'", hint=did_you_mean(name, known)
    )


def name_within(scope: str, top: str, name: str) -> str:
    """Return a name within a model as its robot has it.

    Args:
        scope: Scoped name of the model that has it, which may be nested.
        top: Name of the robot.
        name: In that model.
    """
    prefix = scope.removeprefix(top).removeprefix("::")
    return f"{prefix}::{name}" if prefix else name

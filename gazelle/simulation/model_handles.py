"""Handles of all links and joints of a model."""

from __future__ import annotations

from gazelle.description import Model
from gazelle.simulation.joints import JointHandle
from gazelle.simulation.links import LinkHandle
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
    moving = set(simulation.engine.joints.names)
    return {
        name_within(placed.scope, model.name, joint.name): JointHandle(
            simulation, f"{placed.scope}::{joint.name}"
        )
        for placed in model.walk()
        for joint in placed.model.joints
        if f"{placed.scope}::{joint.name}" in moving
    }


def name_within(scope: str, top: str, name: str) -> str:
    """Return a name within a model as its robot has it.

    Args:
        scope: Scoped name of the model that has it, which may be nested.
        top: Name of the robot.
        name: In that model.
    """
    prefix = scope.removeprefix(top).removeprefix("::")
    return f"{prefix}::{name}" if prefix else name

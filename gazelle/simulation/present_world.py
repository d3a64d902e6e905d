"""Description of a world as it is in the middle of a run."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from gazelle.array_types import Worlds
from gazelle.description import (
    Collision,
    Inertia,
    Inertial,
    Joint,
    Link,
    Model,
    Pose,
    World,
)
from gazelle.errors import EngineError
from gazelle.simulation.inputs import one_world
from gazelle.simulation.simulation import Simulation

_CLOSE = 1e-9
_OF_AXIS = {
    "damping": "joint_damping",
    "friction": "joint_friction",
    "lower": "joint_lower",
    "upper": "joint_upper",
}


def present_world(simulation: Simulation, world: int = 0) -> World:
    """Return the description of a running world with its present poses and parameters.

    Models stand where they are now, with masses, friction, damping, limits and gravity as set by
    ``sim.parameters``. Joints have their positions of rest, since files have no word for others.

    Args:
        simulation: Any engine.
        world: World of a batch.

    Raises:
        SimulationError: There is no such world.
    """
    reader = _PresentParts(simulation, np.array([one_world(world, simulation.nworld)]))
    with simulation.lock:
        x, y, z = reader.read("gravity", "", simulation.world.gravity)
        return replace(
            simulation.world,
            gravity=(x, y, z),
            models=tuple(reader.placed(each) for each in simulation.world.models),
        )


class _PresentParts:
    """Reads what may have changed of one world."""

    def __init__(self, simulation: Simulation, row: Worlds) -> None:
        self._simulation, self._row = simulation, row

    def placed(self, model: Model) -> Model:
        """Return a model of the world where it is now."""
        robot = self._simulation.robots.get(model.name)
        if robot is None:
            return model
        pose = robot.placement(self._row).first()
        if pose.is_close(model.pose):
            pose = model.pose
        return replace(model if model.static else self._model(model, model.name), pose=pose)

    def read(self, kind: str, name: str, described: tuple[float, ...]) -> tuple[float, ...]:
        """Return a parameter; what the description says where it says the same."""
        try:
            found = self._simulation.engine.parameter(kind, name, self._row)[0]
        except EngineError:  # static, or of an engine without it
            return described
        if np.allclose(found, described, rtol=_CLOSE, atol=_CLOSE):
            return described
        return tuple(found.tolist())

    def _model(self, model: Model, scope: str) -> Model:
        return replace(
            model,
            links=tuple(self._link(each, f"{scope}::{each.name}") for each in model.links),
            joints=tuple(self._joint(each, f"{scope}::{each.name}") for each in model.joints),
            models=tuple(self._model(each, f"{scope}::{each.name}") for each in model.models),
        )

    def _link(self, link: Link, name: str) -> Link:
        collisions = tuple(
            self._collision(each, f"{name}::{each.name}") for each in link.collisions
        )
        inertial = link.inertial
        if inertial is not None:
            inertial = self._inertial(inertial, name)
        return replace(link, collisions=collisions, inertial=inertial)

    def _inertial(self, inertial: Inertial, name: str) -> Inertial:
        pose = inertial.pose
        axes = pose.matrix()[:3, :3]
        tensor = axes @ inertial.inertia.matrix() @ axes.T
        row = tensor[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
        described = (inertial.mass, *pose.position, *row.tolist())
        mass = self.read("link_mass", name, described[:1])
        centre = self.read("link_centre", name, described[1:4])
        moments = self.read("link_inertia", name, described[4:])
        if (*mass, *centre, *moments) == described:
            return inertial
        return Inertial(mass[0], Pose(*centre), Inertia(*moments))

    def _collision(self, collision: Collision, name: str) -> Collision:
        friction = collision.surface.friction
        found = self.read("collision_friction", name, (friction.mu,))[0]
        if found == friction.mu:
            return collision
        changed = replace(friction, mu=found, mu2=found)
        return replace(collision, surface=replace(collision.surface, friction=changed))

    def _joint(self, joint: Joint, name: str) -> Joint:
        if len(joint.axes) != 1:
            return joint
        axis = joint.axes[0]
        changes: dict[str, Any] = {
            field: self.read(kind, name, (getattr(axis, field),))[0]
            for field, kind in _OF_AXIS.items()
        }
        return replace(joint, axes=(replace(axis, **changes),))

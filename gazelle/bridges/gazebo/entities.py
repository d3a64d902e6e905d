"""Find models, links, joints and frames by the names that Gazebo's interfaces use."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Floats
from gazelle.rotations import conjugate, multiply, rotate
from gazelle.simulation import JointHandle, LinkHandle, Robot, Simulation

# Names of the inertial frame.
_WORLD = frozenset({"", "world", "map", "/map"})


@dataclass(frozen=True, slots=True)
class State:
    """Pose and velocity in one world, seen from the world frame.

    Attributes:
        position: [m], shape (3,).
        quaternion: (x, y, z, w), shape (4,).
        linear: Velocity of its origin [m/s], shape (3,).
        angular: [rad/s], shape (3,).
    """

    position: Floats
    quaternion: Floats
    linear: Floats
    angular: Floats

    def seen_from(self, frame: State) -> State:
        """Return the state in a frame's axes, velocities as differences to the frame's own."""
        back = conjugate(frame.quaternion)
        return State(
            rotate(back, self.position - frame.position),
            multiply(back, self.quaternion),
            rotate(back, self.linear - frame.linear),
            rotate(back, self.angular - frame.angular),
        )

    def placed_in(self, frame: State) -> State:
        """Transform a state from a frame's axes to the world; velocities are only rotated."""
        return State(
            frame.position + rotate(frame.quaternion, self.position),
            multiply(frame.quaternion, self.quaternion),
            rotate(frame.quaternion, self.linear),
            rotate(frame.quaternion, self.angular),
        )


REST = State(np.zeros(3), np.array([0.0, 0.0, 0.0, 1.0]), np.zeros(3), np.zeros(3))
"""The world frame."""


def is_world(frame: str) -> bool:
    """Return whether a name stands for the inertial frame."""
    return frame in _WORLD


class Entities:
    """Models, links and joints in one world of a simulation.

    Args:
        simulation: Runs.
        world: World of the batch.
    """

    def __init__(self, simulation: Simulation, world: int) -> None:
        self.simulation = simulation
        # None, for all, is quicker than a list of the only one there is.
        self.worlds = None if simulation.nworld == 1 else np.array([world])

    def model(self, name: str) -> Robot | None:
        """Return a model."""
        found: Robot | None = self.simulation.robots.get(name)
        return found

    def links(self) -> list[LinkHandle]:
        """Return all links, in the order of their models."""
        return [link for robot in self.simulation.robots.values() for link in robot.links.values()]

    def link(self, name: str) -> LinkHandle | None:
        """Return a link by its scoped name ``model::link``, or the first of a plain name."""
        model, _, inner = name.partition("::")
        robots = self.simulation.robots
        if inner:
            robot = robots.get(model)
            found: LinkHandle | None = None if robot is None else robot.links.get(inner)
            return found
        for robot in robots.values():
            if name in robot.links:
                return robot.links[name]
        return None

    def joint(self, name: str) -> tuple[Robot, JointHandle] | None:
        """Return a movable joint, by plain or scoped name, in the first model that has it."""
        model, _, inner = name.partition("::")
        for robot in self.simulation.robots.values():
            if name in robot.joints:
                return robot, robot.joints[name]
            if inner and robot.name == model and inner in robot.joints:
                return robot, robot.joints[inner]
        return None

    def has_fixed_joint(self, name: str) -> bool:
        """Return whether a model has a joint that does not move, by plain or scoped name."""
        return any(
            name in (joint.name, f"{placed.scope}::{joint.name}")
            for robot in self.simulation.robots.values()
            for placed in robot.description.walk()
            for joint in placed.model.joints
        )

    def frame(self, name: str) -> State | None:
        """Return the state of a model or link.

        The world frame for ``""``, ``world`` or ``map``.
        """
        if is_world(name):
            return REST
        robot = self.model(name)
        if robot is not None:
            return self.state(robot)
        link = self.link(name)
        return None if link is None else self.state(link)

    def state(self, entity: Robot | LinkHandle) -> State:
        """Return pose and velocity of a link, or of a model's frame and its canonical link."""
        place, motion = entity.placement(self.worlds), entity.motion(self.worlds)
        return State(place.position[0], place.quaternion[0], motion.linear[0], motion.angular[0])

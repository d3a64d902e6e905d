"""Fetch's gripper in all worlds of a simulation, and how it follows commands."""

from __future__ import annotations

import dataclasses
from abc import ABC, abstractmethod
from collections.abc import Sequence

import numpy as np

from gazelle import assets, formats, rotations
from gazelle.array_types import Floats, Worlds
from gazelle.description import (
    Inertial,
    Joint,
    JointAxis,
    Link,
    Mimic,
    Model,
    Pose,
)
from gazelle.simulation import Robot, Simulation

FINGERS = ("r_gripper_finger_joint", "l_gripper_finger_joint")
TIP = "gripper_link"
GRIP = np.array([0.02, 0.0, 0.0])
"""The point between the fingers, in the gripper's frame [m]."""

DOWN = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
"""Orientation of the gripper's frame: its x axis down."""

_OPEN = 0.05  # that a finger opens at most [m]
_GRASP = 120.0  # of the motor that closes both fingers: as much as two of 60 N [N]
_WRIST = "wrist_roll_link"
_SLIDES = {"slide_x": (1.0, 0.0, 0.0), "slide_y": (0.0, 1.0, 0.0), "slide_z": (0.0, 0.0, 1.0)}
_PULL = 45.0  # of a slide's motor, for each kilogram of its load [N/kg]
_FINGER = 4.0  # that a finger of the flying gripper weighs, as there [kg]
_CARRIER = 1.0  # [kg]


def fetch_model() -> Model:
    """Fetch as its file describes it."""
    return formats.load(assets.root() / "fetch_description" / "robots" / "fetch.urdf").models[0]


def driven(joint: Joint) -> Joint:
    """Return a joint for a motor that holds velocities; the left finger follows the right.

    Such a motor wants no viscosity: with it the solver looks for forces that nothing determines where something stiff presses on a
    table, and throws it about.
    """
    follows = Mimic(FINGERS[0]) if joint.name == FINGERS[1] else None
    axes = tuple(dataclasses.replace(axis, damping=0.0, mimic=follows) for axis in joint.axes)
    return dataclasses.replace(joint, axes=axes)


class FetchGripper(ABC):
    """Fetch's gripper, pointing down, in all worlds.

    Args:
        robot: Robot of the part.
        slides: Names of its slide joints, which have motors.
        fingers_move: Whether there are motors on the fingers; else they stay closed.
    """

    def __init__(self, robot: Robot, slides: Sequence[str], *, fingers_move: bool) -> None:
        self._robot = robot
        self._joints = [robot.joints[name] for name in slides]
        self._fingers = [robot.joints[name] for name in FINGERS if fingers_move]
        if self._fingers:
            self._fingers[0].add_motor(_GRASP)
        self._link, offset = robot.frame(TIP)
        self._point = offset.matrix()[:3] @ np.array([*GRIP, 1.0])

    @abstractmethod
    def begin(self, worlds: Worlds) -> None:
        """Place the gripper at its start, at rest, in worlds that were reset."""

    @abstractmethod
    def move(self, way: Floats, period: float) -> None:
        """Move the gripper by a displacement in a period, pointing down, in all worlds.

        Args:
            way: [m], shape (nworld, 3).
            period: [s].
        """

    def move_fingers(self, speed: Floats, period: float) -> None:
        """Open the fingers, if they move, as far as they go.

        Args:
            speed: Below 0 to close them [m/s], shape (nworld,).
            period: After which they may get another command [s].
        """
        if self._fingers:
            now = self._fingers[0].positions()[:, 0]
            self._fingers[0].drive(np.clip(speed, -now / period, (_OPEN - now) / period))

    def position(self, worlds: Worlds | None) -> Floats:
        """Return the world position of the point between the fingers [m], shape (n, 3)."""
        place = self._link.placement(worlds)
        position: Floats = place.position + rotations.rotate(place.quaternion, self._point)
        return position

    def velocity(self, worlds: Worlds | None) -> Floats:
        """Return the velocity of that point [m/s], shape (n, 3)."""
        motion = self._link.motion(worlds)
        arm = rotations.rotate(self._link.placement(worlds).quaternion, self._point)
        return motion.linear + rotations.cross(motion.angular, arm)

    def opening(self, worlds: Worlds | None) -> tuple[Floats, Floats]:
        """Return the opening of the right and the left finger [m] and its rate, shapes (n, 2)."""
        if not self._fingers:
            count = self._robot.simulation.nworld if worlds is None else len(worlds)
            return np.zeros((count, 2)), np.zeros((count, 2))
        positions = [finger.positions(worlds) for finger in self._fingers]
        velocities = [finger.velocities(worlds) for finger in self._fingers]
        return np.hstack(positions), np.hstack(velocities)

    def _stop(self, worlds: Worlds) -> None:
        """Set all motors to rest."""
        for joint in (*self._joints, *self._fingers[:1]):
            joint.drive(0.0, worlds)


class FlyingGripper(FetchGripper):
    """The gripper alone, on three slides that go wherever they are commanded.

    Args:
        simulation: Simulation for it.
        start: Start of the point between its fingers [m], in the world frame.
        fingers_move: See `FetchGripper`.
    """

    def __init__(
        self, simulation: Simulation, start: tuple[float, float, float], *, fingers_move: bool
    ) -> None:
        model = flying_model(fetch_model(), start, fingers_move=fingers_move)
        robot = simulation.spawn(model, name="fetch")
        super().__init__(robot, tuple(_SLIDES), fingers_move=fingers_move)
        mass = sum(link.inertial.mass for link in model.links if link.inertial is not None)
        for joint in self._joints:
            joint.add_motor(_PULL * mass)

    def begin(self, worlds: Worlds) -> None:
        """Do nothing: the slides' zero is the start."""
        self._stop(worlds)

    def move(self, way: Floats, period: float) -> None:
        """Set the velocity of each slide to its part of the displacement."""
        for joint, speed in zip(self._joints, way.T / period, strict=True):
            joint.drive(speed)


def flying_model(robot: Model, start: tuple[float, float, float], *, fingers_move: bool) -> Model:
    """Return the gripper of a robot alone, pointing down on three slides.

    Args:
        robot: Fetch.
        start: Position of the point between its fingers with all slides at zero [m].
        fingers_move: Whether the fingers can move; else they stay closed.
    """
    kept = {_WRIST, *(joint.child for joint in robot.joints if joint.name in FINGERS)}
    tip = next(frame for frame in robot.frames if frame.name == TIP)
    wrist = next(link for link in robot.links if link.name == _WRIST)
    target = Pose.from_matrix(_homogeneous(DOWN, np.array(start) - DOWN @ GRIP))
    moved = target * (wrist.pose * tip.pose).inverse()
    links = [
        dataclasses.replace(
            each,
            pose=moved * each.pose,
            gravity=False,
            inertial=heavy_finger(each).inertial
            if fingers_move and each.name != _WRIST
            else each.inertial,
        )
        for each in robot.links
        if each.name in kept
    ]
    place = Pose(*start)
    carriers = [
        Link(name=f"{slide}_carrier", pose=place, gravity=False, inertial=Inertial(mass=_CARRIER))
        for slide in _SLIDES
    ]
    parents = ["world", *(link.name for link in carriers)]
    slides = [
        Joint(
            name=name, type="prismatic", parent=parent, child=link.name, axes=(JointAxis(xyz=axis),)
        )
        for (name, axis), parent, link in zip(_SLIDES.items(), parents, carriers, strict=False)
    ]
    fingers = [
        driven(joint) if fingers_move else dataclasses.replace(joint, type="fixed", axes=())
        for joint in robot.joints
        if joint.name in FINGERS
    ]
    held = Joint(name="wrist_held", type="fixed", parent=parents[-1], child=_WRIST)
    return dataclasses.replace(
        robot,
        links=(*carriers, *links),
        joints=(*slides, held, *fingers),
        frames=tuple(frame for frame in robot.frames if frame.attached_to in kept),
        plugins=(),
    )


def heavy_finger(link: Link) -> Link:
    """Return a finger that weighs as much as there; how it would turn matters to nothing."""
    inertial = dataclasses.replace(link.inertial or Inertial(), mass=_FINGER)
    return dataclasses.replace(link, inertial=inertial)


def _homogeneous(turned: Floats, position: Floats) -> Floats:
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = turned, position
    return matrix

"""Links of a model in a running simulation."""

from __future__ import annotations

import math
import warnings

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Floats, Worlds
from gazelle.description import Inertia, Link, Pose
from gazelle.engines import Motion, Placement
from gazelle.errors import SimulationError, SimulationWarning
from gazelle.rotations import from_yaw
from gazelle.simulation.inputs import (
    FIRST_WORLD,
    chosen,
    finite,
    motion,
    numbers,
    placement,
    size_of,
)
from gazelle.simulation.parameter_changes import set_parameters
from gazelle.simulation.running_state import RunningState
from gazelle.simulation.state_lock import between_steps

_CLOSE = 1e-3
"""Tolerance within which a pose counts as the requested one [m or rad]."""


class LinkHandle:
    """A link of a robot."""

    def __init__(self, simulation: RunningState, name: str, link: Link) -> None:
        self.name = name
        self.description = link
        self._simulation = simulation
        self._lock = simulation.lock
        self._engine = simulation.engine
        self._row = simulation.engine.links[name]

    @property
    @between_steps
    def pose(self) -> Pose:
        """Pose in world 0."""
        return self._row.placement(FIRST_WORLD).first()

    @between_steps
    def placement(self, worlds: Worlds | None = None) -> Placement:
        """Return the pose in many worlds."""
        return self._row.placement(chosen(worlds, self._engine.nworld))

    @between_steps
    def motion(self, worlds: Worlds | None = None) -> Motion:
        """Return the velocity in many worlds, in the world frame."""
        return self._row.motion(chosen(worlds, self._engine.nworld))

    @between_steps
    def set_pose(
        self,
        position: ArrayLike,
        quaternion: ArrayLike | None = None,
        *,
        yaw: ArrayLike | None = None,
        worlds: Worlds | None = None,
    ) -> None:
        """Set the pose of the link and of everything attached to it; joints stay as they are.

        A link that hangs on a joint takes the part of the pose that its joint allows, and a
        warning says if that is not all.

        Args:
            position: [m], shape (3,) or (n, 3).
            quaternion: (x, y, z, w), shape (4,) or (n, 4); upright if None.
            yaw: Heading [rad] instead of a quaternion, shape () or (n,).
            worlds: Worlds; all if None.

        Raises:
            EngineError: The link is fixed to the world.
            SimulationError: A value is invalid, or both a quaternion and a heading are given.
        """
        self.approach(position, orientation_of(quaternion, yaw), worlds)

    @between_steps
    def approach(
        self, position: ArrayLike, quaternion: ArrayLike, worlds: Worlds | None = None
    ) -> str:
        """Set the pose like ``set_pose``; returns a text if the link's joint prevents it."""
        some = chosen(worlds, self._engine.nworld)
        goal = placement(self.name, position, quaternion, size_of(some, self._engine.nworld))
        joint = self._row.set_placement(*goal, some)
        apart = _apart(self._row.placement(some), *goal) if joint else ""
        if apart:
            text = f"link '{self.name}' takes only the part of a pose that joint '{joint}' allows"
            warnings.warn(SimulationWarning(text), stacklevel=3)
            return f"joint '{joint}' holds it {apart} from there"
        return ""

    @between_steps
    def set_twist(
        self, linear: ArrayLike, angular: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Set the velocity in the world frame [m/s, rad/s], shape (3,) or (n, 3).

        The joints of what hangs on it keep their speeds. A link that hangs on a joint takes the
        part that its joint allows.

        Raises:
            SimulationError: A value is invalid.
        """
        some = chosen(worlds, self._engine.nworld)
        twist = motion(self.name, linear, angular, size_of(some, self._engine.nworld))
        self._row.set_motion(*twist, some)

    @between_steps
    def apply_wrench(
        self,
        force: ArrayLike = (0.0, 0.0, 0.0),
        torque: ArrayLike = (0.0, 0.0, 0.0),
        *,
        point: ArrayLike | None = None,
        frame: LinkHandle | None = None,
        follow: bool = False,
        start: float | None = None,
        duration: float | None = None,
        worlds: Worlds | None = None,
    ) -> None:
        """Apply a wrench to the link for a time. Several wrenches at once add up.

        Args:
            force: [N], shape (3,) or (n, 3).
            torque: [N m], shape (3,) or (n, 3).
            point: Point of the force [m], in ``frame``, shape (3,) or (n, 3); the link's
                centre of mass if None.
            frame: Frame of force, torque and point; the world if None.
            follow: Whether the wrench turns with ``frame``; if not, it keeps the direction and
                the lever that it has when it begins, as Gazebo's do.
            start: Start in simulated time [s]; now if None or past.
            duration: Duration [s]; until cleared if None.
            worlds: Worlds; all if None.

        Raises:
            EngineError: Nothing can push the link: it does not move.
            SimulationError: A value is not finite, or the duration is negative.
        """
        simulation = self._simulation
        some = chosen(worlds, simulation.nworld)
        count = size_of(some, simulation.nworld)
        push = numbers("a force", force, 3, count), numbers("a torque", torque, 3, count)
        where = None if point is None else finite("the point of a force", point, 3, count)
        simulation.applied_wrenches.push(
            self.name,
            *push,
            point=where,
            frame="" if frame is None else frame.name,
            follow=follow,
            start=start,
            duration=duration,
            worlds=some,
        )

    @between_steps
    def clear_wrenches(self) -> None:
        """Remove all wrenches from the link, in all worlds."""
        self._simulation.applied_wrenches.clear_link(self.name)

    @between_steps
    def set_properties(
        self,
        *,
        mass: ArrayLike | None = None,
        centre: ArrayLike | None = None,
        inertia: Inertia | ArrayLike | None = None,
        gravity: ArrayLike | None = None,
        worlds: Worlds | None = None,
    ) -> None:
        """Set mass properties of the link; those that are None stay.

        Args:
            mass: [kg], shape () or (n,).
            centre: Centre of mass in the link frame [m], shape (3,) or (n, 3).
            inertia: About the centre of mass in the link's axes [kg m²]; xx, yy, zz, xy, xz,
                yz, shape (6,) or (n, 6).
            gravity: Whether gravity acts on it, shape () or (n,).
            worlds: Worlds; all if None.

        Raises:
            EngineError: The link does not move, or a value is invalid.
        """
        if isinstance(inertia, Inertia):
            i = inertia
            inertia = (i.ixx, i.iyy, i.izz, i.ixy, i.ixz, i.iyz)
        given = {
            "link_mass": mass,
            "link_centre": centre,
            "link_inertia": inertia,
            "link_gravity": gravity,
        }
        set_parameters(self._simulation, self.name, given, worlds)


def _apart(here: Placement, position: Floats, quaternion: Floats) -> str:
    """Return how far a link is from where it was to be, in words; empty if it is there."""
    distance = float(np.linalg.norm(here.position - position, axis=-1).max())
    goal = quaternion / np.linalg.norm(quaternion, axis=-1, keepdims=True)
    cosine = float(np.abs(np.sum(here.quaternion * goal, axis=-1)).min())
    turned = 2.0 * math.acos(min(1.0, cosine))
    parts = [f"{distance:.3g} m"] if distance > _CLOSE else []
    return " and ".join([*parts, f"{turned:.3g} rad"] if turned > _CLOSE else parts)


def orientation_of(quaternion: ArrayLike | None, yaw: ArrayLike | None) -> ArrayLike:
    """Return a quaternion (x, y, z, w), given as such or as a heading [rad]; identity by default.

    Raises:
        SimulationError: Both are given.
    """
    if quaternion is None:
        return from_yaw(_headings(0.0 if yaw is None else yaw))
    if yaw is not None:
        raise SimulationError("give a quaternion or a yaw, not both")
    return quaternion


def _headings(yaw: ArrayLike) -> Floats:
    try:
        return np.asarray(yaw, np.float64)
    except (TypeError, ValueError, OverflowError):
        raise SimulationError(f"a heading must be numbers [rad], not {yaw!r}") from None

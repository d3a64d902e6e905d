"""Links and joints of a model in a running simulation."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.description import Inertia, Link, Pose
from gazelle.engines import Motion, Placement, Wrench
from gazelle.errors import SimulationError
from gazelle.rotations import from_yaw

if TYPE_CHECKING:
    from gazelle.simulation.simulation import Simulation

Floats = NDArray[np.float64]
Worlds = NDArray[np.intp]


class LinkHandle:
    """A link of a robot."""

    def __init__(self, simulation: Simulation, name: str, link: Link) -> None:
        self.name = name
        self.description = link
        self._simulation = simulation
        self._engine = simulation.engine

    @property
    def pose(self) -> Pose:
        """Its pose in world 0."""
        place = self._engine.link_placement(self.name, np.array([0]))
        return Pose.from_quaternion(tuple(place.position[0]), tuple(place.quaternion[0]))

    def placement(self, worlds: Worlds | None = None) -> Placement:
        """Its pose in many worlds."""
        return self._engine.link_placement(self.name, worlds)

    def motion(self, worlds: Worlds | None = None) -> Motion:
        """Its velocity in many worlds, in the world frame."""
        return self._engine.link_motion(self.name, worlds)

    def set_pose(
        self,
        position: ArrayLike,
        quaternion: ArrayLike | None = None,
        *,
        yaw: ArrayLike | None = None,
        worlds: Worlds | None = None,
    ) -> None:
        """Put the link somewhere, with all that hangs together with it, joints as they are.

        Args:
            position: [m], shape (3,) or (n, 3).
            quaternion: (x, y, z, w), shape (4,) or (n, 4); upright if None.
            yaw: Heading [rad] instead of a quaternion, shape () or (n,).
            worlds: Which worlds; all if None.

        Raises:
            EngineError: The link is held to the world by a joint.
            SimulationError: Both a quaternion and a heading are given.
        """
        turned = orientation_of(quaternion, yaw)
        self._simulation.requests.call(
            lambda: self._engine.set_link_placement(self.name, position, turned, worlds)
        )

    def set_twist(
        self, linear: ArrayLike, angular: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Give the link a velocity in the world frame [m/s, rad/s], shape (3,) or (n, 3).

        The joints of what hangs together with it keep their speeds.
        """
        self._simulation.requests.call(
            lambda: self._engine.set_link_motion(self.name, linear, angular, worlds)
        )

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
        """Push the link for a time. Several wrenches at once add up.

        Args:
            force: [N], shape (3,) or (n, 3).
            torque: [N m], shape (3,) or (n, 3).
            point: Where the force acts [m], in ``frame``, shape (3,) or (n, 3); the link's
                centre of mass if None.
            frame: The link in whose frame force, torque and point are given; the world if None.
            follow: Whether the wrench turns with ``frame``; if not, it keeps the direction and
                the lever that it has when it begins, as Gazebo's do.
            start: When it begins, in simulated time [s]; now if None or past.
            duration: How long it acts [s]; until it is cleared if None.
            worlds: Which worlds; all if None.

        Raises:
            EngineError: Nothing can push the link: it does not move.
            SimulationError: A value is not finite, or the duration is negative.
        """
        simulation = self._simulation
        simulation.requests.call(
            lambda: simulation.loads.push(
                self.name,
                force,
                torque,
                point=point,
                frame="" if frame is None else frame.name,
                follow=follow,
                start=start,
                duration=duration,
                worlds=worlds,
            )
        )

    def clear_wrenches(self) -> None:
        """End all wrenches on the link, in all worlds."""
        simulation = self._simulation
        simulation.requests.call(lambda: simulation.loads.clear_link(self.name))

    def set_properties(
        self,
        *,
        mass: ArrayLike | None = None,
        centre: ArrayLike | None = None,
        inertia: Inertia | ArrayLike | None = None,
        gravity: ArrayLike | None = None,
        worlds: Worlds | None = None,
    ) -> None:
        """Change what the link weighs; what is None stays.

        Args:
            mass: [kg], shape () or (n,).
            centre: Centre of mass in the link frame [m], shape (3,) or (n, 3).
            inertia: About the centre of mass in the link's axes [kg m²]; xx, yy, zz, xy, xz,
                yz, shape (6,) or (n, 6).
            gravity: Whether gravity acts on it, shape () or (n,).
            worlds: Which worlds; all if None.

        Raises:
            EngineError: The link does not move, or a value cannot be.
        """
        if isinstance(inertia, Inertia):
            i = inertia
            inertia = (i.ixx, i.iyy, i.izz, i.ixy, i.ixz, i.iyz)
        given = {
            "link_mass": _column(mass),
            "link_centre": centre,
            "link_inertia": inertia,
            "link_gravity": _column(gravity),
        }
        _set_parameters(self._simulation, self.name, given, worlds)


class JointHandle:
    """A joint of a robot; values are of world 0 when read, of all worlds when set."""

    def __init__(self, simulation: Simulation, name: str) -> None:
        self.name = name
        self._simulation = simulation
        self._engine = simulation.engine

    @property
    def position(self) -> float:
        """Position of the first axis [m or rad]; setting it teleports the joint."""
        return float(self._engine.joint_position(self.name, np.array([0]))[0, 0])

    @position.setter
    def position(self, value: ArrayLike) -> None:
        self._engine.set_joint_position(self.name, _rows(value))

    @property
    def velocity(self) -> float:
        """Velocity of the first axis [m/s or rad/s]; setting it changes the state at once."""
        return float(self._engine.joint_velocity(self.name, np.array([0]))[0, 0])

    @velocity.setter
    def velocity(self, value: ArrayLike) -> None:
        self._engine.set_joint_velocity(self.name, _rows(value))

    @property
    def effort(self) -> None:
        """Write only: effort applied until told otherwise [N or N m]."""
        raise SimulationError(f"the effort on joint '{self.name}' is measured by a force sensor")

    @effort.setter
    def effort(self, value: ArrayLike) -> None:
        self._simulation.loads.set_lasting(self.name, _rows(value))

    def apply_effort(
        self,
        effort: ArrayLike,
        *,
        start: float | None = None,
        duration: float | None = None,
        worlds: Worlds | None = None,
    ) -> None:
        """Let an effort act for a time, besides what acts already.

        Args:
            effort: [N or N m], shape (), (n,) or (n, axes).
            start: When it begins, in simulated time [s]; now if None or past.
            duration: How long it acts [s]; until it is cleared if None.
            worlds: Which worlds; all if None.

        Raises:
            SimulationError: A value is not finite, or the duration is negative.
        """
        simulation = self._simulation
        simulation.requests.call(
            lambda: simulation.loads.turn(self.name, _rows(effort), start, duration, worlds)
        )

    def clear_efforts(self) -> None:
        """End all efforts on the joint, in all worlds."""
        simulation = self._simulation
        simulation.requests.call(lambda: simulation.loads.clear_joint(self.name))

    def positions(self, worlds: Worlds | None = None) -> Floats:
        """Positions of all axes, shape (n, axes)."""
        return self._engine.joint_position(self.name, worlds)

    def velocities(self, worlds: Worlds | None = None) -> Floats:
        """Velocities of all axes, shape (n, axes)."""
        return self._engine.joint_velocity(self.name, worlds)

    def wrench(self, worlds: Worlds | None = None) -> Wrench:
        """What the child exerts on the parent, about the joint's origin, in the world frame."""
        return self._engine.joint_wrench(self.name, worlds)

    def add_motor(self, max_effort: float) -> None:
        """Put a velocity motor of limited effort [N or N m] on it."""
        self._engine.add_motor(self.name, max_effort)

    def drive(self, velocity: ArrayLike, worlds: Worlds | None = None) -> None:
        """Set what the motor holds [m/s or rad/s], shape () or (n,)."""
        self._engine.set_motor_velocity(self.name, velocity, worlds)

    def set_properties(
        self,
        *,
        damping: ArrayLike | None = None,
        friction: ArrayLike | None = None,
        lower: ArrayLike | None = None,
        upper: ArrayLike | None = None,
        motor_effort: ArrayLike | None = None,
        worlds: Worlds | None = None,
    ) -> None:
        """Change how the joint moves; what is None stays. All shapes: (), (n,) or (n, axes).

        Args:
            damping: Viscous [N s/m or N m s/rad].
            friction: Static [N or N m].
            lower: Lower limit [m or rad]; minus infinity for none.
            upper: Upper limit [m or rad]; infinity for none.
            motor_effort: Largest effort of its motor [N or N m].
            worlds: Which worlds; all if None.

        Raises:
            EngineError: A value cannot be, or there is no motor.
        """
        given = {
            "joint_damping": _column(damping),
            "joint_friction": _column(friction),
            "joint_lower": _column(lower),
            "joint_upper": _column(upper),
            "motor_effort": _column(motor_effort),
        }
        _set_parameters(self._simulation, self.name, given, worlds)


def orientation_of(quaternion: ArrayLike | None, yaw: ArrayLike | None) -> ArrayLike:
    """A quaternion (x, y, z, w), or that of a heading [rad]; upright if neither is given.

    Raises:
        SimulationError: Both are given.
    """
    if quaternion is None:
        return from_yaw(np.asarray(0.0 if yaw is None else yaw, np.float64))
    if yaw is not None:
        raise SimulationError("give a quaternion or a yaw, not both")
    return quaternion


def _set_parameters(
    simulation: Simulation,
    name: str,
    given: Mapping[str, ArrayLike | None],
    worlds: Worlds | None,
) -> None:
    def work() -> None:
        for kind, values in given.items():
            if values is not None:
                simulation.engine.set_parameter(kind, name, values, worlds)

    simulation.requests.call(work)


def _column(value: ArrayLike | None) -> Floats | None:
    return None if value is None else _rows(value)


def _rows(value: ArrayLike) -> Floats:
    array = np.asarray(value, np.float64)
    if array.ndim == 1:
        return array.reshape(-1, 1)
    return array.reshape(1, -1) if array.ndim == 0 else array

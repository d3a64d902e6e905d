"""Links and joints of a model in a running simulation."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Floats, Worlds
from gazelle.description import Inertia, Link, Pose
from gazelle.engines import Motion, Placement, Wrench
from gazelle.errors import Error, SimulationError
from gazelle.rotations import from_yaw
from gazelle.simulation.inputs import VECTORS, chosen, finite, motion, numbers, placement, size_of

if TYPE_CHECKING:
    from gazelle.simulation.simulation import Simulation


_LIMITS = ("joint_lower", "joint_upper")


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
            SimulationError: A value cannot be, or both a quaternion and a heading are given.
        """
        some = chosen(worlds, self._engine.nworld)
        turned = orientation_of(quaternion, yaw)
        place = placement(self.name, position, turned, size_of(some, self._engine.nworld))
        self._simulation.requests.call(
            lambda: self._engine.set_link_placement(self.name, *place, some)
        )

    def set_twist(
        self, linear: ArrayLike, angular: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Give the link a velocity in the world frame [m/s, rad/s], shape (3,) or (n, 3).

        The joints of what hangs together with it keep their speeds.

        Raises:
            SimulationError: A value cannot be.
        """
        some = chosen(worlds, self._engine.nworld)
        twist = motion(self.name, linear, angular, size_of(some, self._engine.nworld))
        self._simulation.requests.call(
            lambda: self._engine.set_link_motion(self.name, *twist, some)
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
        some = chosen(worlds, simulation.nworld)
        count = size_of(some, simulation.nworld)
        push = numbers("a force", force, 3, count), numbers("a torque", torque, 3, count)
        where = None if point is None else finite("the point of a force", point, 3, count)
        simulation.requests.call(
            lambda: simulation.loads.push(
                self.name,
                *push,
                point=where,
                frame="" if frame is None else frame.name,
                follow=follow,
                start=start,
                duration=duration,
                worlds=some,
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
            "link_mass": mass,
            "link_centre": centre,
            "link_inertia": inertia,
            "link_gravity": gravity,
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
        """Position of the first axis [m or rad].

        Setting it teleports the joint, to its limits at most, as in Gazebo. It takes a number
        an axis, of a ball joint a quaternion (x, y, z, w).
        """
        return float(self._engine.joint_position(self.name, np.array([0]))[0, 0])

    @position.setter
    def position(self, value: ArrayLike) -> None:
        width = self.positions(np.array([0])).shape[1]
        what = f"the position of joint '{self.name}'"
        self._engine.set_joint_position(self.name, finite(what, value, width, self._engine.nworld))

    @property
    def velocity(self) -> float:
        """Velocity of the first axis [m/s or rad/s]; setting it changes the state at once."""
        return float(self._engine.joint_velocity(self.name, np.array([0]))[0, 0])

    @velocity.setter
    def velocity(self, value: ArrayLike) -> None:
        what, nworld = f"the velocity of joint '{self.name}'", self._engine.nworld
        given = finite(what, value, self.axes, nworld, alike=True)
        self._engine.set_joint_velocity(self.name, given)

    @property
    def effort(self) -> None:
        """Write only: effort applied until told otherwise [N or N m]."""
        raise SimulationError(f"the effort on joint '{self.name}' is measured by a force sensor")

    @effort.setter
    def effort(self, value: ArrayLike) -> None:
        self._simulation.loads.set_lasting(self.name, self._effort_of(value, None))

    @property
    def axes(self) -> int:
        """How many ways the joint can move: numbers of a velocity or an effort."""
        return int(self._engine.joint_velocity(self.name, np.array([0])).shape[1])

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
        some = chosen(worlds, self._engine.nworld)
        rows = self._effort_of(effort, some)
        simulation.requests.call(
            lambda: simulation.loads.turn(self.name, rows, start, duration, some)
        )

    def clear_efforts(self) -> None:
        """End all efforts on the joint, in all worlds."""
        simulation = self._simulation
        simulation.requests.call(lambda: simulation.loads.clear_joint(self.name))

    def _effort_of(self, values: ArrayLike, worlds: Worlds | None) -> Floats:
        """Efforts of the right shape. One that is not finite breaks its own world, no other."""
        count = size_of(worlds, self._engine.nworld)
        return numbers(f"the effort on joint '{self.name}'", values, self.axes, count, alike=True)

    def positions(self, worlds: Worlds | None = None) -> Floats:
        """Positions of all axes, shape (n, axes); of ball joints quaternions, shape (n, 4)."""
        return self._engine.joint_position(self.name, worlds)

    def velocities(self, worlds: Worlds | None = None) -> Floats:
        """Velocities of all axes, shape (n, axes)."""
        return self._engine.joint_velocity(self.name, worlds)

    def wrench(self, worlds: Worlds | None = None) -> Wrench:
        """What the child exerts on the parent, about the joint's origin, in the world frame."""
        return self._engine.joint_wrench(self.name, worlds)

    def add_motor(self, max_effort: ArrayLike) -> None:
        """Put a velocity motor on it that holds still until ``drive``.

        Args:
            max_effort: Of all axes or of each [N or N m], shape () or (axes,).

        Raises:
            EngineError: It has no axis that a motor could turn, or an effort cannot be.
        """
        self._engine.add_motor(self.name, max_effort)

    def motor_effort(self, worlds: Worlds | None = None) -> Floats:
        """Largest efforts of its motor [N or N m], shape (n, axes).

        Raises:
            EngineError: There is no motor on it.
        """
        return self._engine.parameter("motor_effort", self.name, worlds)

    @property
    def has_motor(self) -> bool:
        """Whether there is a velocity motor on it."""
        calls = (call for call in self._engine.history() if call.method == "add_motor")
        return any(call.arguments[0] == self.name for call in calls)

    def drive(self, velocity: ArrayLike, worlds: Worlds | None = None) -> None:
        """Set what the motor holds [m/s or rad/s]: () or (n,), of several axes (n, axes)."""
        try:
            self._engine.set_motor_velocity(self.name, velocity, worlds)
        except (TypeError, ValueError) as error:
            raise SimulationError(
                f"the velocity of the motor on '{self.name}' cannot be {velocity!r}: {error}",
                hint="give a number, one for each world, or a row of axes for each world",
            ) from None

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
            EngineError: A value cannot be, or there is no motor; nothing is changed.
            SimulationError: The lower limit would be above the upper.
        """
        given = {
            "joint_damping": damping,
            "joint_friction": friction,
            "joint_lower": lower,
            "joint_upper": upper,
            "motor_effort": motor_effort,
        }
        _set_parameters(self._simulation, self.name, given, worlds)


def orientation_of(quaternion: ArrayLike | None, yaw: ArrayLike | None) -> ArrayLike:
    """A quaternion (x, y, z, w), or that of a heading [rad]; upright if neither is given.

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
    except (TypeError, ValueError):
        raise SimulationError(f"a heading must be numbers [rad], not {yaw!r}") from None


def _set_parameters(
    simulation: Simulation,
    name: str,
    given: Mapping[str, ArrayLike | None],
    worlds: Worlds | None,
) -> None:
    """Set several parameters, or none of them if one cannot be."""
    engine = simulation.engine
    some = chosen(worlds, simulation.nworld)
    wanted = {kind: values for kind, values in given.items() if values is not None}

    def work() -> None:
        before: dict[str, Floats] = {}
        try:
            for kind, values in wanted.items():
                old = engine.parameter(kind, name, some)
                what, alike = f"the {kind} of '{name}'", kind not in VECTORS
                rows = numbers(what, values, old.shape[1], len(old), alike=alike)
                engine.set_parameter(kind, name, rows, some)
                before[kind] = old
            if not before.keys().isdisjoint(_LIMITS):
                _check_limits(simulation, name, some)
        except Error:
            for kind, old in before.items():
                engine.set_parameter(kind, name, old, some)
            raise

    simulation.requests.call(work)


def _check_limits(simulation: Simulation, joint: str, worlds: Worlds | None) -> None:
    lower, upper = (simulation.engine.parameter(kind, joint, worlds) for kind in _LIMITS)
    if (lower > upper).any():
        low, high = lower[lower > upper][0], upper[lower > upper][0]
        raise SimulationError(
            f"the lower limit of joint '{joint}' would be {low:g}, above the upper one, {high:g}"
        )
